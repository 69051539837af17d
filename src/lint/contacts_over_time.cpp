#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <tuple>

#include "core/at.h"
#include "lint/tally.h"

namespace contactscope::lint {
namespace {

constexpr double kBeyond = std::numeric_limits<double>::infinity();
/// Frames without a contact after which its return is a new contact.
constexpr int kMaxGap = 10;
/// Relative to the smaller shape: displacement of b as seen from a, and distance of two points that
/// are the same point in two frames.
constexpr double kAtRest = 2e-3, kOnePoint = 1e-2;
/// Points closer than this share of the smaller shape are one point.
constexpr double kDoubled = 1e-6;
/// Share of the tolerance by which a separation may change although the surfaces do not move.
constexpr double kDepthNoise = 0.25;
/// Radians that a normal may turn more than the bodies.
constexpr double kTurn = 3 * std::numbers::pi / 180;
/// A flipped normal: the claims of this frame name it.
constexpr double kFlipped = 150 * std::numbers::pi / 180;

/// A contact point, and what the shapes measure there.
struct Spot {
  Vec3d in_a;           // shape a's frame
  Vec3d normal;         // shape a's frame, from a to b
  double reported = 0;  // separation
  double measured = 0;  // likewise; positive infinity: cannot be measured
  double excess = 0;    // overlap along the normal beyond the least overlap; 0 for meshes
};

/// A point that was reported, and is not in some frames since.
struct LostSpot {
  Spot spot;
  std::size_t points = 0;      // of the pair in the first frame without it
  int line = 0, frame = 0;     // that frame
  int frames = 0;              // without it, until now
  double farthest = -kBeyond;  // the largest separation measured in them
  double moved = 0;            // metres, b as seen from a
};

/// State of a pair in earlier frames.
struct Known {
  Pose<double> b_in_a;
  std::vector<Spot> spots;  // of the frame before; empty: not reported there
  std::vector<LostSpot> lost;
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
    // Rounding decides whether shapes touch: in long traces a few of these are no fault.
    constexpr double kShare = 1e-4;
    pairs_.report("contacts of a pair vanish and return, and the shapes stay where they are",
                  "in these frames the pair has no contact: check the broad phase, caches that "
                  "expire, and what is left out when a frame is written",
                  1, kShare, findings);
    points_.report("contact points vanish and return, and the shapes stay where they are",
                   "in these frames the manifold has fewer points: check clipping, the reduction, "
                   "and how points are matched with those of the frame before",
                   1, kShare, findings);
    depths_.report(
        "separations jump, and the shapes stay where they are",
        "a separation follows the poses: check points that are kept from earlier frames, "
        "and the feature that is measured against",
        1, kShare, findings);
    normals_.report("normals turn, and the shapes do not",
                    "along these normals the shapes overlap more than in the frame before: check "
                    "the test that chooses the axis, and its preference for that of the last frame",
                    1, kShare, findings);
    doubled_.report("manifolds have a point twice",
                    "leave one out: the solver applies both impulses; maybe a point that is kept "
                    "and the new one are both written",
                    1, 0, findings);
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
    const std::optional<Placed> at = place(solids, frames.now, a, {});
    const std::optional<Placed> bt = place(solids, frames.now, b, {});
    if (!at || !bt) return std::nullopt;
    const double size = std::min({at->size(), bt->size(), 1e6});
    const double reach = std::max(at->pose.position.norm(), bt->pose.position.norm());
    const double tolerance = solids.tolerance_of(*at, *bt);
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

