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

struct CheckedPicture {
  PictureKey key;
  std::filesystem::path stored;  // the file
  Verdict verdict = Verdict::Same;
  bool fails = false;
  std::vector<std::string> sentences;  // what differs, or why it failed; empty when the same
  std::optional<Image> expected;       // as stored; set where it can be read and differs
};

/// A stored picture that cannot be read differs.
CheckedPicture check_picture(const std::filesystem::path& root, const PictureKey& key,
                             const Image& actual, const Policy& policy);

struct CheckedTrace {
  std::string scenario;
  std::filesystem::path stored;
  Verdict verdict = Verdict::Same;
  bool fails = false;
  std::vector<std::string> sentences;
};

/// `actual` holds the frames that the scenario stores, no more and no fewer. A stored trace that
/// cannot be read differs. Throws std::domain_error where a trace with a number that is not finite
/// would have to be written.
CheckedTrace check_trace(const std::filesystem::path& root, const trace::Trace& actual,
                         const Policy& policy);

struct StaleFile {
  std::string scenario;
  std::filesystem::path stored;
  Verdict verdict = Verdict::Stale;
  bool fails = false;
  std::vector<std::string> sentences;
};

/// Pictures that the scenario does not store any more; see stale_files().
std::vector<StaleFile> check_stale(const std::filesystem::path& root, const std::string& scenario,
                                   std::span<const std::string> views, std::span<const int> frames,
                                   const Policy& policy);

/// The same for every file of scenarios that are stored but not in `scenarios`; for a check of all.
std::vector<StaleFile> check_stale_scenarios(const std::filesystem::path& root,
                                             std::span<const std::string> scenarios,
                                             const Policy& policy);

}  // namespace contactscope::snapshot
