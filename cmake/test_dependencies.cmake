# GoogleTest and RapidCheck. Debian's RapidCheck is the plain library; its GoogleTest header needs no target of its own.
find_package(GTest REQUIRED)
find_package(rapidcheck CONFIG QUIET)
if(NOT TARGET rapidcheck)
  find_path(RAPIDCHECK_INCLUDE_DIR rapidcheck/gtest.h REQUIRED)
  find_library(RAPIDCHECK_LIBRARY rapidcheck REQUIRED)
  add_library(rapidcheck UNKNOWN IMPORTED)
  set_target_properties(rapidcheck PROPERTIES IMPORTED_LOCATION ${RAPIDCHECK_LIBRARY}
                                              INTERFACE_INCLUDE_DIRECTORIES ${RAPIDCHECK_INCLUDE_DIR})
endif()
