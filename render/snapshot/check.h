#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "image/image.h"
#include "snapshot/store.h"
#include "snapshot/verdict.h"

/// From a stored file and what a run made to a verdict, and to the file where the policy says so.
/// `root` is the folder "snapshots". Different files may be checked from several threads at once.
/// Every function throws std::filesystem::filesystem_error where a file cannot be written or
/// removed.
namespace contactscope::snapshot {

/// What came of one stored file.
struct Checked {
  std::string scenario;
  std::filesystem::path stored;
  Verdict verdict = Verdict::Same;
  bool fails = false;
  std::vector<std::string> sentences{};  // what differs, or why it failed; empty when the same
};

struct CheckedPicture : Checked {
  PictureKey key;
  std::optional<Image> expected{};  // as stored; set where it can be read and differs
};

/// A stored picture that cannot be read differs.
CheckedPicture check_picture(const std::filesystem::path& root, const PictureKey& key,
                             const Image& actual, const Policy& policy);

/// `actual` holds the frames that the scenario stores, no more and no fewer. A stored trace that
/// cannot be read differs. Throws std::domain_error where a trace with a number that is not finite
/// would have to be written.
Checked check_trace(const std::filesystem::path& root, const trace::Trace& actual,
                    const Policy& policy);

/// Pictures that the scenario does not store any more; see stale_files().
std::vector<Checked> check_stale(const std::filesystem::path& root, const std::string& scenario,
                                 std::span<const std::string> views, std::span<const int> frames,
                                 const Policy& policy);

/// The same for every file of scenarios that are stored but not in `scenarios`; for a check of all.
std::vector<Checked> check_stale_scenarios(const std::filesystem::path& root,
                                           std::span<const std::string> scenarios,
                                           const Policy& policy);

}  // namespace contactscope::snapshot
