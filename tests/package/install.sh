#!/bin/sh
# Installs the build into a folder and moves it: no file may contain the original path.
#   install.sh BUILD WORK
set -eu
build=$1 work=$2
rm -rf "$work"
mkdir -p "$work"
cmake --install "$build" --prefix "$work/first" >"$work/install.log"
mv "$work/first" "$work/tree"
cd "$work/tree"
for file in bin/contactscope include/contactscope/collide.h include/contactscope/gtest.h \
  include/contactscope/recorder/contactscope.h include/contactscope/adapters/bullet.h; do
  test -e "$file" || { echo "not installed: $file"; exit 1; }
done
bin/contactscope --version
# A consumer's build reads no path of the build or of the first folder.
if grep -rl -e "$work/first" -e "$build" lib*/cmake; then
  echo "these files know where they were installed from, or to"
  exit 1
fi
