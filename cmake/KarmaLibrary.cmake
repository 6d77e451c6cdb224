# karma_library(<name> DESCRIPTION <text> SOURCES ... HEADERS ...
#               [DEPENDS <Karma libraries>] [SYSTEM <libraries private to it>])
#
# One Karma library: target <name>, alias Karma::<name>, installed with its headers, its CMake target
# and its pkg-config file. Its objects are also to be had as <name>_objects, for tests of what it hides.
# Double-precision libraries are called lib<name>_double, so that both can stand side by side.

if(KARMA_PRECISION STREQUAL double)
  set(KARMA_SUFFIX _double)
  set(KARMA_PC_SUFFIX -double)
  set(KARMA_NAMESPACE KarmaDouble)
else()
  set(KARMA_SUFFIX "")
  set(KARMA_PC_SUFFIX "")
  set(KARMA_NAMESPACE Karma)
endif()
set(KARMA_INCLUDEDIR ${CMAKE_INSTALL_INCLUDEDIR}/karma)

function(karma_library name)
  cmake_parse_arguments(ARG "" "DESCRIPTION" "SOURCES;HEADERS;DEPENDS;SYSTEM" ${ARGN})
  list(TRANSFORM ARG_HEADERS PREPEND include/ OUTPUT_VARIABLE headers)
  list(TRANSFORM ARG_SOURCES PREPEND src/ OUTPUT_VARIABLE sources)

  add_library(${name}_objects OBJECT ${sources} ${headers})
  target_include_directories(${name}_objects
    PUBLIC ${CMAKE_CURRENT_SOURCE_DIR}/include PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
  target_link_libraries(${name}_objects PRIVATE karma_settings INTERFACE ${ARG_SYSTEM})
  target_compile_options(${name}_objects PRIVATE ${KARMA_LIBRARY_OPTIONS})
  if(KARMA_PRECISION STREQUAL double)
    target_compile_definitions(${name}_objects PUBLIC _ME_API_DOUBLE=1)
  endif()
  foreach(dep ${ARG_DEPENDS})
    target_link_libraries(${name}_objects PUBLIC ${dep}_headers)
  endforeach()

  # What a dependent library needs to compile: headers and definitions, no code.
  add_library(${name}_headers INTERFACE)
  target_include_directories(${name}_headers INTERFACE ${CMAKE_CURRENT_SOURCE_DIR}/include)
  foreach(dep ${ARG_DEPENDS})
    target_link_libraries(${name}_headers INTERFACE ${dep}_headers)
  endforeach()

  add_library(${name} $<TARGET_OBJECTS:${name}_objects>)
  add_library(Karma::${name} ALIAS ${name})
  set_target_properties(${name} PROPERTIES
    OUTPUT_NAME ${name}${KARMA_SUFFIX} VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}
    EXPORT_NAME ${name} LINKER_LANGUAGE C
    INSTALL_RPATH $ORIGIN) # in any prefix, they find each other
  target_include_directories(${name} INTERFACE
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${KARMA_INCLUDEDIR}>)
  if(KARMA_PRECISION STREQUAL double)
    target_compile_definitions(${name} INTERFACE _ME_API_DOUBLE=1)
  endif()
  target_link_libraries(${name} PUBLIC ${ARG_DEPENDS} PRIVATE $<BUILD_INTERFACE:karma_settings> ${ARG_SYSTEM})

  set_property(GLOBAL APPEND PROPERTY KARMA_LIBRARIES ${name})
  set_property(TARGET ${name} PROPERTY KARMA_HEADERS ${ARG_HEADERS})
  install(TARGETS ${name} EXPORT Karma
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(FILES ${headers} DESTINATION ${KARMA_INCLUDEDIR})
  karma_pkgconfig(${name} "${ARG_DESCRIPTION}" "${ARG_DEPENDS}" "${ARG_SYSTEM}")
endfunction()
