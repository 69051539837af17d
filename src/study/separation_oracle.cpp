#include "study/separation_oracle.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace contactscope {
namespace {

using Real = long double;
using Vec = Vec3<Real>;

constexpr Real kInfinity = std::numeric_limits<Real>::infinity();
// Edges nearer to parallel have no cross product in 64 bits of mantissa.
constexpr Real kParallel = 1e-17L;

Vec normalized(const Vec& v) {
  return v / v.norm();
}

/// By the fan of triangles about the first vertex.
Vec face_normal(const std::vector<Vec>& face) {
  Vec sum = Vec::Zero();
  for (std::size_t i = 1; i + 1 < face.size(); ++i) {
    const Vec first = face[i] - face[0];
    const Vec second = face[i + 1] - face[0];
    sum += first.cross(second);
  }
  return normalized(sum);
}

Real clamped(Real value) {
  return std::clamp(value, Real(0), Real(1));
}

Real point_to_segment(const Vec& point, const std::pair<Vec, Vec>& segment) {
  const Vec along = segment.second - segment.first;
  const Real squared = along.squaredNorm();
  const Real t = squared > 0 ? clamped(along.dot(Vec(point - segment.first)) / squared) : Real(0);
  const Vec nearest = segment.first + t * along;
  return (point - nearest).norm();
}

/// The closest points lie inside of both segments, or one of them is an end. Of nearly parallel ones
/// the first point is uncertain, but then the distance hardly depends on it.
Real segment_to_segment(const std::pair<Vec, Vec>& one, const std::pair<Vec, Vec>& other) {
  const Real best =
      std::min({point_to_segment(one.first, other), point_to_segment(one.second, other),
                point_to_segment(other.first, one), point_to_segment(other.second, one)});
  const Vec along = one.second - one.first;
  const Vec across = other.second - other.first;
  const Vec normal = along.cross(across);
  const Real squared = normal.squaredNorm();
  if (!(squared > kParallel * kParallel * along.squaredNorm() * across.squaredNorm())) return best;
  const Vec between = other.first - one.first;
  const Real s = clamped(between.cross(across).dot(normal) / squared);
  return std::min(best, point_to_segment(Vec(one.first + s * along), other));
}

template <class S>
std::vector<std::vector<int>> loops_of(const Hull<S>& hull) {
  std::vector<std::vector<int>> loops;
  for (int face = 0; face < hull.face_count(); ++face) loops.push_back(face_vertices(hull, face));
  return loops;
}

}  // namespace

/// Edges are those of the loops, each once: a loop's edge runs from a lower to a higher index in
/// one of its two faces.
SeparationOracle::Core SeparationOracle::make_core(std::vector<Vec> vertices,
                                                   const std::vector<std::vector<int>>& loops) {
  Core core;
  for (const std::vector<int>& loop : loops) {
    std::vector<Vec>& face = core.faces.emplace_back();
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const int from = loop[i];
      const int to = loop[(i + 1) % loop.size()];
      face.push_back(vertices[static_cast<std::size_t>(from)]);
      if (from < to) {
        core.edges.emplace_back(vertices[static_cast<std::size_t>(from)],
                                vertices[static_cast<std::size_t>(to)]);
      }
    }
    core.normals.push_back(face_normal(face));
  }
  core.vertices = std::move(vertices);
  return core;
}