  static std::vector<Spot> spots_of(const Placement& at, const trace::Pair& pair) {
    std::vector<Spot> spots;
    std::optional<Separation> best;
    if (!at.is_mesh && !pair.manifolds.empty()) best = best_separation(at.a, at.b);
    for (const trace::Manifold& manifold : pair.manifolds)
      for (const trace::Point& point : manifold.points) {
        Spot spot{at.a.pose.inverse_transform(point.position),
                  at.a.pose.inverse_rotate(manifold.normal).normalized(), point.separation};
        spot.measured = measure(at, spot.in_a, spot.normal);
        if (best) spot.excess = best->distance - separation_along(at.a, at.b, manifold.normal);
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
    see_lost(frames, *at, key, known, spots, moved);
    if (!known.spots.empty() && !spots.empty()) see_jumps(frames, *at, pair, known, spots, moved);
    see_doubled(frames, *at, pair, spots);
    known.b_in_a = at->b_in_a;
    known.spots = std::move(spots);
  }

  static const Spot* same_place(const std::vector<Spot>& spots, const Spot& as, double near) {
    const Spot* best = nullptr;
    for (const Spot& spot : spots) {
      const double distance = (spot.in_a - as.in_a).norm();
      if (distance > near) continue;
      if (best == nullptr || distance < (best->in_a - as.in_a).norm()) best = &spot;
    }
    return best;
  }

  /// Whether a point was about as close while it was not reported as before or after, and clearly
  /// within the separations up to which the engine reports contacts.
  bool returns(const Placement& at, const LostSpot& lost, const Spot& now) const {
    constexpr double kClear = 4;
    const double farther =
        std::max(lost.farthest - std::max(lost.spot.measured, now.measured), 0.0);
    return lost.moved <= kAtRest * at.size &&
           lost.farthest < reach_ - at.rounding - kClear * farther;
  }

  void see_lost(const Moments& frames, const Placement& at, const Key& key, Known& known,
                const std::vector<Spot>& spots, double moved) {
    const double near = kOnePoint * at.size;
    if (!spots.empty()) ++points_.of, ++pairs_.of;
    bool is_counted = false;
    std::erase_if(known.lost, [&](LostSpot& lost) {
      lost.moved += moved;
      const Spot* const now = same_place(spots, lost.spot, near);
      if (now == nullptr) {
        lost.farthest = std::max(lost.farthest, measure(at, lost.spot.in_a, lost.spot.normal));
        return ++lost.frames >= kMaxGap || lost.moved > kAtRest * at.size;
      }
      if (is_counted || lost.points >= spots.size() || !returns(at, lost, *now)) return true;
      is_counted = true;
      (lost.points == 0 ? pairs_ : points_)
          .wrong_at({lost.frame, lost.line, std::get<0>(key), std::get<1>(key)}, frames, [&] {
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
    for (const Spot& spot : known.spots)
      if (same_place(spots, spot, near) == nullptr)
        known.lost.push_back({spot, spots.size(), frames.now->line, frames.now->frame, 1,
                              measure(at, spot.in_a, spot.normal), moved});
  }

  /// Changes of separations and normals that the poses do not explain.
  void see_jumps(const Moments& frames, const Placement& at, const trace::Pair& pair, Known& known,
                 const std::vector<Spot>& spots, double moved) {
    ++depths_.of, ++normals_.of;
    double jump = 0, error = 0, error_before = 0, turn = 0;
    const Spot *deep = nullptr, *deep_before = nullptr, *turned = nullptr, *turned_before = nullptr;
    for (const Spot& now : spots) {
      const Spot* const before = same_place(known.spots, now, kOnePoint * at.size);
      if (before == nullptr) continue;
      const double angle = std::acos(std::clamp(now.normal.dot(before->normal), -1.0, 1.0));
      if (angle > turn) turn = angle, turned = &now, turned_before = before;
      if (!std::isfinite(now.measured) || !std::isfinite(before->measured)) continue;
      const double off = now.reported - now.measured,
                   off_before = before->reported - before->measured;
      if (angle > kTurn || std::abs(off - off_before) <= jump) continue;
      jump = std::abs(off - off_before);
      error = std::abs(off), error_before = std::abs(off_before);
      deep = &now, deep_before = before;
    }
    const bool jumps = deep != nullptr && jump > kDepthNoise * at.tolerance + moved;
    if (jumps && error > error_before) {
      depths_.wrong(frames, pair.a, pair.b, [&] {
        return std::pair(
            "separation " + metres(deep->reported) + ", and " + metres(deep_before->reported) +
                " in the frame before",
            "the surfaces moved by " + metres(deep->measured - deep_before->measured) + " m");
      });
      frames.explained->insert(&pair);
    }
    const double own_turn = known.b_in_a.rotation.angularDistance(at.b_in_a.rotation);
    if (turned == nullptr || turn < kTurn + 4 * own_turn || turn > kFlipped) return;
    if (!(turned->excess > turned_before->excess + at.tolerance / 4)) return;
    normals_.wrong(frames, pair.a, pair.b, [&] {
      return std::pair("normal " + spelled(at.a.pose.rotate(turned->normal)) + ", and " +
                           spelled(at.a.pose.rotate(turned_before->normal)) +
                           " in the frame before",
                       "it turns by " + metres(turn * 180 / std::numbers::pi) +
                           " degrees, the shapes by " + metres(own_turn * 180 / std::numbers::pi));
    });
    frames.explained->insert(&pair);
  }

  void see_doubled(const Moments& frames, const Placement& at, const trace::Pair& pair,
                   const std::vector<Spot>& spots) {
    if (at.is_mesh || spots.empty()) return;
    ++doubled_.of;
    for (std::size_t i = 0; i < spots.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if ((spots[i].in_a - spots[j].in_a).norm() <= kDoubled * at.size)
          return doubled_.wrong(frames, pair.a, pair.b, [&] {
            return std::pair("points " + std::to_string(j) + " and " + std::to_string(i) +
                                 " are at " + spelled(at.a.pose.transform(spots[i].in_a)),
                             std::string("they are one point"));
          });
  }

  std::map<Key, Known> known_;
  double reach_ = 0;  // the largest separation that was reported so far, at least 0
  Tally pairs_{"pairs_flicker"}, points_{"points_flicker"}, depths_{"depths_jump"},
      normals_{"normals_jump"}, doubled_{"points_twice"};
};

}  // namespace

std::unique_ptr<Watch> watch_contacts_over_time() { return std::make_unique<ContactsWatch>(); }

}  // namespace contactscope::lint
