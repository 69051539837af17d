#!/bin/sh
# What an engineer of another repository does first, with the README alone; the document on CI begins alike.
. "$2/tests/recipes/common.sh"
for line in "contactscope check --write-missing" "contactscope check"; do
  grep -qE -- "^    $line( |$)" "$document" || fail "$document has no line '$line'"
done
document=$2/README.md
scenario scenarios/hull/crate.toml 0.495
scenario scenarios/hull/other.toml 0.495

contactscope check > log 2>&1
[ $? = 2 ] || fail "without a folder of snapshots it is trouble"
grep -q -- '--write-missing' log || fail "no remedy: $(cat log)"
[ ! -e snapshots ] || fail "check made a folder that nobody asked for"
recipe 0 "contactscope check --write-missing"
[ -f snapshots/hull/crate/frame_0001.png ] || fail "no first baselines"
recipe 0 "contactscope check"

# A deliberate change, and the check that fails.
scenario scenarios/hull/crate.toml 0.48
recipe 1 "contactscope check"
contactscope check --json --quiet --junit junit.xml | grep -q 'crate: moved 15 mm along -y' || fail "no cause"
grep -q 'testcase classname="hull" name="crate"' junit.xml || fail "JUnit names no scenario: $(head -c 600 junit.xml)"
grep -q 'failures="1"' junit.xml || fail "JUnit counts no failure"
grep -q 'data:image/png;base64,' out/check/report.html || fail "the report has no pictures"
contactscope review --list | grep -q '^changed *hull/crate/frame_0000' || fail "nothing to review"

# One of two pictures.
contactscope check --accept hull/crate/frame_0000 || fail "one picture is not accepted"
contactscope check > log 2>&1
[ $? = 1 ] || fail "the other picture and the trace still differ"
contactscope review --list | grep -q 'hull/crate/frame_0000 ' && fail "the accepted picture is still there"
contactscope review --list | grep -q '^changed *hull/crate/frame_0001' || fail "the other one is not"

# What the page says of choices.
echo '{"accept":["hull/crate/trace"],"reject":["hull/crate/frame_0001"]}' | contactscope review --from -
[ $? = 1 ] || fail "a rejected picture fails"
contactscope review --list | grep -q '^rejected *hull/crate/frame_0001' || fail "nothing is rejected"

# Four machines.
for part in 1 2 3 4; do contactscope check --shard $part/4 --out shards --quiet > /dev/null; done
for part in 1 2 3 4; do contactscope check --accept '*' --shard $part/4 --out shards; done
recipe 0 "contactscope check"

timeout -s INT --preserve-status 0.3 contactscope study stability --cases 1000 > log 2>&1
[ $? = 130 ] || fail "Ctrl-C exits 130: $(cat log)"
contactscope help check | grep -q 'Exit codes' || fail "help is a verb"
