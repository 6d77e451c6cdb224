# pkg-config files (one per library, and karma.pc for everything) and the CMake package.
include(CMakePackageConfigHelpers)

# Nothing is installed where nobody said, as into the default /usr/local by an empty --prefix.
set(KARMA_NO_PREFIX /no-prefix-was-given)
if(PROJECT_IS_TOP_LEVEL AND CMAKE_INSTALL_PREFIX_INITIALIZED_TO_DEFAULT)
  set_property(CACHE CMAKE_INSTALL_PREFIX PROPERTY VALUE ${KARMA_NO_PREFIX})
endif()
include(GNUInstallDirs)

# Before all other rules. Where another project is installed is not ours to say.
function(karma_guard_install)
  if(PROJECT_IS_TOP_LEVEL)
    install(CODE "set(KARMA_SOURCE \"${PROJECT_SOURCE_DIR}\")\nset(KARMA_NO_PREFIX ${KARMA_NO_PREFIX})" ALL_COMPONENTS)
    install(SCRIPT ${PROJECT_SOURCE_DIR}/cmake/KarmaInstallGuard.cmake ALL_COMPONENTS)
  endif()
endfunction()

# karma_pkgconfig(<library> <description> <Karma libraries it needs> <system libraries it needs>)
function(karma_pkgconfig name description depends system)
  set(requires "")
  foreach(dep ${depends})
    string(TOLOWER karma-${dep}${KARMA_PC_SUFFIX} dep)
    list(APPEND requires ${dep})
  endforeach()
  list(JOIN requires " " requires)
  list(TRANSFORM system PREPEND -l)
  list(JOIN system " " system)
  # A static library cannot bring its own dependencies along: the program must name them.
  set(libs "-l${name}${KARMA_SUFFIX}")
  set(libs_private "")
  if(BUILD_SHARED_LIBS)
    set(libs_private "${system}")
  else()
    string(APPEND libs " ${system}")
  endif()
  set(cflags "")
  if(KARMA_PRECISION STREQUAL double)
    set(cflags " -D_ME_API_DOUBLE=1")
  endif()
  string(TOLOWER karma-${name}${KARMA_PC_SUFFIX}.pc file)
  karma_write_pc(${file} ${name} "${description}" "${requires}" "-L\${libdir} ${libs}" "${libs_private}" "-I\${includedir}${cflags}")
endfunction()

function(karma_write_pc file title description requires libs libs_private cflags)
  file(RELATIVE_PATH up ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
  set(text "prefix=\${pcfiledir}/${up}\n")
  string(APPEND text "libdir=\${prefix}/${CMAKE_INSTALL_LIBDIR}\nincludedir=\${prefix}/${KARMA_INCLUDEDIR}\n\n")
  string(APPEND text "Name: Karma ${title} (${KARMA_PRECISION} precision)\nDescription: ${description}\n")
  string(APPEND text "Version: ${PROJECT_VERSION}\n")
  foreach(field "Requires:${requires}" "Libs:${libs}" "Libs.private:${libs_private}" "Cflags:${cflags}")
    string(REGEX MATCH "^([^:]+):(.*)$" _ "${field}")
    if(NOT CMAKE_MATCH_2 STREQUAL "")
      string(APPEND text "${CMAKE_MATCH_1}: ${CMAKE_MATCH_2}\n")
    endif()
  endforeach()
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/${file} CONTENT "${text}" @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${file} DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()

# The CMake package: Karma::<library> are the single-precision targets, KarmaDouble::<library> the double ones.
# Static and shared builds write files of different names, so that all four can be installed into one prefix.
function(karma_install)
  get_property(libraries GLOBAL PROPERTY KARMA_LIBRARIES)
  set(requires "")
  foreach(name ${libraries})
    string(TOLOWER karma-${name}${KARMA_PC_SUFFIX} pc)
    list(APPEND requires ${pc})
  endforeach()
  list(REVERSE requires)
  list(JOIN requires " " requires)
  karma_write_pc(karma${KARMA_PC_SUFFIX}.pc "SDK" "All Karma libraries" "${requires}" "" "" "")

  set(destination ${CMAKE_INSTALL_LIBDIR}/cmake/Karma)
  set(linkage static)
  if(BUILD_SHARED_LIBS)
    set(linkage shared)
  endif()
  install(EXPORT Karma NAMESPACE ${KARMA_NAMESPACE}:: DESTINATION ${destination}
    FILE KarmaTargets-${KARMA_PRECISION}-${linkage}.cmake)
  configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/KarmaConfig.cmake.in
    ${PROJECT_BINARY_DIR}/KarmaConfig.cmake INSTALL_DESTINATION ${destination})
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/KarmaConfigVersion.cmake COMPATIBILITY SameMajorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/KarmaConfig.cmake ${PROJECT_BINARY_DIR}/KarmaConfigVersion.cmake
    DESTINATION ${destination})
  # Pages with their pictures, as they link to each other, and what a reader copies from.
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md
    ${PROJECT_SOURCE_DIR}/CONTRIBUTING.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION ${CMAKE_INSTALL_DOCDIR} PATTERN "Doxyfile.in" EXCLUDE)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/tutorials DESTINATION ${CMAKE_INSTALL_DATADIR}/karma
    FILES_MATCHING PATTERN "*.c" PATTERN "*.h" PATTERN "browser" EXCLUDE PATTERN "menu" EXCLUDE)
endfunction()
