# Writes a C++ source with the text of every presets/KIND/**/NAME.json, as read by base/builtin.h; presets/NAME.schema.json has the kind
# "schemas".
function(jawari_embed_presets OUTPUT)
  set(root ${PROJECT_SOURCE_DIR}/presets)
  file(GLOB_RECURSE files CONFIGURE_DEPENDS RELATIVE ${root} ${root}/*.json)
  list(SORT files)
  set(table "")
  foreach(file IN LISTS files)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${root}/${file})
    if(file MATCHES "^([^/]+)\\.schema\\.json$")
      set(kind "schemas")
      set(name "${CMAKE_MATCH_1}")
    elseif(file MATCHES "^([^/]+)/(.+)\\.json$")
      set(kind "${CMAKE_MATCH_1}")
      set(name "${CMAKE_MATCH_2}")
    else()
      message(FATAL_ERROR "presets/${file}: expected presets/KIND/NAME.json")
    endif()
    file(READ ${root}/${file} text)
    string(APPEND table "    {\"${kind}\", \"${name}\", R\"preset(${text})preset\"},\n")
  endforeach()
  string(CONCAT source
    "// Generated from presets/. Do not edit.\n#include \"base/builtin.h\"\n\n#include <cstddef>\n\nnamespace jawari::host {\n\n"
    "extern const BuiltinFile builtin_table[];\nextern const std::size_t builtin_table_size;\n\n"
    "const BuiltinFile builtin_table[] = {\n${table}};\n"
    "const std::size_t builtin_table_size = sizeof(builtin_table) / sizeof(builtin_table[0]);\n\n"
    "}  // namespace jawari::host\n")
  set(old "")
  if(EXISTS ${OUTPUT})
    file(READ ${OUTPUT} old)
  endif()
  if(NOT old STREQUAL source)
    file(WRITE ${OUTPUT} "${source}")
  endif()
endfunction()
