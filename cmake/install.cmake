# Installs the program, the library and what find_package(peritherm) needs.
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/peritherm)
install(
  TARGETS peritherm
  EXPORT peritherm_targets
  FILE_SET HEADERS)
install(TARGETS peritherm_program)
install(
  EXPORT peritherm_targets
  NAMESPACE peritherm::
  DESTINATION ${package_folder})

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/peritherm_config.cmake.in
                              ${PROJECT_BINARY_DIR}/generated/peritherm-config.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/generated/peritherm-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/generated/peritherm-config.cmake
              ${PROJECT_BINARY_DIR}/generated/peritherm-config-version.cmake DESTINATION ${package_folder})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
