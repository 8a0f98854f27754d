# Run as a script: writes the C++ file that holds the text of all shaders.
set(text "#include \"render/gpu/shader_source.h\"\n\nnamespace stipple {\n\nstd::span<const EmbeddedShader> embedded_shaders() {\n  static constexpr EmbeddedShader kShaders[] = {\n")
foreach(shader ${SHADERS})
  get_filename_component(name ${shader} NAME)
  file(READ ${shader} body)
  string(APPEND text "      {\"${name}\", R\"glsl(${body})glsl\"},\n")
endforeach()
string(APPEND text "  };\n  return kShaders;\n}\n\n}  // namespace stipple\n")
file(WRITE ${OUT} "${text}")
