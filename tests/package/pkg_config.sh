#!/bin/sh
# A compiler and pkg-config build a program with the installed library, and a shared object of it.
#   pkg_config.sh TREE CONSUMER WORK CC CXX
set -eu
tree=$1 consumer=$2 work=$3 cc=$4 cxx=$5
rm -rf "$work"
mkdir -p "$work"
cd "$work"
PKG_CONFIG_PATH=$(dirname "$(find "$tree" -name contactscope.pc)")
export PKG_CONFIG_PATH
# shellcheck disable=SC2046  # flags are a list of words
{
  "$cxx" -std=c++20 "$consumer/contacts.cpp" -o contacts $(pkg-config --cflags --libs contactscope)
  "$cc" -std=c99 "$consumer/record.c" -o record $(pkg-config --cflags --libs contactscope-recorder)
  "$cxx" -std=c++20 -shared -fPIC "$consumer/contacts.cpp" -o contacts.so -Wl,-z,defs \
    $(pkg-config --cflags --libs contactscope)
}
./contacts | grep -q "touching, -0.020 m"
./record
test "$(pkg-config --modversion contactscope)" = "$("$tree/bin/contactscope" --version | cut -d ' ' -f 2)"
# The shared object exports none of the library's own names.
if nm -D --defined-only --demangle contacts.so | grep ' [A-Z] contactscope::' | grep -v ' contactscope::package::'; then
  echo "these names of the library leave the shared object"
  exit 1
fi
