#include "snapshot/check.h"

#include <algorithm>
#include <exception>

#include "image/compare.h"
#include "image/png.h"
#include "snapshot/compare_trace.h"

namespace contactscope::snapshot {
namespace fs = std::filesystem;
namespace {

std::string size_of(const Image& image) {
  return std::to_string(image.width) + "x" + std::to_string(image.height);
}

/// What is different, for people: "picture differs in 19 pixels, ...".
std::string describe(const PixelComparison& comparison, const Image& expected,
                     const Image& actual) {
  if (comparison.verdict == PixelVerdict::SizeDiffers) {
    return "picture has size " + size_of(actual) + ", stored is " + size_of(expected);
  }
  const PixelBox& box = comparison.largest_cluster_at;
  std::string text = "picture differs in " + std::to_string(comparison.differing) + " pixels";
  text += ", " + std::to_string(comparison.largest_cluster) + " of them together at x ";
  text += std::to_string(box.left) + " to " + std::to_string(box.right - 1) + ", y ";
  text += std::to_string(box.top) + " to " + std::to_string(box.bottom - 1);
  text += "; a channel by up to " + std::to_string(comparison.largest_channel_difference);
  return text;
}

/// What a user should know or do, beyond what differs; empty where the verdict says all.
std::string advice(const Decision& decision, const fs::path& stored) {
  const std::string file = stored.generic_string();
  switch (decision.verdict) {
    case Verdict::Missing:
      return "nothing is stored at " + file +
             "; run check without CI=true, look at what it writes, and commit it";
    case Verdict::Written:
      if (!decision.fails) return {};
      return "nothing was stored; wrote " + file + ": look at it and commit it";
    case Verdict::Stale:
      return file +
             " is stored, but the scenario does not ask for it; delete it, or run check "
             "--update";
    case Verdict::Same:
    case Verdict::Different:
    case Verdict::Updated:
    case Verdict::Removed:
      break;
  }
  return {};
}

template <class Checked>
void settle(Checked& checked, const Decision& decision, const std::string& subject) {
  checked.verdict = decision.verdict;
  checked.fails = decision.fails;
  const std::string more = advice(decision, checked.stored);
  if (!more.empty()) checked.sentences.push_back(subject + ": " + more);
}

StaleFile settle_stale(const std::string& scenario, const fs::path& file, const Policy& policy) {
  StaleFile stale{scenario, file, {}, false, {}};
  const Decision decision = decide(Finding::Stale, policy);
  if (decision.action == Action::Remove) {
    fs::remove(file);
    // A folder that has nothing left would be called a scenario or a view by a reader.
    std::error_code not_empty;
    fs::remove(file.parent_path(), not_empty);
  }
  settle(stale, decision, scenario);
  return stale;
}

}  // namespace

CheckedPicture check_picture(const fs::path& root, const PictureKey& key, const Image& actual,
                             const Policy& policy) {
  CheckedPicture checked{key, picture_path(root, key), {}, false, {}, {}};
  Finding finding = Finding::Missing;
  if (fs::exists(checked.stored)) {
    try {
      Image expected = read_png(checked.stored.string());
      const PixelComparison comparison = compare_pixels(expected, actual);
      finding = comparison.passed() ? Finding::Same : Finding::Different;
      if (finding == Finding::Different) {
        checked.sentences.push_back(to_string(key) + ": " + describe(comparison, expected, actual));
        checked.expected = std::move(expected);
      }
    } catch (const std::exception& error) {
      finding = Finding::Different;
      checked.sentences.push_back(to_string(key) + ": " + error.what());
    }
  }
  const Decision decision = decide(finding, policy);
  if (decision.action == Action::Write) {
    fs::create_directories(checked.stored.parent_path());
    // Written once, read by every clone: the smallest level that stays fast.
    constexpr int kStoredLevel = 9;
    write_png(checked.stored.string(), actual, kStoredLevel);
  }
  settle(checked, decision, to_string(key));
  return checked;
}

CheckedTrace check_trace(const fs::path& root, const trace::Trace& actual, const Policy& policy) {
  const std::string& scenario = actual.header.scenario;
  CheckedTrace checked{scenario, trace_path(root, scenario), {}, false, {}};
  Finding finding = Finding::Different;
  try {
    if (const std::optional<std::string> stored = read_stored_trace(root, scenario)) {
      checked.sentences = compare_with_stored(*stored, checked.stored.string(), actual);
      if (checked.sentences.empty()) finding = Finding::Same;
    } else {
      finding = Finding::Missing;
    }
  } catch (const std::exception& error) {
    checked.sentences.push_back(scenario + ": " + error.what());
  }
  const Decision decision = decide(finding, policy);
  if (decision.action == Action::Write) write_text(checked.stored, to_json_lines(actual));
  settle(checked, decision, scenario);
  return checked;
}

std::vector<StaleFile> check_stale(const fs::path& root, const std::string& scenario,
                                   std::span<const std::string> views, std::span<const int> frames,
                                   const Policy& policy) {
  std::vector<StaleFile> all;
  for (const fs::path& file : stale_files(root, scenario, views, frames)) {
    all.push_back(settle_stale(scenario, file, policy));
  }
  return all;
}

std::vector<StaleFile> check_stale_scenarios(const fs::path& root,
                                             std::span<const std::string> scenarios,
                                             const Policy& policy) {
  std::vector<StaleFile> all;
  for (const std::string& scenario : stored_scenarios(root)) {
    if (std::find(scenarios.begin(), scenarios.end(), scenario) != scenarios.end()) continue;
    std::vector<fs::path> files = stale_files(root, scenario, {}, {});
    const fs::path trace = trace_path(root, scenario);
    if (fs::exists(trace)) files.push_back(trace);
    for (const fs::path& file : files) all.push_back(settle_stale(scenario, file, policy));
  }
  return all;
}

}  // namespace contactscope::snapshot
