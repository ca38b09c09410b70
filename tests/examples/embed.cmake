# Run by ctest: install -> configure -> build -> run -> check what the examples print. Once with CMake's package and
# Highway's, once with CMake's package and Highway by pkg-config, once with pkg-config alone.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
set(prefix ${WORK_DIR}/prefix)
file(REMOVE_RECURSE ${WORK_DIR})

run(${CMAKE_COMMAND} --install ${BUILD_DIR}/engine --prefix ${prefix})

# configure_examples(FOLDER ARGUMENT...): `pkg_config_finds` counts how often Highway was found that way.
macro(configure_examples folder)
  run(${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${folder} -G ${GENERATOR} -D CMAKE_BUILD_TYPE=Release
      -D CMAKE_CXX_COMPILER=${CXX} -D CMAKE_CXX_FLAGS=${FLAGS} -D CMAKE_PREFIX_PATH=${prefix}
      -D CMAKE_FIND_USE_PACKAGE_REGISTRY=OFF ${ARGN})
  file(STRINGS ${folder}/CMakeCache.txt found REGEX "^JawariHighway_FOUND:INTERNAL=1")
  list(LENGTH found pkg_config_finds)
endmacro()

configure_examples(${WORK_DIR}/build)
if(HIGHWAY_HAS_PACKAGE)
  expect(pkg_config_finds EQUAL 0)
endif()
run(${CMAKE_COMMAND} --build ${WORK_DIR}/build)

run(${WORK_DIR}/build/pluck_string)
message("${output}")
take(steps)
take(impulses)
take(energy_at_start_J)
take(energy_at_end_J)
take(worst_penetration_m)
take(worst_imbalance_ratio)
take(refused)
expect(steps EQUAL 96000)  # 0.1 s at 960 kHz
expect(impulses GREATER 1000)
# A triangle in the continuous flexible string stores T h^2 L/(2 x (L - x)) = 5.4457 mJ; partials beyond the 400th take 0.165 % of
# it away, bending (B sum sin^2(k pi x/L) over pi^2 x (L - x)/(2 L^2)) adds 0.79 %: 5.480 mJ.
expect(energy_at_start_J GREATER 0.005475)
expect(energy_at_start_J LESS 0.005485)
expect(energy_at_end_J LESS energy_at_start_J)
expect(worst_penetration_m LESS 1e-12)
expect(worst_imbalance_ratio LESS 1e-13)
expect(refused STREQUAL "strings[0].contacts[0].position_m: 2 (allowed: 0 to 0.863)")
check_play_notes(${WORK_DIR}/build/play_notes)

# An installed tree that was moved, Highway by pkg-config.
file(RENAME ${prefix} ${WORK_DIR}/moved)
set(prefix ${WORK_DIR}/moved)
configure_examples(${WORK_DIR}/pkg_config_highway -D CMAKE_DISABLE_FIND_PACKAGE_hwy=ON)
expect(pkg_config_finds EQUAL 1)
run(${CMAKE_COMMAND} --build ${WORK_DIR}/pkg_config_highway --target play_notes)
check_play_notes(${WORK_DIR}/pkg_config_highway/play_notes)

# Without CMake.
find_program(PKG_CONFIG pkg-config REQUIRED)
file(GLOB_RECURSE pc ${prefix}/*/jawari.pc)
cmake_path(GET pc PARENT_PATH folder)
set(ENV{PKG_CONFIG_PATH} ${folder})
run(${PKG_CONFIG} --modversion jawari)
expect(output MATCHES "^${VERSION}\n$")
run(${PKG_CONFIG} --cflags --libs jawari)
separate_arguments(flags UNIX_COMMAND "${output}")
run(${CXX} -std=c++20 ${FLAGS} ${SOURCE_DIR}/play_notes.cpp ${flags} -o ${WORK_DIR}/play_notes_pkg_config)
check_play_notes(${WORK_DIR}/play_notes_pkg_config)
