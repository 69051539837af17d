#!/bin/sh
# The README's workflow file: it is YAML, and its contactscope steps run as on a GitHub runner.
. "$2/tests/recipes/common.sh"
repository
mkdir -p .github/workflows
sed -n '/^    name: contacts$/,/path: "out\/check"/p' "$readme" | sed 's/^    //' > .github/workflows/contacts.yml
if python3 -c 'import yaml' 2> /dev/null; then
  python3 - << 'END' || fail "the workflow is no YAML, or lacks a job"
import yaml
jobs = yaml.safe_load(open(".github/workflows/contacts.yml"))["jobs"]
assert jobs["merge"]["needs"] == "check"
assert jobs["check"]["strategy"]["matrix"]["part"] == [1, 2, 3, 4]
END
fi

# Steps "- run: contactscope ..." that contain $1.
steps() {
  sed -n 's/^ *- run: \(contactscope .*\)$/\1/p' .github/workflows/contacts.yml | grep -- "$1"
}
[ "$(steps . | wc -l)" = 2 ] || fail "the workflow has other steps than check and merge"
export GITHUB_STEP_SUMMARY="$work/summary.md" CI=true
for part in 1 2 3 4; do
  steps ' --shard ' | sed "s/\${{ matrix.part }}/$part/" > step.sh
  grep -q "shard $part/4" step.sh || fail "the step has no part: $(cat step.sh)"
  bash -e step.sh > log 2>&1 || fail "part $part exits $?: $(cat log)"
done
steps '^contactscope merge ' > step.sh
bash -e step.sh > log 2>&1
[ $? = 1 ] || fail "the merge does not fail, though a scenario was changed: $(cat log)"
grep -q '^::error file=scenarios/hull/moved.toml' log || fail "no annotation: $(cat log)"
grep -q 'data:image/png;base64,' summary.md || fail "the summary has no picture"
grep -q 'failures="1"' junit.xml || fail "junit.xml counts no failure"

# Then on the reviewer's machine, with the artifact in out/check.
export CI=
contactscope check --accept 'hull/moved' || fail "nothing is accepted"
recipe 0 "contactscope check"
