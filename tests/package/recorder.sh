#!/bin/sh
# The recorder alone, as a C99 and as a C++11 program, with only a compiler.
#   recorder.sh TREE CONSUMER WORK CC CXX
set -eu
tree=$1 consumer=$2 work=$3 cc=$4 cxx=$5
rm -rf "$work"
mkdir -p "$work"
cd "$work"
warnings="-Wall -Wextra -Wpedantic -Werror"
# shellcheck disable=SC2086  # $warnings is a list of words
{
  "$cc" -std=c99 $warnings -I "$tree/include/contactscope/recorder" "$consumer/record.c" -o c99 -lm
  "$cxx" -std=c++11 $warnings -I "$tree/include/contactscope/recorder" -x c++ "$consumer/record.c" -o cxx11
}
for program in c99 cxx11; do
  ./$program
  "$tree/bin/contactscope" lint run.jsonl | grep -q '^ok'
  mv run.jsonl $program.jsonl
done
cmp c99.jsonl cxx11.jsonl
