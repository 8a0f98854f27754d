# stipple_embed_shaders(TARGET DIR): compiles every DIR/*.glsl into TARGET as `stipple::embedded_shaders()`.
function(stipple_embed_shaders target dir)
  file(GLOB shaders CONFIGURE_DEPENDS ${dir}/*.glsl)
  set(generated ${CMAKE_CURRENT_BINARY_DIR}/embedded_shaders.cpp)
  add_custom_command(
    OUTPUT ${generated}
    COMMAND ${CMAKE_COMMAND} -DOUT=${generated} "-DSHADERS=${shaders}" -P ${PROJECT_SOURCE_DIR}/cmake/WriteShaders.cmake
    DEPENDS ${shaders} ${PROJECT_SOURCE_DIR}/cmake/WriteShaders.cmake
    COMMENT "Embedding shaders"
    VERBATIM)
  target_sources(${target} PRIVATE ${generated})
endfunction()
