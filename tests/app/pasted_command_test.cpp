#include <gtest/gtest.h>

#include <sys/wait.h>

#include <cstdlib>

#include "app/render/figure_canvas.h"
#include "snapshot/changes.h"
#include "support/cases.h"
#include "support/random_geometry.h"
#include "support/temporary_folder.h"

// Commands that are printed for pasting, run by a shell.
namespace contactscope::test {
namespace {

using app::for_shell;

/// A name of bytes that are special to shells and patterns, and of others.
std::string nasty_name(Random& random) {
  const std::string bytes = "ab/ '\"\\$`!&|;<>(){}[]*?~#=%^-_.,:@+\t\xc3\xa9";
  std::string name;
  for (int length = 1 + random.index(12); length > 0; --length)
    name += bytes[static_cast<std::size_t>(random.index(static_cast<int>(bytes.size())))];
  return name;
}

TEST(PastedCommand, AShellTakesEachWordAsItIs) {
  const int names = cases(20'000);
  Random random(16);
  const TemporaryFolder folder;
  std::string script = "contactscope() { for word; do printf '%s\\0' \"$word\"; done; }\n",
              expected;
  for (int i = 0; i < names; ++i) {
    const std::string name = nasty_name(random);
    script += "contactscope " + for_shell(name) + "\n";
    expected += name + '\0';
  }
  const std::string command = "cd '" + folder.path().string() + "' && sh '" +
                              folder.write("script", script) + "' > '" + (folder / "out") + "'";
  ASSERT_EQ(WEXITSTATUS(std::system(command.c_str())), 0);
  EXPECT_TRUE(read_text(folder / "out") == expected);
  EXPECT_EQ(folder.files(), (std::set<std::string>{"out", "script"})) << "some name was run";
}

TEST(PastedCommand, APlainWordStaysAsItIs) {
  EXPECT_EQ(for_shell("hull/face_contact/frame_0012"), "hull/face_contact/frame_0012");
  EXPECT_EQ(for_shell("a b/$(touch X)"), "'a b/$(touch X)'");
  EXPECT_EQ(for_shell("it's"), "'it'\\''s'");
  EXPECT_EQ(for_shell(""), "''");
}

TEST(PastedCommand, APatternNamesItsKeyAndNoOther) {
  Random random(17);
  for (int i = 0; i < cases(20'000); ++i) {
    snapshot::Finding own, other;
    own.file = "g/" + nasty_name(random) + "/trace.jsonl";
    other.file = "g/" + nasty_name(random) + "/trace.jsonl";
    const std::string pattern = snapshot::pattern_of(own.key());
    EXPECT_TRUE(snapshot::names(pattern, own)) << pattern;
    EXPECT_EQ(snapshot::names(pattern, other), own.file == other.file) << pattern << other.file;
  }
}

}  // namespace
}  // namespace contactscope::test
