#include "vector/svg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/random_geometry.h"

namespace contactscope::test {
namespace {

/// Pieces of text that are special in HTML, XML or JavaScript.
std::string nasty_text(Random& random) {
  const char* const pieces[] = {
      "<!--", "<script>",     "</script",     "]]>",    "&lt;", "\\", "\"", "'",
      "-->",  "\xE2\x80\xA8", "\xE2\x80\xA9", "@DATA@", "é",    "\n", " ",  "crate"};
  std::string text;
  for (int count = 1 + random.index(6); count > 0; --count)
    text += pieces[random.index(static_cast<int>(std::size(pieces)))];
  return text;
}

TEST(Markup, JsonInAScriptIsTheSameJsonAndHoldsNoMarkup) {
  Random random(15);
  for (int i = 0; i < 100'000; ++i) {
    const std::string text = nasty_text(random);
    const nlohmann::json json{{text, text}};
    const std::string shown = vector::in_script(json.dump());
    ASSERT_EQ(shown.find_first_of("<>&"), std::string::npos) << shown;
    ASSERT_EQ(shown.find("\xE2\x80\xA8"), std::string::npos) << shown;
    ASSERT_EQ(nlohmann::json::parse(shown), json) << shown;
  }
}

TEST(Markup, EscapedTextHasNoByteThatXmlLacks) {
  EXPECT_EQ(vector::escaped("<a b=\"&\">"), "&lt;a b=&quot;&amp;&quot;&gt;");
  EXPECT_EQ(vector::escaped("é\xFF\xEF\xBF\xBE\x01z"), "é\uFFFD\uFFFD z");
}

}  // namespace
}  // namespace contactscope::test
