#pragma once

#include "lint/claims.h"
#include "lint/linter.h"

namespace contactscope::lint {

/// One kind of check of a trace: sees each frame once and reports at the end.
class Watch {
 public:
  virtual ~Watch() = default;
  /// frames.now is set; its neighbours are set if the trace has the frame before and after.
  virtual void see(const Solids& solids, const Moments& frames) = 0;
  virtual void report(std::vector<Finding>& findings) = 0;
};

/// bodies_over_time.cpp: poses that jump and come back, bodies that fly off.
std::unique_ptr<Watch> watch_bodies_over_time(const trace::Header& header);
/// contacts_over_time.cpp: pairs and points that come and go, separations and normals that jump, all
/// without motion; points reported twice.
std::unique_ptr<Watch> watch_contacts_over_time();
/// claims_watch.cpp: compares points, normals and separations with the shapes, and explains errors.
std::unique_ptr<Watch> watch_claims(const trace::Header& header, const LintOptions& options);
/// overlaps.cpp: overlapping shapes without contacts, also of bodies at rest on one another.
std::unique_ptr<Watch> watch_overlaps(const trace::Header& header);
/// internal_edges.cpp: contacts with edges of a mesh where its surface continues.
std::unique_ptr<Watch> watch_internal_edges();
/// ids.cpp: ids of points that change while nothing moves.
std::unique_ptr<Watch> watch_ids();
/// turned_shapes.cpp: quaternions with w last that look like half turns.
std::unique_ptr<Watch> watch_rotations();
/// motion.cpp: falling and resting bodies compared with gravity, weights and the up axis.
std::unique_ptr<Watch> watch_motion(const trace::Header& header);

/// causes.cpp: duplicate pairs, pairs without points, times that do not increase.
std::unique_ptr<Watch> watch_records();
/// velocities.cpp: friction perpendicular to the normal, bounded by its impulse, against sliding.
std::unique_ptr<Watch> watch_friction();
/// velocities.cpp: compared with displacements.
std::unique_ptr<Watch> watch_velocities();
/// turned_shapes.cpp: meshes that are hit from behind.
std::unique_ptr<Watch> watch_windings();

/// "0.0213": a number as written in findings.
std::string shown(double value);
/// "0.0213 m".
inline std::string metres(double length) { return shown(length) + " m"; }
/// "[0, 1, 0]".
std::string spelled(const Vec3d& vector);

/// The same pair in another frame; null if it is not there.
inline const trace::Pair* same_pair(const trace::Frame& frame, const trace::Pair& pair) {
  const auto found = std::ranges::find_if(frame.pairs, [&](const trace::Pair& other) {
    return other.a == pair.a && other.b == pair.b && other.label == pair.label;
  });
  return found == frame.pairs.end() ? nullptr : &*found;
}

/// An evenly spaced subset of a sequence of any length: up to kMax, and at least half as many.
template <class T, std::size_t kMax> class Thinned {
 public:
  /// `always`: it stays, whatever the number; then all others have to as well.
  void add(T one, bool always = false) {
    if (!always && count_++ % every_ != 0) return;
    kept_.push_back(std::move(one));
    if (always || kept_.size() < kMax) return;
    every_ *= 2;
    for (std::size_t i = 1; 2 * i < kMax; ++i) kept_[i] = std::move(kept_[2 * i]);
    kept_.resize((kMax + 1) / 2);
  }
  const std::vector<T>& kept() const { return kept_; }

 private:
  std::vector<T> kept_;
  std::size_t count_ = 0, every_ = 1;
};

/// The marks of a finding, and the frames of all of them.
struct Marks {
  void add(Mark mark, const LintOptions* options) {
    frames.add(mark.frame);
    const bool always = options != nullptr && options->is_marked;
    if (!always || options->is_marked(mark.frame)) marks.add(std::move(mark), always);
  }
  void put_in(Finding& finding) const {
    finding.marks = marks.kept(), finding.frames = frames.kept();
  }

