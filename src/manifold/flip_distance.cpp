
#include "core/random.h"
#include "geometry/bounds.h"
#include "manifold/dispatch.h"

namespace contactscope {
namespace {

constexpr double kReach = 0.01;  // as a fraction of the smaller shape
constexpr int kHalvings = 12;    // bisection steps between a change and its double
constexpr int kMaxFlipPlaces = 1 << 20;

/// The identity of a pair's points: ids, with the triangle of a mesh.
using Names = std::vector<std::pair<int, FeatureId>>;

template <class S> Names names_of(const Manifolds<S>& manifolds) {
  Names names;
  for (const Manifold<S>& manifold : manifolds)
    for (const ContactPoint<S>& point : manifold.points)
      names.emplace_back(manifold.triangle, point.id);
  std::ranges::sort(names);
  return names;
}

/// The least change, from `first` on, with `differs(change)`; `limit` if there is none below it.
template <class Differs> double least_change(double first, double limit, const Differs& differs) {
  double same = 0, other = first;
  while (!differs(other)) {
    same = other;
    other *= 2;
    if (other > limit) return limit;
  }
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (same + other);
    (differs(middle) ? other : same) = middle;
  }
  return other;
}

/// Half the diagonal of its box; infinite for a plane.
template <class S> double size_of(const Shape<S>& shape) {
  const std::optional<Aabb<S>> box = aabb_of(shape);
  return box ? 0.5 * static_cast<double>(box->extent().norm())
             : std::numeric_limits<double>::infinity();
}

}  // namespace

template <class S>
trace::Flip flip_distance(const Shape<S>& a, const Pose<S>& pose_a, const Shape<S>& b,
                          const Pose<S>& pose_b, const CollideOptions& options,
                          const FlipOptions& flip) {
  const auto collided_at = [&](const Pose<S>& pose) {
    Manifolds<S> manifolds;
    collide(a, pose_a, b, pose, options, manifolds);
    return manifolds;
  };
  const auto names_at = [&](const Pose<S>& pose) { return names_of(collided_at(pose)); };
  const Manifolds<S> manifolds = collided_at(pose_b);
  const Names names = names_of(manifolds);
  trace::Flip found;
  if (names.empty()) return found;

  Vec3d middle = Vec3d::Zero(), normal = Vec3d::Zero();
  for (const Manifold<S>& manifold : manifolds) {
    normal += manifold.normal.template cast<double>();
    for (const ContactPoint<S>& point : manifold.points)
      middle += point.position.template cast<double>() / static_cast<double>(names.size());
  }
  normal = normal.norm() > 0 ? Vec3d(normal.normalized()) : Vec3d(Vec3d::UnitY());
  const Vec3d across = normal.unitOrthogonal();
  std::vector<Vec3d> directions = {
      normal, -normal, across, -across, normal.cross(across), -normal.cross(across)};
  std::mt19937_64 engine(flip.seed);
  while (static_cast<int>(directions.size()) < flip.directions)
    directions.push_back(random_direction(engine));
  directions.resize(static_cast<std::size_t>(std::max(flip.directions, 1)));

  const double size = std::min(size_of(a), size_of(b));
  const double limit = kReach * size;
  const Pose<double> exact = pose_b.template cast<double>();
  const double rounding =
      std::numeric_limits<S>::epsilon() * (size + exact.position.lpNorm<Eigen::Infinity>());

  double offset = limit, turn = kReach;
  for (const Vec3d& direction : directions) {
    const double moved = least_change(rounding, offset, [&](double change) {
      const Pose<double> pose{exact.rotation, exact.position + change * direction};
      return names_at(pose.template cast<S>()) != names;
    });
    if (moved < offset) {
      offset = moved;
      found.offset = moved;
      found.direction = direction;
    }
    const double turned = least_change(rounding / size, turn, [&](double change) {
      const Quatd by(Eigen::AngleAxisd(change, direction));
      const Pose<double> pose{(by * exact.rotation).normalized(),
                              middle + by * (exact.position - middle)};
      return names_at(pose.template cast<S>()) != names;
    });
    if (turned < turn) {
      turn = turned;
      found.turn = turned;
      found.axis = direction;
    }
  }

  const S largest = static_cast<S>(std::max(size, exact.position.lpNorm<Eigen::Infinity>()));
  const S unit = std::nextafter(largest, std::numeric_limits<S>::infinity()) - largest;
  double places = kMaxFlipPlaces;
  for (int axis = 0; axis < 3; ++axis)
    for (const S sign : {S(1), S(-1)})
      places = std::floor(least_change(1, places, [&](double change) {
        Pose<S> pose = pose_b;
        pose.position[axis] += sign * unit * static_cast<S>(std::floor(change));
        return names_at(pose) != names;
      }));
  if (places < kMaxFlipPlaces) found.last_places = static_cast<int>(places);
  return found;
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(flip_distance);

}  // namespace contactscope
