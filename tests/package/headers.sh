#!/bin/sh
# Each public header compiles alone, without warnings, and includes nothing of JSON, Dear ImGui or
# Eigen.
#   headers.sh TREE CXX
set -eu
tree=$1 cxx=$2
warnings="-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror"
count=0
read=$(mktemp)
trap 'rm -f "$read"' EXIT
for header in "$tree"/include/contactscope/*.h; do
  name=contactscope/$(basename "$header")
  # shellcheck disable=SC2086  # $warnings is a list of words
  echo "#include <$name>" |
    "$cxx" -std=c++20 $warnings -I "$tree/include" -fsyntax-only -MD -MF "$read" -x c++ -
  inside=$(tr ' ' '\n' <"$read" | grep -i -e nlohmann -e imgui -e /Eigen/ -e toml || true)
  test -z "$inside" || { echo "$name includes $inside"; exit 1; }
  count=$((count + 1))
done
test $count -ge 9
