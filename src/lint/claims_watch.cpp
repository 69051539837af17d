#include "lint/small_depths.h"
#include "lint/watch.h"
#include "lint/wrong_pairs.h"

namespace contactscope::lint {
namespace {

/// Number of wrong pairs on which all explanations are tried; they represent the others.
constexpr int kTried = 1000;
/// A few small errors are approximations of engines: leaning capsules, cut corners, points kept
/// while bodies turn. Report errors only at this frequency, or beyond this many tolerances.
constexpr double kOften = 0.02, kGross = 15, kSevere = 40;
/// No engine approximates by the same amount for long, beyond this many tolerances.
constexpr double kSteady = 5;
constexpr const char* kFewAndSmall = "2 % or 15 tolerances";
constexpr double kFewLeft = 0.25;
/// Minimum share of the remaining wrong pairs for a cause, and minimum number if it may be chance.
constexpr double kOfWrong = 0.3;
constexpr int kNoChance = 3;
/// One wrong claim in this many may have a cause of its own.
constexpr int kFixed = 5;
constexpr double kFar = 1000;  // tolerances: twice the size of the smaller shape
/// A shape has the wrong size if this share of its pairs fits another one.
constexpr double kOfShape = 0.5;
/// Share of the pairs of some types, if all of their wrong ones fit: MuJoCo halves boxes face to face.
constexpr double kOfTypes = 0.2;
constexpr int kListed = 4;  // more such shapes are only counted
using Names = std::pair<std::string, std::string>;

/// The amount if all points are off by the same amount beyond the tolerance; else 0.
double common_depth(const Verdict& verdict) {
  if (verdict.deeper.empty()) return 0;
  const auto [least, most] = std::ranges::minmax(verdict.deeper);
  const double middle = (least + most) / 2;
  const bool is_common = most - least <= std::max(verdict.tolerance, 0.1 * std::abs(middle));
  return is_common && std::abs(middle) > verdict.tolerance ? middle : 0;
}

/// Whether a mistake may be made in a single frame: not one of units, axes, shapes or moments.
bool may_be_rare(Reading reading) {
  reading.normals_flipped = reading.separations_negated = reading.sides_swapped = false;
  return reading == Reading();
}

class ClaimsWatch final : public Watch {
 public:
  ClaimsWatch(const trace::Header& header, const LintOptions& options)
      : after_step_(header.poses_at == "after_step"), options_(options) {}

  void see(const Solids& solids, const Moments& frames) override {
    for (const trace::Pair& pair : frames.now->pairs)
      if (!pair.manifolds.empty()) see_pair(solids, frames, pair);
  }

