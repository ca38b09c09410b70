# Shared by the tests of this folder.

# run(COMMAND...): its output in `output`; a failure ends the test.
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

# check_play_notes(PROGRAM): the example says what it should.
macro(check_play_notes program)
  run(${program})
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
endmacro()
