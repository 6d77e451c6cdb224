# karma_reference(): the target `reference` makes the reference of all public functions, with Doxygen, from the headers and
# docs/; it is installed where it has been made. With KARMA_REFERENCE it is part of every build.
function(karma_reference)
  find_program(KARMA_DOXYGEN doxygen)
  if(NOT KARMA_DOXYGEN)
    if(KARMA_REFERENCE)
      message(STATUS "The reference is not made: doxygen not found; `tools/setup test` installs it")
    endif()
    return()
  endif()
  set(KARMA_REFERENCE_DIRECTORY ${PROJECT_BINARY_DIR}/reference)
  file(MAKE_DIRECTORY ${KARMA_REFERENCE_DIRECTORY})
  configure_file(${PROJECT_SOURCE_DIR}/docs/Doxyfile.in ${KARMA_REFERENCE_DIRECTORY}/Doxyfile @ONLY)
  file(GLOB pages CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/docs/*.md ${PROJECT_SOURCE_DIR}/docs/*/*.md
    ${PROJECT_SOURCE_DIR}/*/include/*.h)
  add_custom_command(OUTPUT ${KARMA_REFERENCE_DIRECTORY}/karma.tag
    COMMAND ${KARMA_DOXYGEN} ${KARMA_REFERENCE_DIRECTORY}/Doxyfile
    DEPENDS ${pages} ${PROJECT_SOURCE_DIR}/README.md ${KARMA_REFERENCE_DIRECTORY}/Doxyfile
    COMMENT "The reference of all public functions, by Doxygen" VERBATIM)
  set(all "")
  if(KARMA_REFERENCE)
    set(all ALL)
  endif()
  add_custom_target(reference ${all} DEPENDS ${KARMA_REFERENCE_DIRECTORY}/karma.tag)
  install(DIRECTORY ${KARMA_REFERENCE_DIRECTORY}/html/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/reference OPTIONAL)
endfunction()
