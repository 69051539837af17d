#include "support/brute_force_sat.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace contactscope::test {
namespace {

using Cloud = Eigen::Matrix<double, Eigen::Dynamic, 3>;

Cloud world_vertices(const Hull<double>& hull, const Pose<double>& pose) {
  const Mat3<double> rotation = pose.rotation.normalized().toRotationMatrix();
  Cloud result(hull.vertex_count(), 3);
  for (int i = 0; i < hull.vertex_count(); ++i) {
    const Vec3d moved = rotation * hull.vertices[static_cast<std::size_t>(i)] + pose.position;
    result.row(i) = moved.transpose();
  }
  return result;
}

Vec3d vertex(const Cloud& cloud, int i) { return cloud.row(i).transpose(); }

/// Each normal comes from the fan of triangles about the first vertex.
std::vector<Vec3d> face_normals(const Hull<double>& hull, const Cloud& cloud) {
  std::vector<Vec3d> result;
  for (int f = 0; f < hull.face_count(); ++f) {
    const std::vector<int> loop = face_vertices(hull, f);
    Vec3d sum = Vec3d::Zero();
    for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
      const Vec3d first = vertex(cloud, loop[k]) - vertex(cloud, loop[0]);
      const Vec3d second = vertex(cloud, loop[k + 1]) - vertex(cloud, loop[0]);
      sum += first.cross(second);
    }
    result.push_back(sum.normalized());
  }
  return result;
}

std::vector<Vec3d> edge_directions(const Hull<double>& hull, const Cloud& cloud) {
  std::vector<Vec3d> result;
  for (int e = 0; e < hull.edge_count(); ++e) {
    const int from = hull.half_edges[static_cast<std::size_t>(2 * e)].origin;
    const int to = hull.half_edges[static_cast<std::size_t>(2 * e + 1)].origin;
    result.push_back((vertex(cloud, to) - vertex(cloud, from)).normalized());
  }
  return result;
}

/// Tries both signs of an axis: B above A, and A above B.
void try_axis(const Vec3d& axis, const Cloud& a, const Cloud& b, Eigen::VectorXd& on_a,
              Eigen::VectorXd& on_b, BruteForceAxis& best) {
  on_a.noalias() = a * axis;
  on_b.noalias() = b * axis;
  const double above = on_b.minCoeff() - on_a.maxCoeff();
  const double below = on_a.minCoeff() - on_b.maxCoeff();
  if (above > best.separation) best = {above, axis};
  if (below > best.separation) best = {below, -axis};
}

}  // namespace

BruteForceAxis brute_force_sat(const Hull<double>& a, const Pose<double>& pose_a,
                               const Hull<double>& b, const Pose<double>& pose_b) {
  // Relative to A's position: the world's origin may be far away.
  const Pose<double> near_a{pose_a.rotation, Vec3d::Zero()};
  const Pose<double> near_b{pose_b.rotation, pose_b.position - pose_a.position};
  const Cloud cloud_a = world_vertices(a, near_a);
  const Cloud cloud_b = world_vertices(b, near_b);
  Eigen::VectorXd on_a(a.vertex_count());
  Eigen::VectorXd on_b(b.vertex_count());
  BruteForceAxis best{-std::numeric_limits<double>::infinity(), Vec3d::UnitX()};
  for (const Vec3d& axis : face_normals(a, cloud_a)) {
    try_axis(axis, cloud_a, cloud_b, on_a, on_b, best);
  }
  for (const Vec3d& axis : face_normals(b, cloud_b)) {
    try_axis(axis, cloud_a, cloud_b, on_a, on_b, best);
  }
  const std::vector<Vec3d> edges_b = edge_directions(b, cloud_b);
  for (const Vec3d& edge_a : edge_directions(a, cloud_a)) {
    for (const Vec3d& edge_b : edges_b) {
      const Vec3d axis = edge_a.cross(edge_b);
      const double sine = axis.norm();
      if (sine < 1e-12) continue;  // parallel: the cross product is all rounding
      try_axis(axis / sine, cloud_a, cloud_b, on_a, on_b, best);
    }
  }
  return best;
}

BruteForceAxis brute_force_sat(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b,
                               const Pose<double>& b_in_a) {
  const Mat3<double> rotation = b_in_a.rotation.toRotationMatrix();
  const auto cloud_of = [](const std::vector<Vec3d>& points, const Pose<double>& pose) {
    Cloud cloud(static_cast<Eigen::Index>(points.size()), 3);
    for (std::size_t i = 0; i < points.size(); ++i)
      cloud.row(static_cast<Eigen::Index>(i)) = pose.transform(points[i]).transpose();
    return cloud;
  };
  const Cloud cloud_a = cloud_of(a, {}), cloud_b = cloud_of(b, b_in_a);
  Eigen::VectorXd on_a(cloud_a.rows()), on_b(cloud_b.rows());
  BruteForceAxis best{-std::numeric_limits<double>::infinity(), Vec3d::UnitX()};
  const auto try_cross = [&](const Vec3d& one, const Vec3d& other) {
    const Vec3d cross = one.cross(other);
    const double length = cross.norm();
    if (length > 1e-13 * one.norm() * other.norm())
      try_axis(cross / length, cloud_a, cloud_b, on_a, on_b, best);
  };
  const auto differences = [](const std::vector<Vec3d>& points, const Mat3<double>& turn) {
    std::vector<Vec3d> result;
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t j = i + 1; j < points.size(); ++j)
        result.push_back(turn * Vec3d(points[j] - points[i]));
    return result;
  };
  const auto try_triples = [&](const std::vector<Vec3d>& points, const Mat3<double>& turn) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t j = i + 1; j < points.size(); ++j) {
        for (std::size_t k = j + 1; k < points.size(); ++k) {
          const Vec3d x = turn * Vec3d(points[j] - points[i]);
          const Vec3d y = turn * Vec3d(points[k] - points[j]);
          const Vec3d z = turn * Vec3d(points[i] - points[k]);
          // The two shorter sides: rounding loses a short side derived from longer ones.
          const double longest = std::max({x.norm(), y.norm(), z.norm()});
          if (x.norm() == longest)
            try_cross(y, z);
          else
            try_cross(x, y.norm() == longest ? z : y);
        }
      }
    }
  };
  try_triples(a, Mat3<double>::Identity());
  try_triples(b, rotation);
  const std::vector<Vec3d> of_b = differences(b, rotation);
  for (const Vec3d& of_a : differences(a, Mat3<double>::Identity()))
    for (const Vec3d& edge : of_b) try_cross(of_a, edge);
  return best;
}

double separation_along(const Vec3d& direction, const Hull<double>& a, const Pose<double>& pose_a,
                        const Hull<double>& b, const Pose<double>& pose_b) {
  const Cloud cloud_a = world_vertices(a, {pose_a.rotation, Vec3d::Zero()});
  const Cloud cloud_b = world_vertices(b, {pose_b.rotation, pose_b.position - pose_a.position});
  const Eigen::VectorXd on_a = cloud_a * direction;
  const Eigen::VectorXd on_b = cloud_b * direction;
  return on_b.minCoeff() - on_a.maxCoeff();
}

}  // namespace contactscope::test
