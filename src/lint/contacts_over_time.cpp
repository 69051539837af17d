#include "lint/balance.h"
#include "lint/watch.h"

namespace contactscope::lint {
namespace {

constexpr double kBeyond = std::numeric_limits<double>::infinity();
/// Frames without a contact after which its return is a new contact.
constexpr int kMaxGap = 10;
/// Relative to the smaller shape: b's displacement seen from a, and that of one point in two frames.
constexpr double kAtRest = 2e-3, kPairAtRest = 2e-2, kOnePoint = 1e-2;
/// Points closer than this share of the smaller shape are one point.
constexpr double kDoubled = 1e-6;
/// Share of the tolerance by which a separation may change although the surfaces do not move.
constexpr double kDepthNoise = 0.25;
/// A jump that is undone is gross from this share of the smaller shape on.
constexpr double kGrossJump = 4e-3;
/// The same as a share of a positive separation: engines measure it roughly, for the next step.
constexpr double kSpeculativeNoise = 0.25;
/// Radians that a normal may turn more than the bodies.
constexpr double kTurn = 3 * std::numbers::pi / 180;
/// Cosine: a plane is infinite along a normal that rounding has turned.
constexpr double kAligned = 0.9994;
/// A flipped normal: the claims of this frame name it.
constexpr double kFlipped = 150 * std::numbers::pi / 180;

/// A contact point, and what the shapes measure there.
struct Spot {
  Vec3d in_a, normal;             // shape a's frame; the normal from a to b
  double reported = 0;            // separation
  double measured = 0;            // likewise; positive infinity: cannot be measured
  double excess = 0;              // overlap along the normal beyond the least overlap; 0 for meshes
  Vec3d impulse = Vec3d::Zero();  // N s, world; zero: not known
  const trace::Manifold* manifold = nullptr;  // its own, in its frame
  const trace::Point* point = nullptr;

  bool carries() const { return !impulse.isZero(); }
};

/// A separation or a normal that changed although the shapes stayed. It is a fault if it changes back.
struct Jump {
  Spot before, then;
  int line = 0, frame = 0;  // of `then`
  int frames = 1;           // since `before`
  double moved = 0;         // metres, b as seen from a, since `before`
  double turned = 0;        // radians, likewise
};

/// A point that was reported, and is not in some frames since.
struct LostSpot {
  Spot spot;
  std::size_t points = 0;      // of the pair in the first frame without it
  int line = 0, frame = 0;     // that frame
  int frames = 0;              // without it, until now
  double farthest = -kBeyond;  // the largest separation measured in them
  double moved = 0;            // metres, b as seen from a
  bool slept = false;          // both shapes stood still in them
  bool is_missed = false;      // in the first of them, a body moves as if it were there
};

/// State of a pair in earlier frames.
struct Known {
  Pose<double> b_in_a;
  std::vector<Spot> spots;  // of the frame before; empty: not reported there
  std::vector<LostSpot> lost;
  std::optional<Jump> depth, normal;
};

class ContactsWatch final : public Watch {
 public:
  void see(const Solids& solids, const Moments& frames) override {
    if (frames.before == nullptr) known_.clear();
    std::set<Key> now;
    for (const trace::Pair& pair : frames.now->pairs) {
      if (pair.manifolds.empty() || pair.query || pair.degenerate) continue;
      const Key key{pair.a, pair.b, pair.label};
      if (now.insert(key).second) see_pair(solids, frames, key, pair, known_[key]);
    }
    std::erase_if(known_, [](const auto& one) {
      return one.second.spots.empty() && one.second.lost.empty();
    });
    for (auto& [key, known] : known_)
      if (!now.contains(key)) see_pair(solids, frames, key, {}, known);
  }

  void report(std::vector<Finding>& findings) override {
    // In a long trace, rounding parts the shapes of some pair for a frame.
    constexpr double kShare = 1e-4;
    constexpr int kRepeats = 2;
    pairs_.report(findings, "contacts of a pair vanish and return, and the shapes go on touching",
                  "in these frames the pair has no contact: check the broad phase, caches that "
                  "expire, and what is left out when a frame is written",
                  1, kShare, kRepeats);
    points_.report(findings, "contact points vanish and return, and the shapes stay where they are",
                   "in these frames the manifold has fewer points: check clipping, the reduction, "
                   "and how points are matched with those of the frame before",
                   1, kShare);
    depths_.report(
        findings, "separations jump, and the shapes stay where they are",
        "a separation follows the poses: check points that are kept from earlier frames, "
        "and the feature that is measured against",
        1, kShare);
    normals_.report(findings, "normals turn, and the shapes do not",
                    "along these normals the shapes overlap more than in the frame before: check "
                    "the test that chooses the axis, and its preference for that of the last frame",
                    1, kShare);
    doubled_.report(findings, "manifolds have a point twice",
                    "leave one out: the solver applies both impulses; maybe a point that is kept "
                    "and the new one are both written");
  }

