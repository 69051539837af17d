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

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::UnorderedElementsAre;

constexpr Policy kLocal{false, Update::None};
constexpr Policy kMissing{false, Update::Missing};
constexpr Policy kUpdate{false, Update::Failed};
constexpr Policy kUpdateAll{false, Update::All};

const PictureKey kKey{"hull/face_contact", {}, 12};

class Check : public testing::Test {
 protected:
  StoredScenario archive() const { return archive_of(root(), kKey.scenario); }
  CheckedPicture check(const Image& image, const Policy& policy = kLocal,
                       const PixelLimits& limits = {}) const {
    return check_picture(archive(), kKey, image, policy, limits);
  }
  CheckedTrace check(const trace::Trace& trace, const Policy& policy = kLocal) const {
    return check_trace(archive(), trace, policy);
  }
  void store_picture(const PictureKey& key, const Image& image) {
    check_picture(archive(), key, image, kUpdate);
  }
  void store_trace(const trace::Trace& trace) { check(trace, kUpdate); }
  const std::filesystem::path& root() const { return folder_.path(); }
  std::filesystem::path picture() const { return picture_path(root(), kKey); }
  std::filesystem::path sibling(const std::string& name) const {
    return picture().parent_path() / name;
  }
  /// Sets a file's time to long ago, so that any rewriting shows.
  void age(const std::filesystem::path& file) {
    std::filesystem::last_write_time(file, std::filesystem::file_time_type{});
  }
  bool is_aged(const std::filesystem::path& file) {
    return std::filesystem::last_write_time(file) == std::filesystem::file_time_type{};
  }

  TemporaryFolder folder_;
};

/// Matches the kind and sentence of a finding.
auto Reports(FindingKind kind, const std::string& sentence) {
  return testing::Optional(testing::AllOf(testing::Field(&Finding::kind, kind),
                                          testing::Field(&Finding::sentence, HasSubstr(sentence))));
}

TEST_F(Check, TheSamePicturePasses) {
  store_picture(kKey, dot_picture(80, 45));
  EXPECT_EQ(check(dot_picture(80, 45)).finding, std::nullopt);
}

TEST_F(Check, RoundingOfTwoAChannelPasses) {
  store_picture(kKey, dot_picture(80, 45));
  Image rounded = dot_picture(80, 45);
  for (std::uint8_t& channel : rounded.rgb) {
    channel = static_cast<std::uint8_t>(channel < 128 ? channel + 2 : channel - 2);
  }
  EXPECT_EQ(check(rounded).finding, std::nullopt);
}

TEST_F(Check, AMovedDotFailsWithItsNumbersAndTheLimits) {
  store_picture(kKey, dot_picture(80, 45));
  age(picture());
  const CheckedPicture checked = check(dot_picture(82, 45));
  ASSERT_THAT(checked.finding,
              Reports(FindingKind::Changed, "hull/face_contact frame 12: picture differs in"));
  const Finding& finding = *checked.finding;
  EXPECT_TRUE(finding.fails());
  EXPECT_EQ(finding.key(), "hull/face_contact/frame_0012");
  ASSERT_TRUE(finding.pixels.has_value());
  EXPECT_GT(finding.pixels->differing, 8);
  EXPECT_THAT(finding.details, Contains("allowed: 100 pixels, fewer than 8 of them together, "
                                        "and a channel by 2"));
  EXPECT_EQ(finding.stored_sha256, sha256_of_file(picture()));
  ASSERT_TRUE(checked.expected.has_value());
  EXPECT_EQ(*checked.expected, dot_picture(80, 45));
  EXPECT_TRUE(is_aged(picture()));
}

TEST_F(Check, LimitsOfAViewAreItsOwn) {
  store_picture(kKey, dot_picture(80, 45));
  EXPECT_EQ(check(dot_picture(82, 45), kLocal, {2, 1000, 1000}).finding, std::nullopt);
  EXPECT_NE(check(dot_picture(82, 45), kLocal, {2, 1000, 10}).finding, std::nullopt);
}

