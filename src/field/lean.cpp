#include "field/triangle_sieve.h"

namespace contactscope {
namespace {

/// Larger tangents are treated as unknown.
constexpr double kLargestLean = 8;
constexpr double kMinCosine = 0.1;

/// Tangent of the angle between two unit vectors.
double tangent_between(const Vec3d& one, const Vec3d& other) {
  const double cosine = one.dot(other);
  return cosine > kMinCosine ? one.cross(other).norm() / cosine : double{kAnyLean};
}

/// Tangent of the sum of two angles, from their tangents.
double tangent_of_sum(double one, double other) {
  const double cosines = 1 - one * other;
  return cosines > kMinCosine ? (one + other) / cosines : double{kAnyLean};
}

/// A corner of a triangle, at the start of the edge with that number.
struct Corner {
  int triangle, edge;

  friend bool operator==(const Corner&, const Corner&) = default;
};

class LeanFinder {
 public:
  explicit LeanFinder(const Mesh<double>& mesh)
      : mesh_(mesh), leans_(mesh.triangles.size()), seen_(mesh.triangles.size()) {}

  std::vector<float> find() {
    for (int t = 0; t < mesh_.triangle_count(); ++t) {
      for (int k = 0; k < 3; ++k) {
        const int next = mesh_.neighbour(t, k);
        raise(t, next < 0 ? kAnyLean : tangent_between(mesh_.normal(t), mesh_.normal(next)));
        if (!at(at(seen_, t), k)) look_around({t, k});
      }
    }
    return std::move(leans_);
  }

 private:
  void raise(int triangle, double lean) {
    float& own = at(leans_, triangle);
    own = std::max(own, lean <= kLargestLean ? static_cast<float>(lean) : kAnyLean);
  }

  /// Handles the triangles around the vertex of a corner, counter-clockwise.
  void look_around(const Corner& first) {
    fan_.clear();
    Vec3d sum = Vec3d::Zero();
    std::optional<Corner> corner = first;
    while (corner && !at(at(seen_, corner->triangle), corner->edge)) {
      at(at(seen_, corner->triangle), corner->edge) = true;
      sum += mesh_.normal(corner->triangle);
      fan_.push_back(*corner);
      corner = next_around(*corner);
    }
    const Vec3d mean = sum.normalized();
    const double lean = corner == first ? lean_from(mean) : double{kAnyLean};
    for (const auto& [triangle, edge] : fan_)
      raise(triangle, tangent_of_sum(lean, tangent_between(mean, mesh_.normal(triangle))));
  }

  /// The corner at the same vertex in the next triangle, across the edge that ends there.
  std::optional<Corner> next_around(const Corner& corner) const {
    const int next = mesh_.neighbour(corner.triangle, (corner.edge + 2) % 3);
    if (next < 0) return {};
    const Vec3d& vertex = mesh_.corner(corner.triangle, corner.edge);
    for (int k = 0; k < 3; ++k)
      if (mesh_.neighbour(next, k) == corner.triangle && mesh_.corner(next, k) == vertex)
        return Corner{next, k};
    return {};
  }

  /// Lean of directions to the vertex of a closed fan from its mean normal: tan b in the header.
  double lean_from(const Vec3d& mean) {
    across_.clear();
    double steepest = 0;
    for (const auto& [triangle, k] : fan_) {
      if (!(mesh_.normal(triangle).dot(mean) > kMinCosine)) return kAnyLean;
      const Vec3d edge = mesh_.corner(triangle, (k + 1) % 3) - mesh_.corner(triangle, k);
      const double height = edge.dot(mean);
      const Vec3d across = edge - height * mean;
      const double length = across.norm();
      if (!(length > kMinCosine * std::abs(height))) return kAnyLean;
      steepest = std::max(steepest, std::abs(height) / length);
      across_.emplace_back(across / length);
    }
    // All normals are on one side, so each edge is less than half a turn from the one before.
    double least = 1;  // cosine of the largest angle between neighbours
    for (std::size_t i = 0; i < across_.size(); ++i)
      least = std::min(least, across_[i].dot(across_[(i + 1) % across_.size()]));
    const double of_half = std::sqrt(0.5 * std::max(0.0, 1 + least));
    return of_half > kMinCosine ? steepest / of_half : double{kAnyLean};
  }

  const Mesh<double>& mesh_;
  std::vector<float> leans_;
  std::vector<std::array<bool, 3>> seen_;  // by triangle and corner
  std::vector<Corner> fan_;
  std::vector<Vec3d> across_;  // its edges, projected along the mean normal, unit
};

}  // namespace

std::vector<float> largest_leans(const Mesh<double>& mesh) { return LeanFinder(mesh).find(); }

}  // namespace contactscope
