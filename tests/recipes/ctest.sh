#!/bin/sh
# The document's tests for CTest, in a project of their own.
. "$2/tests/recipes/common.sh"
repository
{
  echo 'cmake_minimum_required(VERSION 3.16)'
  echo 'project(mine NONE)'
  echo 'enable_testing()'
  sed -n '/^    foreach(part RANGE 1 4)/,/FIXTURES_REQUIRED/p' "$document"
} > CMakeLists.txt
grep -q FIXTURES_REQUIRED CMakeLists.txt || fail "the document has no tests for CTest"
cmake -S . -B build > cmake.log || fail "$(cat cmake.log)"
ctest --test-dir build -j2 > ctest.log && fail "nothing fails, though a scenario was changed"
grep -q '4/5 tests passed\|80% tests passed, 1 tests\? failed out of 5' ctest.log || fail "$(cat ctest.log)"
grep -q '<failure type="changed"' build/contacts/junit.xml || fail "junit.xml tells of no change"
contactscope check --accept hull/moved --out build/contacts || fail "nothing is accepted"
ctest --test-dir build -j2 > ctest.log || fail "$(cat ctest.log)"
