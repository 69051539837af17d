#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "image/compare.h"

/// What a check found, as data: whoever tells of it, in a terminal, on a page or to another program,
/// and whoever accepts some of it later, reads this and nothing else.
namespace contactscope::snapshot {

enum class FindingKind {
  Changed,
  New,      // nothing at all is stored of the scenario
  Missing,  // something is, but not this file
  Orphaned,
  UnmetExpectation,
  Unreadable,
  KnownBad,
  UnreadableScenario,  // its file cannot be read, parsed or run, so nothing was compared
};
inline constexpr std::array<std::string_view, 8> kFindingKinds = {
    "changed",           "new",        "missing",   "orphaned",
    "unmet_expectation", "unreadable", "known_bad", "unreadable_scenario"};
inline constexpr std::string_view name_of(FindingKind kind) {
  return kFindingKinds[static_cast<std::size_t>(kind)];
}

/// What the cause begins with where what the scenario's file says is another: a shape, a setting, where it starts.
inline constexpr std::string_view kInputCause = "scenario: ";

/// What became of the stored file.
enum class Done { Nothing, Written, Updated, Removed };
inline constexpr std::array<std::string_view, 4> kDone = {"nothing", "written", "updated",
                                                          "removed"};

/// What somebody said of it since.
enum class Review { Open, Accepted, Rejected };
inline constexpr std::array<std::string_view, 3> kReviews = {"open", "accepted", "rejected"};

/// How two pictures differ, and what they may differ by.
struct PixelMeasures {
  PixelComparison found{};
  PixelLimits limits{};
};

/// One thing that is not as it is stored, or not as it was expected.
struct Finding {
  FindingKind kind = FindingKind::Changed;
  std::string scenario;
  std::string view{};          // empty: the scenario has one, or it is of no picture
  std::optional<int> frame{};  // of a picture
  std::string file{};      // below the folder of snapshots, with slashes; of an expectation empty
  std::string sentence{};  // what to know first
  std::vector<std::string> details{};  // all that differs, one a line
  std::string cause{};                 // equal for findings that may have one cause; never empty
  std::optional<PixelMeasures> pixels{};
  std::vector<std::string>
      layers{};  // of a picture whose facts changed: those that are drawn otherwise
  // Below the folder of the report; empty where there is none.
  std::string candidate{};       // what the run made, to be stored where it is accepted
  std::string expected{};        // what is stored
  std::string difference{};      // a picture of both
  std::string layers_picture{};  // an SVG of the layers, as expected and as they are
  // Of the file as the run found it, and of the candidate; empty where there is none.
  std::string stored_sha256{}, candidate_sha256{};
  Done done = Done::Nothing;
  Review review = Review::Open;

  /// What a command line calls it: "hull/face_contact/side/frame_0012", "hull/face_contact/trace",
  /// "hull/face_contact/expectations", "hull/face_contact/scenario" of one that cannot be read.
  std::string key() const {
    if (kind == FindingKind::UnreadableScenario) return scenario + "/scenario";
    if (file.empty()) return scenario + "/expectations";
    return file.substr(0, file.rfind('.'));
  }
  /// The check exits with 1.
  bool fails() const { return done == Done::Nothing && review != Review::Accepted; }
  bool is_picture() const { return frame.has_value(); }
  /// There is a candidate, or a file to remove. An expectation is mended instead, and so is what is known to be bad.
  bool is_acceptable() const { return !file.empty() && kind != FindingKind::KnownBad; }
};

/// What came of one scenario.
struct ScenarioOutcome {
  std::string scenario;
  std::string file{};                  // that describes it; empty where none does any more
  int frames = 0;                      // whose facts were compared
  int pictures = 0;                    // that were
  int written = 0;                     // stored files that were written, rewritten or removed
  bool is_known_same = false;          // nothing that it is made of changed since it was the same
  std::vector<std::string> notes{};    // what a reader should know though nothing is wrong
  std::vector<std::string> brittle{};  // decisions within rounding, see brittle.h
  std::vector<Finding> findings{};

  bool fails() const {
    for (const Finding& finding : findings)
      if (finding.fails()) return true;
    return false;
  }
};

/// Which part of all scenarios a run looked at.
struct Shard {
  int part = 1, of = 1;
  friend bool operator==(const Shard&, const Shard&) = default;
};

/// What came of a run.
struct Outcome {
  std::string snapshots;  // the folder, as it was named
  bool facts_only = false;
  std::optional<Shard> shard{};
  std::vector<std::string> all{};  // of a shard: the names of all scenarios, sorted
  std::string made_of{};           // of a shard: the program and all scenario files, as a hash
  std::vector<ScenarioOutcome> scenarios{};  // by name
};

/// How many of what.
struct Tally {
  int scenarios = 0, same = 0, failing = 0, known_same = 0;
  int without_file =
      0;  // of those that fail: stored, but no scenario any more, or no mesh that a trace is of
  int frames = 0, pictures = 0, written = 0;
  std::array<int, kFindingKinds.size()> kinds{};  // of those that fail
  int rejected = 0, accepted = 0;                 // in a review
};
Tally tally(const Outcome& outcome);

/// "154 scenarios: 150 the same, 4 fail (3 changed, 1 new, 0 missing, 0 orphaned, 0 unreadable,
/// 0 known bad, 1 unmet expectation)".
std::string summary(const Tally& tally);

/// "1 frame", "2 frames".
std::string counted(int count, const std::string& one, const std::string& many = "");

/// Findings of one cause, told once.
struct Cause {
  std::vector<const Finding*> findings;  // the one that tells it best first
  std::vector<std::string> scenarios;    // by name
};

/// Those that fail, by cause: what concerns most scenarios first, then the largest difference. Within one the traces
/// before pictures, which follow from them, and the largest difference first. Where a few scenarios say something else
/// now, somebody edited each of them, and each is a cause of its own.
std::vector<Cause> causes(const Outcome& outcome);

}  // namespace contactscope::snapshot
