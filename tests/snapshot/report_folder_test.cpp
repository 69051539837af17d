#include "snapshot/report_folder.h"

#include <gmock/gmock.h>

#include "core/input_error.h"
#include "image/png.h"
#include "snapshot/changes.h"
#include "snapshot/dot_picture.h"
#include "snapshot/sample_trace.h"
#include "support/temporary_folder.h"

namespace contactscope::snapshot {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::UnorderedElementsAre;

constexpr Policy kLocal{false, Update::None};
constexpr Policy kUpdate{false, Update::Failed};

class ReportFiles : public testing::Test {
 protected:
  ReportFiles() { store(dot_picture(80, 45)); }

  void store(const Image& image) { check_picture(archive(), key_, image, kUpdate); }
  StoredScenario archive() const { return archive_of(snapshots_.path(), key_.scenario); }
  std::string out(const std::string& file) const { return (out_.path() / "check" / file).string(); }
  std::filesystem::path folder() const { return out_.path() / "check"; }
  Outcome report(const Image& actual) {
    ReportFolder report(out_.path());
    CheckedPicture checked = check_picture(archive(), key_, actual, kLocal);
    Outcome outcome{snapshots_.path().string()};
    outcome.scenarios.push_back({key_.scenario, "scenarios/hull/face_contact.toml", 24, 1});
    if (checked.finding) {
      report.add_picture(*checked.finding, checked, actual);
      outcome.scenarios[0].findings.push_back(*checked.finding);
    }
    report.publish(outcome);
    return outcome;
  }
  static Finding& only(Outcome& outcome) { return outcome.scenarios[0].findings[0]; }

