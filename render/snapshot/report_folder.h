#pragma once

#include "snapshot/check.h"

namespace contactscope::snapshot {

/// Files of a check for people and programs, under OUT/check:
///
///     findings.json                                     the Outcome
///     <group>/<idea>/[<view>/]frame_0012.actual.png     a candidate
///     <group>/<idea>/[<view>/]frame_0012.expected.png, .difference.png
///     <group>/<idea>/trace.actual.jsonl, frames.actual.txt
///
/// Readers never see a partial or mixed report: files are written to a temporary folder and moved
/// when complete. Not thread-safe. Writing throws std::filesystem::filesystem_error.
class ReportFolder {
 public:
  /// `name` is the folder in `out`; each shard has its own.
  explicit ReportFolder(const std::filesystem::path& out, const std::string& name = "check");
  ~ReportFolder();
  ReportFolder& operator=(ReportFolder&&) = delete;

  /// Each stores the files of a failing finding and sets their paths in it. `actual` is the run's.
  void add_picture(Finding& finding, const CheckedPicture& checked, const Image& actual);
  /// SVG of the moved parts of a picture; does nothing if `svg` is empty.
  void add_layers(Finding& finding, const std::string& svg);
  void add_text(Finding& finding, const std::string& actual);
  /// Another file: its path relative to the folder, and its text.
  void add_file(const std::string& path, const std::string& text);

  /// Moves all files into place. Files of an older report are removed, other files stay. Returns
  /// the path of findings.json.
  std::filesystem::path publish(const Outcome& outcome);

  /// The temporary folder.
  const std::filesystem::path& aside() const { return aside_; }

 private:
  std::filesystem::path out_, folder_, aside_;
};

/// Reads OUT/check/findings.json. Throws core's InputError with a remedy if it is missing.
Outcome read_outcome(const std::filesystem::path& folder);
/// Rewrites it after a review.
void write_outcome(const std::filesystem::path& folder, const Outcome& outcome);

// An Outcome as the file OUT/check/findings.json; see src/trace/README.md, "Findings". It has no
// times or other data that differ between runs on the same files.

inline constexpr const char* kFindingsSchema = "contactscope.check/1";

/// The whole file, indented, with a final newline.
std::string to_json(const Outcome& outcome);

/// Throws core's InputError for invalid text; `name` is the file name.
Outcome parse_outcome(const std::string& text, const std::string& name);

}  // namespace contactscope::snapshot
