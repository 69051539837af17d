#include "geometry/primitives.h"
#include "manifold/dispatch.h"
#include "study/limits_study.h"
#include "study/random_cases.h"

namespace contactscope {
namespace {

constexpr double kSphereRadius = 0.5;
constexpr double kCapsuleRadius = 0.3;
constexpr double kCapsuleHalfLength = 0.5;
constexpr double kHalfCube = 0.5;
constexpr double kHalfMesh = 4;
constexpr double kMinCrossing = 0.3;  // radians, between the axes of capsules
constexpr double kShift = 0.2;        // of the size: the upper shape stays over the lower

Quatd turn(const Vec3d& axis, double radians) { return Quatd(Eigen::AngleAxisd(radians, axis)); }

Shape<double> shape_of(Stacked kind, double size, double aspect) {
  if (kind == Stacked::Sphere) return Sphere<double>{kSphereRadius * size};
  if (kind == Stacked::Capsule) {
    const double half = kCapsuleHalfLength * size * aspect;
    return Capsule<double>{{Vec3d(-half, 0, 0), Vec3d(half, 0, 0)}, kCapsuleRadius * size};
  }
  if (kind == Stacked::Box)
    return make_box(Vec3d(kHalfCube * size * aspect, kHalfCube * size, kHalfCube * size));
  if (kind == Stacked::Plane) return HalfSpace<double>{{Vec3d::UnitY(), 0}};
  const double x = kHalfMesh * size * aspect, z = kHalfMesh * size;
  // Off centre, so that the upper shape touches one of the two.
  return build_mesh({{-0.5 * x, 0, -1.5 * z},
                     {1.5 * x, 0, -1.5 * z},
                     {1.5 * x, 0, 0.5 * z},
                     {-0.5 * x, 0, 0.5 * z}},
                    {{0, 2, 1}, {0, 3, 2}});
}

/// Lowest point of an upper shape, from its centre.
Vec3d lowest_point(const Shape<double>& shape, const Quatd& rotation) {
  if (const auto* sphere = std::get_if<Sphere<double>>(&shape)) return {0, -sphere->radius, 0};
  if (const auto* round = std::get_if<Capsule<double>>(&shape)) {
    const Vec3d end = rotation * round->points[1];
    return (end.y() > 0 ? Vec3d(-end) : end) - Vec3d(0, round->radius, 0);
  }
  Vec3d lowest = Vec3d::Zero();
  for (const Vec3d& vertex : std::get<Hull<double>>(shape).vertices) {
    const Vec3d turned = rotation * vertex;
    if (turned.y() < lowest.y()) lowest = turned;
  }
  return lowest;
}

Quatd rotation_on_top(const PairKind& kind, const Stacking& stacking, bool on_a_corner,
                      std::mt19937_64& engine) {
  const double yaw = uniform(engine, 0, 2 * std::numbers::pi);
  const Quatd any = uniform_rotation(engine);
  if (stacking.angle != 0) {
    const double edge_down = kind.top == Stacked::Box ? std::numbers::pi / 4 : 0;
    return turn(Vec3d::UnitY(), stacking.angle) * turn(Vec3d::UnitX(), edge_down);
  }
  if (stacking.tilt != 0) return turn(Vec3d::UnitZ(), stacking.tilt);
  // A downward end would miss the lower axis. Nearly parallel axes have their own study.
  if (kind.below == Stacked::Capsule)
    return turn(Vec3d::UnitY(), kMinCrossing + yaw / 2 * (1 - 2 * kMinCrossing / std::numbers::pi));
  return on_a_corner ? any : turn(Vec3d::UnitY(), yaw);
}

// From query/tolerance.h, preference_tolerance: shares of the depth and the smaller hull's radius.
constexpr double kPreferredDepth = 0.05;
constexpr double kPreferredRadius = 0.002;

/// The deepest point of a contact, with its manifold's normal.
struct Deepest {
  double separation = std::numeric_limits<double>::infinity();
  Vec3d normal = Vec3d::Zero();
  int triangle = -1;
  bool finite = true;

