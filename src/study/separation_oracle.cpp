#include "study/separation_oracle.h"

namespace contactscope {
namespace {

using Real = OracleBody::Real;
using Vec = OracleBody::Vec;
using Core = OracleBody::Core;

constexpr Real kInfinity = std::numeric_limits<Real>::infinity();
// Edges closer to parallel have no cross product in 64 bits of mantissa.
constexpr Real kParallel = 1e-17L;

Vec face_normal(const std::vector<Vec>& face) {
  Vec sum = Vec::Zero();
  for (std::size_t i = 1; i + 1 < face.size(); ++i)
    sum += Vec(face[i] - face[0]).cross(Vec(face[i + 1] - face[0]));
  return sum.normalized();
}

Real clamped(Real value) { return std::clamp(value, Real(0), Real(1)); }

Real point_to_segment(const Vec& point, const std::pair<Vec, Vec>& segment) {
  const Vec along = segment.second - segment.first;
  const Real squared = along.squaredNorm();
  const Real t = squared > 0 ? clamped(along.dot(Vec(point - segment.first)) / squared) : Real(0);
  const Vec nearest = segment.first + t * along;
  return (point - nearest).norm();
}

/// The closest points are inside both segments, or one of them is an end. For nearly parallel
/// segments the first case is inaccurate, but the distance hardly depends on it.
Real segment_to_segment(const std::pair<Vec, Vec>& one, const std::pair<Vec, Vec>& other) {
  const Real best =
      std::min({point_to_segment(one.first, other), point_to_segment(one.second, other),
                point_to_segment(other.first, one), point_to_segment(other.second, one)});
  const Vec along = one.second - one.first, across = other.second - other.first;
  const Vec normal = along.cross(across);
  const Real squared = normal.squaredNorm();
  if (!(squared > kParallel * kParallel * along.squaredNorm() * across.squaredNorm())) return best;
  const Vec between = other.first - one.first;
  const Real s = clamped(between.cross(across).dot(normal) / squared);
  return std::min(best, point_to_segment(Vec(one.first + s * along), other));
}

/// Edges of the loops, once: each runs from a lower to a higher index in one of its faces.
Core make_core(std::vector<Vec> vertices, const std::vector<std::vector<int>>& loops) {
  Core core;
  for (const std::vector<int>& loop : loops) {
    std::vector<Vec>& face = core.faces.emplace_back();
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const int from = loop[i];
      const int to = loop[(i + 1) % loop.size()];
      face.push_back(at(vertices, from));
      if (from < to) core.edges.emplace_back(at(vertices, from), at(vertices, to));
    }
    core.normals.push_back(face_normal(face));
  }
  core.vertices = std::move(vertices);
  return core;
}

template <class S> Mat3<Real> turn_of(const Pose<S>& pose) {
  return pose.rotation.template cast<Real>().normalized().toRotationMatrix();
}

template <class S>
OracleBody make_body(const Shape<S>& shape, const Mat3<Real>& turn, const Vec& position) {
  OracleBody body;
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
    const Vec from = placed(capsule->points[0]), to = placed(capsule->points[1]);
    body.cores = {{{from, to}, {{from, to}}, {}, {}, capsule->radius}};
    body.reach += body.cores[0].radius;
  } else if (const auto* hull = std::get_if<Hull<S>>(&shape)) {
    std::vector<Vec> vertices;
    for (const Vec3<S>& vertex : hull->vertices) vertices.push_back(placed(vertex));
    std::vector<std::vector<int>> loops;
    for (int f = 0; f < hull->face_count(); ++f) loops.push_back(face_vertices(*hull, f));
    body.cores = {make_core(std::move(vertices), loops)};
  } else if (const auto* mesh = std::get_if<Mesh<S>>(&shape)) {
    for (int t = 0; t < mesh->triangle_count(); ++t)
      body.cores.push_back(make_core(
          {placed(mesh->corner(t, 0)), placed(mesh->corner(t, 1)), placed(mesh->corner(t, 2))},
          {{0, 1, 2}, {2, 1, 0}}));
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

/// For the cores, without radii.
Real along(const Vec& normal, const Core& a, const Core& b) {
  Real highest = -kInfinity;
  Real lowest = kInfinity;
  for (const Vec& vertex : a.vertices) highest = std::max(highest, normal.dot(vertex));
  for (const Vec& vertex : b.vertices) lowest = std::min(lowest, normal.dot(vertex));
  return lowest - highest;
}

void try_axis(const Vec& axis, const Core& a, const Core& b, Real& best) {
  best = std::max({best, along(axis, a, b), along(Vec(-axis), a, b)});
}

Real largest_separation(const Core& a, const Core& b) {
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
      // A short cross product has large rounding errors; remove the component along the edges.
      const Vec unit_a = along_a.normalized();
      const Vec rounded = cross / length;
      try_axis((rounded - rounded.dot(unit_a) * unit_a).normalized(), a, b, best);
    }
  }
  return best;
}

