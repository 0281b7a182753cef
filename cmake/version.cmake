# Sets PERITHERM_VERSION_TEXT: "0.1.0 (abc1234)", or "0.1.0" outside a repository.
set(PERITHERM_VERSION_TEXT ${PROJECT_VERSION})
find_package(Git QUIET)
if(Git_FOUND AND EXISTS ${PROJECT_SOURCE_DIR}/.git)
  execute_process(
    COMMAND ${GIT_EXECUTABLE} rev-parse --short HEAD
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
    OUTPUT_VARIABLE PERITHERM_COMMIT
    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET
    RESULT_VARIABLE PERITHERM_COMMIT_FAILED)
  if(NOT PERITHERM_COMMIT_FAILED)
    string(APPEND PERITHERM_VERSION_TEXT " (${PERITHERM_COMMIT})")
  endif()
  # A new commit changes this file, so the version never names an old one.
  if(EXISTS ${PROJECT_SOURCE_DIR}/.git/logs/HEAD)
    set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
                                                                 ${PROJECT_SOURCE_DIR}/.git/logs/HEAD)
  endif()
endif()
configure_file(${PROJECT_SOURCE_DIR}/src/peritherm/base/version.cpp.in ${PROJECT_BINARY_DIR}/generated/version.cpp @ONLY)
