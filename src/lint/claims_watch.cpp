#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <span>

#include "core/at.h"
#include "lint/tally.h"
#include "lint/wrong_pairs.h"

namespace contactscope::lint {
namespace {

/// Number of wrong pairs on which all explanations are tried; they represent the others.
constexpr int kTried = 1000;
/// A few small errors are approximations of engines: leaning capsules, cut corners, points kept
/// while bodies turn. Report errors only at this frequency, or beyond this many tolerances.
constexpr double kOften = 0.02, kGross = 15, kSevere = 40;
constexpr const char* kFewAndSmall = "2 %, or 15 tolerances";
constexpr double kFewLeft = 0.25;
/// Minimum share of the remaining wrong pairs for a cause, and minimum number if it may be chance.
constexpr double kOfWrong = 0.3;
constexpr int kNoChance = 3;
/// One wrong claim in this many may have a cause of its own.
constexpr int kFixed = 5;
constexpr double kFar = 1000;  // tolerances: twice the size of the smaller shape
/// A shape has the wrong size if this share of its pairs fits another one.
constexpr double kOfShape = 0.5;
constexpr int kListed = 4;  // more such shapes are only counted
/// Values, each with the number of its occurrences.
using Counted = std::vector<std::pair<double, int>>;

/// The median.
double middle_of(Counted& values) {
  std::ranges::sort(values);
  int all = 0, below = 0;
  for (const auto& [value, times] : values) all += times;
  for (const auto& [value, times] : values)
    if ((below += times) > all / 2) return value;
  return 0;
}

/// The amount if all points are off by the same amount beyond the tolerance; else 0.
double common_depth(const Verdict& verdict) {
  if (verdict.deeper.empty()) return 0;
  const auto [least, most] = std::ranges::minmax(verdict.deeper);
  const double middle = (least + most) / 2;
  const bool is_common = most - least <= std::max(verdict.tolerance, 0.1 * std::abs(middle));
  return is_common && std::abs(middle) > verdict.tolerance ? middle : 0;
}

/// Whether a mistake may be made in a single frame: not one of units, axes, shapes or moments.
bool may_be_rare(const Reading& reading) {
  Reading rare;
  rare.normals_flipped = reading.normals_flipped;
  rare.separations_negated = reading.separations_negated;
  rare.sides_swapped = reading.sides_swapped;
  return rare == reading;
}

/// Whether a form changes one of the two shapes.
bool is_about(Form form, const Solids& solids, const trace::Pair& pair) {
  return form == Form::AsReported || solids.find(pair.a, form) != solids.find(pair.a) ||
         solids.find(pair.b, form) != solids.find(pair.b);
}

struct Words {
  const char *cause, *what, *remedy;
};
constexpr Words kUnexplained[kWrongs] = {
    {"separation", "separations do not match the shapes",
     "a separation is measured at the point, along the normal, from the surface of a to that of b; "
     "check the shapes' sizes, and the time of the poses"},
    {"surface", "points are off the surfaces",
     "a point lies on a surface, or between the two; check its frame and unit, and the shapes' "
     "sizes"},
    {"side", "'on_a' or 'on_b' is off its surface",
     "'on_a' is on the surface of a, 'on_b' on that of b, both in the world"},
    {"normal", "normals are not the directions of least overlap",
     "moving b along the normal by the overlap separates the shapes; check the test that chose the "
     "axis"},
    {"deepest", "no point is as deep as the overlap",
     "keep the deepest point: check clipping and reduction"},
};

class ClaimsWatch final : public Watch {
 public:
  ClaimsWatch(const trace::Header& header, const LintOptions& options)
      : after_step_(header.poses_at == "after_step"), options_(options) {}

  void see(const Solids& solids, const Moments& frames) override {
    for (const trace::Pair& pair : frames.now->pairs) {
      if (pair.manifolds.empty()) continue;
      see_pair(solids, frames, pair);
    }
  }