/// Vertices of A directly above or below a face of B.
Real vertices_to_faces(const Core& a, const Core& b) {
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

Real distance(const Core& a, const Core& b) {
  Real best = std::min(vertices_to_faces(a, b), vertices_to_faces(b, a));
  for (const auto& edge_a : a.edges)
    for (const auto& edge_b : b.edges) best = std::min(best, segment_to_segment(edge_a, edge_b));
  return best;
}

Real separation_of(const Core& a, const Core& b) {
  // Two points or segments have no inside: their distance is enough.
  const bool solid = !a.faces.empty() || !b.faces.empty();
  const Real overlap = solid ? largest_separation(a, b) : Real(1);
  // No axis gives the distance of a triangle from a shape in its plane.
  return (overlap >= 0 ? distance(a, b) : overlap) - a.radius - b.radius;
}

/// Two faces that share an edge, and that edge.
struct HullEdge {
  Vec from, along;       // along is unit
  Vec normal1, normal2;  // of its two faces
};

std::vector<HullEdge> edges_of(const Hull<double>& hull, const Core& core) {
  std::vector<HullEdge> edges;
  for (std::size_t h = 0; h < hull.half_edges.size(); h += 2) {
    const HalfEdge& one = hull.half_edges[h];
    const HalfEdge& other = hull.half_edges[h + 1];
    const Vec& from = at(core.vertices, one.origin);
    const Vec along = (at(core.vertices, other.origin) - from).normalized();
    edges.push_back({from, along, at(core.normals, one.face), at(core.normals, other.face)});
  }
  return edges;
}

struct Axis {
  Real separation = -kInfinity;
  Vec normal = Vec::UnitX();

  void offer(Real other_separation, const Vec& other_normal) {
    if (!(other_separation > separation)) return;
    separation = other_separation;
    normal = other_normal;
  }
};

Axis best_face(const Core& core, const Core& other) {
  Axis best;
  for (std::size_t f = 0; f < core.normals.size(); ++f) {
    Real least = kInfinity;
    for (const Vec& vertex : other.vertices)
      least = std::min(least, core.normals[f].dot(Vec(vertex - core.faces[f].front())));
    best.offer(least, core.normals[f]);
  }
  return best;
}

bool is_minkowski_face(const HullEdge& a, const HullEdge& b) {
  const Vec c = -b.normal1;
  const Vec d = -b.normal2;
  const Vec b_x_a = a.normal2.cross(a.normal1);
  const Vec d_x_c = d.cross(c);
  const Real cba = c.dot(b_x_a);
  const Real dba = d.dot(b_x_a);
  const Real adc = a.normal1.dot(d_x_c);
  const Real bdc = a.normal2.dot(d_x_c);
  return cba * dba < 0 && adc * bdc < 0 && cba * bdc > 0;
}

}  // namespace

OracleAxis oracle_axis(const Hull<double>& a, const Hull<double>& b, const Pose<double>& b_in_a) {
  const Core core_a = make_body<double>(a, Mat3<Real>::Identity(), Vec::Zero()).cores.front();
  const Core core_b =
      make_body<double>(b, turn_of(b_in_a), b_in_a.position.cast<Real>()).cores.front();
  Axis best = best_face(core_a, core_b);
  const Axis of_b = best_face(core_b, core_a);
  best.offer(of_b.separation, Vec(-of_b.normal));
  Vec center = Vec::Zero();
  for (const Vec& vertex : core_a.vertices) center += vertex;
  center /= static_cast<Real>(core_a.vertices.size());
  const std::vector<HullEdge> edges_b = edges_of(b, core_b);
  for (const HullEdge& edge_a : edges_of(a, core_a)) {
    for (const HullEdge& edge_b : edges_b) {
      if (!is_minkowski_face(edge_a, edge_b)) continue;
      const Vec cross = edge_a.along.cross(edge_b.along);
      const Real sine = cross.norm();
      if (!(sine > 0)) continue;
      Vec normal = cross / sine;
      if (normal.dot(Vec(edge_a.from - center)) < 0) normal = -normal;
      best.offer(normal.dot(Vec(edge_b.from - edge_a.from)), normal);
    }
  }
  return {static_cast<double>(best.separation), best.normal.cast<double>()};
}

