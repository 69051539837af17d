#include "snapshot/check.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <limits>

#include "image/png.h"
#include "snapshot/dot_picture.h"
#include "snapshot/sample_trace.h"
#include "support/temporary_folder.h"

namespace contactscope::snapshot {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::UnorderedElementsAre;

constexpr Policy kLocal{false, Update::None};
constexpr Policy kUpdate{false, Update::Failed};
constexpr Policy kUpdateAll{false, Update::All};

const PictureKey kKey{"hull/face_contact", {}, 12};

class Check : public testing::Test {
 protected:
  void store_picture(const PictureKey& key, const Image& image) {
    check_picture(root(), key, image, kUpdate);
  }
  void store_trace(const trace::Trace& trace) { check_trace(root(), trace, kUpdate); }
  const std::filesystem::path& root() const { return folder_.path(); }
  std::filesystem::path picture() const { return picture_path(root(), kKey); }
  /// Sets a file's time to long ago, so that any rewriting shows.
  void age(const std::filesystem::path& file) {
    std::filesystem::last_write_time(file, std::filesystem::file_time_type{});
  }
  bool is_aged(const std::filesystem::path& file) {
    return std::filesystem::last_write_time(file) == std::filesystem::file_time_type{};
  }

  TemporaryFolder folder_;
};

TEST_F(Check, TheSamePicturePasses) {
  store_picture(kKey, dot_picture(80, 45));
  const CheckedPicture checked = check_picture(root(), kKey, dot_picture(80, 45), kLocal);
  EXPECT_EQ(checked.verdict, Verdict::Same);
  EXPECT_FALSE(checked.fails);
  EXPECT_THAT(checked.sentences, IsEmpty());
}

TEST_F(Check, RoundingOfTwoAChannelPasses) {
  store_picture(kKey, dot_picture(80, 45));
  Image rounded = dot_picture(80, 45);
  for (std::uint8_t& channel : rounded.rgb) {
    channel = static_cast<std::uint8_t>(channel < 128 ? channel + 2 : channel - 2);
  }
  EXPECT_FALSE(check_picture(root(), kKey, rounded, kLocal).fails);
}

TEST_F(Check, AMovedDotFails) {
  store_picture(kKey, dot_picture(80, 45));
  age(picture());
  const CheckedPicture checked = check_picture(root(), kKey, dot_picture(82, 45), kLocal);
  EXPECT_EQ(checked.verdict, Verdict::Different);
  EXPECT_TRUE(checked.fails);
  EXPECT_THAT(checked.sentences,
              ElementsAre(HasSubstr("hull/face_contact frame 12: picture differs in")));
  ASSERT_TRUE(checked.expected.has_value());
  EXPECT_EQ(*checked.expected, dot_picture(80, 45));
  EXPECT_TRUE(is_aged(picture()));
}

TEST_F(Check, AnotherSizeFails) {
  store_picture(kKey, dot_picture(80, 45));
  const CheckedPicture checked = check_picture(root(), kKey, dot_picture(80, 45, 161, 90), kLocal);
  EXPECT_TRUE(checked.fails);
  EXPECT_THAT(checked.sentences, ElementsAre("hull/face_contact frame 12: picture has size "
                                             "161x90, stored is 160x90"));
}

TEST_F(Check, ATornPictureFailsAndAnUpdateMendsIt) {
  store_picture(kKey, dot_picture(80, 45));
  std::filesystem::resize_file(picture(), std::filesystem::file_size(picture()) / 2);
  const CheckedPicture checked = check_picture(root(), kKey, dot_picture(80, 45), kLocal);
  EXPECT_EQ(checked.verdict, Verdict::Different);
  EXPECT_TRUE(checked.fails);
  EXPECT_THAT(checked.sentences, ElementsAre(HasSubstr("frame_0012.png")));
  EXPECT_EQ(check_picture(root(), kKey, dot_picture(80, 45), kUpdate).verdict, Verdict::Updated);
  EXPECT_EQ(check_picture(root(), kKey, dot_picture(80, 45), kLocal).verdict, Verdict::Same);
}

TEST_F(Check, AMissingPictureIsWrittenAndFailsOnce) {
  const CheckedPicture first = check_picture(root(), kKey, dot_picture(80, 45), kLocal);
  EXPECT_EQ(first.verdict, Verdict::Written);
  EXPECT_TRUE(first.fails);
  EXPECT_THAT(first.sentences, ElementsAre(HasSubstr("nothing was stored; wrote")));
  EXPECT_EQ(read_png(picture().string()), dot_picture(80, 45));
  EXPECT_FALSE(check_picture(root(), kKey, dot_picture(80, 45), kLocal).fails);
}

TEST_F(Check, AMissingTraceIsWrittenAndFailsOnce) {
  const Checked first = check_trace(root(), sample_trace(), kLocal);
  EXPECT_EQ(first.verdict, Verdict::Written);
  EXPECT_TRUE(first.fails);
  EXPECT_THAT(first.sentences, SizeIs(1));
  const Checked second = check_trace(root(), sample_trace(), kLocal);
  EXPECT_EQ(second.verdict, Verdict::Same);
  EXPECT_FALSE(second.fails);
}

TEST_F(Check, CiWritesNothing) {
  for (const Update update : {Update::None, Update::Failed, Update::All}) {
    const Policy ci{true, update};
    const CheckedPicture picture = check_picture(root(), kKey, dot_picture(80, 45), ci);
    EXPECT_EQ(picture.verdict, Verdict::Missing);
    EXPECT_TRUE(picture.fails);
    EXPECT_THAT(picture.sentences, ElementsAre(HasSubstr("nothing is stored")));
    const Checked trace = check_trace(root(), sample_trace(), ci);
    EXPECT_EQ(trace.verdict, Verdict::Missing);
    EXPECT_TRUE(trace.fails);
    EXPECT_TRUE(std::filesystem::is_empty(root()));
  }
}

TEST_F(Check, CiChangesNothing) {
  store_picture(kKey, dot_picture(80, 45));
  store_trace(sample_trace());
  const std::filesystem::path trace = trace_path(root(), kKey.scenario);
  age(picture());
  age(trace);
  trace::Trace other = sample_trace();
  sample_manifold(other).normal *= -1;
  for (const Update update : {Update::None, Update::Failed, Update::All}) {
    const Policy ci{true, update};
    EXPECT_TRUE(check_picture(root(), kKey, dot_picture(20, 45), ci).fails);
    EXPECT_TRUE(check_trace(root(), other, ci).fails);
    EXPECT_THAT(check_stale(root(), kKey.scenario, {}, {}, ci), SizeIs(1));
    EXPECT_TRUE(is_aged(picture()));
    EXPECT_TRUE(is_aged(trace));
  }
}

TEST_F(Check, AChangedDigitInAStoredTraceFails) {
  store_trace(sample_trace());
  const std::filesystem::path file = trace_path(root(), kKey.scenario);
  std::string text = read_text(file);
  // -0.005 as a float; frame 12 stands last.
  const std::string number = "-0.004999999888";
  const std::size_t place = text.rfind(number);
  ASSERT_NE(place, std::string::npos);
  text[place + 4] = '1';
  write_text(file, text);
  const Checked checked = check_trace(root(), sample_trace(), kLocal);
  EXPECT_EQ(checked.verdict, Verdict::Different);
  EXPECT_TRUE(checked.fails);
  EXPECT_THAT(checked.sentences,
              ElementsAre(HasSubstr("hull/face_contact frame 12, crate-floor: persistent point 3 "
                                    "separation")));
}

TEST_F(Check, AStoredTraceThatCannotBeReadFails) {
  store_trace(sample_trace());
  const std::filesystem::path file = trace_path(root(), kKey.scenario);
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 10);
  const Checked checked = check_trace(root(), sample_trace(), kLocal);
  EXPECT_TRUE(checked.fails);
  EXPECT_THAT(checked.sentences, ElementsAre(HasSubstr("trace.jsonl:3")));
}