  void report(std::vector<Finding>& findings) override {
    report_small_depths(findings);
    while (report_best_explanation(findings)) continue;
    // If a cause explains nearly all pairs, the others mostly share it and have another error too.
    if (wrong_.untold() < kFewLeft * wrong_.count()) return;
    // A margin is a size of round shapes too.
    if (!report_margin(findings))
      while (report_size(findings)) continue;
    std::vector<Finding> unexplained;
    for (int kind = 0; kind < kWrongs; ++kind)
      report_unexplained(static_cast<Wrong>(kind), unexplained);
    std::ranges::stable_sort(unexplained, std::greater(), &Finding::count);
    std::ranges::move(unexplained, std::back_inserter(findings));
  }

 private:
  void see_pair(const Solids& solids, const Moments& frames, const trace::Pair& pair) {
    if (after_step_ && frames.before == nullptr) return;  // the poses before are unknown
    std::optional<Verdict> verdict = judge(solids, frames, pair, {});
    if (!verdict || verdict->claims == 0) return;
    if (after_step_ && verdict->wrong > 0) {
      Reading before;
      before.moment = Moment::FrameBefore;
      if (auto then = judge(solids, frames, pair, before); then) verdict = std::move(then);
    }
    for (const std::string& name : {pair.a, pair.b, std::string()}) ++judged_of_[name];
    ++judged_;
    moving_ += moves(solids, frames, pair, verdict->tolerance);
    if (verdict->wrong == 0) return count_small_depths(*verdict);
    WrongPair wrong;
    wrong.line = frames.now->line;
    wrong.frame = frames.now->frame;
    wrong.a = pair.a;
    wrong.b = pair.b;
    wrong.problem = *verdict->worst;
    wrong.deeper = common_depth(*verdict);
    wrong.size = std::min(1.0, verdict->farthest / (kFar / 2 * verdict->tolerance));
    if (!options_.shapes_are_given)
      wrong.scales = {scale_of(solids, frames, pair, true, false),
                      scale_of(solids, frames, pair, false, true),
                      scale_of(solids, frames, pair, true, true)};
    wrong.gross = !(verdict->farthest <= kGross * verdict->tolerance);
    wrong.severe =
        !(verdict->farthest <= kSevere * verdict->tolerance) && wrong.problem.kind <= Wrong::Side;
    put_in_words(pair, wrong);
    Reading flipped;
    flipped.normals_flipped = true;
    const std::vector<Explanation>& all = explanations();
    for (std::size_t e = 0; e < std::min(all.size(), kMaxExplanations); ++e) {
      const bool is_tried = wrong_.count() < kTried || has_explained_.test(e) ||
                            (wrong.severe && all[e].reading == flipped);
      if (!is_tried) continue;
      if (options_.shapes_are_given && all[e].reading.moves_shapes()) continue;
      if (after_step_ && all[e].reading.moment == Moment::FrameBefore) continue;
      if (!is_about(all[e].reading.form, solids, pair)) continue;
      // Points scaled down move towards the origin, which may be where the shapes touch.
      const bool are_far = verdict->farthest > kFar * verdict->tolerance;
      if (all[e].reading.point_scale < 1 && !are_far) continue;
      const std::optional<Verdict> then = judge(solids, frames, pair, all[e].reading);
      if (!then || !have_their_size(all[e].reading, *then)) continue;
      // Or a gross error becomes one of an engine's approximations.
      const bool is_fewer =
          2 * then->wrong <= verdict->wrong ||
          (then->wrong < verdict->wrong && kGross * then->farthest <= verdict->farthest);
      const bool is_smaller = wrong.gross && is_fewer && then->farthest <= kGross * then->tolerance;
      wrong.explained_by.set(e, is_smaller || kFixed * then->wrong <= verdict->wrong);
    }
    if (const auto jump = frames.explained->find(&pair); jump != frames.explained->end()) {
      if (jump->second == Explained::Wholly) return;
      for (std::size_t e = 0; e < std::min(all.size(), kMaxExplanations); ++e)
        if (!may_be_rare(all[e].reading)) wrong.explained_by.reset(e);
      if (wrong.explained_by.none()) return;
    }
    has_explained_ |= wrong.explained_by;
    wrong_.add(std::move(wrong), options_.marks(frames.now->frame));
  }