 private:
  using Key = std::tuple<std::string, std::string, std::string>;  // a, b, label

  struct Placement {
    Placed a, b;
    double size, tolerance, rounding;
    Pose<double> b_in_a;
    bool is_mesh;
  };

  static std::optional<Placement> placed(const Solids& solids, const Moments& frames,
                                         const std::string& a, const std::string& b) {
    const Reading collided = solids.collided(a, b);
    const std::optional<Placed> at = place(solids, frames.of_contacts(), a, collided);
    const std::optional<Placed> bt = place(solids, frames.of_contacts(), b, collided);
    if (!at || !bt) return std::nullopt;
    const double size = std::min({at->size(), bt->size(), 1e6});
    const double reach = std::max(at->pose.position.norm(), bt->pose.position.norm());
    const double tolerance = solids.allowed_for(*at, *bt);
    return Placement{*at,
                     *bt,
                     size,
                     tolerance,
                     std::max(1e-6 * (size + reach), tolerance / 50),
                     relative_pose(at->pose, bt->pose),
                     !(at->solid->is_convex() || at->solid->is_plane()) ||
                         !(bt->solid->is_convex() || bt->solid->is_plane())};
  }

  /// Separation of the surfaces along a normal, both in a's frame.
  static double measure(const Placement& at, const Vec3d& in_a, const Vec3d& normal) {
    const Vec3d point = at.a.pose.transform(in_a), direction = at.a.pose.rotate(normal);
    const std::optional<double> of_a = at.a.exit(point, direction);
    const std::optional<double> of_b = at.b.exit(point, -direction);
    return of_a && of_b ? -*of_a - *of_b : kBeyond;
  }

  /// Likewise at a point that is not reported, or of the shapes if none of the pair is.
  static double measure_lost(const Placement& at, const LostSpot& lost) {
    if (lost.points == 0 && !at.is_mesh)
      if (const std::optional<Separation> best = best_separation(at.a, at.b)) return best->distance;
    return measure(at, lost.spot.in_a, lost.spot.normal);
  }

  static std::vector<Spot> spots_of(const Placement& at, const trace::Pair& pair) {
    std::vector<Spot> spots;
    std::optional<Separation> best;
    if (!at.is_mesh && !pair.manifolds.empty()) best = best_separation(at.a, at.b);
    for (const trace::Manifold& manifold : pair.manifolds)
      for (const trace::Point& point : manifold.points) {
        Spot spot{at.a.pose.inverse_transform(point.position),
                  at.a.pose.inverse_rotate(manifold.normal).normalized(), point.separation};
        spot.manifold = &manifold, spot.point = &point;
        if (point.impulse)
          spot.impulse = point.impulse->normal * manifold.normal + point.impulse->friction;
        spot.measured = measure(at, spot.in_a, spot.normal);
        if (best && manifold.normal.dot(best->normal) < kAligned)
          spot.excess = best->distance - separation_along(at.a, at.b, manifold.normal);
        spots.push_back(spot);
      }
    return spots;
  }

  void see_pair(const Solids& solids, const Moments& frames, const Key& key,
                const trace::Pair& pair, Known& known) {
    const std::optional<Placement> at = placed(solids, frames, std::get<0>(key), std::get<1>(key));
    if (!at) return known.spots.clear(), known.lost.clear();
    std::vector<Spot> spots = spots_of(*at, pair);
    for (const Spot& spot : spots)
      reach_ = std::max(reach_, std::min(spot.reported, spot.measured));
    const double moved = (at->b_in_a.position - known.b_in_a.position).norm() +
                         at->size * at->b_in_a.rotation.angularDistance(known.b_in_a.rotation);
    see_lost(solids, frames, *at, key, known, spots, moved);
    if (!known.spots.empty() && !spots.empty())
      see_jumps(frames, *at, key, pair, known, spots, moved);
    see_doubled(frames, *at, pair, spots);
    known.b_in_a = at->b_in_a;
    known.spots = std::move(spots);
  }

