# Compile options shared by every target of the project.
add_library(jawari_options INTERFACE)
if(MSVC)
  # /fp:precise: fused multiply-adds are written where they are wanted (kernels), never left to the compiler.
  target_compile_options(jawari_options INTERFACE /W4 /permissive- /Zc:__cplusplus /utf-8 /bigobj /fp:precise
    $<$<CXX_COMPILER_ID:Clang>:/clang:-ffp-contract=off>)
  target_compile_definitions(jawari_options INTERFACE NOMINMAX)
else()
  if(NOT PROJECT_IS_TOP_LEVEL)
    # The parent may have -ffast-math; the bounds on contact rest on IEEE arithmetic.
    target_compile_options(jawari_options INTERFACE -fno-fast-math)
  endif()
  target_compile_options(jawari_options INTERFACE -Wall -Wextra -Wconversion -Wshadow -ffp-contract=off)
  # GCC 12 takes `"text" + std::string` for an overlapping copy (GCC bug 105651).
  target_compile_options(jawari_options INTERFACE
    $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>)
  # std::stable_sort of libstdc++ 12 calls a function that is deprecated; clang 19 says so where it is used.
  target_compile_options(jawari_options INTERFACE
    $<$<AND:$<CXX_COMPILER_ID:Clang>,$<VERSION_GREATER_EQUAL:$<CXX_COMPILER_VERSION>,17>>:-Wno-deprecated-declarations>)
endif()
if(JAWARI_WARNINGS_AS_ERRORS)
  target_compile_options(jawari_options INTERFACE $<IF:$<CXX_COMPILER_ID:MSVC>,/WX,-Werror>)
endif()
if(JAWARI_SANITIZE)
  # Of this folder and those below it; whoever links the library links with it (engine/CMakeLists.txt).
  add_compile_options(-fsanitize=${JAWARI_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${JAWARI_SANITIZE})
  add_compile_definitions(JAWARI_SANITIZED)  # tests that a sanitizer slows down or contradicts look at it
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    # A copy of the kernels for each width of vectors; those left out are the same source at a width that is there, and an
    # instrumented kernel takes the longest of all files to compile.
    add_compile_definitions("HWY_DISABLED_TARGETS=(HWY_SSSE3|HWY_SSE4|HWY_AVX3_DL)")
  endif()
endif()
# Several files in one unit: of names in another file, or that GCC would not take for a header's; other builds look.
add_library(jawari_joined_options INTERFACE)
if(NOT MSVC)
  target_compile_options(jawari_joined_options INTERFACE -Wno-shadow $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endif()
if(CMAKE_UNITY_BUILD)
  target_link_libraries(jawari_options INTERFACE jawari_joined_options)
endif()

