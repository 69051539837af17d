#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "image/image.h"
#include "snapshot/check.h"

namespace contactscope::snapshot {

/// What a check leaves for people and programs, under OUT/check:
///
///     findings.json                                     the Outcome
///     <group>/<idea>/[<view>/]frame_0012.actual.png     a candidate
///     <group>/<idea>/[<view>/]frame_0012.expected.png, .difference.png
///     <group>/<idea>/trace.actual.jsonl, frames.actual.txt
///
/// Nobody sees half of it, nor that of two runs mixed: files are made aside, and take their places
/// when all are there. Not for several threads at once. Writing throws std::filesystem::filesystem_error.
class ReportFolder {
 public:
  /// `name`: of the folder in `out`; a shard has one of its own.
  explicit ReportFolder(const std::filesystem::path& out, const std::string& name = "check");
  ~ReportFolder();
  ReportFolder(const ReportFolder&) = delete;
  ReportFolder& operator=(const ReportFolder&) = delete;

  /// Each keeps what a finding that fails is about, and says in it where. `actual`: what the run made.
  void add_picture(Finding& finding, const CheckedPicture& checked, const Image& actual);
  /// What of a picture moved, as SVG; nothing where that is empty.
  void add_layers(Finding& finding, const std::string& svg);
  void add_text(Finding& finding, const std::string& actual);
  /// A file of another kind: a path below the folder, and its text.
  void add_file(const std::string& path, const std::string& text);

  /// One of another report.
  void copy_file(const std::filesystem::path& from, const std::string& path);

  /// Puts all in their places, where the files of an older report go and any others stay. Returns the
  /// path of findings.json.
  std::filesystem::path publish(const Outcome& outcome);

  const std::filesystem::path& folder() const { return folder_; }
  /// Where files are made.
  const std::filesystem::path& aside() const { return aside_; }

 private:
  std::filesystem::path out_, folder_, aside_;
};

/// Reads OUT/check/findings.json. Throws core's InputError where there is none, with what would make one.
Outcome read_outcome(const std::filesystem::path& folder);
/// Writes it again, after a review.
void write_outcome(const std::filesystem::path& folder, const Outcome& outcome);

}  // namespace contactscope::snapshot