  /// The nearest spot. On a mesh several triangles have one there: then that with the same normal.
  static const Spot* same_place(const std::vector<Spot>& spots, const Spot& as, double near,
                                bool by_normal = false) {
    const auto distance = [&](const Spot& spot) {
      return by_normal ? -spot.normal.dot(as.normal) : (spot.in_a - as.in_a).norm();
    };
    const Spot* best = nullptr;
    for (const Spot& spot : spots) {
      if ((spot.in_a - as.in_a).norm() > near) continue;
      if (best == nullptr || distance(spot) < distance(*best)) best = &spot;
    }
    return best;
  }

  /// A lost pair is measured as a whole, wherever it touches; while it clearly overlaps, its motion
  /// explains nothing. A missing impulse shows a lost point.
  static double rest_of(const Placement& at, const LostSpot& lost) {
    constexpr double kOverlaps = 0.4, kMoves = 0.2;
    if (lost.points == 0 && !at.is_mesh && lost.farthest < -kOverlaps * at.tolerance) return kMoves;
    return lost.points == 0 || lost.is_missed ? kPairAtRest : kAtRest;
  }

  /// Whether a point was about as close while it was not reported as before or after, and clearly
  /// within the separations up to which the engine reports contacts.
  bool returns(const Placement& at, const LostSpot& lost, const Spot& now) const {
    constexpr double kClear = 4;
    const double farther =
        std::max(lost.farthest - std::max(lost.spot.measured, now.measured), 0.0);
    // The reports of separated shapes may depend on their velocities.
    const double reach = lost.moved <= kAtRest * at.size ? reach_ : 0;
    return lost.moved <= rest_of(at, lost) * at.size &&
           (lost.is_missed ? lost.farthest < std::max(reach, at.tolerance)
                           : lost.farthest < reach - at.rounding - kClear * farther);
  }

  /// Overlaps far beyond rounding count as gross: engines choose points, but not pairs.
  static double size_of(const Placement& at, const LostSpot& lost) {
    constexpr double kCertain = 10;
    const bool is_certain = lost.points == 0 && -lost.farthest > kCertain * at.rounding;
    return lost.is_missed ? 1 : std::max(-lost.farthest / at.size, is_certain * Tally::kGross);
  }

  void see_lost(const Solids& solids, const Moments& frames, const Placement& at, const Key& key,
                Known& known, const std::vector<Spot>& spots, double moved) {
    const double near = kOnePoint * at.size;
    if (!spots.empty()) ++points_.of, ++pairs_.of;
    const bool are_still = stands_still(solids, frames, std::get<0>(key)) &&
                           stands_still(solids, frames, std::get<1>(key));
    bool is_counted = false;
    std::erase_if(known.lost, [&](LostSpot& lost) {
      lost.moved += moved;
      lost.slept = lost.slept && (are_still || !spots.empty());
      const Spot* const now = same_place(spots, lost.spot, lost.points == 0 ? kBeyond : near);
      if (now == nullptr) {
        lost.farthest = std::max(lost.farthest, measure_lost(at, lost));
        return ++lost.frames >= kMaxGap || lost.moved > rest_of(at, lost) * at.size;
      }
      // A sleeping body has no contacts, and moves when it wakes.
      const bool wakes = lost.points == 0 && lost.slept && !are_still;
      if (is_counted || wakes || lost.points >= spots.size() || !returns(at, lost, *now))
        return true;
      is_counted = true;
      (lost.points == 0 ? pairs_ : points_)
          .wrong_at(
              {lost.frame, lost.line, std::get<0>(key), std::get<1>(key),
               at.a.pose.transform(lost.spot.in_a)},
              frames, size_of(at, lost), [&] {
                return std::pair(
                    std::to_string(lost.points) + " points" +
                        (lost.frames > 1 ? " for " + std::to_string(lost.frames) + " frames" : "") +
                        ", none at " + spelled(at.a.pose.transform(lost.spot.in_a)),
                    "the separation there is " + metres(lost.farthest) + ", as in frame " +
                        std::to_string(lost.frame - 1) + ", which has it");
              });
      return true;
    });
    if (spots.size() >= known.spots.size()) return;
    const std::size_t first = known.lost.size();
    Vec3d impulse = Vec3d::Zero();
    for (const Spot& spot : known.spots) {
      if (same_place(spots, spot, near) != nullptr) continue;
      impulse += spot.impulse;
      known.lost.push_back(
          {spot, spots.size(), frames.now->line, frames.now->frame, 1, 0, moved, are_still});
      known.lost.back().farthest = measure_lost(at, known.lost.back());
    }
    const auto lacks = [&](const std::string& name, const Vec3d& of_lost) {
      constexpr double kAbout = 0.5;
      const Balance::Missing* const one = frames.balance->missing(solids.body_of(name));
      return one && one->is_off() && !one->was_off &&
             (one->impulse - of_lost).norm() <= kAbout * one->impulse.norm();
    };
    // Where all impulses of a pair are missing, no point is.
    const bool is_missed = (spots.empty() || std::ranges::any_of(spots, &Spot::carries)) &&
                           (lacks(std::get<0>(key), -impulse) || lacks(std::get<1>(key), impulse));
    for (std::size_t i = first; i < known.lost.size(); ++i) known.lost[i].is_missed = is_missed;
  }

