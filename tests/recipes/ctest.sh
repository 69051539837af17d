#!/bin/sh
# The README's tests for CTest, in a separate project.
. "$2/tests/recipes/common.sh"
repository
{
  echo 'cmake_minimum_required(VERSION 3.16)'
  echo 'project(mine NONE)'
  echo 'enable_testing()'
  sed -n '/^    foreach(part RANGE 1 4)/,/FIXTURES_REQUIRED/p' "$readme"
} > CMakeLists.txt
grep -q FIXTURES_REQUIRED CMakeLists.txt || fail "the README has no tests for CTest"
cmake -S . -B build > cmake.log || fail "$(cat cmake.log)"
ctest --test-dir build -j2 > ctest.log && fail "nothing fails, though a scenario was changed"
grep -q '4/5 tests passed\|80% tests passed, 1 tests\? failed out of 5' ctest.log || fail "$(cat ctest.log)"
grep -q '<failure type="changed"' build/contacts/junit.xml || fail "junit.xml tells of no change"
contactscope check --accept hull/moved --out build/contacts || fail "nothing is accepted"
ctest --test-dir build -j2 > ctest.log || fail "$(cat ctest.log)"
