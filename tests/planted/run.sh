#!/usr/bin/env bash
# Switches on one planted bug after another, and records which test notices it, and its message:
#   CONTACTSCOPE_SHARD=2/5 tests/planted/run.sh TREE BUILD TABLE
# plant.cmake makes TREE, and BUILD is its build. The whole table (see README.md) is written to
# TABLE; a shard, here every fifth bug from the second on, to BUILD/noticed_2_of_5.tsv. Exits with
# status 1 if no test notices a bug, 2 if something fails without any bug. Tests that compare traces
# byte for byte are excluded: they only notice a change.
set -u
export TREE BUILD && TREE=$(realpath "$1") && BUILD=$(realpath "$2") || exit 2
table=$(realpath -m "$3") shard=${CONTACTSCOPE_SHARD:-1/1}
own=${shard%/*} of=${shard#*/}
if ! [[ $shard =~ ^[1-9][0-9]*/[1-9][0-9]*$ ]] || [ "$own" -gt "$of" ]; then
  echo "CONTACTSCOPE_SHARD=$shard: a shard is K/N, as in 2/5, with K from 1 to N" >&2
  exit 2
fi
[ "$shard" = 1/1 ] || table=$BUILD/noticed_${own}_of_$of.tsv
export OUT && OUT=$(mktemp -d) && trap 'rm -rf "$OUT"' EXIT
cp "$3" "$OUT/last" 2>/dev/null || touch "$OUT/last"
cd "$TREE" || exit 2
# A bug may run forever. Steps that take ten seconds without a bug get five minutes.
export PATIENCE=300

# A cell of the table: one line, at most $1 bytes, without partial characters.
cell() {
  tr '\n\t' '  ' | sed "s|$TREE/||g; s/  */ /g; s/^ //" | cut -c1-"$1" | iconv -c -f UTF-8 -t UTF-8 2>/dev/null | sed 's/ *$//'
}

# The first test of a folder that fails, and the first lines of its message; or only the named test.
by_test() {
  local folder=$1 said=$OUT/$2.test
  timeout $PATIENCE "$BUILD/tests/${folder}_test" --gtest_fail_fast --gtest_color=no --gtest_filter="${3:--*Slow*}" >"$said" 2>&1
  local code=$?
  [ $code -eq 0 ] && return 1
  local name sentence
  name=$(sed -n 's/^\[  FAILED  \] \([^ ,]*\).*/\1/p' "$said" | head -1)
  if [ -n "$name" ]; then
    sentence=$(sed -n '/: Failure$/,/^\[  FAILED/{/: Failure$/d;/^\[  FAILED/q;p}' "$said" | head -8 | cell 240)
  else
    name=$(sed -n 's/^\[ RUN      \] //p' "$said" | tail -1)
    sentence="ended with $code"
    [ $code -eq 124 ] && sentence="ran for more than $PATIENCE s"
  fi
  printf '%s.%s\t%s' "$folder" "$name" "$sentence"
}

# Whether a folder's tests pass without any bug.
is_well() {
  local noticed
  echo "no bug: $1_test"
  ! noticed=$(by_test "$1" "none_$1") || { echo "a test fails without any bug: $noticed" >&2 && false; }
}

# The first message about a changed scenario: by its facts (a second), or else its pictures.
by_check() {
  local said=$OUT/$1.check how code
  for how in --facts-only ''; do
    timeout $PATIENCE "$BUILD/contactscope" check --fresh --quiet $how --snapshots "$OUT/snapshots" --out "$OUT/$1.out" >"$said" 2>&1
    code=$?
    rm -rf "$OUT/$1.out"
    [ $code -eq 0 ] && continue
    local sentence
    sentence=$(head -1 "$said" | cell 240)
    [ $code -eq 124 ] && sentence="ran for more than $PATIENCE s"
    printf 'check%s\t%s' "${how:+ $how}" "${sentence:-exit code $code}"
    return 0
  done
  return 1
}

# A line of the table for a line of planted.txt, tried first with the test of the last time.
try() {
  local file=$1 name=$2 folder noticed='' begin=$EPOCHREALTIME last
  export CONTACTSCOPE_PLANTED=$name
  last=$(awk -F'\t' -v name="$name" '$2 == name { print $3 }' "$OUT/last")
  case $last in
    check*) noticed=$(by_check "$name") ;;
    *.*) [ -x "$BUILD/tests/${last%%.*}_test" ] && noticed=$(by_test "${last%%.*}" "$name" "${last#*.}") ;;
  esac
  [ -n "$noticed" ] || for folder in "${@:3}"; do noticed=$(by_test "$folder" "$name") && break; done
  [ -n "$noticed" ] || noticed=$(by_check "$name") || noticed=$'nobody\t'
  rm -f "$OUT/$name".*
  printf '%s\t%s\t%s\n' "$file" "$name" "$noticed" >"$OUT/$name.line"
  printf '%5.1f s  %s: %s\n' "$(awk "BEGIN { print $EPOCHREALTIME - $begin }")" "$name" "${noticed%%$'\t'*}"
}
export -f cell by_test is_well by_check try

# Without any bug everything must pass. The snapshots are new, so the tree's own may be outdated.
echo "no bug: what is stored"
unset CONTACTSCOPE_PLANTED CI # with CI=true nothing would be stored
if ! "$BUILD/contactscope" check --quiet --update=all --snapshots "$OUT/snapshots" --out "$OUT/none" >"$OUT/none.txt" 2>&1 ||
  ! "$BUILD/contactscope" check --quiet --fresh --snapshots "$OUT/snapshots" --out "$OUT/none" >"$OUT/none.txt" 2>&1; then
  echo "check finds something without any bug:" && cat "$OUT/none.txt"
  exit 2
fi >&2
rm -rf "$OUT/none"
awk -v own="$own" -v of="$of" '(NR - 1) % of + 1 == own' planted.txt >"$OUT/chosen"
at_once=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}
cut -d' ' -f3- "$OUT/chosen" | tr ' ' '\n' | sort -u | xargs -P "$at_once" -L 1 bash -c 'is_well "$@"' is_well || exit 2
xargs -a "$OUT/chosen" -P "$at_once" -L 1 bash -c 'try "$@"' try
cat "$OUT"/*.line | LC_ALL=C sort >"$table"
echo "$table: $(wc -l <"$table") bugs"
! grep $'\tnobody\t' "$table"
