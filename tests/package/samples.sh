#!/bin/sh
# The samples of src/package/README.md are lines of a project that the tests build.
#   samples.sh SOURCE CONSUMER
set -eu
source=$1 consumer=$2
lines=0
check() {
  while IFS= read -r line; do
    lines=$((lines + 1))
    cat "$consumer"/*.cpp "$consumer"/CMakeLists.txt | sed 's/^ *//' | grep -q -x -F -e "$line" ||
      { echo "no line of $consumer is: $line"; return 1; }
  done
  test $lines -ge "$1" || { echo "only $lines lines of samples were found"; return 1; }
}
# Code is indented by four. Shell commands and program output are not part of the project.
sed -n 's/^    \( *[^ ]\)/\1/p' "$source/src/package/README.md" | sed 's/^ *//; s/  *# .*$//' |
  grep -v -e '^cmake --' -e '^INFO(' -e '^CHECK(' -e '^crate/on_ground' -e '^see /' | check 32
