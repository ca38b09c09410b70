# One target per layer of the tree, and the check that no layer includes one above it (cmake/layers.txt).

# jawari_keep_apart(FILE...): those that Highway reads once per instruction set share no unit with others (CMAKE_UNITY_BUILD):
# it does so for one file of a unit. These are the loops over modes: under sanitizers, whose builds optimise little, they are half of the
# time of every test that renders. So they are optimised there, and clang leaves out checks of pointers that the address sanitizer makes
# as well (two thirds of the time to compile one of them) and what tells the fuzzers of branches.
function(jawari_keep_apart)
  foreach(source ${ARGN})
    file(STRINGS ${source} of_instruction_sets REGEX "hwy/foreach_target\\.h" LIMIT_COUNT 1)
    if(of_instruction_sets)
      set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
      if(JAWARI_SANITIZE)
        set_property(SOURCE ${source} APPEND PROPERTY COMPILE_OPTIONS -O2 $<$<CXX_COMPILER_ID:Clang>:-fno-sanitize=null,alignment,object-size,pointer-overflow,fuzzer-no-link>)
      endif()
    endif()
  endforeach()
endfunction()

# jawari_layer(NAME OBJECT|STATIC FOLDER SOURCES file... [USES target...] [NEEDS target...]): the sources of one folder as a
# library. USES are the layers below it, which who uses the layer uses too; NEEDS are libraries of its own. The precompiled headers are
# those of the target that JAWARI_LAYER_HEADERS names, if any. With JAWARI_LAYERS_JOINED up to eight files are one unit (JAWARI_JOIN_FILES).
function(jawari_layer name kind folder)
  cmake_parse_arguments(PARSE_ARGV 3 ARG "" "" "SOURCES;USES;NEEDS")
  list(TRANSFORM ARG_SOURCES PREPEND ${folder}/)
  list(FILTER ARG_SOURCES INCLUDE REGEX "\\.cpp$")
  if(NOT ARG_SOURCES)  # headers alone
    add_library(${name} INTERFACE)
    target_link_libraries(${name} INTERFACE ${ARG_USES})
  else()
    add_library(${name} ${kind} ${ARG_SOURCES})
    jawari_keep_apart(${ARG_SOURCES})
    target_link_libraries(${name} PUBLIC ${ARG_USES} PRIVATE ${ARG_NEEDS} jawari_options)
    if(JAWARI_LAYER_HEADERS AND NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)
      target_precompile_headers(${name} REUSE_FROM ${JAWARI_LAYER_HEADERS})
      # GCC 12 takes `"text" + std::string` for a copy out of bounds, and says so of precompiled system headers too (GCC bug 105651).
      target_compile_options(${name} PRIVATE
        $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-stringop-overflow$<SEMICOLON>-Wno-array-bounds>)
    endif()
    if(JAWARI_LAYERS_JOINED AND JAWARI_JOIN_FILES)
      set_target_properties(${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
      target_link_libraries(${name} PRIVATE jawari_joined_options)  # after jawari_options
    endif()
    if(TARGET jawari_layers)
      add_dependencies(${name} jawari_layers)
    endif()
  endif()
endfunction()

# Who builds the library inside another project does not change its tree.
if(NOT PROJECT_IS_TOP_LEVEL)
  return()
endif()

# Runs once per change of a source: an include that runs upward ends the build with its file and line.
file(GLOB_RECURSE JAWARI_LAYERED_FILES CONFIGURE_DEPENDS
  ${PROJECT_SOURCE_DIR}/engine/*.h ${PROJECT_SOURCE_DIR}/engine/*.cpp
  ${PROJECT_SOURCE_DIR}/host/*.h ${PROJECT_SOURCE_DIR}/host/*.cpp)
add_custom_command(OUTPUT ${PROJECT_BINARY_DIR}/layers.stamp
  COMMAND ${CMAKE_COMMAND} -D ROOT=${PROJECT_SOURCE_DIR} -P ${PROJECT_SOURCE_DIR}/cmake/check_layers.cmake
  COMMAND ${CMAKE_COMMAND} -E touch ${PROJECT_BINARY_DIR}/layers.stamp
  DEPENDS ${JAWARI_LAYERED_FILES} ${PROJECT_SOURCE_DIR}/cmake/check_layers.cmake ${PROJECT_SOURCE_DIR}/cmake/layers.txt
  COMMENT "Looking for includes that run upward"
  VERBATIM)
add_custom_target(jawari_layers DEPENDS ${PROJECT_BINARY_DIR}/layers.stamp)
