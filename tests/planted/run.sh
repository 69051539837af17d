#!/usr/bin/env bash
# Switches on one planted bug after the other, and notes who notices it and how it is told:
#   tests/planted/run.sh TREE BUILD [K/N]
# TREE was made by plant.cmake and BUILD is of it. With K/N every N-th bug from the K-th on, so that N machines, or jobs of
# an array, share them. A line a bug on standard output: its name, the test or `check`, and the sentence, parted by tabs.
# Exit code 1 where one was not noticed. Tests that compare traces byte for byte take no part: they notice that something
# changed, and not what.
set -u
tree=$1 build=$2 shard=${3:-1/1}
own=${shard%/*} of=${shard#*/}
cd "$tree" || exit 2
out=$(mktemp -d) && trap 'rm -rf "$out"' EXIT

# The first test of a folder that fails, and the first line that says why.
by_test() {
  "$build/tests/$1_test" --gtest_fail_fast --gtest_brief=1 --gtest_filter='-*Slow*' >"$out/test" 2>&1
  local code=$?
  [ $code -eq 0 ] && return 1
  local name sentence
  name=$(sed -n 's/^\[  FAILED  \] \([^ ,]*\).*/\1/p' "$out/test" | head -1)
  sentence=$(grep -A3 -m1 ': Failure$' "$out/test" | sed 1d | tr '\n' ' ' | sed 's/  */ /g' | cut -c1-200)
  printf '%s.%s\t%s' "$1" "${name:-died with $code}" "$sentence"
}

# The first sentence of a scenario that is not the same.
by_check() {
  "$build/contactscope" check --quiet --out "$out/check" >"$out/check.txt" 2>&1
  local code=$?
  [ $code -eq 0 ] && return 1
  local sentence
  sentence=$(sed -n 's/^        //p' "$out/check.txt" | head -1 | cut -c1-200)
  printf 'check\t%s' "${sentence:-exit code $code}"
}

survivors=0 number=0
while read -r name tests; do
  number=$((number + 1))
  [ $(((number - 1) % of + 1)) -eq "$own" ] || continue
  export CONTACTSCOPE_PLANTED=$name
  noticed=
  for test in $tests; do
    noticed=$(by_test "$test") && break
  done
  [ -n "$noticed" ] || noticed=$(by_check)
  if [ -z "$noticed" ]; then
    noticed=$(printf 'nobody\t')
    survivors=$((survivors + 1))
  fi
  printf '%s\t%s\n' "$name" "$noticed"
done <planted.txt
[ $survivors -eq 0 ]
