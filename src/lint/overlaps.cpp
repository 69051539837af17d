#include "lint/balance.h"
#include "lint/watch.h"

namespace contactscope::lint {
namespace {

using Names = std::pair<std::string, std::string>;

/// Bounding box of a placed solid and what is near, world.
Aabb<double> box_of(const Placed& placed) {
  const Vec3d middle = (placed.solid->lower() + placed.solid->upper()) / 2;
  constexpr double kNear = 1e-3;  // relative to its size: bodies at rest may not overlap
  const Vec3d half =
      (placed.solid->upper() - placed.solid->lower()) / 2 + Vec3d::Constant(kNear * placed.size());
  const Vec3d reach = placed.pose.rotation.toRotationMatrix().cwiseAbs() * half;
  const Vec3d center = placed.pose.transform(middle);
  return {center - reach, center + reach};
}

struct Missing {
  int count = 0;
  int line = 0, frame = 0, last = 0;
  double deepest = 0, size = 0;  // metres, and relative to the smaller shape
  bool is_gross = false;

  /// Engines that round corners miss a few tolerances.
  void add(const Moments& frames, double overlap, double tolerance, double of, bool hangs = false) {
    constexpr double kGrossly = 15;
    is_gross = is_gross || hangs || overlap > kGrossly * tolerance;
    if (hangs) size = 1;
    last = frames.now->frame;
    if (count++ > 0 && overlap <= deepest) return;
    deepest = overlap;
    size = hangs ? 1 : std::max(size, overlap / of);
    line = frames.now->line;
    frame = frames.now->frame;
  }
};

/// Looks for a point that two bodies share while one turns about it: that of a ball joint or hinge.
struct Pivot {
  Pose<double> first{};  // of b in the frame of a
  Mat3<double> squares = Mat3<double>::Zero();
  Vec3d moments = Vec3d::Zero();
  double moved = 0, turned = 0;
  double size = 0;  // of the smaller body, metres
  int count = 0;

  void add(const Pose<double>& b_in_a) {
    if (count++ == 0) first = b_in_a;
    // A point p of b stays where it is: turn p = -shift.
    const Mat3<double> turn =
        b_in_a.rotation.toRotationMatrix() - first.rotation.toRotationMatrix();
    const Vec3d shift = b_in_a.position - first.position;
    squares += turn.transpose() * turn;
    moments -= turn.transpose() * shift;
    moved += shift.squaredNorm(), turned += turn.squaredNorm();
  }
  /// Bodies that hardly move show nothing.
  bool is_joint() const {
    constexpr double kMoves = 2e-3, kRest = 0.25;  // solvers leave joints some play
    const double motion = std::max(moved, size * size * turned);
    if (!(motion > count * kMoves * kMoves * size * size)) return false;
    const Vec3d p =
        (squares + 1e-9 * squares.trace() * Mat3<double>::Identity()).inverse() * moments;
    return moved - 2 * p.dot(moments) + p.dot(squares * p) < kRest * kRest * motion;
  }
};

class OverlapsWatch final : public Watch {
 public:
  explicit OverlapsWatch(const trace::Header& header)
      : up_(header.up == "z" ? Vec3d::UnitZ() : Vec3d::UnitY()) {}

