#pragma once

#include "core/spell.h"
#include "image/compare.h"
#include "trace/field.h"

/// Results of a check as data. Reports (terminal, page, other programs) and later reviews read only
/// these structs.
namespace contactscope::trace {

template <> struct ListOf<PixelLimits> {
  static constexpr auto fields() {
    using L = PixelLimits;
    return field::list(field::exact<&L::channel>, field::exact<&L::cluster>,
                       field::exact<&L::total>);
  }
};

}  // namespace contactscope::trace

namespace contactscope::snapshot {

enum class FindingKind {
  Changed,
  New,      // nothing is stored for the scenario
  Missing,  // other files of the scenario are stored
  Orphaned,
  UnmetExpectation,
  Unreadable,
  KnownBad,
  UnreadableScenario,  // its file cannot be read, parsed or run; nothing was compared
};
inline constexpr std::array<std::string_view, 8> kFindingKinds = {
    "changed",           "new",        "missing",   "orphaned",
    "unmet_expectation", "unreadable", "known_bad", "unreadable_scenario"};
constexpr const auto& words_of(FindingKind) { return kFindingKinds; }
constexpr std::string_view name_of(FindingKind kind) {
  return kFindingKinds[static_cast<std::size_t>(kind)];
}

/// Prefix of a cause in the scenario's file: a shape, a setting or a start pose.
inline constexpr std::string_view kInputCause = "scenario: ";

/// Action on the stored file.
enum class Done { Nothing, Written, Updated, Removed };
inline constexpr std::array<std::string_view, 4> kDone = {"nothing", "written", "updated",
                                                          "removed"};
constexpr const auto& words_of(Done) { return kDone; }

/// Decision of a reviewer.
enum class Review { Open, Accepted, Rejected };
inline constexpr std::array<std::string_view, 3> kReviews = {"open", "accepted", "rejected"};
constexpr const auto& words_of(Review) { return kReviews; }

/// Measured difference of two pictures and the limits.
struct PixelMeasures {
  bool size_differs = false;
  int differing = 0, largest_cluster = 0;
  std::array<int, 4> largest_cluster_at{};  // left, top, right, bottom; the last two are outside
  int largest_channel_difference = 0;
  PixelLimits allowed{};

  static constexpr auto fields() {
    using M = PixelMeasures;
    using namespace trace::field;
    return list(exact<&M::size_differs>, exact<&M::differing>, exact<&M::largest_cluster>,
                exact<&M::largest_cluster_at>, exact<&M::largest_channel_difference>,
                exact<&M::allowed>);
  }
};

/// A stored file or an expectation that the run did not match.
struct Finding {
  FindingKind kind = FindingKind::Changed;
  std::string scenario;
  std::string view{};          // empty: a single view, or not a picture
  std::optional<int> frame{};  // set for pictures
  std::string file{};          // relative to the snapshot folder, with slashes; empty: expectation
  std::string sentence{};      // summary
  std::vector<std::string> details{};  // all differences, one per line
  std::string cause{};                 // equal for findings that may share a cause; never empty
  std::optional<PixelMeasures> pixels{};
  std::vector<std::string> layers{};  // for pictures with changed facts: layers that changed
  // Paths relative to the report folder; empty: no such file.
  std::string candidate{};       // result of the run, stored when accepted
  std::string expected{};        // stored file
  std::string difference{};      // a picture of the differences
  std::string layers_picture{};  // SVG of the layers, expected and actual
  // Hashes of the stored file during the run, and of the candidate; empty: no such file.
  std::string stored_sha256{}, candidate_sha256{};
  Done done = Done::Nothing;
  Review review = Review::Open;

  /// Name on the command line: "hull/face_contact/side/frame_0012", "hull/face_contact/trace",
  /// "hull/face_contact/expectations", or "hull/face_contact/scenario" if it is unreadable.
  std::string key() const {
    if (kind == FindingKind::UnreadableScenario) return scenario + "/scenario";
    if (file.empty()) return scenario + "/expectations";
    return file.substr(0, file.rfind('.'));
  }
  /// The check exits with status 1.
  bool fails() const { return done == Done::Nothing && review != Review::Accepted; }
  bool is_picture() const { return frame.has_value(); }
  /// There is a candidate, or a file to remove. Expectations and known bugs need a fix instead.
  bool is_acceptable() const { return !file.empty() && kind != FindingKind::KnownBad; }

