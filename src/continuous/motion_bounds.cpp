#include "continuous/motion_bounds.h"

#include "broadphase/broad_phase.h"

namespace contactscope {

template <class S> Pose<S> Sweep<S>::at(S time) const {
  const S angle = turn.norm();
  Pose<S> pose = start;
  if (angle > S(0))
    pose.rotation = turned(start.rotation, Vec3<S>(turn / angle), time * angle).normalized();
  pose.position = start.transform(pivot) + time * displacement - pose.rotate(pivot);
  return pose;
}

template struct Sweep<float>;
template struct Sweep<double>;

namespace {

template <class S> struct ReachAbout {
  Vec3<S> pivot;

  S operator()(const Sphere<S>& sphere) const { return pivot.norm() + sphere.radius; }
  S operator()(const Capsule<S>& capsule) const {
    return std::max((capsule.points[0] - pivot).norm(), (capsule.points[1] - pivot).norm()) +
           capsule.radius;
  }
  S operator()(const Hull<S>& hull) const {
    S reach = 0;
    for (const Vec3<S>& vertex : hull.vertices) reach = std::max(reach, (vertex - pivot).norm());
    return reach;
  }
  S operator()(const Mesh<S>& mesh) const {
    const Aabb<S> box = mesh.tree.bounds();
    const Vec3<S> farther =
        (box.lower - pivot).cwiseAbs().cwiseMax(Vec3<S>((box.upper - pivot).cwiseAbs()));
    return farther.norm();
  }
  S operator()(const Field<S>& field) const { return std::visit(*this, field.source->shape); }
  S operator()(const HalfSpace<S>&) const { return std::numeric_limits<S>::infinity(); }
};

/// Largest displacement of a point by the turn: the chord of its arc.
template <class S> S chord(const Shape<S>& shape, const Sweep<S>& sweep) {
  if (sweep.turn.isZero(S(0))) return 0;
  return std::min(sweep.turn.norm(), S(2)) * reach_about_pivot(shape, sweep.pivot);
}

}  // namespace

template <class S> S reach_about_pivot(const Shape<S>& shape, const Vec3<S>& pivot) {
  return std::visit(ReachAbout<S>{pivot}, shape);
}

template <class S>
Aabb<float> swept_world_box(const Shape<S>& shape, const Sweep<S>& sweep, double margin) {
  // Between two samples a turning point is off its chord by the height of the arc, the square of
  // the angle over eight radii. Three samples per radian keep that below 1/50 of the reach.
  constexpr double kLooksARadian = 3, kMaxLooks = 64;
  const double angle = static_cast<double>(sweep.turn.norm());
  const double looks = std::clamp(std::ceil(kLooksARadian * angle), 1.0, kMaxLooks);
  double off = 0;
  if (angle > 0)
    off = std::min(angle * angle / (looks * looks) / 8, 2.0) *
          static_cast<double>(reach_about_pivot(shape, sweep.pivot));
  Aabb<float> box;
  if (std::isinf(off)) {
    constexpr float kNoEnd = std::numeric_limits<float>::infinity();
    return {Vec3<float>::Constant(-kNoEnd), Vec3<float>::Constant(kNoEnd)};
  }
  for (int i = 0; i <= static_cast<int>(looks); ++i)
    box.include(world_box(shape, sweep.at(static_cast<S>(i / looks)), margin + off));
  return box;
}

template <class S>
S largest_approach(const Shape<S>& a, const Sweep<S>& sweep_a, const Shape<S>& b,
                   const Sweep<S>& sweep_b) {
  return (sweep_b.displacement - sweep_a.displacement).norm() + chord(a, sweep_a) +
         chord(b, sweep_b);
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(reach_about_pivot, swept_world_box, largest_approach);

}  // namespace contactscope
