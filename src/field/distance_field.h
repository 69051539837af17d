#pragma once

#include <cstdint>
#include <optional>
#include <variant>

#include "core/at.h"
#include "field/nearest_point.h"
#include "field/node_blend.h"
#include "geometry/shape.h"

/// Signed distance fields: a lattice of distances to the surface of a shape, negative inside.
///
///     +-----------+-----------+     coarse nodes, 4 cells apart, everywhere: far from the surface a
///     |           |. . . . . .|     query blends these
///     |  coarse   |. . fine . |     fine nodes in the blocks near the surface: the narrow band
///     |           |. .-----. .|
///     +-----------+--/--------+     cells that the surface passes know their triangles, and are
///                                   answered exactly where a blend would not do: what is thinner than
///                                   a cell does not vanish
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
/// See FieldSettings::smooth.
inline constexpr double kSmoothPart = 1.0 / 32;

struct FieldSettings {
  int cells = 64;  // along the longest side of the shape, kFewestFieldCells to kMostFieldCells
  int band = 3;    // cells on each side of the surface that have fine nodes; 0: all have
  FieldInterpolation interpolation = FieldInterpolation::Cubic;
  bool exact = true;  // cells that the surface passes know their triangles
  /// sample() blends nodes in such cells too where they are smooth: nothing thin can be in them, and the
  /// blend, measured at five points of the cell, is off by no more than this, cells. 0: none is, and all
  /// of these cells are answered by their triangles; kSmoothPart: queries take a fifth of the time.
  double smooth = 0;
  std::size_t most_bytes = std::size_t{1} << 30;  // a larger field is refused
  /// Threads that build the field, which is the same whatever their number. 0: as many as the processor
  /// runs at once, and fewer for a small field.
  int threads = 0;

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
  /// Blend of the eight nodes around a point (node_blend.h), or, where the surface passes the cell and
  /// the settings say so, the distance itself. A point outside the lattice gets its distance from where
  /// on the surface the value and the gradient of the nearest point of the lattice point to.
  [[gnu::always_inline]] FieldSample sample(const Vec3d& point) const;

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
  bool in_band(const Vec3d& point) const { return in_lattice(point) && locate(point).fine; }
  /// Whether a point is in a cell that knows its triangles.
  bool at_surface(const Vec3d& point) const {
    return in_lattice(point) && !triangles_of(locate(point)).empty();
  }
  /// The surface as triangles, caps included; null for a sphere or a capsule, which have a core.
  const Mesh<double>* surface() const { return core_ ? nullptr : &triangles_.mesh(); }
  /// Sphere or capsule.
  const std::optional<Capsule<double>>& core() const { return core_; }

  static constexpr int kBlock = 4;  // cells along the side of a block
  static constexpr int kSide = kBlock + 1;
  static constexpr int kNodes = kSide * kSide * kSide;
  static constexpr int kPairs = kBlock * kSide * kSide;
  static constexpr int kCells = kBlock * kBlock * kBlock;

  /// How far an exact distance may be from the truth: rounding of coordinates up to kMostFieldCells is
  /// some 2^-37 cells.
  static constexpr double kExactSlack = 0x1p-33;

 private:
  friend class FieldBuilder;
  friend class BlockFiller;

  /// Where a point of the lattice is.
  struct Place {
    const NodePair* first;  // of the cell's nodes
    const NodeLayout* layout;
    lanes::Flags<float> weights;
    lanes::Flags<float> block,
        cell;            // that many blocks from the origin, and cells from the block's
    int first_of_block;  // its node
    bool fine;

    Vec3d corner() const {
      const lanes::Flags<float> all = kBlock * block + cell;
      return Vec3d(all[0], all[1], all[2]);
    }
  };
  /// Calls visit(position, distance) for the eight nodes around until it says false.
  template <class Visit>
  void for_nodes(const Place& place, const Visit& visit) const;

  using Integers = lanes::Flags<float>;
  bool in_lattice(const Vec3d& point) const {
    return (point.array() >= 0).all() && (point.array() <= size_.array()).all();
  }
  /// Of a point of the lattice.
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
  /// The nearest point of the lattice; of what is no number its corner.
  Vec3d clamped(const Vec3d& point) const {
    const auto along = [&](int axis) { return std::min(std::max(0.0, point[axis]), size_[axis]); };
    return {along(0), along(1), along(2)};
  }
  /// How far the number of a node may be from the truth, cells.
  static double slack(const Place& place) {
    return kNodeRounding * double{place.layout->step} + kExactSlack;
  }

  FieldSettings settings_;
  std::array<int, 3> blocks_{};  // along each axis
  int blocks_of_layer_ = 0;      // x and y
  Vec3d size_ = Vec3d::Zero();
  Integers last_part_{};                 // the largest of the lattice (node_blend::parts_of)
  std::array<NodeLayout, 2> layouts_{};  // of the coarse nodes and of a fine block
  std::vector<NodePair> nodes_;          // the coarse ones, x first, then kPairs of each fine block
  int coarse_count_ = 0;
  /// Of a coarse one twice the number of its corner, of a fine one twice that of its own first, and 1.
  std::vector<std::uint32_t> first_node_of_block_;
  Aabb<double> surface_box_;
  std::vector<std::uint32_t> first_triangle_;  // of each cell of the fine blocks, and of the end
  std::vector<int> cell_triangles_;
  int fine_block_count_ = 0;
  NearestTriangles triangles_;
  std::optional<Capsule<double>> core_;
  bool regular_ = false;  // closed without caps, and its fronts look one way
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
  // Both kinds of blocks without a branch, which nothing could foresee: all bits where it is fine.
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
  if (place.first->asks_triangles()) return exact_in_cell(point);
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

  template <class S>
  static PlacedField of(const Field<S>& shape) {
    return {shape.values, shape.origin, shape.cell};
  }
  Vec3d in_lattice(const Vec3d& point) const { return (point - origin) * per_cell; }
  /// The sample at a point of the shape's frame, its distance in metres.
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

/// A shape made of a field and what it was made of.
inline Field<double> field_shape(const PlacedField& placed, const Shape<double>& source) {
  return {placed.field, placed.origin, placed.cell,
          std::make_shared<const FieldSource<double>>(FieldSource<double>{source})};
}

/// Builds the field of a shape: a sphere, a capsule, a hull or a mesh.
///
/// Steps: 1. the surface is closed (closed_surface.h); 2. distances at the coarse nodes, and which blocks
/// the band reaches (survey_blocks.cpp); 3. signs of the coarse nodes: nodes whose distances together are
/// larger than the way between them have one sign, as the surface cannot pass between; where that does
/// not reach, the winding number decides; 4. blocks that the band reaches get fine nodes, and 5. their
/// signs in the same way; 6. cells that the surface passes get all triangles that can be nearest to one of
/// their points; 7. those of them that are not smooth are marked. Triangles are sifted (triangle_sieve.h):
/// in 2 for eight blocks together and each of them, in 4 for the eight parts of a block and groups of eight
/// nodes, in 6 for cells. Several threads do 2, 4 to 6 and 7 (field_builder.h).
///
/// Throws ShapeError for a plane, for a mesh without an inside, and for a field of more bytes than the
/// settings allow, with the number of bytes that it would take.
PlacedField build_distance_field(const Shape<double>& shape, const FieldSettings& settings = {});

}  // namespace contactscope
