#!/bin/sh
# The document's tests for CTest, in a project of their own.
. "$2/tests/recipes/common.sh"
repository
{
  echo 'cmake_minimum_required(VERSION 3.16)'
  echo 'project(mine NONE)'
  echo 'enable_testing()'
  sed -n '/^    foreach(part RANGE 1 4)/,/endforeach()/p' "$document"
} > CMakeLists.txt
grep -q add_test CMakeLists.txt || fail "the document has no tests for CTest"
cmake -S . -B build > cmake.log || fail "$(cat cmake.log)"
ctest --test-dir build -j2 > ctest.log && fail "nothing fails, though a scenario was changed"
grep -q '75% tests passed, 1 tests\? failed out of 4' ctest.log || fail "$(cat ctest.log)"
cat build/contacts/part_*.xml | grep -q '<failure type="changed"' || fail "no JUnit file tells of the change"
part=$(grep -l '^ "same": false' build/contacts/check_*_of_4/findings.json | sed 's/.*check_\(.\)_of_4.*/\1/')
contactscope check --accept hull/moved --shard "$part/4" --out build/contacts || fail "nothing is accepted"
ctest --test-dir build -j2 > ctest.log || fail "$(cat ctest.log)"
