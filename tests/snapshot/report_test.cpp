#include "snapshot/report.h"

#include <gmock/gmock.h>

#include "image/png.h"
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
constexpr Policy kCi{true, Update::None};

/// How many pixels of a picture are exactly of this colour.
int count_colour(const Image& image, std::uint8_t r, std::uint8_t g, std::uint8_t b) {
  int count = 0;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    count += image.rgb[i] == r && image.rgb[i + 1] == g && image.rgb[i + 2] == b;
  }
  return count;
}

class ReportFiles : public testing::Test {
 protected:
  std::string out(const std::string& file) const { return (out_.path() / "check" / file).string(); }

  TemporaryFolder snapshots_, out_;
  const PictureKey key_{"hull/face_contact", {}, 12};
};

TEST_F(ReportFiles, AMovedDotLeavesItsPicturesAndWhatDiffers) {
  check_picture(snapshots_.path(), key_, dot_picture(80, 45), kUpdate);
  const Image moved = dot_picture(82, 45);
  Report report(out_.path());
  report.add(check_picture(snapshots_.path(), key_, moved, kLocal), moved);
  EXPECT_EQ(report.failures(), 1);
  EXPECT_EQ(report.finish(), out_.path() / "check" / "index.html");

  EXPECT_THAT(out_.files(),
              UnorderedElementsAre("check/index.html", "check/hull/face_contact/report.txt",
                                   "check/hull/face_contact/frame_0012.expected.png",
                                   "check/hull/face_contact/frame_0012.actual.png",
                                   "check/hull/face_contact/frame_0012.difference.png"));
  EXPECT_EQ(read_png(out("hull/face_contact/frame_0012.expected.png")), dot_picture(80, 45));
  EXPECT_EQ(read_png(out("hull/face_contact/frame_0012.actual.png")), moved);
  // Two crescents of the dot's rim; see difference_image() for the colour.
  const Image difference = read_png(out("hull/face_contact/frame_0012.difference.png"));
  EXPECT_GT(count_colour(difference, 0xD5, 0x5E, 0x00), 20);
  EXPECT_LT(count_colour(difference, 0xD5, 0x5E, 0x00), 120);
  EXPECT_THAT(read_text(out("hull/face_contact/report.txt")),
              HasSubstr("hull/face_contact frame 12: picture differs in "));
  EXPECT_THAT(read_text(out("index.html")),
              HasSubstr("<img src=\"hull/face_contact/frame_0012.difference.png\""));
}

TEST_F(ReportFiles, AViewHasItsOwnFolder) {
  const PictureKey key{"hull/face_contact", "side", 12};
  const Image image = dot_picture(80, 45);
  check_picture(snapshots_.path(), key, image, kUpdate);
  Report report(out_.path());
  report.add(check_picture(snapshots_.path(), key, dot_picture(60, 45), kLocal), image);
  EXPECT_TRUE(std::filesystem::exists(out("hull/face_contact/side/frame_0012.expected.png")));
}

TEST_F(ReportFiles, APictureThatIsMissingShowsWhatTheRunMade) {
  const Image image = dot_picture(80, 45);
  Report report(out_.path());
  report.add(check_picture(snapshots_.path(), key_, image, kCi), image);
  report.finish();
  EXPECT_THAT(out_.files(),
              UnorderedElementsAre("check/index.html", "check/hull/face_contact/report.txt",
                                   "check/hull/face_contact/frame_0012.actual.png"));
}

TEST_F(ReportFiles, EveryKindOfFailureIsTold) {
  check_trace(snapshots_.path(), sample_trace(), kUpdate);
  check_picture(snapshots_.path(), key_, dot_picture(80, 45), kUpdate);
  trace::Trace other = sample_trace();
  sample_manifold(other).normal *= -1;
  Report report(out_.path());
  report.add(check_trace(snapshots_.path(), other, kLocal));
  for (const Checked& file : check_stale(snapshots_.path(), key_.scenario, {}, {}, kLocal)) {
    report.add(file);
  }
  report.add("hull/other", {"scenarios/hull/other.toml:31: expected 4 points, got 2"});
  EXPECT_EQ(report.failures(), 3);
  report.finish();
  EXPECT_THAT(read_text(out("hull/face_contact/report.txt")), HasSubstr("normal flipped\n"));
  EXPECT_THAT(read_text(out("hull/face_contact/report.txt")), HasSubstr("frame_0012.png"));
  EXPECT_THAT(read_text(out("hull/other/report.txt")), HasSubstr("expected 4 points, got 2\n"));
  const std::string index = read_text(out("index.html"));
  EXPECT_THAT(index, HasSubstr("<h1>2 scenarios fail</h1>"));
  EXPECT_THAT(index, HasSubstr("normal flipped</li>"));
}

TEST_F(ReportFiles, WhatPassesLeavesNothing) {
  const Image image = dot_picture(80, 45);
  check_picture(snapshots_.path(), key_, image, kUpdate);
  Report report(out_.path());
  report.add(check_picture(snapshots_.path(), key_, image, kLocal), image);
  report.add(check_picture(snapshots_.path(), key_, dot_picture(20, 45), kUpdate), image);
  report.add(check_trace(snapshots_.path(), sample_trace(), kUpdate));
  EXPECT_EQ(report.failures(), 0);
  EXPECT_EQ(report.finish(), std::nullopt);
  EXPECT_THAT(out_.files(), IsEmpty());
}

TEST_F(ReportFiles, AnOldReportIsRemovedAndNothingElse) {
  write_text(out("hull/a/frame_0001.expected.png"), "old");
  write_text(out("hull/a/report.txt"), "old");
  write_text(out("hull/b/side/frame_0001.difference.png"), "old");
  write_text(out("hull/b/mine.txt"), "keep");
  write_text(out("index.html"), "old");
  write_text(out_.path() / "report.txt", "keep");
  const Report report(out_.path());
  EXPECT_EQ(report.failures(), 0);
  EXPECT_THAT(out_.files(), UnorderedElementsAre("check/hull/b/mine.txt", "report.txt"));
  EXPECT_FALSE(std::filesystem::exists(out("hull/a")));
}

TEST_F(ReportFiles, TextAndNamesAreEscaped) {
  const PictureKey key{"a & b/<i>", {}, 0};
  const Image image = dot_picture(80, 45);
  Report report(out_.path());
  report.add(check_picture(snapshots_.path(), key, image, kCi), image);
  report.finish();
  const std::string index = read_text(out("index.html"));
  EXPECT_THAT(index, HasSubstr("<h2>a &amp; b/&lt;i&gt;</h2>"));
  EXPECT_THAT(index, HasSubstr("src=\"a%20%26%20b/%3Ci%3E/frame_0000.actual.png\""));
  EXPECT_THAT(index, Not(HasSubstr("<i>")));
  EXPECT_EQ(escape_html("\"<a>\" & 'b'"), "&quot;&lt;a&gt;&quot; &amp; &#39;b&#39;");
  EXPECT_EQ(to_url("a b/\xC3\xA9#?.png"), "a%20b/%C3%A9%23%3F.png");
}

}  // namespace
}  // namespace contactscope::snapshot
