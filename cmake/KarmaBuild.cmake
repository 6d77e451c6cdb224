# Compiler settings that hold for every target of this project, and for no one else's.
if(NOT KARMA_PRECISION MATCHES "^(single|double)$")
  message(FATAL_ERROR "KARMA_PRECISION is '${KARMA_PRECISION}': it must be single or double")
endif()
get_property(has_configurations GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
set(release_options "")
if(NOT CMAKE_BUILD_TYPE AND NOT has_configurations)
  message(STATUS "Karma: no build type is given (CMAKE_BUILD_TYPE): it counts as Release")
  if(PROJECT_IS_TOP_LEVEL)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
  else() # another project's build type is its own
    foreach(lang C CXX)
      separate_arguments(options UNIX_COMMAND "${CMAKE_${lang}_FLAGS_RELEASE}")
      list(APPEND release_options "$<$<COMPILE_LANGUAGE:${lang}>:${options}>")
    endforeach()
  endif()
endif()

# Two classes of checks, both off in what is shipped: with both, programs take 10 to 25 % longer, and end at the first
# assertion that is broken.
#
#     KARMA_CHECK      macro KARMA_CHECK: handles     macro KARMA_ASSERT: assertions
#                      are looked up                  (MeAssert.h)
#     ON               1                              1
#     OFF              0                              0
#     AUTO, the default, by the build type:
#       Debug          1                              1
#       RelWithDebInfo 0                              1
#       any other      0                              0
#
# Of the assertions there are two levels. Those that cost more than what they check (MEVALIDATE) are on where KARMA_VALIDATE
# says so too: ON, OFF, or AUTO, the default, in Debug.
string(TOUPPER "${KARMA_CHECK}" check)
if(check STREQUAL AUTO)
  set(checks $<CONFIG:Debug>)
  set(assertions $<CONFIG:Debug,RelWithDebInfo>)
elseif(check MATCHES "^(ON|TRUE|YES|1)$")
  set(checks 1)
  set(assertions 1)
elseif(check MATCHES "^(OFF|FALSE|NO|0)$")
  set(checks 0)
  set(assertions 0)
else()
  message(FATAL_ERROR "KARMA_CHECK is '${KARMA_CHECK}': it must be AUTO, ON or OFF")
endif()

string(TOUPPER "${KARMA_VALIDATE}" validate)
if(validate STREQUAL AUTO)
  set(validations $<CONFIG:Debug>)
elseif(validate MATCHES "^(ON|TRUE|YES|1)$")
  set(validations 1)
elseif(validate MATCHES "^(OFF|FALSE|NO|0)$")
  set(validations 0)
else()
  message(FATAL_ERROR "KARMA_VALIDATE is '${KARMA_VALIDATE}': it must be AUTO, ON or OFF")
endif()

set(CMAKE_C_STANDARD 11)
set(CMAKE_CXX_STANDARD 17)
foreach(lang C CXX)
  set(CMAKE_${lang}_STANDARD_REQUIRED ON)
  set(CMAKE_${lang}_EXTENSIONS OFF)
  set(CMAKE_${lang}_VISIBILITY_PRESET hidden)
endforeach()
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

# Linked to privately by every target of this project.
add_library(karma_settings INTERFACE)
target_compile_options(karma_settings INTERFACE ${release_options})
# Tests reckon in double; what they call rounds. Clang still warns of numbers with a fraction that become integers.
set(in_tests $<STREQUAL:$<TARGET_PROPERTY:FOLDER>,tests>)
set(quiet_in_tests $<$<AND:${in_tests},$<C_COMPILER_ID:GNU>>:-Wno-float-conversion>
  $<$<AND:${in_tests},$<C_COMPILER_ID:Clang,AppleClang>>:-Wno-implicit-float-conversion>)
# No fused multiply-add behind our back: the same bits on every machine and at every optimization level.
target_compile_options(karma_settings INTERFACE -ffp-contract=off -fno-math-errno
  -Wall -Wextra -Wshadow -Wconversion -Wpointer-arith -Wundef -Wvla ${quiet_in_tests}
  $<$<COMPILE_LANGUAGE:C>:-Wstrict-prototypes -Wmissing-prototypes -Wold-style-definition>)
# For the libraries only: before C23 the language warns of every MeMatrix3 passed as const MeMatrix3, in programs too.
set(KARMA_LIBRARY_OPTIONS -Wpedantic)
# GCC tuned for any x86 copies and clears small records by `rep movs` and `rep stos`, which are slow to start; moves are
# faster, and the C library for what is larger. Exact rag dolls (bench/dolls --exact) take 3.5 % less time; a limit of
# 32 bytes instead of 128 makes no difference.
include(CheckCCompilerFlag)
set(copies unrolled_loop:128:noalign,libcall:-1:noalign)
check_c_compiler_flag(-mmemcpy-strategy=${copies} KARMA_CAN_CHOOSE_COPIES)
if(KARMA_CAN_CHOOSE_COPIES)
  target_compile_options(karma_settings INTERFACE
    $<$<COMPILE_LANGUAGE:C>:-mmemcpy-strategy=${copies} -mmemset-strategy=${copies}>)
endif()
if(KARMA_WERROR)
  target_compile_options(karma_settings INTERFACE -Werror)
endif()
target_compile_definitions(karma_settings INTERFACE KARMA_CHECK=${checks} KARMA_ASSERT=${assertions}
  KARMA_VALIDATE=${validations})
if(KARMA_SANITIZE)
  target_compile_options(karma_settings INTERFACE
    -fsanitize=${KARMA_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(karma_settings INTERFACE -fsanitize=${KARMA_SANITIZE})
endif()
