#pragma once

#include "field/nearest_point.h"
#include "field/node_blend.h"
#include "geometry/shape.h"

/// Signed distance fields: a lattice of distances to the surface of a shape, negative inside.
///
///     +-----------+-----------+     coarse nodes, every 4 cells, everywhere: queries far from the
///     |           |. . . . . .|     surface blend these
///     |  coarse   |. . fine . |     fine nodes in the blocks near the surface: the narrow band
///     |           |. .-----. .|
///     +-----------+--/--------+     surface cells store their triangles for exact answers where a
///                                   blend is not enough, so parts thinner than a cell remain
///
/// All of this is in the lattice's frame: its unit is a cell, its origin the lattice's corner. A
/// field can be moved and scaled without changing its numbers; see PlacedField.
namespace contactscope {

enum class FieldInterpolation : std::uint8_t {
  Trilinear,  // blends eight nodes' distances; error: cell squared over radius of curvature
  Cubic,      // blends their gradients as well
};

/// "trilinear", "cubic", as written in scenarios.
constexpr const char* to_string(FieldInterpolation interpolation) {
  return interpolation == FieldInterpolation::Trilinear ? "trilinear" : "cubic";
}

inline constexpr int kFewestFieldCells = 2;
inline constexpr int kMaxFieldCells = 4096;
/// See FieldSettings::smooth.
inline constexpr double kSmoothPart = 1.0 / 32;

struct FieldSettings {
  int cells = 64;  // along the longest side of the shape, kFewestFieldCells to kMaxFieldCells
  int band = 3;    // cells with fine nodes on each side of the surface; 0: all
  FieldInterpolation interpolation = FieldInterpolation::Cubic;
  bool exact = true;  // surface cells store their triangles
  /// Largest blend error in surface cells, in cells. sample() also blends in those that are smooth:
  /// nothing thin can be in them, and the error at five points is within this. 0: all use their
  /// triangles. kSmoothPart: queries take a fifth of the time.
  double smooth = 0;
  std::size_t most_bytes = std::size_t{1} << 30;  // larger fields are rejected
  /// Number of threads; does not change the field. 0: all of the processor, fewer for small fields.
  int threads = 0;
  friend bool operator==(const FieldSettings&, const FieldSettings&) = default;
};

/// A field's value at a point.
struct FieldSample {
  double distance;  // cells, negative inside
  Vec3d gradient;   // of the distance; about unit, shorter where the nearest point jumps
  enum class Source : std::uint8_t { Exact, Fine, Coarse, Outside } source;
};

/// Bounds of a distance, cells.
struct FieldBounds {
  double lower, upper;
};

/// A lattice of distances, made by build_distance_field() only.
class DistanceField {
 public:
  /// Blends the eight nodes around a point (node_blend.h), or gives the exact distance in surface
  /// cells if the settings say so. Outside the lattice, the value and gradient at the nearest
  /// lattice point give the surface point to measure from.
  [[gnu::always_inline]] FieldSample sample(const Vec3d& point) const;

  /// Bounds for every point, including rounding: the distance differs from a node's by at most the
  /// distance to it, for the eight nodes around (Lipschitz). Exact in surface cells.
  FieldBounds bounds(const Vec3d& point) const;

  /// The distance to the triangles, everywhere. Slower than sample().
  FieldSample exact(const Vec3d& point) const;

  /// In cells: the lattice is the box from 0 to size().
  const Vec3d& size() const { return size_; }
  const Aabb<double>& surface_box() const { return surface_box_; }
  const FieldSettings& settings() const { return settings_; }
  /// Size of the nodes, the cells' triangles and the surface.
  std::size_t bytes() const;
  int fine_blocks() const { return fine_block_count_; }
  bool in_band(const Vec3d& point) const { return in_lattice(point) && locate(point).fine; }
  /// Whether a point is in a cell that stores its triangles.
  bool at_surface(const Vec3d& point) const {
    return in_lattice(point) && !triangles_of(locate(point)).empty();
  }
  /// The surface as triangles, including caps; null for spheres and capsules, which have a core.
  const Mesh<double>* surface() const { return core_ ? nullptr : &triangles_.mesh(); }
  /// The sphere or capsule.
  const std::optional<Capsule<double>>& core() const { return core_; }

