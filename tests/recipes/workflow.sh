#!/bin/sh
# The document's workflow file: that it is YAML, and each step of it that runs contactscope, as a runner of GitHub would.
. "$2/tests/recipes/common.sh"
repository
mkdir -p .github/workflows
sed -n '/^    name: contacts$/,/path: "out\/check"/p' "$document" | sed 's/^    //' > .github/workflows/contacts.yml
if python3 -c 'import yaml' 2> /dev/null; then
  python3 - << 'END' || fail "the workflow is no YAML, or lacks a job"
import yaml
jobs = yaml.safe_load(open(".github/workflows/contacts.yml"))["jobs"]
assert len(jobs["check"]["steps"]) == 4
END
fi

sed -n 's/^ *- run: \(contactscope .*\)$/\1/p' .github/workflows/contacts.yml > step.sh
[ "$(wc -l < step.sh)" = 1 ] || fail "the workflow has other steps than check: $(cat step.sh)"
export GITHUB_STEP_SUMMARY="$work/summary.md" CI=true
bash -e step.sh > log 2>&1
[ $? = 1 ] || fail "the check does not fail, though a scenario was changed: $(cat log)"
grep -q '^::error file=scenarios/hull/moved.toml' log || fail "no annotation: $(cat log)"
grep -q 'data:image/png;base64,' summary.md || fail "the summary has no picture"
grep -q 'failures="1"' junit.xml || fail "junit.xml counts no failure"

# And on the machine of whoever looks at it, with the artifact in out/check.
export CI=
contactscope check --accept 'hull/moved' || fail "nothing is accepted"
recipe 0 "contactscope check"