TEST_F(Check, UpdateRewritesWhatDiffersAndTellsWhat) {
  store_picture(kKey, dot_picture(80, 45));
  store_trace(sample_trace());
  trace::Trace other = sample_trace();
  sample_manifold(other).normal *= -1;
  const Checked trace = check_trace(root(), other, kUpdate);
  EXPECT_EQ(trace.verdict, Verdict::Updated);
  EXPECT_FALSE(trace.fails);
  EXPECT_THAT(trace.sentences, ElementsAre(HasSubstr("normal flipped")));
  EXPECT_EQ(check_picture(root(), kKey, dot_picture(82, 45), kUpdate).verdict, Verdict::Updated);
  EXPECT_EQ(check_trace(root(), other, kLocal).verdict, Verdict::Same);
  EXPECT_EQ(read_png(picture().string()), dot_picture(82, 45));
}

TEST_F(Check, OnlyUpdateAllRewritesWhatIsTheSame) {
  store_picture(kKey, dot_picture(80, 45));
  store_trace(sample_trace());
  const std::filesystem::path trace = trace_path(root(), kKey.scenario);
  age(picture());
  age(trace);
  check_picture(root(), kKey, dot_picture(80, 45), kUpdate);
  check_trace(root(), sample_trace(), kUpdate);
  EXPECT_TRUE(is_aged(picture()));
  EXPECT_TRUE(is_aged(trace));
  check_picture(root(), kKey, dot_picture(80, 45), kUpdateAll);
  check_trace(root(), sample_trace(), kUpdateAll);
  EXPECT_FALSE(is_aged(picture()));
  EXPECT_FALSE(is_aged(trace));
}