  /// In files it is an entry of its scenario.
  static constexpr auto fields() {
    using F = Finding;
    using namespace trace::field;
    return list(exact<&F::key>, exact<&F::kind>, exact<&F::view>.where_set(), exact<&F::frame>,
                exact<&F::file>.where_set(), exact<&F::sentence>, exact<&F::details>.where_set(),
                exact<&F::cause>, exact<&F::pixels>, exact<&F::layers>.where_set(),
                exact<&F::layers_picture>.where_set(), exact<&F::candidate>.where_set(),
                exact<&F::expected>.where_set(), exact<&F::difference>.where_set(),
                exact<&F::stored_sha256>.where_set(), exact<&F::candidate_sha256>.where_set(),
                exact<&F::done>, exact<&F::review>, exact<&F::fails>);
  }
};

/// Result of one scenario.
struct ScenarioOutcome {
  std::string scenario;
  std::string file{};                  // scenario file; empty: there is none any more
  int frames = 0;                      // with compared facts
  int pictures = 0;                    // compared
  int written = 0;                     // files written, rewritten or removed
  std::vector<std::string> notes{};    // remarks that are not errors
  std::vector<std::string> brittle{};  // decisions within rounding, see compare_trace.h
  std::vector<Finding> findings{};

  bool fails() const {
    for (const Finding& finding : findings)
      if (finding.fails()) return true;
    return false;
  }
  bool same() const { return !fails(); }

  static constexpr auto fields() {
    using S = ScenarioOutcome;
    using namespace trace::field;
    return list(exact<&S::scenario>, exact<&S::file>.where_set(), exact<&S::same>,
                exact<&S::frames>, exact<&S::pictures>, exact<&S::written>,
                exact<&S::notes>.where_set(), exact<&S::brittle>.where_set(), exact<&S::findings>);
  }
};

/// Part of all scenarios in a run.
struct Shard {
  int part = 1, of = 1;
  friend bool operator==(const Shard&, const Shard&) = default;

  static constexpr auto fields() {
    using namespace trace::field;
    return list(exact<&Shard::part>, exact<&Shard::of>);
  }
};

/// Result of a run.
struct Outcome {
  std::string snapshots;  // folder as given by the user
  bool facts_only = false;
  std::optional<Shard> shard{};
  std::vector<ScenarioOutcome> scenarios{};  // sorted by name; in files after the counts

  static constexpr auto fields() {
    using O = Outcome;
    using namespace trace::field;
    return list(exact<&O::snapshots>, exact<&O::facts_only>.where_set(), exact<&O::shard>);
  }
};

/// Counts of a run.
struct Tally {
  int scenarios = 0, same = 0, failing = 0;
  int without_file =
      0;  // failing ones that are stored but have no scenario file (or meshes without a trace)
  int frames = 0, pictures = 0, written = 0;
  std::array<int, kFindingKinds.size()> kinds{};  // failing findings by kind
  int rejected = 0, accepted = 0;                 // by reviewers
};
Tally tally(const Outcome& outcome);

/// "154 scenarios: 150 the same, 4 fail (3 changed, 1 new, 0 missing, 0 orphaned, 0 unreadable,
/// 0 known bad, 1 unmet expectation)".
std::string summary(const Tally& tally);

/// Findings with the same cause.
struct Cause {
  std::vector<const Finding*> findings;  // the most informative one first
  std::vector<std::string> scenarios;    // sorted by name
};

/// Failing findings by cause, most scenarios first, then the largest difference. Within a cause
/// traces come before pictures, which follow from them, then the largest difference first. If only
/// a few scenarios have an input change, each was edited on its own and is its own cause.
std::vector<Cause> causes(const Outcome& outcome);

}  // namespace contactscope::snapshot