  static constexpr int kBlock = 4;  // cells along the side of a block
  static constexpr int kSide = kBlock + 1;
  static constexpr int kNodes = kSide * kSide * kSide;
  static constexpr int kPairs = kBlock * kSide * kSide;
  static constexpr int kCells = kBlock * kBlock * kBlock;

  /// Error bound of exact distances: coordinates up to kMaxFieldCells round by some 2^-37 cells.
  static constexpr double kExactSlack = 0x1p-33;

 private:
  friend class FieldBuilder;
  friend class BlockFiller;

  /// The cell of a point in the lattice.
  struct Place {
    const NodePair* first;  // first pair of the cell's nodes
    const NodeLayout* layout;
    lanes::Flags<float> weights;
    lanes::Flags<float> block,
        cell;            // blocks from the origin, cells from the block's origin
    int first_of_block;  // index of its first pair
    bool fine;

    Vec3d corner() const {
      const lanes::Flags<float> all = kBlock * block + cell;
      return Vec3d(all[0], all[1], all[2]);
    }
  };
  /// Calls visit(position, distance) for the eight nodes around until it returns false.
  template <class Visit> void for_nodes(const Place& place, const Visit& visit) const;

  using Integers = lanes::Flags<float>;
  bool in_lattice(const Vec3d& point) const {
    return (point.array() >= 0).all() && (point.array() <= size_.array()).all();
  }
  /// For a point inside the lattice.
  Place locate(const Vec3d& inside) const {
    return locate(lanes::smaller(node_blend::parts_of(inside), last_part_));
  }
  Place locate(const Integers& parts) const;
  [[gnu::always_inline]] FieldSample sample(const Place& place, const Vec3d& point) const;
  FieldSample sample_outside(const Vec3d& point) const;
  FieldSample exact_in_cell(const Vec3d& point) const;
  FieldBounds bounds_by_nodes(const Place& place, const Vec3d& inside) const;
  std::span<const int> triangles_of(const Place& place) const;
  FieldSample exact_near(const Place& place, const Vec3d& point, const NearestPoint& nearest,
                         std::span<const int> around) const;
  FieldSample by_core(const Vec3d& point) const;
  bool is_inside(const Place& place, const Vec3d& point, const NearestPoint& nearest,
                 std::span<const int> around) const;
  /// The nearest point of the lattice; its corner for NaN.
  Vec3d clamped(const Vec3d& point) const {
    const auto along = [&](int axis) { return std::min(std::max(0.0, point[axis]), size_[axis]); };
    return {along(0), along(1), along(2)};
  }
  /// Error bound of a node's distance, cells.
  static double slack(const Place& place) {
    return kNodeRounding * double{place.layout->step} + kExactSlack;
  }

