#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/input_error.h"
#include "scenario/scenario.h"
#include "support/cases.h"
#include "support/damaged_text.h"
#include "support/random_geometry.h"
#include "support/temporary_folder.h"

namespace contactscope::test {
namespace {

TEST(DamagedFile, SlowIsAScenarioOrRefusedInOneLineWithItsPlace) {
  const std::string folder = CONTACTSCOPE_SOURCE_DIR "/scenarios/";
  std::vector<std::string> texts;
  for (const char* name :
       {"hull/face_contact.toml", "solver/stack_of_ten.toml", "incremental/building_up.toml",
        "field/sampling_misses.toml", "continuous/two_iterations.toml", "query/gjk_steps.toml"})
    texts.push_back(read_text(folder + name));
  Random random(18);
  int refused = 0;
  const int files = cases(10'000);
  for (int i = 0; i < files; ++i) {
    const auto& one = texts[static_cast<std::size_t>(random.index(int(texts.size())))];
    const auto& other = texts[static_cast<std::size_t>(random.index(int(texts.size())))];
    const std::string text = damaged(one, other, random);
    try {
      parse_scenario(text, folder + "group/idea.toml");
    } catch (const InputError& error) {
      const std::string message = error.what();
      ++refused;
      EXPECT_TRUE(message.starts_with(folder + "group/idea.toml:")) << message;
      EXPECT_LT(message.size(), 3'000u) << message;
      EXPECT_TRUE(std::ranges::none_of(message, [](char c) { return c >= 0 && c < ' '; }))
          << message;
    }
  }
  EXPECT_GT(refused, files / 4);
  EXPECT_LT(refused, files);
}

}  // namespace
}  // namespace contactscope::test
