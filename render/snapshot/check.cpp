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

/// Takes the verdict, and says what a user should know or do beyond what differs, where the verdict
/// does not say all. `subject` begins the sentence.
void settle(Checked& checked, const Decision& decision, const std::string& subject) {
  checked.verdict = decision.verdict;
  checked.fails = decision.fails;
  const std::string file = checked.stored.generic_string();
  const auto advise = [&](const std::string& advice) {
    checked.sentences.push_back(subject + ": " + advice);
  };
  if (decision.verdict == Verdict::Missing)
    advise("nothing is stored at " + file +
           "; run check without CI=true, look at what it writes, and commit it");
  if (decision.verdict == Verdict::Written && decision.fails)
    advise("nothing was stored; wrote " + file + ": look at it and commit it");
  if (decision.verdict == Verdict::Stale)
    advise(file +
           " is stored, but the scenario does not ask for it; delete it, or run check --update");
}

std::vector<Checked> settle_stale(const std::string& scenario, const std::vector<fs::path>& files,
                                  const Policy& policy) {
  const Decision decision = decide(Finding::Stale, policy);
  std::vector<Checked> all;
  for (const fs::path& file : files) {
    if (decision.verdict == Verdict::Removed) {
      fs::remove(file);
      // A folder that has nothing left would be called a scenario or a view by a reader.
      std::error_code not_empty;
      fs::remove(file.parent_path(), not_empty);
    }
    settle(all.emplace_back(Checked{scenario, file}), decision, scenario);
  }
  return all;
}

}  // namespace

CheckedPicture check_picture(const fs::path& root, const PictureKey& key, const Image& actual,
                             const Policy& policy) {
  CheckedPicture checked{{key.scenario, picture_path(root, key)}, key};
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
  if (decision.verdict >= Verdict::Written) {
    fs::create_directories(checked.stored.parent_path());
    // Written once, read by every clone: the smallest level that stays fast. Without a word of its
    // origin: its path and the trace beside it say that, and a version or a hash would rewrite every
    // stored file with each release, or with a comment in a scenario.
    constexpr int kStoredLevel = 9;
    write_png(checked.stored.string(), actual, kStoredLevel);
  }
  settle(checked, decision, to_string(key));
  return checked;
}

Checked check_trace(const fs::path& root, const trace::Trace& actual, const Policy& policy) {
  const std::string& scenario = actual.header.scenario;
  Checked checked{scenario, trace_path(root, scenario)};
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
  if (decision.verdict >= Verdict::Written) write_text(checked.stored, to_json_lines(actual));
  settle(checked, decision, scenario);
  return checked;
}

std::vector<Checked> check_stale(const fs::path& root, const std::string& scenario,
                                 std::span<const std::string> views, std::span<const int> frames,
                                 const Policy& policy) {
  return settle_stale(scenario, stale_files(root, scenario, views, frames), policy);
}

std::vector<Checked> check_stale_scenarios(const fs::path& root,
                                           std::span<const std::string> scenarios,
                                           const Policy& policy) {
  std::vector<Checked> all;
  for (const std::string& scenario : stored_scenarios(root)) {
    if (std::ranges::find(scenarios, scenario) != scenarios.end()) continue;
    std::vector<fs::path> files = stale_files(root, scenario, {}, {});
    const fs::path trace = trace_path(root, scenario);
    if (fs::exists(trace)) files.push_back(trace);
    std::ranges::move(settle_stale(scenario, files, policy), std::back_inserter(all));
  }
  return all;
}

}  // namespace contactscope::snapshot