TEST_F(Check, AnotherSizeFails) {
  store_picture(kKey, dot_picture(80, 45));
  EXPECT_THAT(check(dot_picture(80, 45, 161, 90)).finding,
              Reports(FindingKind::Changed,
                      "hull/face_contact frame 12: picture has size 161x90, stored is 160x90"));
}

TEST_F(Check, ATornPictureIsUnreadableAndAnUpdateFixesIt) {
  store_picture(kKey, dot_picture(80, 45));
  std::filesystem::resize_file(picture(), std::filesystem::file_size(picture()) / 2);
  EXPECT_THAT(check(dot_picture(80, 45)).finding,
              Reports(FindingKind::Unreadable, "frame_0012.png"));
  EXPECT_EQ(check(dot_picture(80, 45), kUpdate).finding->done, Done::Updated);
  EXPECT_EQ(check(dot_picture(80, 45)).finding, std::nullopt);
}

TEST_F(Check, NothingIsStoredByDefault) {
  EXPECT_THAT(check(dot_picture(80, 45)).finding,
              Reports(FindingKind::New, "nothing is stored for hull/face_contact"));
  EXPECT_THAT(check(sample_trace()).finding, Reports(FindingKind::New, "nothing is stored"));
  EXPECT_TRUE(std::filesystem::is_empty(root()));
  store_trace(sample_trace());
  EXPECT_THAT(check(dot_picture(80, 45)).finding,
              Reports(FindingKind::Missing, "hull/face_contact/frame_0012.png"));
}

TEST_F(Check, WriteMissingStoresWhatIsNotThereAndLeavesWhatDiffers) {
  const CheckedPicture first = check(dot_picture(80, 45), kMissing);
  EXPECT_EQ(first.finding->done, Done::Written);
  EXPECT_FALSE(first.finding->fails());
  EXPECT_EQ(read_png(picture().string()), dot_picture(80, 45));
  age(picture());
  EXPECT_TRUE(check(dot_picture(20, 45), kMissing).finding->fails());
  EXPECT_TRUE(is_aged(picture()));
  EXPECT_FALSE(check(sample_trace(), kMissing).finding->fails());
  EXPECT_EQ(check(sample_trace()).finding, std::nullopt);
}

TEST_F(Check, CiWritesNothing) {
  store_picture(kKey, dot_picture(80, 45));
  store_trace(sample_trace());
  const std::filesystem::path trace = trace_path(root(), kKey.scenario);
  age(picture());
  age(trace);
  trace::Trace other = sample_trace();
  sample_manifold(other).normal *= -1;
  for (const Update update : {Update::None, Update::Missing, Update::Failed, Update::All}) {
    const Policy ci{true, update};
    EXPECT_TRUE(check(dot_picture(20, 45), ci).finding->fails());
    EXPECT_TRUE(check(other, ci).finding->fails());
    EXPECT_FALSE(check(sample_trace(), ci).is_written);
    EXPECT_THAT(check_stale(archive(), {}, {}, ci), SizeIs(1));
    EXPECT_TRUE(check_frames(archive(), {"r", {{3, "a"}}}, ci).finding->fails());
    EXPECT_TRUE(is_aged(picture()));
    EXPECT_TRUE(is_aged(trace));
  }
  EXPECT_THAT(folder_.files(), SizeIs(2));
}

TEST_F(Check, AChangedDigitInAStoredTraceFails) {
  store_trace(sample_trace());
  const std::filesystem::path file = trace_path(root(), kKey.scenario);
  std::string text = read_text(file);
  // -0.005 as a float; frame 12 comes last.
  const std::string number = "-0.004999999888";
  const std::size_t place = text.rfind(number);
  ASSERT_NE(place, std::string::npos);
  text[place + 4] = '1';
  write_text(file, text);
  const CheckedTrace checked = check(sample_trace());
  EXPECT_THAT(checked.finding,
              Reports(FindingKind::Changed,
                      "hull/face_contact frame 12, crate-floor: persistent point 3 "
                      "separation"));
  EXPECT_THAT(checked.differences.frames, ElementsAre(12));
}