template <class S> double box_separation(const Obb<S>& a, const Obb<S>& b) {
  const auto core_of = [&](const Obb<S>& box) {
    const Vec center = box.center.template cast<Real>() - a.center.template cast<Real>();
    const Mat3<Real> axes = box.axes.template cast<Real>();
    const Vec half = box.half_extents.template cast<Real>();
    Core core;
    for (int i = 0; i < 8; ++i) {
      const Vec signs((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
      core.vertices.push_back(center + axes * signs.cwiseProduct(half));
    }
    for (int k = 0; k < 3; ++k) {
      core.edges.emplace_back(Vec::Zero(), axes.col(k));
      core.normals.push_back(axes.col(k).cross(axes.col((k + 1) % 3)).normalized());
    }
    return core;
  };
  return static_cast<double>(largest_separation(core_of(a), core_of(b)));
}

template <class S>
SeparationOracle::SeparationOracle(const Shape<S>& a, const Pose<S>& pose_a, const Shape<S>& b,
                                   const Pose<S>& pose_b) {
  // Relative to A, since the world's origin may be far. If A has faces, also in A's rotation:
  // rotated corners tilt a triangle a million times as long as high by more than double's rounding.
  const Vec between = pose_b.position.template cast<Real>() - pose_a.position.template cast<Real>();
  const bool has_faces = std::holds_alternative<Hull<S>>(a) || std::holds_alternative<Mesh<S>>(a);
  const Mat3<Real> turn = turn_of(pose_a), identity = Mat3<Real>::Identity();
  to_a_ = has_faces ? Mat3<Real>(turn.transpose()) : identity;
  a_ = make_body(a, has_faces ? identity : turn, Vec(Vec::Zero()));
  b_ = make_body(b, Mat3<Real>(to_a_ * turn_of(pose_b)), Vec(to_a_ * between));
  scale_ = a_.reach + b_.reach + between.norm();
}

double SeparationOracle::separation() const {
  Real least = kInfinity;
  if (a_.is_plane || b_.is_plane) {
    const OracleBody& plane = a_.is_plane ? a_ : b_;
    const Core& core = (a_.is_plane ? b_ : a_).cores.front();
    for (const Vec& vertex : core.vertices)
      least = std::min(least, plane.normal.dot(vertex) - plane.offset - core.radius);
  } else {
    for (const Core& a : a_.cores)
      for (const Core& b : b_.cores) least = std::min(least, separation_of(a, b));
  }
  return static_cast<double>(least);
}

double SeparationOracle::leverage() const {
  if (a_.is_plane || b_.is_plane || a_.cores.size() > 1 || b_.cores.size() > 1) return 1;
  const Real radii = a_.cores.front().radius + b_.cores.front().radius;
  if (!(radii > 0)) return 1;
  const Real gap = static_cast<Real>(separation()) + radii;
  const bool solid = !a_.cores.front().faces.empty() || !b_.cores.front().faces.empty();
  if (solid && !(gap > 0)) return 1;
  return static_cast<double>(gap > 0 ? std::max(Real(1), scale_ / gap) : kInfinity);
}

double SeparationOracle::separation_along(const Vec3d& normal, int triangle) const {
  const Vec direction = to_a_ * normal.cast<Real>() / normal.cast<Real>().norm();
  if (a_.is_plane || b_.is_plane) {
    const Vec expected = a_.is_plane ? a_.normal : Vec(-b_.normal);
    return separation() - static_cast<double>((direction - expected).norm() * scale_);
  }
  const auto core_of = [&](const OracleBody& body) -> const Core& {
    return at(body.cores, body.cores.size() == 1 ? 0 : std::max(0, triangle));
  };
  const Core& a = core_of(a_);
  const Core& b = core_of(b_);
  return static_cast<double>(along(direction, a, b) - a.radius - b.radius);
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(box_separation);
template SeparationOracle::SeparationOracle(const Shape<float>&, const Pose<float>&,
                                            const Shape<float>&, const Pose<float>&);
template SeparationOracle::SeparationOracle(const Shape<double>&, const Pose<double>&,
                                            const Shape<double>&, const Pose<double>&);

}  // namespace contactscope