  /// Whether the largest separation, read with another sign or unit, has the size of the measured
  /// one. Any small number is near enough for surfaces that nearly touch.
  static bool have_their_size(const Reading& reading, const Verdict& verdict) {
    constexpr double kAbout = 1.25;
    if (reading.separation_scale == 1 && !reading.separations_negated) return true;
    double largest = 0, measured = 0;
    for (std::size_t i = 0; i < verdict.separations.size(); ++i) {
      const double is = std::abs(verdict.separations[i]);
      const double said = std::abs(verdict.separations[i] - verdict.deeper[i]);
      if (said > largest) largest = said, measured = is;
    }
    return largest <= kAbout * measured && measured <= kAbout * largest;
  }

  /// Whether another frame has b elsewhere, as seen from a.
  static bool moves(const Solids& solids, const Moments& frames, const trace::Pair& pair,
                    double tolerance) {
    const trace::Frame* const other = frames.before != nullptr ? frames.before : frames.after;
    const auto b_in_a = [&](const trace::Frame* frame) {
      const auto a = place(solids, frame, pair.a, {}), b = place(solids, frame, pair.b, {});
      return a && b ? std::optional(relative_pose(a->pose, b->pose).position) : std::nullopt;
    };
    const std::optional<Vec3d> now = b_in_a(frames.now), then = b_in_a(other);
    return now && then && (*now - *then).norm() > tolerance;
  }

  // Overlaps of a millimetre are within the tolerance whatever is reported. But if all are reported
  // as half, that is a mistake.
  void count_small_depths(const Verdict& verdict) {
    for (std::size_t i = 0; i < verdict.separations.size(); ++i) {
      const double is = verdict.separations[i], said = is - verdict.deeper[i];
      constexpr double kSmallest = 0.05;  // relative to the tolerance; smaller ones are noise
      if (!(is < -kSmallest * verdict.tolerance)) continue;
      ++small_;
      for (std::size_t f = 0; f < std::size(kFactors); ++f)
        small_by_[f] += std::abs(said - kFactors[f] * is) <= 0.03 * std::abs(is);
    }
  }

  void report_small_depths(std::vector<Finding>& findings) const {
    constexpr int kEnough = 8;
    constexpr const char* kNames[] = {"positive_depths", "half_depths", "double_depths"};
    if (small_ < kEnough) return;
    for (std::size_t f = 0; f < std::size(kFactors); ++f) {
      if (small_by_[f] < 0.9 * small_) continue;
      const auto mistake = std::ranges::find(mistakes(), std::string(kNames[f]), &Mistake::name);
      findings.push_back({mistake->name, mistake->what, mistake->remedy, small_by_[f], small_});
    }
  }

  /// The wrong pairs that are not reported yet and that fit; without a place if there are none.
  template <class Fits>
  Finding gathered(const std::string& cause, const std::string& what, const std::string& remedy,
                   const Fits& fits) {
    Finding finding{cause, what, remedy, 0, judged_};
    const WrongPair* first = nullptr;
    Marks marks;
    for (const WrongPair& wrong : wrong_) {
      if (wrong.record || !fits(wrong) || options_.ignores(cause, wrong.a, wrong.b)) continue;
      finding.count += wrong.times;
      add_mark(marks, {wrong.frame, wrong.line, wrong.a, wrong.b, wrong.at}, &options_);
      const auto level = [](const WrongPair& of) { return of.gross + of.severe; };
      if (first == nullptr || level(wrong) > level(*first)) first = &wrong;
      if (wrong.gross) finding.gross = std::max(finding.gross, wrong.size);
    }
    if (first == nullptr) return finding;
    finding.is_severe = first->severe;
    finding.line = first->line;
    finding.frame = first->frame;
    finding.a = first->a, finding.b = first->b;
    finding.said = first->said, finding.is = first->is;
    finding.size = first->size;
    finding.marks = marks.kept();
    if (!first->gross && finding.count < kOften * judged_) finding.below = kFewAndSmall;
    return finding;
  }

