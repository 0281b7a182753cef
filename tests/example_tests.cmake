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

# A case with loads is reduced, and the model asked for all of them.
file(GLOB load_files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/examples/*/loads.toml)
foreach(loads IN LISTS load_files)
  if(NOT TARGET PkgConfig::hdf5)
    continue()
  endif()
  cmake_path(GET loads PARENT_PATH folder)
  cmake_path(GET folder FILENAME name)
  set(model ${PROJECT_BINARY_DIR}/examples/${name}.model)
  add_test(NAME examples.${name}.reduce COMMAND peritherm_program reduce ${folder}/case.toml --output ${model} --overwrite
                                                --verify --quiet --threads 1)
  add_test(NAME examples.${name}.loads COMMAND peritherm_program run ${model}/model.h5 --loads ${loads} --output
                                               ${model}.loads --overwrite --quiet --threads 1)
  set_tests_properties(examples.${name}.reduce PROPERTIES FIXTURES_SETUP ${name}_model)
  set_tests_properties(examples.${name}.loads PROPERTIES FIXTURES_REQUIRED ${name}_model)
  set_tests_properties(examples.${name}.reduce examples.${name}.loads
                       PROPERTIES LABELS examples TIMEOUT 600 ENVIRONMENT "${test_environment}")
endforeach()
