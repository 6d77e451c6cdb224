# karma_find_tests(<variable>): are the tests to be built? KARMA_TESTS is
#   AUTO     where Karma is a project of its own and Check and Python are there; a status line says what is missing,
#   ON       yes: what is missing is an error, as in the presets of CI,
#   THREADS  the same, but only those of threads, as with ThreadSanitizer,
#   FUZZ     the same, but only the fuzzers,
#   OFF      no.
function(karma_find_tests variable)
  set(${variable} OFF PARENT_SCOPE)
  if(NOT KARMA_TESTS OR (KARMA_TESTS STREQUAL AUTO AND NOT PROJECT_IS_TOP_LEVEL))
    return()
  endif()
  find_package(PkgConfig QUIET)
  if(PkgConfig_FOUND)
    pkg_check_modules(CHECK QUIET IMPORTED_TARGET GLOBAL check)
  endif()
  find_package(Python3 QUIET COMPONENTS Interpreter)
  set(missing "")
  if(NOT CHECK_FOUND)
    list(APPEND missing "Check")
  endif()
  if(NOT Python3_FOUND)
    list(APPEND missing "Python 3")
  endif()
  list(JOIN missing " and " missing)
  set(remedy "`tools/setup test` installs what tests need")
  if(missing STREQUAL "")
    set(${variable} ON PARENT_SCOPE)
  elseif(KARMA_TESTS STREQUAL AUTO)
    message(STATUS "Tests are not built: ${missing} not found; ${remedy}")
  else()
    message(FATAL_ERROR "KARMA_TESTS is ${KARMA_TESTS}, but ${missing} not found; ${remedy}")
  endif()
endfunction()
