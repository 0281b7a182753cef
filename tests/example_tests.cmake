# Every example is checked and run, so that the documentation is what works.
file(GLOB cases CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/examples/*/case.toml)
foreach(case IN LISTS cases)
  cmake_path(GET case PARENT_PATH folder)
  cmake_path(GET folder FILENAME name)
  add_test(NAME examples.${name}.check COMMAND peritherm_program check ${case})
  add_test(NAME examples.${name}.run COMMAND peritherm_program run ${case} --output ${PROJECT_BINARY_DIR}/examples/${name}
                                             --overwrite --quiet --threads 1)
  set_tests_properties(examples.${name}.check examples.${name}.run
                       PROPERTIES LABELS examples TIMEOUT 600 ENVIRONMENT "${test_environment}")
endforeach()

file(GLOB studies CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/examples/*/study.toml)
foreach(study IN LISTS studies)
  cmake_path(GET study PARENT_PATH folder)
  cmake_path(GET folder FILENAME name)
  add_test(NAME examples.${name}.study COMMAND peritherm_program study ${study} --output
                                               ${PROJECT_BINARY_DIR}/examples/${name}.study --overwrite --rerun --quiet)
  set_tests_properties(examples.${name}.study PROPERTIES LABELS examples TIMEOUT 600 ENVIRONMENT "${test_environment}")
endforeach()