  bool found() const { return separation < std::numeric_limits<double>::infinity(); }
};

template <class S> Deepest deepest_of(const Manifolds<S>& manifolds) {
  Deepest deepest;
  for (const Manifold<S>& manifold : manifolds) {
    deepest.finite = deepest.finite && manifold.normal.allFinite();
    for (const ContactPoint<S>& point : manifold.points) {
      deepest.finite =
          deepest.finite && point.position.allFinite() && std::isfinite(point.separation);
      if (static_cast<double>(point.separation) >= deepest.separation) continue;
      deepest.separation = static_cast<double>(point.separation);
      deepest.normal = manifold.normal.template cast<double>();
      deepest.triangle = manifold.triangle;
    }
  }
  return deepest;
}

template <class S> Deepest collided(const RoundedPair<S>& pair, Preference preference) {
  CollideOptions options;
  options.preference = preference;
  options.mesh_manifolds =
      MeshManifolds::Triangle;  // the oracle measures along one triangle's axes
  Manifolds<S> manifolds;
  collide(pair.a, pair.pose_a, pair.b, pair.pose_b, options, manifolds);
  return deepest_of(manifolds);
}

ContactFault presence_fault(const Deepest& deepest, double separation, double rounding) {
  if (!deepest.finite) return ContactFault::NotFinite;
  if (!deepest.found() && separation < -rounding) return ContactFault::Missing;
  if (deepest.found() && separation > rounding) return ContactFault::Phantom;
  return ContactFault::None;
}

}  // namespace

std::string to_string(const PairKind& kind) {
  constexpr const char* kNames[] = {"sphere", "capsule", "box", "plane", "mesh"};
  return std::string(kNames[static_cast<int>(kind.top)]) + " on " +
         kNames[static_cast<int>(kind.below)];
}

StackedPair stacked_pair(const PairKind& kind, const Stacking& stacking, int index,
                         std::mt19937_64& engine) {
  const bool crossed = stacking.angle != 0;
  const bool on_a_corner =
      !crossed && stacking.tilt == 0 && kind.below != Stacked::Capsule && index % 2 == 1;
  const bool flat_below = kind.below == Stacked::Plane || kind.below == Stacked::Mesh;
  StackedPair pair;
  pair.size = stacking.size;
  pair.below = shape_of(kind.below, stacking.size, stacking.aspect);
  pair.on_top = shape_of(kind.top, stacking.size, 1);
  if (crossed && kind.below == Stacked::Box)
    pair.pose_below.rotation = turn(Vec3d::UnitX(), std::numbers::pi / 4);
  pair.pose_on_top.rotation = rotation_on_top(kind, stacking, on_a_corner, engine);

  const Vec3d lowest = lowest_point(pair.on_top, pair.pose_on_top.rotation);
  const double height_below =
      flat_below ? 0 : -lowest_point(pair.below, pair.pose_below.rotation).y();
  pair.pose_below.position.y() = -height_below;
  const double sunk = stacking.overlap * (height_below - lowest.y());
  const double least_shift = 1 - stacking.overlap;
  const double along = uniform(engine, -1, 1) * kShift * stacking.size * least_shift;
  const double aside = uniform(engine, -1, 1) * kShift * stacking.size * least_shift;
  // Contact may be anywhere along a long shape.
  const double far = stacking.aspect > 1
                         ? uniform(engine, -0.9, 0.9) * 0.5 * stacking.size * (stacking.aspect - 1)
                         : 0;
  Vec3d shift(along + far, 0, aside);
  // The corner should meet the centre of the lower shape.
  if (on_a_corner) shift -= least_shift * Vec3d(lowest.x(), 0, lowest.z());
  if (kind.below == Stacked::Sphere) shift.setZero();
  if (kind.below == Stacked::Capsule && kind.top == Stacked::Sphere) shift.z() = 0;
  if (crossed) {
    // Move along both edges, so that they still cross.
    shift = Vec3d(along + far, 0, 0);
    shift += pair.pose_on_top.rotation * Vec3d(aside, 0, 0);
  }
  pair.pose_on_top.position = shift + Vec3d(0, -lowest.y() - sunk, 0);
  pair.separation =
      SeparationOracle(pair.below, pair.pose_below, pair.on_top, pair.pose_on_top).separation();
  pair.motion.rotation = uniform_rotation(engine);
  pair.motion.position = uniform_rotation(engine) * Vec3d(stacking.distance * stacking.size, 0, 0);
  return pair;
}

template <class S>
RoundedPair<S>::RoundedPair(const StackedPair& pair)
    : a(shape_cast<S>(pair.below)), b(shape_cast<S>(pair.on_top)) {
  const auto moved = [&](const Pose<double>& pose) {
    Pose<double> there = compose(pair.motion, pose);
    there.rotation.normalize();
    return there.template cast<S>();
  };
  pose_a = moved(pair.pose_below);
  pose_b = moved(pair.pose_on_top);
}

template <class S> double RoundedPair<S>::collide_once() const {
  return collided(*this, Preference::Relative).separation;
}

template <class S> PairVerdict judge_pair(const StackedPair& pair) {
  const RoundedPair<S> rounded(pair);
  const SeparationOracle oracle(rounded.a, rounded.pose_a, rounded.b, rounded.pose_b);
  const double separation = oracle.separation();
  const double ulp = std::numeric_limits<S>::epsilon() * oracle.scale();
  const double rounding = kPrecisionBound * ulp;

  PairVerdict verdict;
  verdict.depth = std::max(0.0, -pair.separation);
  verdict.scale = oracle.scale();
  const Deepest strict = collided(rounded, Preference::None);
  verdict.fault = presence_fault(strict, separation, rounding);
  if (verdict.fault == ContactFault::None) {
    verdict.error = std::max(0.0, -separation);
    if (strict.found()) {
      const double along = oracle.separation_along(strict.normal, strict.triangle);
      verdict.error = std::max(std::abs(strict.separation - separation),
                               std::abs(separation - along) / oracle.leverage());
    }
    if (!(verdict.error <= rounding)) verdict.fault = ContactFault::Imprecise;
  }
  if (verdict.fault == ContactFault::None) {
    const Deepest preferred = collided(rounded, Preference::Relative);
    verdict.fault = presence_fault(preferred, separation, rounding);
    const double granted =
        rounding + std::max(kPreferredDepth * -separation, kPreferredRadius * pair.size);
    if (verdict.fault == ContactFault::None && preferred.found() &&
        !(std::abs(preferred.separation - separation) <= granted)) {
      verdict.fault = ContactFault::Drifting;
    }
  }
  verdict.overlap = std::max(0.0, -separation);
  if (verdict.fault == ContactFault::None && separation < 0) {
    // Test the depth itself too: for shapes of kilometres 64 roundings may exceed it.
    const double off = strict.found() ? std::abs(strict.separation - separation) : -separation;
    if (!(off < 0.5 * -separation)) verdict.fault = ContactFault::Drowned;
  }
  verdict.ulps = verdict.error / ulp;

  verdict.unrounded_error =
      strict.found() ? std::abs(strict.separation - pair.separation) : verdict.depth;
  verdict.unrounded_ulps = verdict.unrounded_error / ulp;
  const double bearable = verdict.depth > 0 ? 0.5 * verdict.depth : rounding;
  verdict.lost = !strict.finite || (verdict.depth > 0 && !strict.found()) ||
                 !(verdict.unrounded_error <= bearable);
  return verdict;
}

template struct RoundedPair<float>;
template struct RoundedPair<double>;
CONTACTSCOPE_FLOAT_AND_DOUBLE(judge_pair);

}  // namespace contactscope
