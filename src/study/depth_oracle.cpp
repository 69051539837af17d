#include "study/depth_oracle.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace contactscope {
namespace {

using Real = long double;
using Vec = Vec3<Real>;

struct Edge {
  Vec from, along;       // along is unit
  Vec normal1, normal2;  // of the faces beside it
};

struct PosedHull {
  std::vector<Vec> vertices;
  std::vector<Vec> normals;
  std::vector<Vec> on_faces;
  std::vector<Edge> edges;
  Vec center = Vec::Zero();
};

/// By the fan of triangles about the first vertex.
Vec face_normal(const std::vector<Vec>& vertices, const std::vector<int>& loop) {
  const auto at = [&](std::size_t i) -> const Vec& {
    return vertices[static_cast<std::size_t>(loop[i])];
  };
  Vec sum = Vec::Zero();
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    const Vec first = at(i) - at(0);
    const Vec second = at(i + 1) - at(0);
    sum += first.cross(second);
  }
  return sum / sum.norm();
}

PosedHull make_body(const Hull<double>& hull, const Pose<double>& pose) {
  const Quat<Real> rotation = pose.rotation.cast<Real>().normalized();
  const Mat3<Real> turn = rotation.toRotationMatrix();
  PosedHull body;
  for (const Vec3d& vertex : hull.vertices) {
    const Vec placed = turn * vertex.cast<Real>() + pose.position.cast<Real>();
    body.vertices.push_back(placed);
    body.center += placed;
  }
  body.center /= static_cast<Real>(hull.vertex_count());
  for (int face = 0; face < hull.face_count(); ++face) {
    const std::vector<int> loop = face_vertices(hull, face);
    body.normals.push_back(face_normal(body.vertices, loop));
    body.on_faces.push_back(body.vertices[static_cast<std::size_t>(loop.front())]);
  }
  for (std::size_t h = 0; h < hull.half_edges.size(); h += 2) {
    const HalfEdge& one = hull.half_edges[h];
    const HalfEdge& other = hull.half_edges[h + 1];
    const Vec& from = body.vertices[static_cast<std::size_t>(one.origin)];
    const Vec along = body.vertices[static_cast<std::size_t>(other.origin)] - from;
    body.edges.push_back({from, along / along.norm(),
                          body.normals[static_cast<std::size_t>(one.face)],
                          body.normals[static_cast<std::size_t>(other.face)]});
  }
  return body;
}

struct Axis {
  Real separation = -std::numeric_limits<Real>::infinity();
  Vec normal = Vec::UnitX();

  void offer(Real other_separation, const Vec& other_normal) {
    if (!(other_separation > separation)) return;
    separation = other_separation;
    normal = other_normal;
  }
};

Axis best_face(const PosedHull& body, const PosedHull& other) {
  Axis best;
  for (std::size_t f = 0; f < body.normals.size(); ++f) {
    Real least = std::numeric_limits<Real>::infinity();
    for (const Vec& vertex : other.vertices) {
      least = std::min(least, body.normals[f].dot(Vec(vertex - body.on_faces[f])));
    }
    best.offer(least, body.normals[f]);
  }
  return best;
}

bool is_minkowski_face(const Edge& a, const Edge& b) {
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
  const PosedHull body_a = make_body(a, {});
  const PosedHull body_b = make_body(b, b_in_a);
  Axis best = best_face(body_a, body_b);
  const Axis of_b = best_face(body_b, body_a);
  best.offer(of_b.separation, Vec(-of_b.normal));
  for (const Edge& edge_a : body_a.edges) {
    for (const Edge& edge_b : body_b.edges) {
      if (!is_minkowski_face(edge_a, edge_b)) continue;
      const Vec cross = edge_a.along.cross(edge_b.along);
      const Real sine = cross.norm();
      if (!(sine > 0)) continue;
      Vec normal = cross / sine;
      if (normal.dot(Vec(edge_a.from - body_a.center)) < 0) normal = -normal;
      best.offer(normal.dot(Vec(edge_b.from - edge_a.from)), normal);
    }
  }
  return {static_cast<double>(best.separation), best.normal.cast<double>()};
}

double oracle_separation(const Hull<double>& a, const Hull<double>& b, const Pose<double>& b_in_a) {
  return oracle_axis(a, b, b_in_a).separation;
}

double separation_along(const Hull<double>& a, const Hull<double>& b, const Pose<double>& b_in_a,
                        const Vec3d& normal) {
  const Mat3<Real> turn = b_in_a.rotation.cast<Real>().normalized().toRotationMatrix();
  const Vec along = normal.cast<Real>().normalized();
  Real most_of_a = -std::numeric_limits<Real>::infinity();
  Real least_of_b = std::numeric_limits<Real>::infinity();
  for (const Vec3d& vertex : a.vertices)
    most_of_a = std::max(most_of_a, along.dot(vertex.cast<Real>()));
  for (const Vec3d& vertex : b.vertices) {
    const Vec placed = turn * vertex.cast<Real>() + b_in_a.position.cast<Real>();
    least_of_b = std::min(least_of_b, along.dot(placed));
  }
  return static_cast<double>(least_of_b - most_of_a);
}

}  // namespace contactscope
