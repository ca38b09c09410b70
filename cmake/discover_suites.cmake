# Writes one CTest test per suite of a GoogleTest program, instead of one per test: under sanitizers the start of a process costs as much as
# most tests do. cmake -D PROGRAM=<file> -D FILE=<to write> -D FOLDER=<of the program> -D PREFIX=<text> -D LABELS=<list>
# -D LEFT_OUT=<patterns of GoogleTest with colons between> -P discover_suites.cmake
cmake_minimum_required(VERSION 3.25)

execute_process(COMMAND ${PROGRAM} --gtest_list_tests --gtest_filter=-${LEFT_OUT} WORKING_DIRECTORY ${FOLDER}
  OUTPUT_VARIABLE listed RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${PROGRAM}: --gtest_list_tests ends with ${result}")
endif()

string(REGEX REPLACE "#[^\n]*" "" listed "${listed}")
string(REPLACE "\n" ";" lines "${listed}")
set(suites "")
foreach(line IN LISTS lines)
  string(STRIP "${line}" name)
  if(line MATCHES "^[^ ].*\\. *$")  # "Suite." and below it "  Test"
    set(suite ${name})
    list(APPEND suites ${suite})
    set(tests_of_${suite} 0)
  elseif(line MATCHES "^  [^ ]")
    math(EXPR tests_of_${suite} "${tests_of_${suite}} + 1")
  endif()
endforeach()

set(text "")
foreach(suite IN LISTS suites)
  string(APPEND text "add_test([=[${PREFIX}${suite}all]=] [=[${PROGRAM}]=] [=[--gtest_filter=${suite}*-${LEFT_OUT}]=])\n")
  # The largest first: at the end the other processors would wait for them.
  string(APPEND text "set_tests_properties([=[${PREFIX}${suite}all]=] PROPERTIES WORKING_DIRECTORY [=[${FOLDER}]=] "
    "COST ${tests_of_${suite}} LABELS [=[${LABELS}]=])\n")
endforeach()
file(WRITE ${FILE} "${text}")
