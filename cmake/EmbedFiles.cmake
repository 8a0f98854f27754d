# stipple_embed_files(TARGET HEADER FUNCTION FILE...): compiles the files into TARGET as
# `std::string_view stipple::FUNCTION(std::string_view name)`, which HEADER declares; a name is that of a file without its
# folder, any other gives nothing.
function(stipple_embed_files target header function)
  set(generated ${CMAKE_CURRENT_BINARY_DIR}/${function}.cpp)
  add_custom_command(
    OUTPUT ${generated}
    COMMAND ${CMAKE_COMMAND} -DOUT=${generated} -DHEADER=${header} -DFUNCTION=${function} "-DFILES=${ARGN}"
      -P ${PROJECT_SOURCE_DIR}/cmake/WriteFiles.cmake
    DEPENDS ${ARGN} ${PROJECT_SOURCE_DIR}/cmake/WriteFiles.cmake
    COMMENT "Embedding files for ${function}"
    VERBATIM)
  target_sources(${target} PRIVATE ${generated})
  set_source_files_properties(${generated} PROPERTIES SKIP_PRECOMPILE_HEADERS ON SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()
