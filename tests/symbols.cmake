# Lists every symbol of LIBRARY that is in no namespace of ours, and fails where there is one; fails too where a
# PERMISSIVE library has a symbol of GSL or FFTW.
cmake_minimum_required(VERSION 3.25)
if(SHARED)
  set(table -D)
  # what ASPERITY_EXPORT marks, and what exceptions and their handlers need of it
  set(allowed "^(asperity::|typeinfo for asperity::|typeinfo name for asperity::|vtable for asperity::)")
else()
  set(table -g)
  # Templates of the standard library, and of Eigen under a name of ours: every object that uses them has them. DW.ref
  # is how exception tables find a symbol.
  set(allowed "(^|[ <(*&])(asperity|asperity_eigen|std|__gnu_cxx)::|^DW[.]ref[.]")
endif()
execute_process(COMMAND ${NM} ${table} --defined-only -C ${LIBRARY}
  OUTPUT_VARIABLE found COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE "[][;]" "_" found "${found}") # which mean something to CMake
string(REGEX MATCHALL "[^\n]+" found "${found}")
set(number 0)
set(strange "")
foreach(line IN LISTS found)
  if(line MATCHES "^[0-9a-f]* +([A-Za-z]) (.+)$")
    set(kind ${CMAKE_MATCH_1})
    set(name "${CMAKE_MATCH_2}")
    math(EXPR number "${number} + 1")
    if(NOT name MATCHES "${allowed}" OR name MATCHES "(^|[ <(*&])Eigen::")
      list(APPEND strange "${kind} ${name}")
    elseif(kind MATCHES "[TDBRG]" AND NOT name MATCHES "asperity")
      list(APPEND strange "${kind} ${name}") # no template: defined once, here
    endif()
  endif()
endforeach()
# hidden ones too: a build under a permissive licence has none of GSL's and FFTW's, and the other shows that they are seen
execute_process(COMMAND ${NM} ${LIBRARY} OUTPUT_VARIABLE all ERROR_QUIET)
if(PERMISSIVE AND all MATCHES " [A-Za-z] (gsl|cblas|fftwf?)_[^\n]*")
  message(FATAL_ERROR "a symbol of GSL or FFTW in a library that is to be without:${CMAKE_MATCH_0}")
elseif(NOT PERMISSIVE AND NOT all MATCHES " [A-Za-z] gsl_integration_qag\n")
  message(FATAL_ERROR "${NM} does not show GSL's symbols, which are in the library")
endif()
if(number LESS 50)
  message(FATAL_ERROR "only ${number} symbols in ${LIBRARY}: nm could not read it")
endif()
if(strange)
  list(JOIN strange "\n" strange)
  message(FATAL_ERROR "symbols that a host must not see:\n${strange}")
endif()
message(STATUS "${number} symbols, all of them ours")