  static double off(const Spot& spot) { return spot.reported - spot.measured; }
  static double angle(const Spot& one, const Spot& other) {
    return std::acos(std::clamp(one.normal.dot(other.normal), -1.0, 1.0));
  }

  /// Elsewhere no separation is measured.
  static bool is_on_surfaces(const Placement& at, const Spot& spot) {
    if (!std::isfinite(spot.measured)) return false;
    if (at.is_mesh) return true;
    const Vec3d point = at.a.pose.transform(spot.in_a);
    const double farthest =
        std::max(std::abs(at.a.distance(point)), std::abs(at.b.distance(point)));
    return farthest <= std::abs(spot.reported) + std::abs(spot.measured) + 4 * at.tolerance;
  }

  /// Whether a jump is undone; forgets it if the shapes have moved, or after too many frames.
  template <class IsBack>
  static bool returns(std::optional<Jump>& jump, const Placement& at,
                      const std::vector<Spot>& spots, double moved, double turned,
                      const IsBack& is_back) {
    if (!jump) return false;
    jump->moved += moved, jump->turned += turned;
    const Spot* const now = same_place(spots, jump->before, kOnePoint * at.size, true);
    const bool is_undone = now != nullptr && is_back(*now, *jump);
    if (!is_undone && ++jump->frames > kMaxGap) jump.reset();
    return is_undone;
  }

  /// Whether the next frame has a jump too: then it may stay, and its claims are judged.
  template <class Differ>
  static bool lasts(const Moments& frames, const Placement& at, const trace::Pair& pair,
                    const Jump& jump, const Differ& differ) {
    const trace::Pair* const after = frames.after ? same_pair(*frames.after, pair) : nullptr;
    if (after == nullptr) return false;
    const std::vector<Spot> spots = spots_of(at, *after);
    const Spot* const next = same_place(spots, jump.then, kOnePoint * at.size, true);
    return next != nullptr && differ(*next, jump.then) < differ(*next, jump.before);
  }

