# Run by ctest: the library as a folder of another project (parent/), which checks that nothing is set for it. All ways
# but the last are configured alone; the first has what would do harm if it leaked. One lane per vector and several files in a
# unit: a fraction of the time to compile.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)

# configure_parent(FOLDER ARGUMENT...): and the parent's own file is compiled with the parent's flags alone.
function(configure_parent folder)
  file(REMOVE ${folder}/CMakeCache.txt)
  run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/parent -B ${folder} -G ${GENERATOR} -D CMAKE_CXX_COMPILER=${CXX}
      -D CMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER} -D CMAKE_EXPORT_COMPILE_COMMANDS=ON -D JAWARI_FOLDER=${SOURCE_DIR}
      -D JAWARI_SCALAR_KERNELS=ON -D CMAKE_FIND_USE_PACKAGE_REGISTRY=OFF ${ARGN})
  file(STRINGS ${folder}/compile_commands.json command REGEX "\"command\".* -o CMakeFiles/own\\.dir")
  expect(command MATCHES "own\\.cpp")
  string(REGEX MATCHALL " -[^oc][^ ]*" options "${command}")
  if(NOT options STREQUAL "${EXPECTED_OPTIONS}")
    message(FATAL_ERROR "the parent's own file is compiled with\"${options}\": ${command}")
  endif()
endfunction()

configure_parent(${WORK_DIR}/fetched -D FETCH=ON -D JAWARI_SANITIZE=undefined -D JAWARI_WARNINGS_AS_ERRORS=ON
                 -D CMAKE_DISABLE_FIND_PACKAGE_hwy=ON)
configure_parent(${WORK_DIR}/own_highway -D OWN_HIGHWAY=ON)
set(EXPECTED_OPTIONS " -ffast-math")  # the library compiles all the same, with its own arithmetic
configure_parent(${WORK_DIR}/added -D CMAKE_CXX_FLAGS=-ffast-math -D CMAKE_UNITY_BUILD=ON -D CMAKE_UNITY_BUILD_BATCH_SIZE=8)
run(${CMAKE_COMMAND} --build ${WORK_DIR}/added)
check_play_notes(${WORK_DIR}/added/play_notes)