TEST_F(Check, AStoredTraceThatCannotBeReadFails) {
  store_trace(sample_trace());
  const std::filesystem::path file = trace_path(root(), kKey.scenario);
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 10);
  EXPECT_THAT(check(sample_trace()).finding, Reports(FindingKind::Unreadable, "trace.jsonl:3"));
}

TEST_F(Check, UpdateRewritesWhatDiffersAndReportsIt) {
  store_picture(kKey, dot_picture(80, 45));
  store_trace(sample_trace());
  trace::Trace other = sample_trace();
  sample_manifold(other).normal *= -1;
  const CheckedTrace trace = check(other, kUpdate);
  EXPECT_EQ(trace.finding->done, Done::Updated);
  EXPECT_FALSE(trace.finding->fails());
  EXPECT_THAT(trace.finding->details, Contains(HasSubstr("normal flipped")));
  EXPECT_EQ(check(dot_picture(82, 45), kUpdate).finding->done, Done::Updated);
  EXPECT_EQ(check(other).finding, std::nullopt);
  EXPECT_EQ(read_png(picture().string()), dot_picture(82, 45));
}

TEST_F(Check, OnlyUpdateAllRewritesWhatIsTheSame) {
  store_picture(kKey, dot_picture(80, 45));
  store_trace(sample_trace());
  const std::filesystem::path trace = trace_path(root(), kKey.scenario);
  age(picture());
  age(trace);
  check(dot_picture(80, 45), kUpdate);
  check(sample_trace(), kUpdate);
  EXPECT_TRUE(is_aged(picture()));
  EXPECT_TRUE(is_aged(trace));
  EXPECT_TRUE(check(dot_picture(80, 45), kUpdateAll).is_written);
  EXPECT_TRUE(check(sample_trace(), kUpdateAll).is_written);
  EXPECT_FALSE(is_aged(picture()));
  EXPECT_FALSE(is_aged(trace));
}

TEST_F(Check, ATraceWithANumberThatIsNotFiniteIsNeverStored) {
  store_trace(sample_trace());
  const std::string before = read_text(trace_path(root(), kKey.scenario));
  trace::Trace bad = sample_trace();
  sample_pair(bad).separation = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(check(bad).finding->fails());
  EXPECT_THROW(check(bad, kUpdate), std::domain_error);
  EXPECT_EQ(read_text(trace_path(root(), kKey.scenario)), before);
}

TEST_F(Check, AnyOfTheDriversPicturesPassesAndTheNearestIsShown) {
  store_picture(kKey, dot_picture(80, 45));
  write_png(sibling("frame_0012.osmesa.png").string(), dot_picture(100, 45));
  EXPECT_EQ(check(dot_picture(100, 45)).finding, std::nullopt);
  const CheckedPicture checked = check(dot_picture(101, 45));
  EXPECT_EQ(checked.nearest, sibling("frame_0012.osmesa.png"));
  EXPECT_EQ(checked.expected, dot_picture(100, 45));
  EXPECT_THAT(checked.finding->details,
              Contains("compared with the nearest of 2, frame_0012.osmesa.png"));
  const std::vector<int> frames{12};
  EXPECT_THAT(check_stale(archive(), {}, frames, kLocal), IsEmpty()) << "it goes with its picture";
}

TEST_F(Check, AKnownBugIsReportedWithItsNote) {
  store_picture(kKey, dot_picture(80, 45));
  write_png(sibling("frame_0012.bad_31.png").string(), dot_picture(100, 45));
  write_text(sibling("frame_0012.bad_31.txt"), "the bug of the lost dot is back\n");
  const CheckedPicture checked = check(dot_picture(100, 45), kUpdate);
  EXPECT_THAT(checked.finding, Reports(FindingKind::KnownBad, "the bug of the lost dot is back"));
  EXPECT_TRUE(checked.finding->fails());
  EXPECT_EQ(read_png(picture().string()), dot_picture(80, 45)) << "no update takes it";
  EXPECT_EQ(check(dot_picture(80, 45)).finding, std::nullopt);
}

