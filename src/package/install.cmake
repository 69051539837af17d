# Rules of `cmake --install`. The installed tree does not contain the prefix and may be moved.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/contactscope)
install(TARGETS contactscope_library contactscope_recorder contactscope_adapters
  EXPORT contactscope COMPONENT development)
install(EXPORT contactscope FILE contactscopeTargets.cmake NAMESPACE contactscope::
  DESTINATION ${package_dir} COMPONENT development)
configure_package_config_file(config.cmake.in contactscopeConfig.cmake
  INSTALL_DESTINATION ${package_dir} NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
# While the major version is 0, the minor one counts breaking changes.
write_basic_package_version_file(contactscopeConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/contactscopeConfig.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/contactscopeConfigVersion.cmake
  DESTINATION ${package_dir} COMPONENT development)

install(DIRECTORY contactscope DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
# In sibling folders, because the adapters include the recorder by a relative path.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/recorder ${PROJECT_SOURCE_DIR}/src/adapters
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/contactscope COMPONENT development
  FILES_MATCHING PATTERN "*.h")

# The library is static, so `pkg-config --libs` without --static must list its dependencies.
set(pc_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH up_to_prefix /prefix/${pc_dir} /prefix)
string(REGEX REPLACE "/$" "" up_to_prefix "${up_to_prefix}")
foreach(name contactscope contactscope-recorder)
  configure_file(${name}.pc.in ${name}.pc @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${name}.pc DESTINATION ${pc_dir} COMPONENT development)
endforeach()

set(doc_dir ${CMAKE_INSTALL_DATAROOTDIR}/doc)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE NOTICE
  DESTINATION ${doc_dir}/libcontactscope-dev COMPONENT development)

if(NOT CONTACTSCOPE_BUILD_PROGRAM)
  return()
endif()
install(TARGETS contactscope COMPONENT program)
install(PROGRAMS ${PROJECT_SOURCE_DIR}/src/scenario/import/contactscope-import TYPE BIN
  COMPONENT program)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE NOTICE DESTINATION ${doc_dir}/contactscope
  COMPONENT program)
# README.md and the documents and pictures that it links to, in their folders, so that the links hold.
file(READ ${PROJECT_SOURCE_DIR}/README.md readme)
string(REGEX MATCHALL "\\([a-zA-Z0-9_/]+\\.(md|png)" documents "${readme}")
list(TRANSFORM documents REPLACE "^\\(" "")
list(APPEND documents README.md)
list(REMOVE_DUPLICATES documents)
foreach(document IN LISTS documents)
  cmake_path(GET document PARENT_PATH folder)
  install(FILES ${PROJECT_SOURCE_DIR}/${document} DESTINATION ${doc_dir}/contactscope/${folder}
    COMPONENT program)
endforeach()
# The program finds scenarios there relative to its own location.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/scenarios
  DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/contactscope COMPONENT program)
install(FILES ${PROJECT_SOURCE_DIR}/src/recorder/contactscope.py
    ${PROJECT_SOURCE_DIR}/src/recorder/contactscope.mjs
    ${PROJECT_SOURCE_DIR}/src/trace/findings.schema.json
    ${PROJECT_SOURCE_DIR}/src/trace/trace.schema.json
  DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/contactscope COMPONENT program)

# The man page and shell completions, as printed by the program.
#   contactscope_manual(WHAT FILE FOLDER...)
set(manuals)
function(contactscope_manual what file)
  set(path ${CMAKE_CURRENT_BINARY_DIR}/manual/${what}/${file})
  add_custom_command(OUTPUT ${path}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_CURRENT_BINARY_DIR}/manual/${what}
    COMMAND contactscope --manual ${what} > ${path}
    DEPENDS contactscope VERBATIM)
  foreach(folder IN LISTS ARGN)
    install(FILES ${path} DESTINATION ${folder} COMPONENT program)
  endforeach()
  set(manuals ${manuals} ${path} PARENT_SCOPE)
endfunction()
contactscope_manual(man contactscope.1 ${CMAKE_INSTALL_MANDIR}/man1)
contactscope_manual(bash contactscope ${CMAKE_INSTALL_DATAROOTDIR}/bash-completion/completions)
# Debian's zsh reads the second folder, other systems the first.
contactscope_manual(zsh _contactscope ${CMAKE_INSTALL_DATAROOTDIR}/zsh/site-functions
  ${CMAKE_INSTALL_DATAROOTDIR}/zsh/vendor-completions)
contactscope_manual(fish contactscope.fish ${CMAKE_INSTALL_DATAROOTDIR}/fish/vendor_completions.d)
add_custom_target(contactscope_manuals ALL DEPENDS ${manuals})

if(PROJECT_IS_TOP_LEVEL)
  include(${CMAKE_CURRENT_SOURCE_DIR}/cpack.cmake)
endif()