  bool explains_gross(std::size_t e) {
    return std::ranges::any_of(wrong_, [&](const WrongPair& wrong) {
      return !wrong.record && wrong.gross && wrong.explained_by.test(e);
    });
  }

  /// Reports the reading that makes most of the remaining wrong pairs right; of several the first,
  /// which is the simplest.
  bool report_best_explanation(std::vector<Finding>& findings) {
    const std::vector<Explanation>& all = explanations();
    std::vector<int> counts(all.size());
    for (const WrongPair& wrong : wrong_)
      for (std::size_t e = 0; e < all.size() && !wrong.record; ++e)
        counts[e] += wrong.explained_by.test(e) ? wrong.times : 0;
    // Two mistakes at once explain a few pairs by chance, except the pair about signs.
    for (std::size_t e = 0; e < all.size(); ++e) {
      Reading signs;
      signs.normals_flipped = signs.separations_negated = true;
      const Reading& reading = all[e].reading;
      const bool several = all[e].made.size() > 1 && !(reading == signs);
      // So do other axes, and another moment unless it explains at least half of all pairs.
      const bool moved = reading.moment != Moment::OfFrame && 2 * counts[e] < judged_;
      if (moved && 2 * counts[e] < moving_) counts[e] = 0;
      if ((several || moved || all[e].made[0]->alone) && counts[e] < kNoChance) counts[e] = 0;
      // All points have one unit.
      if (reading.point_scale != 1 && 2 * counts[e] < judged_) counts[e] = 0;
    }
    // One cause has many effects, so an explanation of few of many wrong pairs is chance. But a
    // normal may be flipped in a single frame.
    const int untold = wrong_.untold();
    Reading flipped;
    flipped.normals_flipped = true;
    for (std::size_t e = 0; e < all.size(); ++e)
      if (counts[e] < kOfWrong * untold && !(all[e].reading == flipped && explains_gross(e)))
        counts[e] = 0;
    const auto most = std::ranges::max_element(counts);
    if (most == counts.end() || *most == 0) return false;
    // A simple one that explains nearly as many is more likely.
    const auto chosen = std::ranges::find_if(counts, [&](int n) { return n >= 0.9 * *most; });
    const auto e = static_cast<std::size_t>(chosen - counts.begin());
    const auto is_explained = [&](const WrongPair& wrong) { return wrong.explained_by.test(e); };
    std::vector<Finding> named;
    for (const Mistake* mistake : all[e].made)
      named.push_back(gathered(mistake->name, mistake->what, mistake->remedy, is_explained));
    if (!named.front().below.empty()) return false;
    for (WrongPair& wrong : wrong_) wrong.record = wrong.record || is_explained(wrong);
    for (Finding& one : named) {
      const auto same = std::ranges::find(findings, one.cause, &Finding::cause);
      if (same == findings.end()) {
        if (one.count > 0) findings.push_back(std::move(one));
      } else if (same->line > 0) {
        same->count += one.count;
      }
    }
    return true;
  }