  void see(const Solids& solids, const Moments& frames) override {
    options_ = frames.options;
    std::set<Names> record;
    touched_.clear(), held_.clear(), pushes_.clear();
    for (const trace::Pair& pair : frames.now->pairs)
      for (const trace::Manifold& manifold : pair.manifolds) {
        const std::string &a = solids.body_of(pair.a), &b = solids.body_of(pair.b);
        touched_.insert(a), touched_.insert(b);
        constexpr double kUpward = 0.2;
        const double up = manifold.normal.dot(up_);
        if (std::abs(up) > kUpward) held_.insert(up > 0 ? b : a);
      }
    for (const trace::Pair& pair : frames.now->pairs) {
      const Names names = std::minmax(pair.a, pair.b);
      record.insert(names);
      if (!pair.manifolds.empty()) with_contacts_.insert(names), ++touching_;
      if (pair.manifolds.empty() && !pair.query && pair.state == "separated" && !pair.degenerate &&
          !pair.voided)
        look(solids, frames, names, separation_);
    }
    std::vector<std::pair<Aabb<double>, const std::string*>> boxes;
    for (const trace::Placement& one : frames.now->poses) {
      const std::optional<Placed> placed = place(solids, frames.of_contacts(), one.first, {});
      if (!placed) continue;
      // A plane's box is infinite.
      const Vec3d all = Vec3d::Constant(std::numeric_limits<double>::infinity());
      boxes.emplace_back(placed->solid->is_plane() ? Aabb<double>{-all, all} : box_of(*placed),
                         &one.first);
    }
    std::ranges::sort(boxes, {}, [](const auto& box) { return box.first.lower.x(); });
    for (std::size_t i = 0; i < boxes.size(); ++i)
      for (std::size_t j = i + 1; j < boxes.size(); ++j) {
        if (boxes[j].first.lower.x() > boxes[i].first.upper.x()) break;
        if (!overlaps(boxes[i].first, boxes[j].first)) continue;
        const Names names = std::minmax(*boxes[i].second, *boxes[j].second);
        if (!record.contains(names)) look(solids, frames, names, untold_);
      }
    for (const auto& [body, one] : frames.balance->all()) {
      if (!frames.balance->is_off(body)) continue;
      const Vec3d& lacking = one.impulse;
      ++off_[body].first;
      off_[body].second += std::ranges::none_of(
          pushes_[body], [&](const Vec3d& push) { return acts_along(lacking, push); });
    }
  }

  void report(std::vector<Finding>& findings) override {
    report_kind("overlap_told_apart", "shapes that overlap are reported as separated",
                "check the test that separates them, and the poses", separation_, findings);
    std::erase_if(untold_.pairs,
                  [&](const auto& one) { return !with_contacts_.contains(one.first); });
    report_kind(
        "overlap_without_contact", "shapes overlap without a reported contact",
        "they have contacts in other frames: check the broad phase, and what is left out when "
        "a frame is written",
        untold_, findings);
    std::erase_if(resting_.pairs, [&](const auto& one) {
      return one.second.count < kResting || with_contacts_.contains(one.first) ||
             (deep_.contains(one.first) && !hanging_.contains(one.first));
    });
    std::erase_if(lacking_, [](const auto& one) { return one.second.count < kResting; });
    erase_forced();
    erase_joined();
    for (auto& [names, one] : lacking_) {
      one.count = std::max(one.count, resting_.pairs[names].count);
      resting_.pairs[names] = one;
    }
    report_kind("pair_never_reported", "a body rests on another, and no contact is reported",
                "check the broad phase, the filter of pairs, and what is left out when a frame is "
                "written; if a rigid joint holds the bodies, ignore this pair",
                resting_, findings);
  }

 private:
  using Pairs = std::map<Names, Missing>;
  struct List {
    Pairs pairs{};
    Marks marks{};  // of these pairs, and of some that are no longer in the list
  };

  /// Frames in which a body rests on another.
  static constexpr int kResting = 10;

