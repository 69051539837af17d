#include "versus/rollout_passing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "trace/find.h"
#include "versus/reference.h"

namespace contactscope::versus {
namespace {

constexpr double kInside = 0.25;  // relative to the thinner shape
constexpr int kLooks = 8;         // while a body moves by the thinner one's thickness
constexpr int kMaxLooks = 2000;   // per step

/// The motion of a shape between two frames.
struct Path {
  lint::Placed from, to;

  lint::Placed at(double share) const {
    lint::Placed there = from;
    there.pose.position = (1 - share) * from.pose.position + share * to.pose.position;
    there.pose.rotation = from.pose.rotation.slerp(share, to.pose.rotation);
    return there;
  }
  double lowest(const Vec3d& axis) const { return -std::max(from.extent(-axis), to.extent(-axis)); }
  double highest(const Vec3d& axis) const { return std::max(from.extent(axis), to.extent(axis)); }
  Vec3d move() const { return to.pose.position - from.pose.position; }
  /// Shortest side of its box; infinite for a surface.
  double thickness() const {
    const double least = (from.solid->upper() - from.solid->lower()).minCoeff();
    return from.solid->is_convex() && least > 0 ? least : std::numeric_limits<double>::infinity();
  }
};

std::optional<Path> path_of(const lint::Solids& solids, const std::string& name,
                            const trace::Frame& before, const trace::Frame& now) {
  const auto from = lint::place(solids, &before, name, {});
  const auto to = lint::place(solids, &now, name, {});
  if (!from || !to || from->solid->is_plane()) return std::nullopt;
  return Path{*from, *to};
}

bool may_meet(const Path& a, const Path& b) {
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3d along = Vec3d::Unit(axis);
    if (a.lowest(along) > b.highest(along) || b.lowest(along) > a.highest(along)) return false;
  }
  return true;
}

bool passes(const Path& body, const Path& other) {
  const double thin = std::min(body.thickness(), other.thickness());
  const double relative_motion = (body.move() - other.move()).norm();
  if (!(relative_motion > body.thickness()) || !may_meet(body, other)) return false;
  const auto is_inside = [&](double share) {
    const std::optional<double> separation = separation_of(body.at(share), other.at(share));
    return separation && *separation < -kInside * thin;
  };
  if (is_inside(0) || is_inside(1)) return false;
  const int looks =
      static_cast<int>(std::min<double>(kMaxLooks, std::ceil(kLooks * relative_motion / thin)));
  for (int i = 1; i < looks; ++i)
    if (is_inside(static_cast<double>(i) / looks)) return true;
  return false;
}

}  // namespace

std::vector<Passing> passings(const lint::Solids& solids, const std::vector<RolloutBody>& bodies,
                              const trace::Frame& before, const trace::Frame& now) {
  std::vector<Passing> found;
  for (const RolloutBody& body : bodies) {
    const std::optional<Path> own = path_of(solids, body.name, before, now);
    // A body at rest next to a bullet is found from the bullet.
    if (!own || own->move().norm() <= own->thickness()) continue;
    for (const trace::Placement& one : now.poses) {
      if (one.first == body.name) continue;
      const std::optional<Path> other = path_of(solids, one.first, before, now);
      if (other && passes(*own, *other)) found.push_back({body.name, one.first});
    }
  }
  return found;
}

}  // namespace contactscope::versus
