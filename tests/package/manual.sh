#!/bin/sh
# The installed program finds its scenarios from anywhere. Its man page, documents and completions are
# in their places, and a shell completes with them.
#   manual.sh TREE
set -eu
tree=$1
cd /
"$tree/bin/contactscope" trace hull/face_contact --frames 0 | head -c 100 | grep -q '"hull/face_contact"'
page=$tree/share/man/man1/contactscope.1
grep -q '^.SH NAME' "$page"
for verb in render trace check review show explore study lint versus doctor list help; do
  grep -q "^.SS \"contactscope $verb" "$page" || { echo "no verb $verb in the man page"; exit 1; }
done
test -s "$tree/share/zsh/site-functions/_contactscope"
test -s "$tree/share/fish/vendor_completions.d/contactscope.fish"
documents=$tree/share/doc/contactscope
test -s "$documents/NOTICE"
# Files that the installed README.md links to.
grep -o '](\(src\|render\|scenarios\|snapshots\|tests\)[^)]*\.\(md\|png\)' "$documents/README.md" | cut -c3- | sort -u |
  while read -r link; do
    test -s "$documents/$link" || { echo "README.md links to $link, which is not installed"; exit 1; }
  done
if command -v zsh >/dev/null; then zsh -fn "$tree/share/zsh/site-functions/_contactscope"; fi
if command -v fish >/dev/null; then
  found=$(PATH=$tree/bin:$PATH fish --no-config -c 'source $argv[1]; complete -C "contactscope study tu"' \
    "$tree/share/fish/vendor_completions.d/contactscope.fish")
  test "$found" = tunnelling || { echo "fish completes tu to $found"; exit 1; }
fi
if ! command -v bash >/dev/null; then exit 0; fi
PATH=$tree/bin:$PATH bash -eu -c '
  source "$1"
  expect() {
    local expected=$1
    shift
    COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
    _contactscope || true
    if [ "${COMPREPLY[*]}" != "$expected" ]; then
      echo "\"$*\" gave \"${COMPREPLY[*]}\" instead of \"$expected\""
      exit 1
    fi
  }
  expect "render" contactscope ren
  expect "--reducer" contactscope render --red
  expect "optimal optimal_deepest" contactscope render --reducer opti
  expect "shapes,contact_axis shapes,contacts" contactscope render --layers shapes,cont
  expect "summary" contactscope render --panels = summ
  expect "tunnelling" contactscope study tu
  expect "hull/face_contact" contactscope trace hull/face_c
' bash "$tree/share/bash-completion/completions/contactscope"
