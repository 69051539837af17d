#include <cmath>

#include "core/at.h"
#include "field/block_filler.h"

namespace contactscope {

void BlockFiller::ask_triangles(int fine) {
  const auto [x, y, z] = shared_.block_at(at(shared_.blocks_, fine));
  for (int cell = 0; cell < kCells; ++cell) {
    const std::uint32_t* range = &at(field_.first_triangle_, fine * kCells + cell);
    if (range[0] == range[1]) continue;
    const int i = cell % kBlock, j = cell / kBlock % kBlock, k = cell / (kBlock * kBlock);
    const std::span<const int> triangles =
        std::span(field_.cell_triangles_).subspan(range[0], range[1] - range[0]);
    if (!is_smooth(kBlock * Vec3d(x, y, z) + Vec3d(i, j, k), triangles))
      asking_.push_back(&pairs_of(fine)[(k * kSide + j) * kBlock + i]);
  }
  // Not before all are judged: the mark is in a gradient that cells beside this one have, too.
  for (NodePair* pair : asking_) pair->ask_triangles();
  asking_.clear();
}

/// Whether nothing thin can be in a cell, and its blend is good.
///
/// If the normals of all triangles there are within less than 90 degrees of one direction, then each line
/// along it crosses the surface in the cell from inside to outside only: so a line crosses it once at
/// most, and no plate or gap can begin and end in the cell.
bool BlockFiller::is_smooth(const Vec3d& corner, std::span<const int> triangles) {
  if (!(field_.settings_.smooth > 0)) return false;
  constexpr double kSameSide = 0.5;  // cosine of 60 degrees
  if (field_.core_) {
    // The surface in a cell bends by less than 60 degrees: its diagonal is 1.73 cells.
    constexpr double kLeastRadius = 2;
    return field_.core_->radius >= kLeastRadius && blends_well(corner);
  }
  if (!field_.regular_) return false;
  const Vec3d& normal = field_.triangles_.normal(triangles.front());
  for (const int triangle : triangles)
    if (field_.triangles_.normal(triangle).dot(normal) < kSameSide) return false;
  sieve_->fill(triangles, of_cell_);
  return blends_well(corner);
}

/// Compares the blend with the distance in the middle of a cell and in those of four of its eight parts, no
/// two of which share a face.
bool BlockFiller::blends_well(const Vec3d& corner) const {
  const auto is_good = [&](const Vec3d& point) {
    const double truth = field_.core_ ? field_.by_core(point).distance
                                      : field_.front_ * sieve_->rough_distance(of_cell_, point);
    return std::abs(field_.sample(point).distance - truth) <= field_.settings_.smooth;
  };
  if (!is_good(corner + Vec3d::Constant(0.5))) return false;
  for (const int part : {0, 3, 5, 6}) {
    const Vec3d side(part & 1, part >> 1 & 1, part >> 2);
    if (!is_good(corner + Vec3d::Constant(0.25) + 0.5 * side)) return false;
  }
  return true;
}

}  // namespace contactscope