  /// Changes of separations and normals that the poses do not explain, and that are undone.
  void see_jumps(const Moments& frames, const Placement& at, const Key& key,
                 const trace::Pair& pair, Known& known, const std::vector<Spot>& spots,
                 double moved) {
    ++depths_.of, ++normals_.of;
    const double turned = known.b_in_a.rotation.angularDistance(at.b_in_a.rotation);
    const auto degrees = [](double radians) { return shown(radians * 180 / std::numbers::pi); };
    const auto mark = [&](const Jump& jump) {
      return Mark{jump.frame, jump.line, std::get<0>(key), std::get<1>(key),
                  at.a.pose.transform(jump.then.in_a)};
    };
    const auto allowed = [&](const Spot& one, const Spot& other, double by) {
      return kDepthNoise * at.tolerance + by +
             kSpeculativeNoise * std::max({one.reported, other.reported, 0.0});
    };
    const bool is_back =
        returns(known.depth, at, spots, moved, turned, [&](const Spot& now, const Jump& jump) {
          const double half = std::abs(off(jump.then) - off(jump.before)) / 2;
          return jump.moved < 2 * half && std::abs(off(now) - off(jump.before)) < half;
        });
    if (is_back) {
      const Spot &before = known.depth->before, &then = known.depth->then;
      const double share = std::abs(off(then) - off(before)) / at.size;
      const double size = share < kGrossJump ? share : std::max(share, Tally::kGross);
      depths_.wrong_at(mark(*known.depth), frames, size, [&] {
        return std::pair("separation " + metres(then.reported) + ", and " +
                             metres(before.reported) + " in the frame before",
                         "the surfaces moved by " + metres(then.measured - before.measured));
      });
      known.depth.reset();
    }
    const bool is_turned_back =
        returns(known.normal, at, spots, moved, turned, [&](const Spot& now, const Jump& jump) {
          return angle(now, jump.before) < angle(jump.then, jump.before) / 2;
        });
    if (is_turned_back) {
      const Jump& jump = *known.normal;
      const double size = 1 - jump.then.normal.dot(jump.before.normal);  // 11 degrees are gross
      Mark turned_mark = mark(jump);
      turned_mark.normal = at.a.pose.rotate(jump.before.normal);
      normals_.wrong_at(turned_mark, frames, size, [&] {
        return std::pair("normal " + spelled(at.a.pose.rotate(jump.then.normal)) + ", and " +
                             spelled(*turned_mark.normal) + " in the frame before",
                         "it turns by " + degrees(angle(jump.then, jump.before)) +
                             " degrees, the shapes by " + degrees(jump.turned));
      });
      known.normal.reset();
    }
    double jump = 0, turn = 0;
    const Jump here{{}, {}, frames.now->line, frames.now->frame, 1, moved, turned};
    std::optional<Jump> depth, normal;
    for (const Spot& now : spots) {
      const Spot* const before = same_place(known.spots, now, kOnePoint * at.size, at.is_mesh);
      if (before == nullptr) continue;
      const double by = angle(now, *before), change = std::abs(off(now) - off(*before));
      const bool is_worse =
          at.is_mesh ? moved <= kAtRest * at.size : now.excess > before->excess + at.tolerance / 4;
      if (by > turn && by >= kTurn + 4 * turned && by <= kFlipped && is_worse) {
        turn = by;
        normal = here;
        normal->before = *before, normal->then = now;
      }
      const double least = std::min(change, std::abs(now.reported - before->reported));
      if (by > kTurn || !(change > jump) || !(least > allowed(now, *before, moved))) continue;
      if (!is_on_surfaces(at, now) || !is_on_surfaces(at, *before)) continue;
      jump = change;
      depth = here;
      depth->before = *before, depth->then = now;
    }
    // One that follows another is no jump that may be undone, but a wrong claim.
    const bool is_first = depth && !is_back && !known.depth;
    if (is_first) known.depth = depth;
    if (normal && !is_turned_back && !known.normal) known.normal = normal;
    const auto by = [](const Spot& one, const Spot& two) {
      return std::abs(one.reported - two.reported);
    };
    if (normal && !is_turned_back && !lasts(frames, at, pair, *normal, &angle))
      (*frames.explained)[&pair] = Explained::Wholly;
    else if (is_first && !lasts(frames, at, pair, *depth, by))
      frames.explained->try_emplace(&pair, Explained::ButForSigns);
  }

  void see_doubled(const Moments& frames, const Placement& at, const trace::Pair& pair,
                   const std::vector<Spot>& spots) {
    if (spots.empty()) return;
    ++doubled_.of;
    // Triangles of a mesh share points. So there a point counts as doubled only within one manifold,
    // or with all points of a triangle.
    const auto are_alike = [](const trace::Point& one, const trace::Point& other) {
      return one.position == other.position && one.separation == other.separation;
    };
    const auto is_same = [&](const Spot& one, const Spot& other) {
      if (!at.is_mesh) return (one.in_a - other.in_a).norm() <= kDoubled * at.size;
      if (one.manifold == other.manifold) return are_alike(*one.point, *other.point);
      return one.manifold->triangle == other.manifold->triangle && one.normal == other.normal &&
             (one.manifold->triangle || one.manifold->points.size() > 2) &&
             std::ranges::equal(one.manifold->points, other.manifold->points, are_alike);
    };
    for (std::size_t i = 0; i < spots.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (is_same(spots[i], spots[j]))
          return doubled_.wrong(
              frames, pair.a, pair.b,
              [&] {
                return std::pair("points " + std::to_string(j) + " and " + std::to_string(i) +
                                     " are at " + spelled(at.a.pose.transform(spots[i].in_a)),
                                 std::string("they are one point"));
              },
              spots[i].point->position);
  }

  std::map<Key, Known> known_;
  double reach_ = 0;  // the largest separation that was reported so far, at least 0
  Tally pairs_{"pairs_flicker"}, points_{"points_flicker"}, depths_{"depths_jump"},
      normals_{"normals_jump"}, doubled_{"points_twice"};
};

}  // namespace

std::unique_ptr<Watch> watch_contacts_over_time() { return std::make_unique<ContactsWatch>(); }

}  // namespace contactscope::lint
