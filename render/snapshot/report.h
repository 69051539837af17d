#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "image/image.h"
#include "snapshot/check.h"

namespace contactscope::snapshot {

/// What a failed check leaves for people to look at, under OUT/check:
///
///     <group>/<idea>/[<view>/]frame_0012.expected.png, .actual.png, .difference.png
///     <group>/<idea>/report.txt     the sentences, one a line
///     index.html                    all failures, pictures side by side; needs no server
///
/// A check that fails nowhere leaves nothing. Not for several threads at once. Writing throws
/// std::filesystem::filesystem_error.
class Report {
 public:
  /// Removes what an earlier report left in `out`/check, so that nothing old is taken for new;
  /// files of other names stay.
  explicit Report(const std::filesystem::path& out);

  /// Each takes only what fails; pictures are written at once.
  void add(const CheckedPicture& picture, const Image& actual);
  void add(const Checked& file);
  /// Anything else that fails a scenario, such as an expectation that is not met.
  void add(const std::string& scenario, const std::vector<std::string>& sentences);

  int failures() const { return failures_; }
  /// Writes the texts. The path of index.html, or nothing where nothing failed.
  std::optional<std::filesystem::path> finish() const;

 private:
  struct Pictures {
    std::string title;  // "frame 12, view side"
    std::string expected, actual,
        difference;  // paths relative to folder_; empty where there is none
  };
  struct ScenarioFailures {
    std::vector<std::string> sentences;
    std::vector<Pictures> pictures;
  };

  std::string html() const;

  std::filesystem::path folder_;
  std::map<std::string, ScenarioFailures> scenarios_;
  int failures_ = 0;
};

/// Text for HTML, between tags or in a quoted attribute.
std::string escape_html(const std::string& text);
/// A relative path as a URL: what is neither a letter, a digit nor one of "-._~/" as %XX.
std::string to_url(const std::string& path);

}  // namespace contactscope::snapshot
