#include "snapshot/check.h"

#include <exception>

#include "core/input_error.h"
#include "image/png.h"
#include "snapshot/meshes.h"

namespace contactscope::snapshot {
namespace fs = std::filesystem;
namespace {

std::string size_of(const Image& image) {
  return std::to_string(image.width) + "x" + std::to_string(image.height);
}

/// Description for people: "picture differs in 19 pixels, ...".
std::string describe(const PixelComparison& comparison, const Image& expected,
                     const Image& actual) {
  if (comparison.verdict == PixelVerdict::SizeDiffers)
    return "picture has size " + size_of(actual) + ", stored is " + size_of(expected);
  const PixelBox& box = comparison.largest_cluster_at;
  std::string text = "picture differs in " + std::to_string(comparison.differing) + " pixels";
  text += ", " + std::to_string(comparison.largest_cluster) + " of them together at x ";
  text += std::to_string(box.left) + " to " + std::to_string(box.right - 1) + ", y ";
  text += std::to_string(box.top) + " to " + std::to_string(box.bottom - 1);
  text += "; a channel by up to " + std::to_string(comparison.largest_channel_difference);
  return text;
}

std::string spell(const PixelLimits& limits) {
  return "allowed: " + std::to_string(limits.total) + " pixels, fewer than " +
         std::to_string(limits.cluster) + " of them together, and a channel by " +
         std::to_string(limits.channel);
}

/// A finding about a file, with a remedy unless it is obvious.
Finding found(FindingKind kind, const StoredScenario& archive, const fs::path& stored,
              const std::string& subject, const Policy& policy) {
  Finding finding{kind, archive.scenario};
  finding.file = stored.lexically_relative(archive.root).generic_string();
  finding.done = decide(kind, policy);
  finding.cause = name_of(kind);
  const std::string file = stored.generic_string();
  if (kind == FindingKind::New)
    finding.sentence = subject + ": new, nothing is stored for " + archive.scenario;
  if (kind == FindingKind::Missing)
    finding.sentence = subject + ": missing, nothing is stored at " + file;
  if (kind == FindingKind::Orphaned)
    finding.sentence = subject + ": " + file + " is stored, but no scenario uses it";
  return finding;
}

FindingKind absent(const StoredScenario& archive) {
  return archive.is_new ? FindingKind::New : FindingKind::Missing;
}

std::vector<Checked> found_stale(const StoredScenario& archive, const std::vector<fs::path>& files,
                                 const Policy& policy) {
  std::vector<Checked> all;
  for (const fs::path& file : files) {
    Finding finding = found(FindingKind::Orphaned, archive, file, archive.scenario, policy);
    finding.stored_sha256 = sha256_of_file(file);
    const bool is_removed = finding.done == Done::Removed;
    if (is_removed) remove_with_meshes(archive.root, file);
    all.push_back({std::move(finding), is_removed});
  }
  return all;
}

/// Whether to write a file: as its finding says, or without one if `all` are written. Adds the hash
/// of the stored file to the finding.
bool is_written(std::optional<Finding>& finding, const fs::path& stored, bool all) {
  if (!finding) return all;
  finding->stored_sha256 = sha256_of_file(stored);
  return finding->done != Done::Nothing;
}

/// Note next to a known-bad baseline.
std::string note_of(const fs::path& baseline) {
  fs::path note = baseline;
  std::string text = read_text_file(note.replace_extension(".txt")).value_or("");
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.empty() ? "matches " + baseline.filename().string() + ", which is known to be bad"
                      : text;
}

}  // namespace

StoredScenario archive_of(const fs::path& root, const std::string& scenario) {
  return {root, scenario, stored_files(root, scenario).empty()};
}

void write_stored_picture(const fs::path& path, const Image& image) {
  fs::create_directories(path.parent_path());
  // The smallest level that is still fast. No origin metadata: path and trace identify the picture,
  // and a version or hash would rewrite every file with each release or scenario comment.
  constexpr int kStoredLevel = 9;
  write_png(path.string(), image, kStoredLevel);
}

CheckedPicture check_picture(const StoredScenario& archive, const PictureKey& key,
                             const Image& actual, const Policy& policy, const PixelLimits& limits) {
  CheckedPicture checked;
  const fs::path own = picture_path(archive.root, key);
  const auto finding = [&](FindingKind kind, const fs::path& file) -> Finding& {
    checked.finding = found(kind, archive, file, to_string(key), policy);
    checked.finding->view = key.view.value_or("");
    checked.finding->frame = key.frame;
    return *checked.finding;
  };
  const std::vector<fs::path> baselines = baselines_of(own);
  std::optional<PixelComparison> nearest;
  std::string unreadable;
  bool is_same = false;
  for (const fs::path& file : baselines) {
    const bool is_bad = is_known_bad(file);
    try {
      Image stored = read_png(file.string());
      const PixelComparison comparison = compare_pixels(stored, actual, limits);
      if (comparison.passed()) {
        is_same = !is_bad;
        checked.finding.reset();
        if (is_bad) {
          Finding& known = finding(FindingKind::KnownBad, file);
          known.sentence = to_string(key) + ": " + note_of(file);
          known.cause = "known bad: " + note_of(file);
        }
        break;
      }
      const bool is_nearer = !nearest || (comparison.verdict == PixelVerdict::Different &&
                                          (nearest->verdict == PixelVerdict::SizeDiffers ||
                                           comparison.differing < nearest->differing));
      if (is_bad || !is_nearer) continue;
      nearest = comparison;
      checked.expected = std::move(stored);
      checked.nearest = file;
    } catch (const std::exception& error) {
      unreadable = error.what();
    }
  }
  if (is_same) {
    checked.expected.reset();
  } else if (checked.finding) {
    // known bad
  } else if (nearest) {
    Finding& changed = finding(FindingKind::Changed, checked.nearest);
    const PixelBox& box = nearest->largest_cluster_at;
    changed.pixels = PixelMeasures{nearest->verdict == PixelVerdict::SizeDiffers,
                                   nearest->differing,
                                   nearest->largest_cluster,
                                   {box.left, box.top, box.right, box.bottom},
                                   nearest->largest_channel_difference,
                                   limits};
    changed.sentence = to_string(key) + ": " + describe(*nearest, *checked.expected, actual);
    changed.details = {spell(limits)};
    if (baselines.size() > 1)
      changed.details.push_back("compared with the nearest of " + std::to_string(baselines.size()) +
                                ", " + checked.nearest.filename().string());
  } else if (!unreadable.empty()) {
    finding(FindingKind::Unreadable, own).sentence = to_string(key) + ": " + unreadable;
  } else {
    finding(absent(archive), own);
  }
  const fs::path file = checked.finding ? archive.root / checked.finding->file : own;
  checked.is_written =
      is_written(checked.finding, file, policy.allowed() == Update::All && is_same);
  if (checked.is_written) write_stored_picture(file, actual);
  return checked;
}

CheckedTrace check_trace(const StoredScenario& archive, const trace::Trace& actual,
                         const Policy& policy, const Margins& margins) {
  CheckedTrace checked;
  const fs::path own = trace_path(archive.root, archive.scenario);
  const auto finding = [&](FindingKind kind) -> Finding& {
    return checked.finding.emplace(found(kind, archive, own, archive.scenario, policy));
  };
  try {
    if (const std::optional<std::string> stored =
            read_stored_trace(archive.root, archive.scenario)) {
      checked.differences = compare_with_stored(*stored, own.string(), actual, margins);
      if (!checked.differences.sentences.empty()) {
        Finding& changed = finding(FindingKind::Changed);
        changed.sentence = checked.differences.cause;
        changed.details = checked.differences.sentences;
        changed.cause = (checked.differences.is_input ? std::string(kInputCause) : "trace: ") +
                        checked.differences.signature;
        for (const fs::path& bad : baselines_of(own)) {
          if (!is_known_bad(bad) ||
              !compare_with_stored(with_meshes(*read_text_file(bad), bad), bad.string(), actual)
                   .sentences.empty())
            continue;
          finding(FindingKind::KnownBad).sentence = archive.scenario + ": " + note_of(bad);
          checked.finding->cause = "known bad: " + note_of(bad);
          break;
        }
      }
    } else {
      finding(absent(archive));
    }
  } catch (const std::exception& error) {
    finding(FindingKind::Unreadable).sentence = archive.scenario + ": " + error.what();
  }
  checked.is_written = is_written(checked.finding, own, policy.allowed() == Update::All);
  if (checked.is_written) write_stored_trace(archive.root, own, to_json_lines(actual));
  return checked;
}

CheckedFrames check_frames(const StoredScenario& archive, const FrameHashes& actual,
                           const Policy& policy) {
  CheckedFrames checked;
  const fs::path own = hashes_path(archive.root, archive.scenario);
  const auto finding = [&](FindingKind kind) -> Finding& {
    return checked.finding.emplace(found(kind, archive, own, archive.scenario, policy));
  };
  const std::optional<std::string> text = read_text_file(own);
  try {
    if (!text) {
      if (!actual.hashes.empty()) finding(absent(archive));
    } else {
      const FrameHashes stored = parse_hashes(*text, own.string());
      checked.is_compared = stored.rounding == actual.rounding;
      std::vector<int> came, went;
      for (const auto& [frame, hash] : actual.hashes) {
        const auto before = stored.hashes.find(frame);
        if (before == stored.hashes.end())
          came.push_back(frame);
        else if (checked.is_compared && before->second != hash)
          checked.changed.push_back(frame);
      }
      for (const auto& [frame, hash] : stored.hashes)
        if (!actual.hashes.contains(frame)) went.push_back(frame);
      std::string what;
      const auto add = [&](const std::vector<int>& frames, const std::string& verb) {
        if (frames.empty()) return;
        what += (what.empty() ? "" : ", ") + std::string(frames.size() > 1 ? "frames " : "frame ") +
                spell_numbers(frames) + " " + verb;
      };
      add(checked.changed, "changed");
      add(came, "added");
      add(went, "gone");
      if (!what.empty()) {
        Finding& changed = finding(FindingKind::Changed);
        changed.sentence = archive.scenario + ": of the frames that are not stored, " + what;
        changed.cause = "frames";
      }
    }
  } catch (const std::exception& error) {
    finding(FindingKind::Unreadable).sentence = archive.scenario + ": " + error.what();
  }
  const bool has_any = !actual.hashes.empty();
  checked.is_written =
      is_written(checked.finding, own, policy.allowed() == Update::All && (has_any || text));
  if (!checked.is_written) return checked;
  if (has_any)
    write_text(own, to_text(actual));
  else
    remove_stored(own);
  return checked;
}

std::vector<Checked> check_stale(const StoredScenario& archive, std::span<const std::string> views,
                                 std::span<const int> frames, const Policy& policy) {
  return found_stale(archive, stale_files(archive.root, archive.scenario, views, frames), policy);
}

std::vector<Checked> check_stale_scenarios(const fs::path& root,
                                           std::span<const std::string> scenarios,
                                           const Policy& policy) {
  std::vector<Checked> all;
  for (const std::string& scenario : stored_scenarios(root)) {
    if (std::ranges::find(scenarios, scenario) != scenarios.end()) continue;
    try {
      if (is_of_an_engine(root, scenario)) continue;
      std::ranges::move(found_stale({root, scenario}, stored_files(root, scenario), policy),
                        std::back_inserter(all));
    } catch (const InputError& error) {
      Finding finding{FindingKind::Unreadable, scenario};
      finding.sentence = scenario + ": " + error.what();
      all.push_back(Checked{std::move(finding)});
    }
  }
  return all;
}

std::vector<Checked> check_stale_meshes(const fs::path& root, const Policy& policy) {
  std::vector<Checked> all;
  for (const fs::path& file : unnamed_meshes(root)) {
    const std::string name = (file.parent_path().filename() / file.stem().stem()).generic_string();
    std::ranges::move(found_stale({root, name}, {file}, policy), std::back_inserter(all));
  }
  return all;
}

}  // namespace contactscope::snapshot
