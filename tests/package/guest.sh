#!/bin/sh
# add_subdirectory(contactscope) in another project: the project's settings stay, and its targets
# get the headers. The library is not built again, which would take too long; build $WORK/contacts
# by hand with cmake --build WORK.
#   guest.sh SOURCE HOST CONSUMER WORK CXX
set -eu
source=$1 host=$2 consumer=$3 work=$4 cxx=$5
rm -rf "$work"
mkdir -p "$work"
CXX=$cxx cmake -G Ninja -S "$host" -B "$work" -DCONTACTSCOPE="$source" -DCONSUMER="$consumer" \
  >"$work.log" 2>&1 || { cat "$work.log"; exit 1; }
cd "$work"
ninja record CMakeFiles/contacts.dir$consumer/contacts.cpp.o
./programs/record
# Linking the library would build it and everything in it.
ninja -n -v contacts | grep -q 'libcontactscope.a'
# The host's own files get none of our flags.
if ninja -t commands record | grep -e -Wall -e -ffp-contract -e -fno-math-errno; then
  echo "the guest's flags are in the host's commands"
  exit 1
fi
