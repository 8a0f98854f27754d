# `find_package(stipple)` gives stipple::octree and stipple::render.
include(CMakePackageConfigHelpers)

install(TARGETS stipple_octree stipple_render EXPORT stippleTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY octree render DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/stipple FILES_MATCHING PATTERN "*.h")
install(EXPORT stippleTargets NAMESPACE stipple:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/stipple)

configure_package_config_file(cmake/stippleConfig.cmake.in ${CMAKE_BINARY_DIR}/stippleConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/stipple)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/stippleConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/stippleConfig.cmake ${CMAKE_BINARY_DIR}/stippleConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/stipple)
