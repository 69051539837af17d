# cpack -G DEB builds one package for the program and one for the library; cpack -G TGZ builds a
# relocatable archive.
set(CPACK_GENERATOR DEB TGZ)
set(CPACK_PACKAGE_CONTACT "The contactscope authors <contactscope@example.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_STRIP_FILES ON)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION devel)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME contactscope)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# Opened at run time, so shlibdeps does not find them.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS
  "libegl1, libegl-mesa0, libgl1-mesa-dri, libcairo2, libharfbuzz-subset0")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "The program, its man page, completions and scenarios")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libcontactscope-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
# Needed to link the static library.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "libc6-dev, libdeflate-dev, libimgui-dev, libisal-dev, libsimdjson-dev, libstb-dev, libtomlplusplus-dev, libwebp-dev, nettle-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "The library, its headers, the recorder and the adapters")
include(CPack)
