#!/bin/sh
# add_subdirectory(contactscope) in another project: what that had set stays, and its targets get the
# headers. The library is not built anew, which would take as long as all of it: $WORK/contacts by hand
# does, with cmake --build WORK.
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
# What links the library would build it, and all that it is made of.
ninja -n -v contacts | grep -q 'libcontactscope.a'
# None of our flags is in the host's own files.
if ninja -t commands record | grep -e -Wall -e -ffp-contract -e -fno-math-errno; then
  echo "the guest's flags are in the host's commands"
  exit 1
fi
