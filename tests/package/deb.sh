#!/bin/sh
# cpack makes two Debian packages with the right contents and dependencies.
#   deb.sh BUILD WORK
set -eu
build=$1 work=$2
rm -rf "$work"
mkdir -p "$work"
cd "$work"
cpack -G DEB --config "$build/CPackConfig.cmake" -B "$work" >cpack.log || { cat cpack.log; exit 1; }
program=$(echo contactscope_*.deb) library=$(echo libcontactscope-dev_*.deb)
has() {
  dpkg-deb -c "$1" | grep -q "$2\$" || { echo "$1 lacks $2"; dpkg-deb -c "$1"; exit 1; }
}
for file in usr/bin/contactscope usr/share/man/man1/contactscope.1 \
  usr/share/bash-completion/completions/contactscope \
  usr/share/zsh/vendor-completions/_contactscope \
  usr/share/fish/vendor_completions.d/contactscope.fish usr/share/doc/contactscope/NOTICE \
  usr/share/contactscope/scenarios/hull/face_contact.toml \
  usr/share/contactscope/contactscope.py usr/share/contactscope/contactscope.mjs \
  usr/share/contactscope/findings.schema.json usr/share/contactscope/trace.schema.json; do
  has "$program" "$file"
done
for file in libcontactscope.a contactscopeConfig.cmake pkgconfig/contactscope.pc \
  usr/include/contactscope/gtest.h usr/include/contactscope/recorder/contactscope.h \
  usr/include/contactscope/adapters/bullet.h; do
  has "$library" "$file"
done
for dependency in libc6 libstdc++6 libdeflate0 libsimdjson libstb0; do
  dpkg-deb -f "$program" Depends | grep -q -F "$dependency" || { echo "no $dependency"; exit 1; }
done
dpkg-deb -f "$program" Recommends | grep -q libegl1
dpkg-deb -f "$library" Depends | grep -q libimgui-dev