  void look(const Solids& solids, const Moments& frames, const Names& names, List& list) {
    const Reading collided = solids.collided(names.first, names.second);
    const std::optional<Placed> a = place(solids, frames.of_contacts(), names.first, collided);
    const std::optional<Placed> b = place(solids, frames.of_contacts(), names.second, collided);
    if (!a || !b) return;
    const std::optional<Separation> separation = separation_of(*a, *b);
    if (!separation) return;
    const double overlap = -separation->distance, tolerance = solids.tolerance_of(*a, *b);
    // A sleeping body has no contacts, and keeps its pose.
    const auto is_still = [&](const std::string& name) {
      return stands_still(solids, frames, name);
    };
    const bool both_still = is_still(names.first) && is_still(names.second);
    const bool is_asleep = both_still && (!touched_.contains(solids.body_of(names.first)) ||
                                          !touched_.contains(solids.body_of(names.second)));
    const bool is_deep = overlap > 4 * tolerance;
    if (is_deep) deep_.insert(names);
    const double size = std::min({a->size(), b->size(), 1e6});
    if (overlap > 4 * solids.allowed_for(*a, *b) && !(&list == &untold_ && is_asleep)) {
      list.pairs[names].add(frames, overlap, tolerance, size);
      list.marks.add(here(names, frames), options_);
    }
    const std::string &of_a = bodies_[names.first] = solids.body_of(names.first),
                      &of_b = bodies_[names.second] = solids.body_of(names.second);
    if (&list == &untold_ && of_a != of_b) {
      pivots_[names].add(relative_pose(a->pose, b->pose));
      pivots_[names].size = size;
    }
    if (both_still || of_a == of_b) return;
    bool is_lacking = false;
    if (&list == &untold_ && overlap > -tolerance &&
        lacks_contact(solids, *frames.balance, names, separation->normal)) {
      Missing& lacking = lacking_[names];
      if (lacking.count < kResting && frames.now->frame > lacking.last + 1) lacking = {};
      lacking.add(frames, overlap, tolerance, size, true);
      is_lacking = true;
    }
    if (&list == &untold_ && overlap > -tolerance) {
      pushes_[of_a].push_back(-separation->normal);
      pushes_[of_b].push_back(separation->normal);
    }
    constexpr double kMinimum = 1e-6, kUpright = 0.5;
    const double reach = a->pose.position.norm() + b->pose.position.norm();
    const double up = separation->normal.isZero() ? (a->solid->is_convex() ? -1 : 1)
                                                  : separation->normal.dot(up_);
    if (is_lacking) resting_.marks.add(here(names, frames), options_);
    if (std::abs(up) < kUpright) return;
    const bool rests = !is_deep && overlap > kMinimum * reach && !separation->normal.isZero();
    const bool is_hanging =
        overlap > -tolerance / 4 && hangs(solids, frames, up > 0 ? names.second : names.first);
    if (is_hanging) hanging_.insert(names);
    if (!rests && !is_hanging) return;
    resting_.pairs[names].add(frames, overlap, tolerance, size, is_hanging);
    if (!is_lacking) resting_.marks.add(here(names, frames), options_);
  }

  static Mark here(const Names& names, const Moments& frames) {
    return {frames.now->frame, frames.now->line, names.first, names.second};
  }

  /// Whether the impulses that two bodies lack are those of a contact of these shapes.
  static bool lacks_contact(const Solids& solids, const Balance& balance, const Names& names,
                            const Vec3d& normal) {
    const std::string &a = solids.body_of(names.first), &b = solids.body_of(names.second);
    if (!balance.is_off(a) && !balance.is_off(b)) return false;
    const Balance::Missing *const on_a = balance.missing(a), *const on_b = balance.missing(b);
    const Vec3d from_a = on_a == nullptr ? on_b->impulse : Vec3d(-on_a->impulse);
    const Vec3d impulse = on_b == nullptr ? from_a : on_b->impulse;
    constexpr double kOpposite = 0.1;
    return (from_a - impulse).norm() <= kOpposite * impulse.norm() && acts_along(impulse, normal);
  }

  static bool acts_along(const Vec3d& impulse, const Vec3d& normal) {
    constexpr double kAlong = 0.5;
    return normal.isZero() || normal.dot(impulse) > kAlong * impulse.norm();
  }