TEST_F(Check, ATraceWithANumberThatIsNotFiniteIsNeverStored) {
  store_trace(sample_trace());
  const std::string before = read_text(trace_path(root(), kKey.scenario));
  trace::Trace bad = sample_trace();
  sample_pair(bad).separation = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(check_trace(root(), bad, kLocal).fails);
  EXPECT_THROW(check_trace(root(), bad, kUpdate), std::domain_error);
  EXPECT_EQ(read_text(trace_path(root(), kKey.scenario)), before);
}

TEST_F(Check, AStalePictureFailsUntilAnUpdateRemovesIt) {
  store_picture(kKey, dot_picture(80, 45));
  store_picture({kKey.scenario, "side", 12}, dot_picture(80, 45));
  const std::vector<int> frames{12};
  const auto check = [&](const Policy& policy) {
    return check_stale(root(), kKey.scenario, {}, frames, policy);
  };
  const std::vector<Checked> stale = check(kLocal);
  ASSERT_THAT(stale, SizeIs(1));
  EXPECT_EQ(stale[0].verdict, Verdict::Stale);
  EXPECT_TRUE(stale[0].fails);
  EXPECT_THAT(stale[0].sentences, ElementsAre(HasSubstr("side/frame_0012.png")));
  ASSERT_THAT(check(kUpdate), SizeIs(1));
  EXPECT_THAT(folder_.files(), UnorderedElementsAre("hull/face_contact/frame_0012.png"));
  EXPECT_FALSE(std::filesystem::exists(root() / "hull/face_contact/side"));
  EXPECT_THAT(check(kLocal), IsEmpty());
}

TEST_F(Check, WhatIsLeftOfARemovedScenarioIsStale) {
  store_picture(kKey, dot_picture(80, 45));
  store_trace(sample_trace());
  const std::vector<std::string> none, still_there{"hull/face_contact"};
  EXPECT_THAT(check_stale_scenarios(root(), still_there, kLocal), IsEmpty());
  EXPECT_THAT(check_stale_scenarios(root(), none, kLocal), SizeIs(2));
  EXPECT_THAT(check_stale_scenarios(root(), none, kUpdate), SizeIs(2));
  EXPECT_THAT(folder_.files(), IsEmpty());
}

}  // namespace
}  // namespace contactscope::snapshot