  void report(std::vector<Finding>& findings) override {
    Finding hint{"rounded_edges", "contacts fit boxes and cylinders with rounded edges",
                 "Bullet's GJK has the margin inside: a tenth of the half extent, up to 40 mm",
                 rounded_, judged_};
    hint.is_hint = true;
    if (rounded_ > 0) findings.push_back(hint);
    hint.cause = "kept_points", hint.count = kept_;
    hint.what = "points and normals are those of earlier frames, and the bodies have moved";
    hint.remedy = "Bullet keeps points that slide by up to 20 mm: gContactBreakingThreshold";
    if (kept_ > 0) findings.push_back(hint);
    small_.report(findings);
    while (report_best_explanation(findings)) continue;
    // If a cause explains nearly all pairs, the others mostly share it and have another error too.
    // If it was found in some kinds of pairs alone, this holds for these kinds.
    if (wrong_.untold() < kFewLeft * wrong_.count()) {
      if (is_of_all_kinds_) return;
      for (WrongPair& wrong : wrong_)
        wrong.record = wrong.record || explained_kinds_.contains(types_in_[{wrong.a, wrong.b}]);
    }
    // A margin is a size of round shapes too.
    if (!report_margin(findings))
      while (report_size(findings)) continue;
    std::vector<Finding> unexplained;
    for (int kind = 0; kind < kWrongs; ++kind) {
      const auto& [cause, what, remedy] = kUnexplained[kind];
      unexplained.push_back(gathered(cause, what, remedy, [&](const WrongPair& one) {
        return int(one.problem.kind) == kind;
      }));
    }
    if (const double deeper = wrong_.common_depth(); deeper != 0)
      unexplained[int(Wrong::Separation)].what +=
          ": all are " + metres(std::abs(deeper)) + (deeper > 0 ? " too deep" : " too shallow");
    std::erase_if(unexplained, [](const Finding& finding) { return finding.count == 0; });
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
    if (const Reading collided = solids.collided(pair.a, pair.b);
        verdict->wrong > 0 && collided.moves_shapes()) {
      const std::optional<Verdict> round = judge(solids, frames, pair, collided);
      rounded_ += round && round->wrong == 0;
      if (round && (round->wrong == 0 || round->farthest < verdict->farthest)) verdict = round;
    }
    for (const std::string& name : {pair.a, pair.b, std::string()}) ++judged_of_[name];
    for (const std::string& name : {pair.a, pair.b}) {
      size_of_[name] = solids.find(name)->size();
      if (!moved_.contains(name) && !stands_still(solids, frames, name)) moved_.insert(name);
    }
    if (judged_in_[{pair.a, pair.b}]++ == 0)
      types_in_[{pair.a, pair.b}] = types_of(solids, pair.a, pair.b);
    ++judged_;
    moving_ += moves(solids, frames, pair, verdict->tolerance);
    kept_ += verdict->kept > 0;
    if (verdict->wrong == 0) return small_.add(types_of(solids, pair.a, pair.b), pair, *verdict);
    WrongPair wrong{frames.now->line, frames.now->frame, pair.a, pair.b, *verdict->worst};
    wrong.deeper = common_depth(*verdict);
    wrong.size = std::min(1.0, verdict->farthest / (kFar / 2 * verdict->tolerance));
    for (std::size_t i = 0; i < wrong.scales.size() && !options_.shapes_are_given; ++i)
      wrong.scales[i] = scale_of(solids, frames, pair, i);
    wrong.gross = !(verdict->farthest <= kGross * verdict->tolerance);
    wrong.severe =
        !(verdict->farthest <= kSevere * verdict->tolerance) && wrong.problem.kind <= Wrong::Side;
    wrong.beyond = verdict->beyond > 0;
    wrong.grossly_beyond = wrong.beyond && !(verdict->farthest <= kGross * verdict->allowed);
    put_in_words(pair, wrong);
    if (std::abs(wrong.deeper) > kSteady * verdict->tolerance) steady_.see(wrong);
    Reading flipped;
    flipped.normals_flipped = true;
    const std::vector<Explanation>& all = explanations();
    for (std::size_t e = 0; e < std::min(all.size(), kMaxExplanations); ++e) {
      const bool is_tried = wrong_.count() < kTried || has_explained_.test(e) ||
                            (wrong.severe && all[e].reading == flipped);
      if (!is_tried) continue;
      if (options_.shapes_are_given && all[e].reading.moves_shapes()) continue;
      if (after_step_ && all[e].reading.moment == Moment::FrameBefore) continue;
      const auto is_same = [&, form = all[e].reading.form](const std::string& shape) {
        return form != Form::AsReported && solids.find(shape, form) == solids.find(shape);
      };
      if (is_same(pair.a) && is_same(pair.b)) continue;
      // Points scaled down move towards the origin, which may be where the shapes touch.
      const bool are_far = verdict->farthest > kFar * verdict->tolerance;
      if (all[e].reading.point_scale < 1 && !are_far) continue;
      const std::optional<Verdict> then = judge(solids, frames, pair, all[e].reading);
      if (!then || !have_their_size(all[e].reading, *then)) continue;
      // Or a gross error becomes one of an engine's approximations.
      const bool is_fewer =
          2 * then->wrong <= verdict->wrong ||
          (then->wrong <= verdict->wrong && kGross * then->farthest <= verdict->farthest);
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
    wrong_.add(std::move(wrong), options_.is_marked && options_.is_marked(frames.now->frame));
  }

  /// The wrong pairs that fit and are not reported yet; without a place if there are none. Those
  /// within the user's tolerance take part in the search of causes, but are not counted.
  template <class Fits>
  Finding gathered(const std::string& cause, const std::string& what, const std::string& remedy,
                   const Fits& fits) {
    Finding finding{cause, what, remedy, 0, judged_};
    const WrongPair* first = nullptr;
    Marks marks;
    std::map<Names, OfPair> pairs;
    all_gathered_ = 0, is_enough_ = false;
    const auto level = [](const WrongPair& of) { return 3 * of.beyond + of.gross + of.severe; };
    for (const WrongPair& wrong : wrong_) {
      if (wrong.record || !fits(wrong)) continue;
      all_gathered_ += wrong.times, is_enough_ = is_enough_ || wrong.gross;
      if (options_.ignores(cause, wrong.a, wrong.b)) continue;
      if (first == nullptr || level(wrong) > level(*first)) first = &wrong;
      if (!wrong.beyond) continue;
      finding.count += wrong.times;
      pairs.try_emplace({wrong.a, wrong.b}, wrong.place()).first->second.count += wrong.times;
      if (!wrong.is_copy) marks.add(wrong.mark(), &options_);
      for (const Mark& other : wrong.others) marks.add(other, &options_);
      if (wrong.grossly_beyond) finding.gross = std::max(finding.gross, wrong.size);
    }
    is_enough_ = is_enough_ || first == nullptr || all_gathered_ >= kOften * judged_;
    if (first == nullptr) return finding;
    put(first->place(), finding);
    finding.is_severe = first->severe, finding.size = first->size;
    marks.put_in(finding);
    std::ranges::stable_sort(finding.marks, {}, &Mark::frame);
    for (Mark& mark : finding.marks)
      if (cause != "flipped_normals" && cause != "normal") mark.normal.reset();
    for (const auto& [names, one] : pairs) finding.pairs.push_back(one);
    if (finding.gross == 0 && finding.count < kOften * judged_) finding.below = kFewAndSmall;
    return finding;
  }

  /// Whether only a single pair fits, although a body of it has others: no convention is wrong.
  bool is_local(const std::set<Names>& pairs) {
    if (pairs.size() != 1) return false;
    const auto& [a, b] = *pairs.begin();
    const int own = judged_in_[*pairs.begin()];
    // A static shape has others that are right.
    return (judged_of_[a] > own && (moved_.contains(a) || !moved_.contains(b))) ||
           (judged_of_[b] > own && (moved_.contains(b) || !moved_.contains(a)));
  }
  /// Pairs with a wrong claim that fits.
  template <class Fits> std::set<Names> pairs_of(const Fits& fits) {
    std::set<Names> pairs;
    for (const WrongPair& wrong : wrong_)
      if (!wrong.record && fits(wrong)) pairs.emplace(wrong.a, wrong.b);
    return pairs;
  }

  /// Whether nearly all of the remaining wrong pairs of these types fit.
  template <class Fits> bool fits_all_of(const std::set<Types>& types, const Fits& fits) {
    int count = 0, of = 0;
    for (const WrongPair& wrong : wrong_) {
      if (wrong.record || !types.contains(types_in_[{wrong.a, wrong.b}])) continue;
      of += wrong.times, count += fits(wrong) ? wrong.times : 0;
    }
    return count >= 0.95 * of;
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
    for (std::size_t e = 0; e < all.size(); ++e) {
      const auto is_gross = [&](const WrongPair& wrong) {
        return !wrong.record && wrong.gross && wrong.explained_by.test(e);
      };
      if (counts[e] < kOfWrong * untold &&
          !(all[e].reading == flipped && std::ranges::any_of(wrong_, is_gross)))
        counts[e] = 0;
    }
    const auto most = std::ranges::max_element(counts);
    if (most == counts.end() || *most == 0) return false;
    // A simple one that explains nearly as many is more likely.
    const auto chosen = std::ranges::find_if(counts, [&](int n) { return n >= 0.9 * *most; });
    const auto e = static_cast<std::size_t>(chosen - counts.begin());
    const auto is_explained = [&](const WrongPair& wrong) { return wrong.explained_by.test(e); };
    const std::set<Names> pairs = pairs_of(is_explained);
    int judged = 0;
    std::set<Types> types;
    for (const Names& names : pairs) {
      judged += judged_in_[names];
      types.insert(types_in_[names]);
    }
    if ((!may_be_rare(all[e].reading) && is_local(pairs)) ||
        (2 * counts[e] < judged && small_.refute(all[e].reading, types) &&
         !(pairs.size() >= kNoChance && counts[e] >= kOfTypes * judged &&
           fits_all_of(types, is_explained)))) {
      for (WrongPair& wrong : wrong_) wrong.explained_by.reset(e);
      return true;
    }
    std::vector<Finding> named;
    const bool is_of_types = types.size() == 1 && std::ranges::any_of(types_in_, [&](auto& of) {
                               return of.second != *types.begin();
                             });
    const auto& [a, b] = *pairs.begin();
    std::string where = is_of_types ? ", in pairs of kind " + in_words(*types.begin()) : "";
    if (pairs.size() == 1 && judged_ > judged) where = ", of '" + a + "' and '" + b + "' alone";
    for (const Mistake* mistake : all[e].made)
      named.push_back(
          gathered(mistake->name, mistake->what + where, mistake->remedy, is_explained));
    if (!is_enough_) return false;
    for (WrongPair& wrong : wrong_) wrong.record = wrong.record || is_explained(wrong);
    is_of_all_kinds_ = is_of_all_kinds_ || !is_of_types;
    if (is_of_types) explained_kinds_.insert(*types.begin());
    for (Finding& one : named) {
      one.below.clear();
      const auto same = std::ranges::find(findings, one.cause, &Finding::cause);
      if (same == findings.end()) {
        if (all_gathered_ > 0) findings.push_back(std::move(one));
      } else if (same->count == 0) {
        *same = std::move(one);
      } else if (same->line > 0) {
        same->count += one.count;
      } else if (one.line > 0) {  // small depths have no place
        one.what = same->what, one.count = same->count, one.of = same->of;
        *same = std::move(one);
      }
    }
    return true;
  }

  /// A scale or margin of a shape; without a name of all alike.
  struct Fit {
    std::string shape{};
    bool is_margin = false;
    double scale = 0, share = kOfShape;  // of its pairs

    // In a pair with a static shape, only the other one has another size.
    bool operator()(const WrongPair& wrong) const {
      for (std::size_t i = 0; i < wrong.scales.size() && !wrong.record; ++i)
        if (WrongPair::is_margin(i) == is_margin && (shape.empty() || wrong.scaled(i) == shape) &&
            std::abs(wrong.scales[i] / scale - 1) < kSameScale[is_margin] - 1)
          return true;
      return false;
    }
  };

  /// Reports the shape that has the wrong size or margin in most of its pairs, or all shapes alike.
  bool report_size(std::vector<Finding>& findings) {
    std::map<std::pair<std::string, bool>, Counted> of_shape;
    for (const WrongPair& wrong : wrong_)
      for (std::size_t i = 0; i < wrong.scales.size() && !wrong.record; ++i)
        if (const std::pair key(wrong.scaled(i), WrongPair::is_margin(i)); wrong.scales[i] > 0)
          of_shape[key].emplace_back(wrong.scales[i], wrong.times);
    Fit best, other;  // the other explains most pairs of the same shape too
    for (auto& [key, scales] : of_shape) {
      Fit fit{key.first, key.second, middle_of(scales)};
      int count = 0;
      for (const WrongPair& wrong : wrong_) count += fit(wrong) ? wrong.times : 0;
      fit.share = double(count) / judged_of_[fit.shape];
      const bool is_same = fit.is_margin && best.scale > 0 && fit.shape == best.shape;
      if (count < kNoChance || fit.share + is_same * 1e-9 <= best.share) continue;
      if (is_local(pairs_of(fit))) continue;
      other = is_same ? best : Fit();
      best = fit;
      if (fit.shape.empty()) break;
    }
    if (best.scale == 0) return false;
    if (best.share == other.share) std::swap(best, other);  // the size is simpler
    const auto is_of = [&](const WrongPair& wrong) { return best(wrong) || other(wrong); };
    const auto amount = [&](const Fit& fit) {
      return fit.is_margin ? metres(std::abs(fit.scale - 1) * size_of_[fit.shape])
                           : shown(1 / fit.scale) + " times";
    };
    constexpr const char* kCauses[2][2] = {{"shape_too_large", "shape_too_small"},
                                           {"margin_taken_off", "margin_added"}};
    const std::string name = "'" + best.shape + "'";
    const auto in_words = [&](const Fit& fit) {
      if (fit.is_margin) return "the margin of " + name + " is off by " + amount(fit);
      return (fit.shape.empty() ? "shapes are " : name + " is ") + amount(fit) +
             " as large as in the engine";
    };
    Finding finding =
        gathered(kCauses[best.is_margin][best.scale > 1],
                 in_words(best) + (other.scale > 0 ? ", or " + in_words(other) : ""),
                 "contacts fit it at another size: check its extents, its scale, its margin, and "
                 "what the engine's margin takes off",
                 is_of);
    for (WrongPair& wrong : wrong_) wrong.record = wrong.record || is_of(wrong);
    finding.below.clear(), finding.of = judged_of_[best.shape];
    finding.fits = {best.shape, best.is_margin ? 0 : best.scale};
    const auto same = std::ranges::find(findings, finding.cause, &Finding::cause);
    if (same == findings.end()) {
      if (all_gathered_ > 0) findings.push_back(std::move(finding));
    } else {
      same->count += finding.count, same->of += finding.of;
      if (std::ranges::count(same->what, ',') < kListed)
        same->what += ", " + name + " " + amount(best);
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
            (larger ? " larger" : " smaller"),
        larger
            ? "the engine adds a margin or radius: write the shapes with it (a hull may have a "
              "'radius' too), or find where it is added twice"
            : "the engine subtracts a margin, or shrinks a shape: write the shapes as they collide",
        has_margin);
    const int count = all_gathered_;
    // A single misplaced body has a depth too.
    const std::set<Names> pairs = pairs_of(has_margin);
    if (count < kOfWrong * wrong_.untold() || (count < kNoChance && 2 * count < judged_) ||
        is_local(pairs))
      return false;
    for (const std::string& name : {finding.a, finding.b}) {
      const auto has_it = [&](const Names& of) { return of.first == name || of.second == name; };
      if (pairs.size() > 1 && moved_.contains(name) && std::ranges::all_of(pairs, has_it))
        finding.what += ", in pairs of '" + name + "' alone";
    }
    for (WrongPair& wrong : wrong_) wrong.record = wrong.record || has_margin(wrong);
    finding.below.clear();
    const bool is_gross = std::abs(margin) > 0 && finding.size > kGross * 2 / kFar;
    if (count > 0) findings.push_back(std::move(finding));
    return is_gross;
  }

  bool after_step_;
  LintOptions options_;
  int judged_ = 0;
  int moving_ = 0;  // pairs for which another frame has other poses
  SmallDepths small_;
  std::map<std::string, int> judged_of_;  // by shape
  std::map<std::string, double> size_of_;
  std::map<Names, int> judged_in_;  // by pair
  std::map<Names, Types> types_in_;
  SteadyErrors steady_;
  std::set<std::string> moved_;  // shapes that did not stand still in some frame
  WrongPairs wrong_;
  int rounded_ = 0;  // pairs that fit rounded edges alone
  int kept_ = 0;     // pairs with claims that hold for kept points alone
  std::bitset<kMaxExplanations> has_explained_;
  std::set<Types> explained_kinds_;  // by causes of one kind of pairs
  bool is_of_all_kinds_ = false;     // whether some cause is not
  int all_gathered_ = 0;             // by the last gathered(), within the tolerance or not
  bool is_enough_ = false;           // whether these are so many or so wrong that they have a cause
};

}  // namespace

std::unique_ptr<Watch> watch_claims(const trace::Header& header, const LintOptions& options) {
  return std::make_unique<ClaimsWatch>(header, options);
}

}  // namespace contactscope::lint
