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
# Headers of engines need their engine, so only their places are looked up, with each set of flags.
for flags in "-I$tree/include" "$(PKG_CONFIG_PATH=$(dirname "$(find "$tree" -name contactscope-recorder.pc)") \
    pkg-config --cflags contactscope-recorder)"; do
  # shellcheck disable=SC2086  # $flags is a list of words
  echo "#if !__has_include(<contactscope/adapters/bullet.h>) || !__has_include(<contactscope/recorder/contactscope.h>)
#error
#endif" | "$cxx" $flags -fsyntax-only -x c++ -
done
