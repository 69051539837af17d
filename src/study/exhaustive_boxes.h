#pragma once

#include "core/pose.h"

/// Lecture 3.4, "Box-Box Contacts": the contact of two boxes by trying all corners and all edges.
/// The study compares it with the separating axis test; nothing else uses it. Boxes are given by
/// half extents along their own axes, about their own origins, metres.
namespace contactscope {

struct ExhaustiveContact {
  double depth = 0;              // metres, > 0
  Vec3d normal = Vec3d::Zero();  // unit, from A to B, in A's frame
};

namespace exhaustive {

/// Slides 27 and 28: a corner inside of a box leaves it along the shallowest of the box's axes, by
/// the returned vector in the box's frame; nothing if it is outside.
inline std::optional<Vec3d> displacement_out(const Vec3d& corner, const Vec3d& half) {
  const Vec3d depths = half - corner.cwiseAbs();
  int axis = 0;
  const double least = depths.minCoeff(&axis);
  if (least < 0) return std::nullopt;
  return Vec3d(Vec3d::Unit(axis) * (corner[axis] < 0 ? -least : least));
}

inline Vec3d corner_of(const Vec3d& half, int index) {
  return {index & 1 ? half.x() : -half.x(), index & 2 ? half.y() : -half.y(),
          index & 4 ? half.z() : -half.z()};
}

struct Edge {
  Vec3d middle, half;  // from the middle to one end
};

/// The twelve edges of a box, in the parent of `pose`.
inline std::array<Edge, 12> edges_of(const Vec3d& half, const Pose<double>& pose) {
  std::array<Edge, 12> edges;
  for (int i = 0; i < 12; ++i) {
    const int axis = i / 4;
    Vec3d middle = corner_of(half, (i & 1) << ((axis + 1) % 3) | (i & 2) >> 1 << ((axis + 2) % 3));
    middle[axis] = 0;
    edges[static_cast<std::size_t>(i)] = {pose.transform(middle),
                                          pose.rotate(Vec3d::Unit(axis) * half[axis])};
  }
  return edges;
}

/// Slide 29: how far two edges have passed each other, where each is inside of the other box;
/// nothing if they are parallel, or have not passed. `outward`: from A's centre to its edge.
/// `is_inside(on_a, on_b)`: of the points where their lines are closest.
template <class IsInside>
std::optional<ExhaustiveContact> crossing(const Edge& a, const Edge& b, const Vec3d& outward,
                                          const IsInside& is_inside) {
  const Vec3d cross = a.half.cross(b.half), between = b.middle - a.middle;
  const double area = cross.norm();
  if (area <= 1e-9 * a.half.norm() * b.half.norm()) return std::nullopt;
  const Vec3d normal = (cross.dot(outward) < 0 ? -1 : 1) / area * cross;
  const double depth = -normal.dot(between);
  // Where the lines are closest, as shares of the half edges.
  const double on_a = between.cross(b.half).dot(cross) / (area * area);
  const double on_b = between.cross(a.half).dot(cross) / (area * area);
  const bool cross_each_other = std::abs(on_a) <= 1 && std::abs(on_b) <= 1;
  if (depth <= 0 || !cross_each_other ||
      !is_inside(Vec3d(a.middle + on_a * a.half), Vec3d(b.middle + on_b * b.half)))
    return std::nullopt;
  return ExhaustiveContact{depth, normal};
}

}  // namespace exhaustive

/// The deepest contact of the lecture's search; nothing if no corner is inside and no edges cross.
inline std::optional<ExhaustiveContact> exhaustive_contact(const Vec3d& a, const Vec3d& b,
                                                           const Pose<double>& b_in_a) {
  std::optional<ExhaustiveContact> deepest;
  const auto keep = [&](double depth, const Vec3d& normal) {
    if (!deepest || depth > deepest->depth) deepest = ExhaustiveContact{depth, normal};
  };
  for (int i = 0; i < 8; ++i) {
    const Vec3d of_b = b_in_a.transform(exhaustive::corner_of(b, i));
    if (const auto out = exhaustive::displacement_out(of_b, a))
      keep(out->norm(), out->stableNormalized());
    const Vec3d of_a = b_in_a.inverse_transform(exhaustive::corner_of(a, i));
    if (const auto out = exhaustive::displacement_out(of_a, b))
      keep(out->norm(), b_in_a.rotate(-out->stableNormalized()));
  }
  const auto is_inside = [&](const Vec3d& on_a, const Vec3d& on_b) {
    return (on_b.cwiseAbs() - a).maxCoeff() <= 0 &&
           (b_in_a.inverse_transform(on_a).cwiseAbs() - b).maxCoeff() <= 0;
  };
  const auto edges_a = exhaustive::edges_of(a, {}), edges_b = exhaustive::edges_of(b, b_in_a);
  for (const exhaustive::Edge& of_a : edges_a) {
    std::optional<ExhaustiveContact> shallowest;
    for (const exhaustive::Edge& of_b : edges_b) {
      const auto found = exhaustive::crossing(of_a, of_b, of_a.middle, is_inside);
      if (found && (!shallowest || found->depth < shallowest->depth)) shallowest = found;
    }
    if (shallowest) keep(shallowest->depth, shallowest->normal);
  }
  return deepest;
}

}  // namespace contactscope
