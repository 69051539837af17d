#include "view/words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

namespace contactscope {
namespace {

using testing::IsEmpty;

TEST(Words, ReplaceWholeTexts) {
  Words words;
  words.replace("contact point", "Kontaktpunkt");
  EXPECT_EQ(words.of("contact point"), "Kontaktpunkt");
  EXPECT_EQ(words.of("contact points"), "contact points");
  EXPECT_EQ(words.of("contact point, whisker = overlap"), "contact point, whisker = overlap");
  EXPECT_EQ(words.of(""), "");
}

TEST(Words, APlaceHoldsAnyText) {
  Words words;
  words.replace("leans {n}", "neigt sich um {n}");
  words.replace("cells: {n} tests", "{n} Prüfungen in Zellen");
  words.replace("leans {n} back", "");
  EXPECT_EQ(words.of("leans 27°"), "neigt sich um 27°");
  EXPECT_EQ(words.of("cells: 8 tests"), "8 Prüfungen in Zellen");
  EXPECT_EQ(words.of("leans "), "leans ") << "the place is empty";
  EXPECT_EQ(words.of("cells:  tests"), "cells:  tests");
}

TEST(Words, AWholeTextTakesPrecedence) {
  Words words;
  words.replace("face {n}", "Fläche {n}");
  words.replace("face 7", "Boden");
  EXPECT_EQ(words.of("face 7"), "Boden");
  EXPECT_EQ(words.of("face 8"), "Fläche 8");
}

TEST(Words, NamesAreReplacedNextToRolesAndAnswers) {
  Words words;
  words.rename("old_crate", "Kiste");
  for (const char* name : {"old_crate", "old crate"}) EXPECT_EQ(words.of(name), "Kiste");
  EXPECT_EQ(words.of("A: old crate"), "A: Kiste");
  EXPECT_EQ(words.of("B: old crate"), "B: Kiste");
  EXPECT_EQ(words.of("old crate: yes, falsely"), "Kiste: yes, falsely");
  EXPECT_EQ(words.of("old crates"), "old crates");
}

TEST(Words, NumbersOfCopiesAreSeparatedAndThoseOfPartsAreNot) {
  for (const auto& [name, words] :
       std::map<std::string, std::string>{{"small_crate3", "small crate 3"},
                                          {"box_12", "box 12"},
                                          {"box3d", "box3d"},
                                          {"car/5", "car/5"},
                                          {"doll_2/1", "doll 2/1"},
                                          {"Kegel\xC3\xA4"
                                           "7",
                                           "Kegel\xC3\xA4 7"},
                                          {"crate.001", "crate.001"},
                                          {"7", "7"}})
    EXPECT_EQ(name_in_words(name), words);
}

TEST(Words, AnEmptyWordHidesTheText) {
  Words words;
  words.replace("leans {n}", "");
  words.rename("crate", "");
  for (const char* text : {"leans 27°", "crate", "A: crate", "B: crate", "crate: no"})
    EXPECT_THAT(words.of(text), IsEmpty()) << text;
}

TEST(Words, LaterEntriesTakeThePlaceOfEarlierOnes) {
  Words words, own;
  words.replace("overlap", "Überlappung");
  words.replace("new", "neu");
  own.replace("overlap", "Tiefe");
  words.replace(own);
  EXPECT_EQ(words.of("overlap"), "Tiefe");
  EXPECT_EQ(words.of("new"), "neu");
}

TEST(Words, PlacesStandInBraces) {
  EXPECT_EQ(place_in("{n} apart, slid"), "{n}");
  EXPECT_EQ(place_in("leans {n}"), "{n}");
  for (const char* key : {"leans", "a } b { c", "{", ""}) EXPECT_THAT(place_in(key), IsEmpty());
}

TEST(KnownWords, EachIsThereOnceWithAtMostOnePlace) {
  const std::set<std::string_view> once(known_words().begin(), known_words().end());
  EXPECT_EQ(once.size(), known_words().size());
  EXPECT_FALSE(once.contains(""));
  for (const std::string_view key : once)
    EXPECT_EQ(std::ranges::count(key, '{'), place_in(key).empty() ? 0 : 1) << key;
}

}  // namespace
}  // namespace contactscope
