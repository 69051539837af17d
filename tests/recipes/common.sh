# What the tests of recipes share. $1 of each: the folder of the built program; $2: the sources.
set -u
export PATH="$1:$PATH" CI=
document=$2/render/snapshot/README.md
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 2

fail() {
  echo "FAILED: $*" >&2
  exit 1
}

# 77: CTest calls the test skipped, and its log says why.
skip() {
  echo "skipped: $*" >&2
  exit 77
}

# A command that stands in the document, word for word, with the exit code that it should have.
recipe() {
  wanted=$1
  shift
  grep -qF -- "    $1" "$document" || fail "$document has no line '$1'"
  echo "\$ $1"
  sh -c "$1"
  code=$?
  [ "$code" = "$wanted" ] || fail "'$1' exits $code, not $wanted"
}

# A crate on a slab, so high over the floor.
scenario() {
  mkdir -p "$(dirname "$1")"
  cat > "$1" << END
title = "A crate on a slab"
[time]
frames = 2
[shapes.slab]
type         = "box"
half_extents = [1.0, 0.2, 1.0]
position     = [0.0, -0.2, 0.0]
[shapes.crate]
type         = "box"
half_extents = [0.5, 0.5, 0.5]
position     = [0.0, $2, 0.0]
[snapshots]
frames = [0, 1]
size   = [320, 180]
END
}

# A repository of eight scenarios with baselines, of which one was changed since.
repository() {
  for name in one two three four five six seven; do scenario "scenarios/hull/$name.toml" 0.495; done
  scenario scenarios/hull/moved.toml 0.495
  contactscope check --write-missing --quiet > /dev/null || fail "no first baselines"
  scenario scenarios/hull/moved.toml 0.48
}

# The reports of four parts are there, and one of them, with the changed scenario, fails.
one_part_fails() {
  passing=$(grep -l '^ "same": true' shards/check_*_of_4/findings.json | wc -l)
  failing=$(grep -l '^ "same": false' shards/check_*_of_4/findings.json | wc -l)
  [ "$passing $failing" = "3 1" ] || fail "$passing parts pass and $failing fail, not 3 and 1"
  [ "$(ls shards/check_*_of_4/hull/moved/frame_0000.actual.png | wc -l)" = 1 ] || fail "the picture is not there once"
}

# As many pictures as all scenarios have.
all_rendered() {
  count=$(find out/hull -name 'frame_*.png' | wc -l)
  [ "$count" = 16 ] || fail "$count pictures of 16"
}
