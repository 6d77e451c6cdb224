# Run by `cmake --install` before it writes anything: is the prefix a place for that? Given: KARMA_SOURCE, the checkout, and
# KARMA_NO_PREFIX, the prefix if nobody says one, which an empty --prefix means, too. With an empty $HOME, "$HOME/karma" is
# a new directory in the root directory.
function(karma_refuse_prefix why)
  message(FATAL_ERROR "Karma is not installed: ${why}. Say where: cmake --install BUILD --prefix DIRECTORY")
endfunction()

set(prefix "${CMAKE_INSTALL_PREFIX}")
if(prefix STREQUAL KARMA_NO_PREFIX)
  karma_refuse_prefix("no prefix is given, or an empty one")
elseif("$ENV{DESTDIR}${prefix}" STREQUAL "") # CMake has taken a slash from its end
  karma_refuse_prefix("the prefix is the root directory")
endif()
get_filename_component(there "$ENV{DESTDIR}${prefix}" ABSOLUTE)
while(NOT EXISTS "${there}")
  get_filename_component(there "${there}" DIRECTORY)
endwhile()
get_filename_component(there "${there}" REALPATH)
get_filename_component(source "${KARMA_SOURCE}" REALPATH)
string(FIND "${there}/" "${source}/" place)
if(NOT IS_DIRECTORY "${there}")
  karma_refuse_prefix("the prefix '${prefix}' is impossible, as ${there} is no directory")
elseif(place EQUAL 0)
  karma_refuse_prefix("the prefix '${prefix}' is inside of the source, ${source}")
elseif(there STREQUAL "/" AND "$ENV{DESTDIR}" STREQUAL "")
  karma_refuse_prefix("the prefix '${prefix}' is a new directory in the root directory: is HOME set? If it is meant, make it first")
endif()