  FieldSettings settings_;
  std::array<int, 3> blocks_{};  // along each axis
  int blocks_of_layer_ = 0;      // along x and y
  Vec3d size_ = Vec3d::Zero();
  Integers last_part_{};                 // largest in the lattice (node_blend::parts_of)
  std::array<NodeLayout, 2> layouts_{};  // coarse nodes, and a fine block
  std::vector<NodePair> nodes_;          // the coarse ones, x first, then kPairs per fine block
  int coarse_count_ = 0;
  /// Index of a coarse block's corner or a fine block's first pair, times 2, plus 1 if fine.
  std::vector<std::uint32_t> first_node_of_block_;
  Aabb<double> surface_box_;
  std::vector<std::uint32_t> first_triangle_;  // for each cell of the fine blocks, and the end
  std::vector<int> cell_triangles_;
  int fine_block_count_ = 0;
  NearestTriangles triangles_;
  std::optional<Capsule<double>> core_;
  bool regular_ = false;  // closed without caps, with consistent fronts
  double front_ = 1;      // 1: fronts are outside
};

inline DistanceField::Place DistanceField::locate(const Integers& parts) const {
  using node_blend::small_lane;
  constexpr int kBlockBits = kWeightBits + 2;
  static_assert(kBlock == 1 << (kBlockBits - kWeightBits));
  const Integers block = parts >> kBlockBits, cell = parts >> kWeightBits & (kBlock - 1);
  const std::uint32_t entry =
      at(first_node_of_block_, small_lane<2>(block) * blocks_of_layer_ +
                                   small_lane<1>(block) * blocks_[0] + small_lane<0>(block));
  const int first = static_cast<int>(entry >> 1);
  // No branch for fine or coarse blocks, which would be unpredictable: all bits are set if fine.
  const int fine = -static_cast<int>(entry & 1);
  const int in_block =
      (small_lane<2>(cell) * kSide + small_lane<1>(cell)) * kBlock + small_lane<0>(cell);
  const NodeLayout& layout = layouts_[entry & 1];
  return {nodes_.data() + first + (in_block & fine),
          &layout,
          parts >> layout.side_bits & (kWeightOne - 1),
          block,
          cell & fine,
          first,
          fine != 0};
}

inline FieldSample DistanceField::sample(const Vec3d& point) const {
  const Integers parts = node_blend::parts_of(point);
  if (lanes::bits<float>((parts < 0) | (parts > last_part_)) != 0) [[unlikely]]
    return sample_outside(point);
  return sample(locate(parts), point);
}

inline FieldSample DistanceField::sample(const Place& place, const Vec3d& point) const {
  if (place.first->queries_triangles()) return exact_in_cell(point);
  const lanes::Pack<float> node = settings_.interpolation == FieldInterpolation::Cubic
                                      ? blend<true>(place.first, *place.layout, place.weights)
                                      : blend<false>(place.first, *place.layout, place.weights);
  return {node[0],
          {node[1], node[2], node[3]},
          place.fine ? FieldSample::Source::Fine : FieldSample::Source::Coarse};
}

/// A field in the frame of a shape, metres.
struct PlacedField {
  std::shared_ptr<const DistanceField> field;
  Vec3d origin = Vec3d::Zero();  // of the lattice, in the shape's frame
  double cell = 1;               // metres
  double per_cell = 1 / cell;    // 1 / metres

  template <class S> static PlacedField of(const Field<S>& shape) {
    return {shape.values, shape.origin, shape.cell};
  }
  Vec3d in_lattice(const Vec3d& point) const { return (point - origin) * per_cell; }
  /// Sample at a point in the shape's frame; its distance in metres.
  [[gnu::always_inline]] FieldSample sample(const Vec3d& point) const {
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

inline Field<double> field_shape(const PlacedField& placed, const Shape<double>& source) {
  return {placed.field, placed.origin, placed.cell,
          std::make_shared<const FieldSource<double>>(FieldSource<double>{source})};
}

/// Builds the field of a shape: a sphere, a capsule, a hull or a mesh.
///
/// Steps: 1. close the surface (closed_surface.h); 2. compute distances at the coarse nodes, and
/// find the blocks that the band reaches (fill_block.cpp); 3. sign the coarse nodes: two nodes
/// whose distances add up to more than the distance between them have one sign, as the surface
/// cannot pass between; elsewhere the winding number decides; 4. give fine nodes to the blocks in
/// the band, and 5. sign them likewise; 6. store in surface cells all triangles that can be nearest
/// to one of their points; 7. mark the cells that are not smooth. Triangles are sifted
/// (triangle_sieve.h): in 2 for eight blocks together and for each, in 4 for the eight parts of a
/// block and groups of eight nodes, in 6 for cells. Threads share 2 and 4 to 7 (field_builder.h).
///
/// Throws ShapeError for planes, meshes without an inside, and fields that need too many bytes.
PlacedField build_distance_field(const Shape<double>& shape, const FieldSettings& settings = {});

}  // namespace contactscope
