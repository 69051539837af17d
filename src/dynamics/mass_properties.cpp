#include <Eigen/Eigenvalues>

#include "dynamics/body.h"
#include "field/distance_field.h"

// Sphere and capsule by the textbook formulas. A hull is cut into tetrahedra from one of its
// vertices (Tonon 2004, "Explicit exact formulas for the 3-D tetrahedron inertia tensor"), here by
// second moments: with corners 0, a, b, c and d = det(a, b, c),
//
//     volume = d / 6,  integral of x = d / 24 (a + b + c),
//     integral of x x^T = d / 120 (a a^T + b b^T + c c^T + (a + b + c)(a + b + c)^T).
//
// Steps: 1. volume and centre, 2. second moments about it, 3. inertia = trace(moments) - moments.

namespace contactscope {
namespace {

Mat3<double> outer(const Vec3d& v) { return v * v.transpose(); }

/// Calls `visit` with the corners of every triangle of the surface, counter-clockwise from outside.
template <class S, class Visit>
void for_each_surface_triangle(const Hull<S>& hull, const Visit& visit) {
  const auto corner = [&](int half_edge) {
    return Vec3d(hull.origin(half_edge).template cast<double>());
  };
  const auto after = [&](int half_edge) { return at(hull.half_edges, half_edge).next; };
  for (const int first : hull.face_edges)
    for (int edge = after(first); after(edge) != first; edge = after(edge))
      visit(corner(first), corner(edge), corner(after(edge)));
}

template <class S, class Visit>
void for_each_surface_triangle(const Mesh<S>& mesh, const Visit& visit) {
  const auto corner = [&](int triangle, int k) {
    return Vec3d(mesh.corner(triangle, k).template cast<double>());
  };
  for (int t = 0; t < mesh.triangle_count(); ++t) visit(corner(t, 0), corner(t, 1), corner(t, 2));
}

/// For the volume inside a closed surface, whichever side is its front.
template <class Surface> MassProperties of_inside(const Surface& surface) {
  MassProperties result;
  const Vec3d apex = surface.vertices.front().template cast<double>();
  Vec3d first_moment = Vec3d::Zero();
  for_each_surface_triangle(surface, [&](const Vec3d& p, const Vec3d& q, const Vec3d& r) {
    const Vec3d a = p - apex, b = q - apex, c = r - apex;
    const double det = a.dot(b.cross(c));
    result.mass += det / 6;
    first_moment += det / 24 * (a + b + c);
  });
  const Vec3d from_apex = first_moment / result.mass;
  result.center = apex + from_apex;

  Mat3<double> moments = Mat3<double>::Zero();
  for_each_surface_triangle(surface, [&](const Vec3d& p, const Vec3d& q, const Vec3d& r) {
    const Vec3d a = p - result.center, b = q - result.center, c = r - result.center;
    const double det = a.dot(b.cross(c));
    moments += det / 120 * (outer(a) + outer(b) + outer(c) + outer(Vec3d(a + b + c)));
  });
  if (result.mass < 0) {
    result.mass = -result.mass;
    moments = -moments;
  }
  result.inertia = moments.trace() * Mat3<double>::Identity() - moments;
  return result;
}

template <class S> std::optional<MassProperties> of_unit_density(const Hull<S>& hull) {
  if (hull.flat()) return std::nullopt;
  return of_inside(hull);
}

template <class S> std::optional<MassProperties> of_unit_density(const Sphere<S>& sphere) {
  const double r = sphere.radius;
  MassProperties result;
  result.mass = 4.0 / 3.0 * std::numbers::pi * r * r * r;
  result.inertia = 0.4 * result.mass * r * r * Mat3<double>::Identity();
  return result;
}

/// A cylinder and two half balls, whose centroids are 3/8 r beyond the ends of the axis.
template <class S> std::optional<MassProperties> of_unit_density(const Capsule<S>& capsule) {
  const double r = capsule.radius;
  const Vec3d end_a = capsule.points[0].template cast<double>();
  const Vec3d end_b = capsule.points[1].template cast<double>();
  const Vec3d axis = end_b - end_a;
  const double length = axis.norm();
  const double ball = 4.0 / 3.0 * std::numbers::pi * r * r * r;
  const double cylinder = std::numbers::pi * r * r * length;
  MassProperties result;
  result.mass = ball + cylinder;
  result.center = 0.5 * (end_a + end_b);
  const double along = (0.4 * ball + 0.5 * cylinder) * r * r;
  // Both half balls together have the ball's moment about its centre; each is moved out by half the
  // length, by the parallel axis theorem about its own centre of mass.
  const double across = cylinder * (r * r / 4 + length * length / 12) +
                        ball * (0.4 * r * r + length * length / 4 + 0.375 * r * length);
  const Vec3d unit = length > 0 ? Vec3d(axis / length) : Vec3d(Vec3d::UnitY());
  result.inertia = across * Mat3<double>::Identity() + (along - across) * outer(unit);
  return result;
}

/// Uses the source shape, or for a mesh the surface with its holes closed.
template <class S> std::optional<MassProperties> of_unit_density(const Field<S>& field) {
  if (!std::holds_alternative<Mesh<S>>(field.source->shape))
    return mass_properties(field.source->shape);
  // Converts length, volume and moment from cells to metres.
  MassProperties result = of_inside(*field.values->surface());
  const double volume = field.cell * field.cell * field.cell;
  result.mass *= volume;
  result.center = field.origin + field.cell * result.center;
  result.inertia *= volume * field.cell * field.cell;
  return result;
}

/// Planes and meshes.
template <class Massless> std::optional<MassProperties> of_unit_density(const Massless&) {
  return std::nullopt;
}

}  // namespace

template <class S> std::optional<MassProperties> mass_properties(const Shape<S>& shape) {
  return std::visit([](const auto& kind) { return of_unit_density(kind); }, shape);
}

MassProperties with_mass(const MassProperties& properties, double mass) {
  MassProperties scaled = properties;
  scaled.mass = mass;
  scaled.inertia *= mass / properties.mass;
  return scaled;
}

double shortest_edge(double mass, const Mat3<double>& inertia) {
  // A box with the edges p <= q <= r has m/12 (q^2 + r^2), m/12 (p^2 + r^2) and m/12 (p^2 + q^2).
  const Eigen::SelfAdjointEigenSolver<Mat3<double>> solver(inertia, Eigen::EigenvaluesOnly);
  const Vec3d moments = solver.eigenvalues();  // ascending
  return std::sqrt(std::max(0.0, 6 / mass * (moments.x() + moments.y() - moments.z())));
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(mass_properties);

}  // namespace contactscope