TEST_F(Check, AKnownBadTraceIsReportedToo) {
  trace::Trace other = sample_trace();
  sample_manifold(other).normal *= -1;
  store_trace(sample_trace());
  write_text(sibling("trace.bad_31.jsonl"), to_json_lines(other));
  EXPECT_THAT(
      check(other).finding,
      Reports(FindingKind::KnownBad, "matches trace.bad_31.jsonl, which is known to be bad"));
}

TEST_F(Check, AStalePictureFailsUntilAnUpdateRemovesIt) {
  store_picture(kKey, dot_picture(80, 45));
  store_picture({kKey.scenario, "side", 12}, dot_picture(80, 45));
  const std::vector<int> frames{12};
  const auto stale = [&](const Policy& policy) {
    return check_stale(archive(), {}, frames, policy);
  };
  const std::vector<Checked> found = stale(kLocal);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_THAT(found[0].finding, Reports(FindingKind::Orphaned, "side/frame_0012.png"));
  ASSERT_THAT(stale(kUpdate), SizeIs(1));
  EXPECT_THAT(folder_.files(), UnorderedElementsAre("hull/face_contact/frame_0012.png"));
  EXPECT_FALSE(std::filesystem::exists(root() / "hull/face_contact/side"));
  EXPECT_THAT(stale(kLocal), IsEmpty());
}

TEST_F(Check, FilesOfARemovedScenarioAreOrphaned) {
  store_picture(kKey, dot_picture(80, 45));
  store_trace(sample_trace());
  check_frames(archive(), {"r", {{3, "a"}}}, kUpdate);
  const std::vector<std::string> none, still_there{"hull/face_contact"};
  EXPECT_THAT(check_stale_scenarios(root(), still_there, kLocal), IsEmpty());
  EXPECT_THAT(check_stale_scenarios(root(), none, kLocal), SizeIs(3));
  EXPECT_THAT(check_stale_scenarios(root(), none, kUpdate), SizeIs(3));
  EXPECT_THAT(folder_.files(), IsEmpty());
}

TEST_F(Check, AnUnreadableTraceOfARemovedScenarioIsReported) {
  store_picture(kKey, dot_picture(80, 45));
  folder_.write("hull/face_contact/trace.jsonl", "");
  for (const Policy& policy : {kLocal, kUpdate}) {
    const std::vector<Checked> found = check_stale_scenarios(root(), {}, policy);
    ASSERT_THAT(found, SizeIs(1));
    EXPECT_THAT(found[0].finding, Reports(FindingKind::Unreadable, "the trace is empty"));
    EXPECT_FALSE(found[0].is_written);
  }
  EXPECT_THAT(folder_.files(), SizeIs(2));
}

TEST_F(Check, FramesThatAreNotStoredAreHeldByTheirHashes) {
  const FrameHashes hashes{"r", {{1, "a"}, {2, "b"}, {3, "c"}}};
  EXPECT_THAT(check_frames(archive(), hashes, kLocal).finding, Reports(FindingKind::New, ""));
  check_frames(archive(), hashes, kUpdate);
  const CheckedFrames same = check_frames(archive(), hashes, kLocal);
  EXPECT_EQ(same.finding, std::nullopt);
  EXPECT_TRUE(same.is_compared);
  const CheckedFrames checked =
      check_frames(archive(), {"r", {{2, "x"}, {3, "y"}, {4, "d"}}}, kLocal);
  EXPECT_THAT(checked.finding, Reports(FindingKind::Changed,
                                       "of the frames that are not stored, frames 2, 3 changed, "
                                       "frame 4 added, frame 1 gone"));
  EXPECT_THAT(checked.changed, ElementsAre(2, 3));
}

TEST_F(Check, HashesOfAMachineThatRoundsDifferentlyAreNotCompared) {
  check_frames(archive(), {"one", {{1, "a"}}}, kUpdate);
  const CheckedFrames checked = check_frames(archive(), {"another", {{1, "x"}}}, kLocal);
  EXPECT_FALSE(checked.is_compared);
  EXPECT_EQ(checked.finding, std::nullopt);
}

}  // namespace
}  // namespace contactscope::snapshot