  Thinned<Mark, 1000> marks;
  Thinned<int, 1000> frames;
};

/// Makes an occurrence the place of a finding.
inline void put(const OfPair& one, Finding& finding) {
  finding.line = one.line, finding.frame = one.frame;
  finding.a = one.a, finding.b = one.b;
  finding.said = one.said, finding.is = one.is, finding.at = one.at;
}

/// Counts occurrences of one problem among all cases, and keeps the first of each pair, and the worst.
struct Tally {
  static constexpr std::size_t kMaxPairs = 1000;  // later ones are only counted
  /// An error of this size, relative to the smaller shape, and so many times as large as all smaller
  /// ones is reported however rare it is: no rounding makes it.
  static constexpr double kGross = 0.02, kTimesOthers = 10;

  std::string cause{};
  std::string_view cases = "pairs";
  bool is_worst_first = false;  // the finding is about the worst, not the first
  int count = 0, of = 0;
  std::map<std::pair<std::string, std::string>, OfPair> pairs{};
  OfPair first{}, worst{};
  double gross = 0, small = 0;  // the size of the worst; the largest size below kGross
  Marks marks{};

  /// Adds an occurrence; `said` and `is` are only built for the first of a pair and the worst.
  template <class Words>
  void wrong_at(Mark mark, const Moments& frames, double size, const Words& words) {
    if (frames.options != nullptr && frames.options->ignores(cause, mark.a, mark.b)) return;
    const std::pair key(mark.a, mark.b);
    const auto known = pairs.find(key);
    const bool is_first = known == pairs.end() && pairs.size() < kMaxPairs;
    if (known != pairs.end()) ++known->second.count;
    const bool is_worst = size >= kGross && size > gross;
    if (size < kGross) small = std::max(small, size);
    if (is_first || is_worst) {
      const auto [said, is] = words();
      const OfPair one{mark.a, mark.b, 1, mark.line, mark.frame, said, is, mark.at};
      if (is_first) pairs[key] = one;
      if (count == 0) first = one;
      if (is_worst) worst = one, gross = size;
    }
    ++count;
    marks.add(std::move(mark), frames.options);
  }
  template <class Words>
  void wrong(const Moments& frames, const std::string& a, const std::string& b, const Words& words,
             const std::optional<Vec3d>& at = std::nullopt) {
    wrong_at({frames.now->frame, frames.now->line, a, b, at}, frames, 0, words);
  }

  /// Reports the problem, as below the threshold unless it occurs at least `least` times and in
  /// that share of the cases, or `repeats` times in one pair, or one is gross.
  void report(std::vector<Finding>& findings, const std::string& what, const char* remedy,
              int least = 1, double share = 0,
              int repeats = std::numeric_limits<int>::max()) const {
    if (count == 0) return;
    // One pair may have nearly all of them, and another one the first.
    const auto most =
        std::ranges::max_element(pairs, {}, [](const auto& pair) { return pair.second.count; });
    const bool is_gross = gross > kTimesOthers * small;
    const bool is_repeated = most->second.count >= repeats;
    const bool is_rare = count < share * of && !is_repeated;
    Finding finding{cause, what, remedy, count, of};
    put(is_worst_first || (is_rare && is_gross)         ? worst
        : is_repeated || 2 * most->second.count > count ? most->second
                                                        : first,
        finding);
    finding.gross = is_gross && !is_worst_first ? gross : 0;
    for (const auto& [names, one] : pairs) finding.pairs.push_back(one);
    finding.cases = cases;
    marks.put_in(finding);
    if (is_rare && !is_gross)
      finding.below = shown(100 * share) + " %";
    else if (count < least)
      finding.below = std::to_string(least) + " of them";
    findings.push_back(finding);
  }
};

/// Values, each with the number of its occurrences.
using Counted = std::vector<std::pair<double, int>>;
/// The median.
inline double middle_of(Counted& values) {
  std::ranges::sort(values);
  int all = 0, below = 0;
  for (const auto& [value, times] : values) all += times;
  for (const auto& [value, times] : values)
    if ((below += times) > all / 2) return value;
  return 0;
}

}  // namespace contactscope::lint
