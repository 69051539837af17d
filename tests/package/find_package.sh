#!/bin/sh
# A separate project finds the installed package, builds with every warning, and runs.
#   find_package.sh TREE CONSUMER WORK CXX
set -eu
tree=$1 consumer=$2 work=$3 cxx=$4
rm -rf "$work"
mkdir -p "$work"
CXX=$cxx cmake -G Ninja -S "$consumer" -B "$work" -DCMAKE_PREFIX_PATH="$tree" \
  -DCMAKE_CXX_FLAGS="-Wall -Wextra -Wpedantic -Wshadow -Werror" \
  -DCMAKE_C_FLAGS="-Wall -Wextra -Wpedantic -Werror" >"$work.log" || { cat "$work.log"; exit 1; }
cmake --build "$work"
cd "$work"
ctest --output-on-failure
./contacts | tee contacts.txt
grep -q "touching, -0.020 m" contacts.txt
test "$(grep -c '^kept ' contacts.txt)" = 3
test -s crate.png
"$tree/bin/contactscope" lint crate.jsonl
./record
"$tree/bin/contactscope" lint run.jsonl
# The recorder alone needs no library.
cat >recorder.cmake <<'EOF'
cmake_minimum_required(VERSION 3.16)
project(recorder_alone C)
find_package(contactscope REQUIRED COMPONENTS recorder)
if(TARGET contactscope::deflate OR TARGET Threads::Threads)
  message(FATAL_ERROR "a recorder looked for libraries")
endif()
find_package(contactscope 9 QUIET)
if(contactscope_FOUND)
  message(FATAL_ERROR "version 9 was found")
endif()
EOF
mkdir alone
mv recorder.cmake alone/CMakeLists.txt
cmake -G Ninja -S alone -B alone/build -DCMAKE_PREFIX_PATH="$tree" >alone.log || { cat alone.log; exit 1; }
