# Compiles and runs tests/header by COMPILER as hosts of many kinds do, in WORK. A warning is an error.
cmake_minimum_required(VERSION 3.25)
if(NOT COMPILER)
  message("skipped: ${NAME} is not there")
  return()
endif()
set(warnings -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow -Wold-style-cast -Wcast-align -Wcast-qual
    -Wdouble-promotion -Wundef -Wnon-virtual-dtor -Woverloaded-virtual -Wformat=2 -Wmissing-declarations -Werror)
if(NAME STREQUAL gcc)
  list(APPEND warnings -Wuseless-cast -Wlogical-op -Wduplicated-cond -Wduplicated-branches -Wextra-semi)
else()
  list(APPEND warnings -Weverything -Wno-c++98-compat -Wno-c++98-compat-pedantic -Wno-padded -Wno-float-equal
       -Wno-unknown-warning-option -Wno-unsafe-buffer-usage -Wno-switch-default
       -Wno-reserved-macro-identifier)
endif()
file(MAKE_DIRECTORY ${WORK})
set(here ${CMAKE_CURRENT_LIST_DIR})

function(try_host what standard)
    execute_process(COMMAND ${COMPILER} -std=${standard} ${warnings} ${ARGN} -isystem ${here}/fuzz -I${here}/../cpp/include
      ${here}/header/one.cpp ${here}/header/two.cpp -o ${WORK}/host
    RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(failed OR said)
    message(FATAL_ERROR "${what}: ${said}")
  endif()
  execute_process(COMMAND ${WORK}/host ${WORK}/small.fmap RESULT_VARIABLE failed ERROR_VARIABLE said)
  if(failed)
    message(FATAL_ERROR "${what}: ${failed} ${said}")
  endif()
  message("ok: ${what}")
endfunction()

try_host("C++17" c++17 -O2)
try_host("C++17, not optimised" c++17 -O0 -g)
try_host("C++20" c++20 -O2)
try_host("without exceptions and type information" c++17 -O2 -fno-exceptions -fno-rtti)
try_host("with -ffast-math" c++17 -O3 -ffast-math)
try_host("by the rules of another compiler, under windows.h" c++17 -O2 -DAS_ON_WINDOWS -Wno-builtin-macro-redefined)
file(WRITE ${WORK}/narrow.cpp "#include <string>\nint main() { return static_cast<int>(std::string().size()); }\n")
execute_process(COMMAND ${COMPILER} -m32 ${WORK}/narrow.cpp -o ${WORK}/narrow
  RESULT_VARIABLE failed OUTPUT_QUIET ERROR_QUIET)
if(failed)
  message("skipped: ${NAME} has no 32-bit library here")
else()
  set(narrow "")
  if(NAME STREQUAL gcc)
    set(narrow -Wno-useless-cast) # some are of use in 64 bits
  endif()
  try_host("32 bits" c++17 -O2 -m32 ${narrow})
  try_host("32 bits, SSE2" c++17 -O2 -m32 -msse2 -mfpmath=sse ${narrow})
endif()
