# Debian's cross compiler for arm64, and QEMU to run its output. Libraries are unpacked below the
# build folder; headers without a library are those of this machine.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
find_program(CONTACTSCOPE_QEMU NAMES qemu-aarch64 qemu-aarch64-static)
if(NOT CONTACTSCOPE_QEMU)
  message(FATAL_ERROR "The preset 'arm64' needs a cross compiler and QEMU: apt-get install "
    "g++-aarch64-linux-gnu qemu-user")
endif()
# C library of Debian's cross compiler.
set(CMAKE_CROSSCOMPILING_EMULATOR ${CONTACTSCOPE_QEMU} -L /usr/aarch64-linux-gnu)

set(libraries ${CMAKE_BINARY_DIR}/libraries)
get_property(trying GLOBAL PROPERTY IN_TRY_COMPILE)
if(NOT trying)
  set(unpack ${CMAKE_CURRENT_LIST_DIR}/unpack_libraries)
  if(${unpack} IS_NEWER_THAN ${libraries}/unpacked)
    message(STATUS "Unpacking libraries of arm64")
    execute_process(COMMAND ${unpack} ${libraries} COMMAND_ERROR_IS_FATAL ANY)
  endif()
endif()
set(CMAKE_FIND_ROOT_PATH ${libraries})
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE BOTH)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE BOTH)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
