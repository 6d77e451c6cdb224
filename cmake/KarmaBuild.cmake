# Compiler settings that hold for every target of this project, and for no one else's.
if(NOT KARMA_PRECISION MATCHES "^(single|double)$")
  message(FATAL_ERROR "KARMA_PRECISION is '${KARMA_PRECISION}': it must be single or double")
endif()
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
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
# No fused multiply-add behind our back: the same bits on every machine and at every optimization level.
target_compile_options(karma_settings INTERFACE -ffp-contract=off -fno-math-errno
  -Wall -Wextra -Wshadow -Wconversion -Wpointer-arith -Wundef -Wvla
  $<$<COMPILE_LANGUAGE:C>:-Wstrict-prototypes -Wmissing-prototypes -Wold-style-definition>)
# For the libraries only: before C23 the language warns of every MeMatrix3 passed as const MeMatrix3, in programs too.
set(KARMA_LIBRARY_OPTIONS -Wpedantic)
# Tuned for every x86 at once, GCC copies and clears small records by `rep movs` and `rep stos`, which take dozens of
# cycles to start: a few moves are faster, and so is the C library from there on.
include(CheckCCompilerFlag)
set(KARMA_COPIES -mmemcpy-strategy=unrolled_loop:128:noalign,libcall:-1:noalign
                 -mmemset-strategy=unrolled_loop:128:noalign,libcall:-1:noalign)
string(REPLACE ";" " " KARMA_COPIES_FLAGS "${KARMA_COPIES}")
check_c_compiler_flag("${KARMA_COPIES_FLAGS}" KARMA_CAN_CHOOSE_COPIES)
if(KARMA_CAN_CHOOSE_COPIES)
  target_compile_options(karma_settings INTERFACE ${KARMA_COPIES})
endif()
if(KARMA_WERROR)
  target_compile_options(karma_settings INTERFACE -Werror)
endif()
if(KARMA_CHECK)
  target_compile_definitions(karma_settings INTERFACE KARMA_CHECK=1)
else()
  target_compile_definitions(karma_settings INTERFACE KARMA_CHECK=0)
endif()
if(KARMA_VALIDATE)
  target_compile_definitions(karma_settings INTERFACE KARMA_VALIDATE=1)
endif()
if(KARMA_SANITIZE)
  target_compile_options(karma_settings INTERFACE
    -fsanitize=${KARMA_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(karma_settings INTERFACE -fsanitize=${KARMA_SANITIZE})
endif()