  /// Reports the shape that has the wrong size in most of its pairs, or all shapes alike.
  bool report_size(std::vector<Finding>& findings) {
    std::map<std::string, Counted> of_shape;
    for (const WrongPair& wrong : wrong_)
      for (std::size_t i = 0; i < wrong.scales.size() && !wrong.record; ++i) {
        if (wrong.scales[i] > 0)
          of_shape[wrong.scaled(i)].emplace_back(wrong.scales[i], wrong.times);
      }
    std::string shape;
    double scale = 0, share = kOfShape;
    // In a pair with a static shape, only the other one has another size.
    const auto fits = [](const WrongPair& wrong, const std::string& name, double common) {
      for (std::size_t i = 0; i < wrong.scales.size() && !wrong.record; ++i)
        if ((name.empty() || wrong.scaled(i) == name) &&
            std::abs(wrong.scales[i] / common - 1) < kSameScale - 1)
          return true;
      return false;
    };
    for (auto& [name, scales] : of_shape) {
      const double common = middle_of(scales);
      int count = 0;
      for (const WrongPair& wrong : wrong_) count += fits(wrong, name, common) ? wrong.times : 0;
      const double of_all = double(count) / judged_of_[name];
      if (count < kNoChance || !(of_all > share)) continue;
      shape = name, scale = common, share = of_all;
      if (name.empty()) break;
    }
    if (scale == 0) return false;
    const auto is_of = [&](const WrongPair& wrong) { return fits(wrong, shape, scale); };
    Finding finding =
        gathered(scale < 1 ? "shape_too_large" : "shape_too_small",
                 (shape.empty() ? "shapes are " : "'" + shape + "' is ") + metres(1 / scale) +
                     " times as large as in the engine",
                 "contacts fit it at " + metres(100 * scale) +
                     " % of its size: check its extents, its scale, and what the engine's margin "
                     "takes off",
                 is_of);
    for (WrongPair& wrong : wrong_) wrong.record = wrong.record || is_of(wrong);
    finding.below.clear();
    finding.of = judged_of_[shape];
    const auto same = std::ranges::find(findings, finding.cause, &Finding::cause);
    if (same == findings.end()) {
      if (finding.count > 0) findings.push_back(std::move(finding));
    } else {
      same->count += finding.count, same->of += finding.of;
      if (std::ranges::count(same->what, ',') < kListed)
        same->what += ", '" + shape + "' " + metres(1 / scale) + " times";
    }
    return true;
  }

  /// Whether a gross one is reported.
  bool report_margin(std::vector<Finding>& findings) {
    Counted depths;
    for (const WrongPair& wrong : wrong_)
      if (!wrong.record && wrong.deeper != 0) depths.emplace_back(wrong.deeper, wrong.times);
    if (depths.empty()) return false;
    const double margin = middle_of(depths);
    const auto has_margin = [&](const WrongPair& wrong) {
      return !wrong.record && std::abs(wrong.deeper - margin) <= 0.1 * std::abs(margin);
    };
    const bool larger = margin > 0;
    Finding finding = gathered(
        larger ? "margin_added" : "margin_taken_off",
        "contacts fit shapes that are together " + metres(std::abs(margin)) +
            (larger ? " m larger" : " m smaller"),
        larger
            ? "the engine adds a margin or radius: write the shapes with it (a hull may have a "
              "'radius' too), or find where it is added twice"
            : "the engine subtracts a margin, or shrinks a shape: write the shapes as they collide",
        has_margin);
    const int count = finding.count;
    // A single misplaced body has a depth too.
    if (count < kOfWrong * wrong_.untold() || (count < kNoChance && 2 * count < judged_))
      return false;
    for (WrongPair& wrong : wrong_) wrong.record = wrong.record || has_margin(wrong);
    finding.below.clear();
    const bool is_gross = std::abs(margin) > 0 && finding.size > kGross * 2 / kFar;
    if (count > 0) findings.push_back(std::move(finding));
    return is_gross;
  }

  void report_unexplained(Wrong kind, std::vector<Finding>& findings) {
    const Words& words = kUnexplained[static_cast<int>(kind)];
    Finding finding = gathered(words.cause, words.what, words.remedy,
                               [&](const WrongPair& wrong) { return wrong.problem.kind == kind; });
    if (finding.count > 0) findings.push_back(std::move(finding));
  }

  static constexpr double kFactors[] = {-1, 0.5, 2};
  bool after_step_;
  LintOptions options_;
  int judged_ = 0;
  int moving_ = 0;  // pairs for which another frame has other poses
  int small_ = 0;
  int small_by_[std::size(kFactors)] = {};
  std::map<std::string, int> judged_of_;  // by shape
  WrongPairs wrong_;
  std::bitset<kMaxExplanations> has_explained_;
};

}  // namespace

std::unique_ptr<Watch> watch_claims(const trace::Header& header, const LintOptions& options) {
  return std::make_unique<ClaimsWatch>(header, options);
}

std::vector<const char*> unexplained_causes() {
  return mapped(std::span(kUnexplained), &Words::cause);
}

}  // namespace contactscope::lint
