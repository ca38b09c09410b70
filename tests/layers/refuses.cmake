# The check of the layers (cmake/check_layers.cmake) accepts the tree, and refuses copies of it in which one include is wrong.
# cmake -D SOURCE_DIR=... -D WORK_DIR=... -P refuses.cmake
cmake_minimum_required(VERSION 3.25)

# check(LOG RESULT): what the check says of the copy.
function(check log result)
  execute_process(COMMAND ${CMAKE_COMMAND} -D ROOT=${WORK_DIR} -P ${SOURCE_DIR}/cmake/check_layers.cmake
                  OUTPUT_VARIABLE out ERROR_VARIABLE out RESULT_VARIABLE code)
  string(REGEX REPLACE "[ \n]+" " " out "${out}")  # CMake wraps lines
  set(${log} "${out}" PARENT_SCOPE)
  set(${result} ${code} PARENT_SCOPE)
endfunction()

# refuses(FILE LINE EXPECTED): with LINE added to FILE, the check fails and says EXPECTED; without it, it passes again.
function(refuses file line expected)
  if(EXISTS ${WORK_DIR}/${file})
    file(READ ${WORK_DIR}/${file} before)
  endif()
  file(APPEND ${WORK_DIR}/${file} "${line}\n")
  check(log result)
  if(DEFINED before)
    file(WRITE ${WORK_DIR}/${file} "${before}")
  else()
    file(REMOVE ${WORK_DIR}/${file})
  endif()
  string(FIND "${log}" "${expected}" at)
  if(result EQUAL 0)
    message(SEND_ERROR "accepted: ${file} with ${line}")
  elseif(at EQUAL -1)
    message(SEND_ERROR "refused ${file} with ${line}, but does not say\n  ${expected}\nbut\n  ${log}")
  else()
    message(STATUS "refused: ${expected}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK_DIR})
file(MAKE_DIRECTORY ${WORK_DIR}/cmake)
file(COPY ${SOURCE_DIR}/cmake/layers.txt DESTINATION ${WORK_DIR}/cmake)
file(COPY ${SOURCE_DIR}/engine ${SOURCE_DIR}/host DESTINATION ${WORK_DIR} FILES_MATCHING PATTERN "*.h" PATTERN "*.cpp")
check(log result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "the tree itself is refused: ${log}")
endif()

# The bottom of the engine must not know its top.
refuses(engine/src/string/kernels/mode_sums.h "#include \"string/frame/frame.h\""
  "engine/src/string/kernels/mode_sums.h: includes \"string/frame/frame.h\" upward: engine/src/string/frame does not lie below engine/src/string/kernels")
# Strings do not know instruments.
refuses(engine/src/string/frame/frame.cpp "  #  include \"instrument/voice/voice.h\"  // why not"
  "engine/src/string/frame/frame.cpp: includes \"instrument/voice/voice.h\" upward")
# A public header needs no private one.
refuses(engine/include/jawari/jawari.h "#include \"base/square.h\""
  "engine/include/jawari/jawari.h: includes \"base/square.h\" upward")
# Layers of one row do not know each other.
refuses(host/commands/render/options.h "#include \"commands/play/options.h\""
  "host/commands/render/options.h: includes \"commands/play/options.h\" upward")
# The host sees the public headers alone.
refuses(host/player/player.h "#include \"string/frame/frame.h\"" "the host sees the engine's public headers alone")
# Nothing hides from the check: neither a file of no layer, nor a path that names no file.
refuses(engine/src/shed/tool.cpp "int tool;" "engine/src/shed/tool.cpp: in no layer of cmake/layers.txt")
refuses(host/main.cpp "#include \"../engine/src/base/square.h\""
  "host/main.cpp: includes \"../engine/src/base/square.h\"; a path begins at")
refuses(engine/src/base/square.h "#include <instrument/voice/voice.h>"
  "engine/src/base/square.h: includes \"instrument/voice/voice.h\" upward")
refuses(host/main.cpp "#include \"missing.h\"" "host/main.cpp: includes \"missing.h\", which is no file")
# What the operating system alone has is in one file per system.
refuses(host/player/recorder.cpp "#include <unistd.h>" "host/player/recorder.cpp: #include <unistd.h>; the operating system is")
file(REMOVE_RECURSE ${WORK_DIR})
