#pragma once

#include <cstdint>
#include <optional>
#include <variant>

#include "core/pack.h"
#include "field/nearest_point.h"
#include "geometry/shape.h"

/// Signed distance fields: a lattice of distances to the surface of a shape, negative inside.
///
///     +-----------+-----------+     coarse nodes, 4 cells apart, everywhere: far from the surface a
///     |           |. . . . . .|     query blends these
///     |  coarse   |. . fine . |     fine nodes in the blocks near the surface: the narrow band
///     |           |. .-----. .|
///     +-----------+--/--------+     cells that the surface passes know their triangles, and are
///                                   answered exactly: what is thinner than a cell does not vanish
///
/// All of this is in a frame of its own, the lattice's: its unit is a cell, its origin the corner of the
/// lattice. A field may so be moved and scaled without a change of its numbers; see PlacedField.
namespace contactscope {

enum class FieldInterpolation : std::uint8_t {
  Trilinear,  // of the distances of eight nodes: wrong by the square of a cell over a radius of curvature
  Cubic,  // and of their gradients
};

/// "trilinear", "cubic", as scenarios spell it.
constexpr const char* to_string(FieldInterpolation interpolation) {
  return interpolation == FieldInterpolation::Trilinear ? "trilinear" : "cubic";
}

inline constexpr int kFewestFieldCells = 2;
inline constexpr int kMostFieldCells = 4096;

struct FieldSettings {
  int cells = 64;  // along the longest side of the shape, kFewestFieldCells to kMostFieldCells
  int band = 3;    // cells on each side of the surface that have fine nodes; 0: all have
  FieldInterpolation interpolation = FieldInterpolation::Cubic;
  bool exact = true;  // cells that the surface passes are answered by their triangles
  std::size_t most_bytes = std::size_t{1} << 30;  // a larger field is refused

  friend bool operator==(const FieldSettings&, const FieldSettings&) = default;
};

/// What a field says of a point.
struct FieldSample {
  double distance;  // cells, negative inside
  Vec3d gradient;   // of the distance; about unit, shorter where the nearest point jumps
  enum class Source : std::uint8_t { Exact, Fine, Coarse, Outside } source;
};

/// Bounds of a distance, cells.
struct FieldBounds {
  double lower, upper;
};

/// A lattice of distances. Made by build_distance_field only.
class DistanceField {
 public:
  /// Blend of the eight nodes around a point, or, where the surface passes the cell and the settings say
  /// exact, the distance itself. A point outside the lattice gets its distance from where on the surface
  /// the value and the gradient of the nearest point of the lattice point to.
  ///
  /// Cubic interpolation is right for polynomials of third order: along each axis Hermite's cubic by
  /// distance and slope of both nodes, across it linear; what it adds to a linear blend is summed over
  /// the axes (a Boolean sum without its mixed parts, after Gordon 1971). The gradient is the linear
  /// blend of the nodes' gradients.
  FieldSample sample(const Vec3d& point) const;

  /// Bounds that hold for every point, rounding included: the distance changes by no more than the way
  /// from each of the eight nodes around (Lipschitz), and in cells that the surface passes it is known.
  FieldBounds bounds(const Vec3d& point) const;

  /// The distance by the triangles themselves, everywhere. Slower than sample().
  FieldSample exact(const Vec3d& point) const;

  /// Steps to each side: the lattice is the box from 0 to size().
  const Vec3d& size() const { return size_; }
  /// Of the surface.
  const Aabb<double>& surface_box() const { return surface_box_; }
  const FieldSettings& settings() const { return settings_; }
  /// Of the nodes, the cells' triangles and the surface.
  std::size_t bytes() const;
  int fine_blocks() const { return fine_block_count_; }
  /// Whether a point is in a cell of the narrow band.
  bool in_band(const Vec3d& point) const {
    return clamped(point) == point && locate(point).fine >= 0;
  }
  /// The surface as triangles, caps included; null for a sphere or a capsule, which have a core.
  const Mesh<double>* surface() const { return core_ ? nullptr : &triangles_.mesh(); }
  /// Sphere or capsule.
  const std::optional<Capsule<double>>& core() const { return core_; }

  static constexpr int kBlock = 4;  // cells along the side of a block
  static constexpr int kSide = kBlock + 1;
  static constexpr int kNodes = kSide * kSide * kSide;
  static constexpr int kCells = kBlock * kBlock * kBlock;

