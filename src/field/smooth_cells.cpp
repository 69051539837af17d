#include <cmath>

#include "core/at.h"
#include "field/block_filler.h"

namespace contactscope {

void BlockFiller::query_triangles(int fine) {
  const auto [x, y, z] = shared_.block_at(at(shared_.blocks_, fine));
  for (int cell = 0; cell < kCells; ++cell) {
    const std::uint32_t* range = &at(field_.first_triangle_, fine * kCells + cell);
    if (range[0] == range[1]) continue;
    const int i = cell % kBlock, j = cell / kBlock % kBlock, k = cell / (kBlock * kBlock);
    const std::span<const int> triangles =
        std::span(field_.cell_triangles_).subspan(range[0], range[1] - range[0]);
    NodePair* first = pairs_of(fine) + (k * kSide + j) * kBlock + i;
    if (!is_smooth(kBlock * Vec3d(x, y, z) + Vec3d(i, j, k), first, triangles))
      querying_.push_back(first);
  }
  // Only after all are tested: the mark is in a gradient that neighbouring cells share.
  for (NodePair* pair : querying_) pair->query_triangles();
  querying_.clear();
}

/// Whether a cell can have nothing thin in it, and its blend is good.
///
/// If all normals are within less than 90 degrees of one direction, each line along it crosses the
/// surface in the cell only from inside to outside. So it crosses it at most once, and no plate or
/// gap can begin and end in the cell.
bool BlockFiller::is_smooth(const Vec3d& corner, const NodePair* first,
                            std::span<const int> triangles) {
  if (!(field_.settings_.smooth > 0)) return false;
  constexpr double kSameSide = 0.5;  // cosine of 60 degrees
  if (field_.core_) {
    // The surface in a cell bends by less than 60 degrees: its diagonal is 1.73 cells.
    constexpr double kMinRadius = 2;
    return field_.core_->radius >= kMinRadius && blends_well(corner, first);
  }
  if (!field_.regular_) return false;
  const Vec3d& normal = field_.triangles_.normal(triangles.front());
  for (const int triangle : triangles)
    if (field_.triangles_.normal(triangle).dot(normal) < kSameSide) return false;
  sieve_->fill(triangles, of_cell_);
  return blends_well(corner, first);
}

/// Compares the blend with the distance in the middle of a cell, and in the middles of four of its
/// eight parts that share no face. `first`: first pair of the cell's nodes.
bool BlockFiller::blends_well(const Vec3d& corner, const NodePair* first) const {
  const bool cubic = field_.settings_.interpolation == FieldInterpolation::Cubic;
  const NodeLayout& layout = field_.layouts_[1];
  // In quarters of the cell.
  const auto is_good = [&](int x, int y, int z) {
    const Vec3d point = corner + 0.25 * Vec3d(x, y, z);
    const double truth = field_.core_ ? field_.by_core(point).distance
                                      : field_.front_ * sieve_->rough_distance(of_cell_, point);
    const lanes::Flags<float> weights = kWeightOne / 4 * lanes::Flags<float>{x, y, z, 0};
    const float found =
        cubic ? blend<true>(first, layout, weights)[0] : blend<false>(first, layout, weights)[0];
    return std::abs(found - truth) <= field_.settings_.smooth;
  };
  return is_good(2, 2, 2) && is_good(1, 1, 1) && is_good(3, 3, 1) && is_good(3, 1, 3) &&
         is_good(1, 3, 3);
}

}  // namespace contactscope
