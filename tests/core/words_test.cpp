#include "core/words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace contactscope {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

Words german() {
  Words words;
  words.replace("contact point", "Kontaktpunkt");
  words.replace("whisker", "Strich");
  words.replace("overlap", "Überlappung");
  words.replace("step {n} of {m}", "Schritt {n} von {m}");
  words.replace("faces of {shape}", "Flächen von {shape}");
  words.replace("{n} points", "{n} Punkte");
  return words;
}

TEST(Words, ReplaceWholeTextsAndPartsOfThem) {
  const Words words = german();
  EXPECT_EQ(words.of("contact point"), "Kontaktpunkt");
  EXPECT_EQ(words.of("contact point, whisker = overlap × 5"),
            "Kontaktpunkt, Strich = Überlappung × 5");
  EXPECT_EQ(words.of("contact point (overlap)"), "Kontaktpunkt (Überlappung)");
  EXPECT_EQ(words.of("contact points"), "contact points") << "no part of a word";
  EXPECT_EQ(words.of(""), "");
}

TEST(Words, PlacesHoldNumbersOrNames) {
  const Words words = german();
  EXPECT_EQ(words.of("step 3 of 12"), "Schritt 3 von 12");
  EXPECT_EQ(words.of("step three of 12"), "step three of 12");
  EXPECT_EQ(words.of("faces of crate"), "Flächen von crate");
  EXPECT_EQ(words.of("4 points, overlap"), "4 Punkte, Überlappung");
}

TEST(Words, ValuesOfPlaceholdersAreReplacedToo) {
  Words words = german();
  words.replace("crate", "Kiste");
  EXPECT_EQ(words.of("faces of crate"), "Flächen von Kiste");
}

TEST(Words, TitlesWithPlaceholdersAreReplacedAsTheyAreFilled) {
  Words words = german();
  words.replace("Face contact: {kept:point} remain", "Flächenkontakt: es bleiben {kept:point}");
  words.replace("Flat{from 2}", "Eben{from 2}");
  EXPECT_EQ(words.of("Flat"), "Eben");
  EXPECT_EQ(words.of("Face contact: 6 points remain"), "Flächenkontakt: es bleiben 6 Punkte");
}

TEST(Words, PlacesMaySwapTheirOrder) {
  Words words;
  words.replace("{n} of {m}", "von {m}: {n}");
  EXPECT_EQ(words.of("3 of 7"), "von 7: 3");
}

TEST(Words, LaterEntriesTakeThePlaceOfEarlierOnes) {
  Words words = german(), own;
  own.replace("overlap", "Tiefe");
  words.replace(own);
  EXPECT_EQ(words.of("overlap"), "Tiefe");
  EXPECT_EQ(words.of("whisker"), "Strich");
}

TEST(Words, TextsWithAnEmptyPartAreOmitted) {
  Words words = german();
  words.replace("crate", "");
  EXPECT_EQ(words.of("crate"), "");
  EXPECT_EQ(words.of("B: crate"), "");
  EXPECT_EQ(words.of("crates"), "crates");
  EXPECT_EQ(words.of("overlap: "), "Überlappung: ") << "what was empty before takes nothing";
  EXPECT_THAT(Words::mistake("step {n} of {m}", ""), IsEmpty());
}

TEST(Words, MistakesAreDescribed) {
  EXPECT_THAT(Words::mistake("step {n} of {m}", "Schritt {n} von {m}"), IsEmpty());
  EXPECT_THAT(Words::mistake("step {n} of {m}", "Schritt {n}"), HasSubstr("{m} is missing"));
  EXPECT_THAT(Words::mistake("overlap", "{n} tief"), HasSubstr("{n} does not stand in"));
}

TEST(KnownWords, EachIsThereOnce) {
  const std::set<std::string_view> once(known_words().begin(), known_words().end());
  EXPECT_EQ(once.size(), known_words().size());
  EXPECT_FALSE(once.contains(""));
}

}  // namespace
}  // namespace contactscope