  /// A joint also pulls, and across. Where no contact explains what a body lacks, none is missing at
  /// the bodies that are joined to it.
  void erase_forced() {
    std::set<std::string> forced;
    for (const auto& [body, frames] : off_)
      if (frames.second >= kResting && 2 * frames.second > frames.first) forced.insert(body);
    for (std::size_t known = 0; known != forced.size();) {
      known = forced.size();
      for (Pairs* const pairs : {&resting_.pairs, &lacking_})
        std::erase_if(*pairs, [&](const auto& one) {
          const std::array of_pair = {bodies_.at(one.first.first), bodies_.at(one.first.second)};
          const auto is_forced = [&](const std::string& body) { return forced.contains(body); };
          if (std::ranges::none_of(of_pair, is_forced)) return false;
          for (const std::string& body : of_pair)
            if (off_.contains(body)) forced.insert(body);  // not a static one
          return true;
        });
    }
  }

  void erase_joined() {
    for (const auto& [names, pivot] : pivots_)
      if (pivot.is_joint()) resting_.pairs.erase(names), lacking_.erase(names);
  }

  /// Whether nothing is reported that holds a body, and it does not fall.
  bool hangs(const Solids& solids, const Moments& frames, const std::string& name) const {
    if (held_.contains(solids.body_of(name))) return false;
    const std::optional<Placed> before = place(solids, frames.before, name, {});
    const std::optional<Placed> now = place(solids, frames.now, name, {});
    constexpr double kHanging = 2e-3;  // relative to its size, in a step
    return before && now && !now->solid->is_plane() &&
           (now->middle() - before->middle()).norm() < kHanging * now->size();
  }

  void report_kind(const char* cause, const char* what, const char* remedy, List& list,
                   std::vector<Finding>& findings) const {
    std::erase_if(list.pairs, [&](const auto& one) {
      return options_ != nullptr && options_->ignores(cause, one.first.first, one.first.second);
    });
    const auto deepest = std::ranges::max_element(list.pairs, {}, [](const auto& one) {
      return std::pair(one.second.is_gross, one.second.deepest);
    });
    if (deepest == list.pairs.end()) return;
    int count = 0;
    for (const auto& one : list.pairs) count += one.second.count;
    findings.push_back({cause, what, remedy, count, touching_ + count, deepest->second.line,
                        deepest->second.frame, deepest->first.first, deepest->first.second,
                        "no contact", "they overlap by " + metres(deepest->second.deepest)});
    findings.back().is_severe = deepest->second.is_gross;
    findings.back().size = deepest->second.size;
    for (const Mark& mark : list.marks.marks.kept())
      if (list.pairs.contains({mark.a, mark.b})) findings.back().marks.push_back(mark);
    for (const auto& [names, one] : list.pairs)
      findings.back().pairs.push_back({names.first, names.second, one.count, one.line, one.frame});
  }

  std::set<Names> with_contacts_;
  // Bodies that have a contact in this frame, and those that one pushes up.
  std::set<std::string> touched_, held_;
  // Directions in which contacts that are not reported may push a body, in this frame.
  std::map<std::string, std::vector<Vec3d>> pushes_;
  // Frames in which a body lacks an impulse, and those in which no contact explains it.
  std::map<std::string, std::pair<int, int>> off_;
  std::map<std::string, std::string> bodies_;  // by shape
  List separation_, untold_, resting_;
  Pairs lacking_;  // pairs of bodies that move as if they had a contact that is not reported
  std::map<Names, Pivot> pivots_;  // of pairs without a contact that are close
  std::set<Names> hanging_;        // pairs without a contact of a body that nothing else holds
  std::set<Names> deep_;           // pairs without a contact that overlap more than bodies at rest
  int touching_ = 0;               // pairs with contacts, of all frames
  const LintOptions* options_ = nullptr;
  Vec3d up_;
};

}  // namespace

std::unique_ptr<Watch> watch_overlaps(const trace::Header& header) {
  return std::make_unique<OverlapsWatch>(header);
}

}  // namespace contactscope::lint
