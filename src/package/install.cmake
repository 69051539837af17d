# What `cmake --install` puts where. Nothing in it knows the prefix: the tree may be moved.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/contactscope)
install(TARGETS contactscope_library contactscope_recorder contactscope_adapters
  EXPORT contactscope COMPONENT development)
install(EXPORT contactscope FILE contactscopeTargets.cmake NAMESPACE contactscope::
  DESTINATION ${package_dir} COMPONENT development)
configure_package_config_file(config.cmake.in contactscopeConfig.cmake
  INSTALL_DESTINATION ${package_dir} NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
# While the first number is 0, the second one counts changes that break programs.
write_basic_package_version_file(contactscopeConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/contactscopeConfig.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/contactscopeConfigVersion.cmake
  DESTINATION ${package_dir} COMPONENT development)

install(DIRECTORY contactscope DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
# Side by side, as the adapters look for the recorder.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/recorder ${PROJECT_SOURCE_DIR}/src/adapters
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/contactscope COMPONENT development
  FILES_MATCHING PATTERN "*.h")

if(CONTACTSCOPE_BUILD_PROGRAM)
  install(TARGETS contactscope COMPONENT program)
endif()
