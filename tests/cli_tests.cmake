# The program as a user meets it: every folder of tests/cli is a case with its expected exit code and lines.
file(GLOB expectations CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/cli/*/expect.toml)
foreach(expectation IN LISTS expectations)
  cmake_path(GET expectation PARENT_PATH folder)
  cmake_path(GET folder FILENAME name)
  add_test(NAME cli.${name} COMMAND ${PERITHERM_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/cli/run_cases.py
                                    $<TARGET_FILE:peritherm_program> ${folder})
  set_tests_properties(cli.${name} PROPERTIES LABELS cli TIMEOUT 120 ENVIRONMENT "${test_environment}")
  # Models are files of HDF5's.
  if(name MATCHES "^(model_|loads_file_|file_is_no_model)" AND NOT TARGET PkgConfig::hdf5)
    set_tests_properties(cli.${name} PROPERTIES LABELS "cli;hdf5" DISABLED TRUE)
  endif()
endforeach()

add_test(NAME cli.interrupt COMMAND ${PERITHERM_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/cli/interrupt.py
                                    $<TARGET_FILE:peritherm_program>)
add_test(NAME cli.interrupt_study COMMAND ${PERITHERM_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/cli/interrupt_study.py
                                          $<TARGET_FILE:peritherm_program>)
set_tests_properties(cli.interrupt cli.interrupt_study PROPERTIES LABELS cli TIMEOUT 120
                                                                  ENVIRONMENT "${test_environment}")

add_test(NAME tools.check_rooms_finds_what_it_should
         COMMAND ${PERITHERM_PYTHON} ${PROJECT_SOURCE_DIR}/tools/test_check_rooms.py)
add_test(NAME tools.rooms COMMAND ${PERITHERM_PYTHON} ${PROJECT_SOURCE_DIR}/tools/check_rooms.py --quiet
                                  ${PROJECT_SOURCE_DIR})
set_tests_properties(tools.check_rooms_finds_what_it_should tools.rooms PROPERTIES LABELS fast)

# The quick variant of the report on every paper; each ends with another exit code if a figure is off.
foreach(paper IN ITEMS bobaru_2010 bobaru_2012 mei_2021 galadima xue_2018)
  add_test(NAME papers.report.${paper} COMMAND peritherm_program papers ${paper} --quick --overwrite --threads 1
                                               --output ${PROJECT_BINARY_DIR}/papers/${paper})
  set_tests_properties(papers.report.${paper} PROPERTIES LABELS papers TIMEOUT 900 ENVIRONMENT "${test_environment}")
endforeach()