template <class S>
SeparationOracle::Body SeparationOracle::make_body(const Shape<S>& shape, const Mat3<Real>& turn,
                                                   const Vec& position) {
  Body body;
  const auto placed = [&](const Vec3<S>& point) {
    const Vec exact = point.template cast<Real>();
    body.reach = std::max(body.reach, exact.norm());
    return Vec(turn * exact + position);
  };
  if (const auto* sphere = std::get_if<Sphere<S>>(&shape)) {
    const Vec center = placed(Vec3<S>::Zero());
    body.cores = {{{center}, {{center, center}}, {}, {}, sphere->radius}};
    body.reach += body.cores[0].radius;
  } else if (const auto* capsule = std::get_if<Capsule<S>>(&shape)) {
    const Vec from = placed(capsule->points[0]);
    const Vec to = placed(capsule->points[1]);
    body.cores = {{{from, to}, {{from, to}}, {}, {}, capsule->radius}};
    body.reach += body.cores[0].radius;
  } else if (const auto* hull = std::get_if<Hull<S>>(&shape)) {
    std::vector<Vec> vertices;
    for (const Vec3<S>& vertex : hull->vertices) vertices.push_back(placed(vertex));
    body.cores = {make_core(std::move(vertices), loops_of(*hull))};
  } else if (const auto* mesh = std::get_if<Mesh<S>>(&shape)) {
    for (int t = 0; t < mesh->triangle_count(); ++t) {
      body.cores.push_back(make_core(
          {placed(mesh->corner(t, 0)), placed(mesh->corner(t, 1)), placed(mesh->corner(t, 2))},
          {{0, 1, 2}, {2, 1, 0}}));
    }
  } else {
    const Plane<S>& plane = std::get_if<HalfSpace<S>>(&shape)->plane;
    const Vec own = plane.normal.template cast<Real>();
    body.is_plane = true;
    body.normal = turn * (own / own.norm());
    body.offset = plane.offset / own.norm() + body.normal.dot(position);
    body.reach = std::abs(static_cast<Real>(plane.offset));
  }
  return body;
}

template <class S>
SeparationOracle::SeparationOracle(const Shape<S>& a, const Pose<S>& pose_a, const Shape<S>& b,
                                   const Pose<S>& pose_b) {
  const auto turn_of = [](const Pose<S>& pose) {
    Quat<Real> rotation = pose.rotation.template cast<Real>();
    rotation.coeffs() /= rotation.coeffs().norm();
    return Mat3<Real>(rotation.toRotationMatrix());
  };
  // As seen from A: the world's origin may be far away.
  const Vec between = pose_b.position.template cast<Real>() - pose_a.position.template cast<Real>();
  a_ = make_body(a, turn_of(pose_a), Vec(Vec::Zero()));
  b_ = make_body(b, turn_of(pose_b), between);
  scale_ = a_.reach + b_.reach + between.norm();
}

void SeparationOracle::try_axis(const Vec& axis, const Core& a, const Core& b, Real& best) {
  best = std::max({best, along(axis, a, b), along(Vec(-axis), a, b)});
}

/// Of the cores; their radii are left out.
SeparationOracle::Real SeparationOracle::along(const Vec& normal, const Core& a, const Core& b) {
  Real highest = -kInfinity;
  Real lowest = kInfinity;
  for (const Vec& vertex : a.vertices) highest = std::max(highest, normal.dot(vertex));
  for (const Vec& vertex : b.vertices) lowest = std::min(lowest, normal.dot(vertex));
  return lowest - highest;
}

SeparationOracle::Real SeparationOracle::largest_separation(const Core& a, const Core& b) {
  Real best = -kInfinity;
  for (const Vec& normal : a.normals) try_axis(normal, a, b, best);
  for (const Vec& normal : b.normals) try_axis(normal, a, b, best);
  for (const auto& [from_a, to_a] : a.edges) {
    const Vec along_a = to_a - from_a;
    for (const auto& [from_b, to_b] : b.edges) {
      const Vec along_b = to_b - from_b;
      const Vec cross = along_a.cross(along_b);
      const Real length = cross.norm();
      if (!(length > kParallel * along_a.norm() * along_b.norm())) continue;
      // A short cross product is rounded all around; along the edges even a little of that counts.
      const Vec unit_a = normalized(along_a);
      const Vec rounded = cross / length;
      try_axis(normalized(rounded - rounded.dot(unit_a) * unit_a), a, b, best);
    }
  }
  return best;
}

