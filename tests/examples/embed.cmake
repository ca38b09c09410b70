# Run by ctest: install -> configure -> build -> run -> check what the examples print.
cmake_minimum_required(VERSION 3.25)
set(prefix ${WORK_DIR}/prefix)
file(REMOVE_RECURSE ${WORK_DIR})

function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "${command}: exit code ${result}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

# `key value` in the output -> variable `key`.
function(take key)
  if(NOT output MATCHES "(^|\n)${key} ([^\n]+)")
    message(FATAL_ERROR "no line '${key}' in:\n${output}")
  endif()
  set(${key} "${CMAKE_MATCH_2}" PARENT_SCOPE)
endfunction()

function(expect)
  if(${ARGV})
    return()
  endif()
  list(JOIN ARGV " " condition)
  message(FATAL_ERROR "expected ${condition} in:\n${output}")
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD_DIR}/engine --prefix ${prefix})
run(${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${WORK_DIR}/build -G ${GENERATOR} -D CMAKE_BUILD_TYPE=Release
    -D CMAKE_CXX_COMPILER=${CXX} -D CMAKE_CXX_FLAGS=${FLAGS} -D CMAKE_PREFIX_PATH=${prefix}
    -D CMAKE_FIND_USE_PACKAGE_REGISTRY=OFF)
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

run(${WORK_DIR}/build/play_notes)
message("${output}")
take(first_sound_frame)
take(notes)
take(impulses)
take(peak_soft_note)
take(peak_hard_note)
take(peak_last_block)
take(refused)
expect(first_sound_frame EQUAL 100)  # the event's frame
expect(notes EQUAL 2)
expect(impulses GREATER 0)
expect(peak_soft_note GREATER 0.001)
expect(peak_hard_note GREATER peak_soft_note)
expect(peak_last_block LESS 0.00001)  # 0.53 s after the keys went up
