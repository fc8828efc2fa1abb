# PETZVAL_VERSION, read from the header that installs with it: one place to change.
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/../include/petzval/version.h lines REGEX "define PETZVAL_VERSION")
string(REGEX MATCH "PETZVAL_VERSION \"([0-9.]+)\"" unused "${lines}")
set(PETZVAL_VERSION ${CMAKE_MATCH_1})
string(REGEX MATCH "MAJOR ([0-9]+).*MINOR ([0-9]+).*PATCH ([0-9]+)" unused "${lines}")
if(NOT PETZVAL_VERSION STREQUAL "${CMAKE_MATCH_1}.${CMAKE_MATCH_2}.${CMAKE_MATCH_3}")
  message(FATAL_ERROR "include/petzval/version.h: PETZVAL_VERSION and its parts differ")
endif()
