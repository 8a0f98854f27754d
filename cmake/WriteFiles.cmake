# Run as a script: writes the C++ file that holds the text of all files.
set(text "#include \"${HEADER}\"\n\nnamespace stipple {\n\nstd::string_view ${FUNCTION}(std::string_view name) {\n")
foreach(file ${FILES})
  get_filename_component(name ${file} NAME)
  file(READ ${file} body)
  string(APPEND text "  if (name == \"${name}\") return R\"stipple(${body})stipple\";\n")
endforeach()
string(APPEND text "  return {};\n}\n\n}  // namespace stipple\n")
file(WRITE ${OUT} "${text}")