  TemporaryFolder snapshots_, out_;
  const PictureKey key_{"hull/face_contact", {}, 12};
};

TEST_F(ReportFiles, AMovedDotLeavesItsPictures) {
  report(dot_picture(82, 45));
  EXPECT_THAT(
      out_.files(),
      UnorderedElementsAre("check/findings.json", "check/hull/face_contact/frame_0012.expected.png",
                           "check/hull/face_contact/frame_0012.actual.png",
                           "check/hull/face_contact/frame_0012.difference.png"));
  EXPECT_EQ(read_png(out("hull/face_contact/frame_0012.expected.png")), dot_picture(80, 45));
  EXPECT_EQ(read_png(out("hull/face_contact/frame_0012.actual.png")), dot_picture(82, 45));
}

TEST_F(ReportFiles, AnUnchangedPictureLeavesOnlyTheFindings) {
  report(dot_picture(82, 45));
  report(dot_picture(80, 45));
  EXPECT_THAT(out_.files(), UnorderedElementsAre("check/findings.json"));
  EXPECT_EQ(tally(read_outcome(folder())).failing, 0);
}

TEST_F(ReportFiles, FilesOfOthersStay) {
  write_text(out("hull/a/frame_0001.expected.png"), "old");
  write_text(out("hull/b/mine.txt"), "keep");
  report(dot_picture(80, 45));
  EXPECT_THAT(out_.files(), UnorderedElementsAre("check/findings.json", "check/hull/b/mine.txt"));
  EXPECT_FALSE(std::filesystem::exists(out("hull/a")));
}

TEST_F(ReportFiles, NothingIsSeenOfAReportThatIsNotDone) {
  report(dot_picture(80, 45));
  {
    ReportFolder unfinished(out_.path());
    unfinished.add_file("hull/a/trace.actual.jsonl", "half");
  }
  EXPECT_THAT(out_.files(), UnorderedElementsAre("check/findings.json"));
}

TEST_F(ReportFiles, FindingsReadBack) {
  const Outcome written = report(dot_picture(82, 45));
  const Outcome read = read_outcome(folder());
  EXPECT_EQ(to_json(read), to_json(written));
  EXPECT_EQ(read.scenarios[0].findings[0].pixels->differing,
            written.scenarios[0].findings[0].pixels->differing);
  EXPECT_THROW(read_outcome(out_.path()), InputError);
  EXPECT_THROW(parse_outcome("{}", "findings.json"), InputError);
}

TEST_F(ReportFiles, AcceptedCandidatesAreWhatAnUpdateStores) {
  Outcome outcome = report(dot_picture(82, 45));
  EXPECT_EQ(accept(folder(), snapshots_.path(), only(outcome)), "");
  EXPECT_FALSE(only(outcome).fails());
  const std::string accepted = read_text(picture_path(snapshots_.path(), key_));
  store(dot_picture(80, 45));
  store(dot_picture(82, 45));
  EXPECT_EQ(read_text(picture_path(snapshots_.path(), key_)), accepted);
  EXPECT_THAT(accept(folder(), snapshots_.path(), only(outcome)), HasSubstr("done already"));
}

TEST_F(ReportFiles, AStaleCandidateIsRefused) {
  Outcome outcome = report(dot_picture(82, 45));
  store(dot_picture(60, 45));
  EXPECT_THAT(accept(folder(), snapshots_.path(), only(outcome)), HasSubstr("is stale"));
  EXPECT_EQ(read_png(picture_path(snapshots_.path(), key_).string()), dot_picture(60, 45));
  store(dot_picture(80, 45));
  write_png(out("hull/face_contact/frame_0012.actual.png"), dot_picture(10, 45));
  EXPECT_THAT(accept(folder(), snapshots_.path(), only(outcome)), HasSubstr("candidate"));
}

TEST_F(ReportFiles, AKnownBugIsStoredNextToTheSnapshot) {
  Outcome outcome = report(dot_picture(82, 45));
  EXPECT_EQ(accept(folder(), snapshots_.path(), only(outcome), {"bad_31", "it is back"}), "");
  EXPECT_THAT(snapshots_.files(), UnorderedElementsAre("hull/face_contact/frame_0012.png",
                                                       "hull/face_contact/frame_0012.bad_31.png",
                                                       "hull/face_contact/frame_0012.bad_31.txt"));
  EXPECT_TRUE(only(outcome).fails()) << "it is known, and as wrong as before";
  EXPECT_EQ(only(outcome).review, Review::Rejected);
  EXPECT_THAT(check_picture(archive(), key_, dot_picture(82, 45), kLocal).finding->sentence,
              HasSubstr("it is back"));
}

TEST_F(ReportFiles, OnlyPicturesHaveAnotherBaseline) {
  Outcome outcome = report(dot_picture(82, 45));
  EXPECT_EQ(accept(folder(), snapshots_.path(), only(outcome), {"osmesa"}), "");
  EXPECT_EQ(only(outcome).done, Done::Written);
  write_text(snapshots_ / "hull/face_contact/trace.jsonl", "stored");
  write_text(folder() / "hull/face_contact/trace.actual.jsonl", "actual");
  Finding trace{FindingKind::Changed, "hull/face_contact", "", {}, "hull/face_contact/trace.jsonl"};
  trace.candidate = "hull/face_contact/trace.actual.jsonl";
  trace.stored_sha256 = sha256_of_file(snapshots_ / "hull/face_contact/trace.jsonl");
  trace.candidate_sha256 = sha256_of_file(folder() / trace.candidate);
  EXPECT_THAT(accept(folder(), snapshots_.path(), trace, {"osmesa"}),
              HasSubstr("is not a picture"));
  EXPECT_TRUE(trace.fails());
}

TEST(Accept, APictureIsNamedWithOrWithoutTheWordOfItsBaseline) {
  const Finding finding{FindingKind::Changed, "hull/face_contact", "", 12,
                        "hull/face_contact/frame_0012.osmesa.png"};
  for (const char* pattern : {"hull/face_contact/frame_0012", "hull/face_contact/frame_0012.osmesa",
                              "*/frame_0012", "hull"})
    EXPECT_TRUE(names(pattern, finding)) << pattern;
  for (const char* pattern : {"hull/face_contact/frame_001", "hull/face_contact/frame_0012.egl"})
    EXPECT_FALSE(names(pattern, finding)) << pattern;
}

TEST(Accept, PatternsNameKeysAndTheFoldersAboveThem) {
  Finding finding{FindingKind::Changed, "hull/face_contact", "side", 12,
                  "hull/face_contact/side/frame_0012.png"};
  for (const char* pattern : {"hull/face_contact/side/frame_0012", "hull/face_contact/side",
                              "hull/face_contact", "hull/", "*", "hull/*", "*frame_001?"})
    EXPECT_TRUE(names(pattern, finding)) << pattern;
  for (const char* pattern : {"hull/face", "face_contact", "frame_0012", "hull/face_contact/top"})
    EXPECT_FALSE(names(pattern, finding)) << pattern;
}

}  // namespace
}  // namespace contactscope::snapshot