/// Vertices of A straight over or under a face of B.
SeparationOracle::Real SeparationOracle::vertices_to_faces(const Core& a, const Core& b) {
  Real best = kInfinity;
  for (std::size_t f = 0; f < b.faces.size(); ++f) {
    const std::vector<Vec>& face = b.faces[f];
    for (const Vec& vertex : a.vertices) {
      bool inside = true;
      for (std::size_t i = 0; i < face.size() && inside; ++i) {
        const Vec edge = face[(i + 1) % face.size()] - face[i];
        const Vec to_vertex = vertex - face[i];
        inside = b.normals[f].dot(Vec(edge.cross(to_vertex))) >= 0;
      }
      if (inside) best = std::min(best, std::abs(b.normals[f].dot(Vec(vertex - face[0]))));
    }
  }
  return best;
}

SeparationOracle::Real SeparationOracle::distance(const Core& a, const Core& b) {
  Real best = std::min(vertices_to_faces(a, b), vertices_to_faces(b, a));
  for (const auto& edge_a : a.edges) {
    for (const auto& edge_b : b.edges) best = std::min(best, segment_to_segment(edge_a, edge_b));
  }
  return best;
}

SeparationOracle::Real SeparationOracle::separation_of(const Core& a, const Core& b) {
  // Two points or segments have no inside: their distance says all.
  const bool solid = !a.faces.empty() || !b.faces.empty();
  const Real overlap = solid ? largest_separation(a, b) : Real(1);
  // Of a triangle and what lies in its plane no axis says how far they are apart.
  return (overlap >= 0 ? distance(a, b) : overlap) - a.radius - b.radius;
}

double SeparationOracle::separation() const {
  Real least = kInfinity;
  if (a_.is_plane || b_.is_plane) {
    const Body& plane = a_.is_plane ? a_ : b_;
    const Core& core = (a_.is_plane ? b_ : a_).cores.front();
    for (const Vec& vertex : core.vertices) {
      least = std::min(least, plane.normal.dot(vertex) - plane.offset - core.radius);
    }
  } else {
    for (const Core& a : a_.cores) {
      for (const Core& b : b_.cores) least = std::min(least, separation_of(a, b));
    }
  }
  return static_cast<double>(least);
}

double SeparationOracle::leverage() const {
  if (a_.is_plane || b_.is_plane || a_.cores.size() > 1 || b_.cores.size() > 1) return 1;
  const Real radii = a_.cores.front().radius + b_.cores.front().radius;
  if (!(radii > 0)) return 1;
  const Real apart = static_cast<Real>(separation()) + radii;
  const bool solid = !a_.cores.front().faces.empty() || !b_.cores.front().faces.empty();
  if (solid && !(apart > 0)) return 1;
  return static_cast<double>(apart > 0 ? std::max(Real(1), scale_ / apart) : kInfinity);
}

double SeparationOracle::separation_along(const Vec3d& normal, int triangle) const {
  const Vec direction = normal.cast<Real>() / normal.cast<Real>().norm();
  if (a_.is_plane || b_.is_plane) {
    const Vec expected = a_.is_plane ? a_.normal : Vec(-b_.normal);
    return separation() - static_cast<double>((direction - expected).norm() * scale_);
  }
  const auto core_of = [&](const Body& body) -> const Core& {
    return body.cores.size() == 1 ? body.cores.front()
                                  : body.cores.at(static_cast<std::size_t>(std::max(0, triangle)));
  };
  const Core& a = core_of(a_);
  const Core& b = core_of(b_);
  return static_cast<double>(along(direction, a, b) - a.radius - b.radius);
}

template SeparationOracle::SeparationOracle(const Shape<float>&, const Pose<float>&,
                                            const Shape<float>&, const Pose<float>&);
template SeparationOracle::SeparationOracle(const Shape<double>&, const Pose<double>&,
                                            const Shape<double>&, const Pose<double>&);

}  // namespace contactscope