  /// How far an exact distance may be from the truth: rounding of coordinates up to kMostFieldCells is
  /// some 2^-37 cells.
  static constexpr double kExactSlack = 0x1p-33;
  /// The same of the number of a node, which is rounded to float.
  static double slack(double distance) { return 0x1p-23 * std::abs(distance) + kExactSlack; }

 private:
  friend class FieldBuilder;
  /// Distance, then its gradient.
  using Node = lanes::Pack<float>;

  /// Where a point of the lattice is.
  struct Place {
    std::array<int, 3> block;
    int fine;           // number among the fine blocks; -1: none
    int cell;           // in the block; 0 where it is coarse
    Vec3d corner;       // of the cell or the coarse block
    double side;        // its length: 1 or kBlock
    const Node* nodes;  // the first of the eight; the others are 1 and these two away
    int next_y, next_z;
  };

  Place locate(const Vec3d& inside) const;
  FieldSample blend(const Place& place, const Vec3d& inside) const;
  FieldBounds bounds_by_nodes(const Place& place, const Vec3d& inside) const;
  std::span<const int> triangles_of(const Place& place) const;
  FieldSample exact_near(const Place& place, const Vec3d& point, const NearestPoint& nearest,
                         std::span<const int> around) const;
  FieldSample by_core(const Vec3d& point) const;
  bool is_inside(const Place& place, const Vec3d& point, const NearestPoint& nearest,
                 std::span<const int> around) const;
  Vec3d clamped(const Vec3d& point) const { return point.cwiseMax(0.0).cwiseMin(size_); }

  FieldSettings settings_;
  std::array<int, 3> blocks_{};  // along each axis
  Vec3d size_ = Vec3d::Zero();
  Aabb<double> surface_box_;
  std::vector<Node> coarse_;                   // x first
  std::vector<int> fine_of_block_;             // -1: none
  std::vector<Node> fine_;                     // kNodes of each fine block
  std::vector<std::uint32_t> first_triangle_;  // of each cell of the fine blocks, and of the end
  std::vector<int> cell_triangles_;
  int fine_block_count_ = 0;
  NearestTriangles triangles_;
  std::optional<Capsule<double>> core_;
  bool regular_ = false;  // closed without caps, and its fronts look one way
  double front_ = 1;      // 1: fronts are outside
};

/// A field in the frame of a shape, metres.
struct PlacedField {
  std::shared_ptr<const DistanceField> field;
  Vec3d origin = Vec3d::Zero();  // of the lattice, in the shape's frame
  double cell = 1;               // metres

  template <class S>
  static PlacedField of(const Field<S>& shape) {
    return {shape.values, shape.origin, shape.cell};
  }
  Vec3d in_lattice(const Vec3d& point) const { return (point - origin) / cell; }
  /// The sample at a point of the shape's frame, its distance in metres.
  FieldSample sample(const Vec3d& point) const {
    return in_metres(field->sample(in_lattice(point)));
  }
  FieldSample exact(const Vec3d& point) const { return in_metres(field->exact(in_lattice(point))); }
  FieldBounds bounds(const Vec3d& point) const {
    const FieldBounds bounds = field->bounds(in_lattice(point));
    return {bounds.lower * cell, bounds.upper * cell};
  }

 private:
  FieldSample in_metres(FieldSample sample) const {
    sample.distance *= cell;
    return sample;
  }
};

/// A shape made of a field and what it was made of.
inline Field<double> field_shape(const PlacedField& placed, const Shape<double>& source) {
  return {placed.field, placed.origin, placed.cell,
          std::make_shared<const FieldSource<double>>(FieldSource<double>{source})};
}

/// Builds the field of a shape: a sphere, a capsule, a hull or a mesh.
///
/// Steps: 1. the surface is closed (closed_surface.h); 2. distances at the coarse nodes; 3. their signs:
/// nodes whose distances together are larger than the way between them have one sign, as the surface
/// cannot pass between; where that does not reach, the winding number decides; 4. blocks that the band
/// reaches get fine nodes, and 5. their signs in the same way; 6. cells that the surface passes get all
/// triangles that can be nearest to one of their points.
///
/// Throws ShapeError for a plane, for a mesh without an inside, and for a field of more bytes than the
/// settings allow, with the number of bytes that it would take.
PlacedField build_distance_field(const Shape<double>& shape, const FieldSettings& settings = {});

}  // namespace contactscope
