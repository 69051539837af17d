#include <cmath>

#include "core/at.h"
#include "field/block_filler.h"
#include "field/field_builder.h"

namespace contactscope {

/// Computes the distances of the coarse nodes, and finds the blocks that the band reaches.
///
/// Groups of 2 x 2 x 2 blocks share a list of triangles if the band may reach one of them. The
/// triangles near a block, and near its coarse nodes, are sifted from it. Elsewhere each node
/// searches the tree, starting with the triangle nearest to the node before.
void FieldBuilder::survey() {
  const auto [nx, ny, nz] = field_.blocks_;
  const auto product = [](int x, int y, int z) {
    return static_cast<std::size_t>(x) * static_cast<std::size_t>(y) * static_cast<std::size_t>(z);
  };
  coarse_.resize(product(nx + 1, ny + 1, nz + 1));
  near_.resize(product(nx, ny, nz));
  std::vector<SurveyLists> lists(static_cast<std::size_t>(workers_->count()));
  const int along_y = ny / 2 + 1;
  workers_->for_each(along_y * (nz / 2 + 1), [&, nx = nx](int row, int worker) {
    int seed = 0;
    for (int x = 0; x <= nx / 2; ++x)
      seed = survey_group({x, row % along_y, row / along_y}, seed, at(lists, worker));
  });
}

/// Surveys the nodes and blocks at twice the group's index, or one more, along each axis. Returns
/// the triangle nearest to the group's middle. `seed`: a triangle nearby.
int FieldBuilder::survey_group(const std::array<int, 3>& group, int seed, SurveyLists& lists) {
  bool near = true;
  NearestPoint last;
  if (sieve_) {
    const Vec3d middle = 2 * kBlock * Vec3d(group[0] + 0.5, group[1] + 0.5, group[2] + 0.5);
    last = sieve_->nearest(middle, seed);
    seed = last.triangle;
    near = band_reaches(last.squared, 2 * kHalfBlock);
    if (near) sieve_->fill_around(middle, kBlock, last.point, lists.of_group);
  }
  for (int part = 0; part < 8; ++part) {
    const int x = 2 * group[0] + (part & 1), y = 2 * group[1] + (part >> 1 & 1);
    const int z = 2 * group[2] + (part >> 2);
    if (x > field_.blocks_[0] || y > field_.blocks_[1] || z > field_.blocks_[2]) continue;
    const Vec3d point = kBlock * Vec3d(x, y, z);
    const bool block =
        near && x < field_.blocks_[0] && y < field_.blocks_[1] && z < field_.blocks_[2];
    if (block)
      at(near_, block_number(x, y, z)) =
          survey_block(point + Vec3d::Constant(0.5 * kBlock), lists, last.point);
    Node& node = at(coarse_, coarse_number(x, y, z));
    if (field_.core_) {
      node = unsigned_node_of_core(point);
      continue;
    }
    last = block ? sieve_->nearest(lists.of_block, point) : sieve_->nearest(point, last.triangle);
    node = unsigned_node(point, last);
  }
  return seed;
}

std::optional<FieldBuilder::NearBlock> FieldBuilder::survey_block(const Vec3d& middle,
                                                                  SurveyLists& lists,
                                                                  const Vec3d& near) const {
  NearBlock block;
  if (field_.core_) {
    block.to_middle.squared = std::pow(field_.by_core(middle).distance, 2);
  } else {
    sieve_->fill_within(lists.of_group, middle, 0.5 * kBlock, near, lists.of_block);
    block.to_middle = sieve_->nearest(lists.of_block, middle);
  }
  if (!band_reaches(block.to_middle.squared, kHalfBlock)) return {};
  const std::span<const int> triangles = lists.of_block.triangles();
  block.triangles.assign(triangles.begin(), triangles.end());
  return block;
}

/// Whether the band may reach a cube, by the distance of its middle and half its diagonal.
bool FieldBuilder::band_reaches(double squared_distance, double half_diagonal) const {
  const double reach = field_.settings_.band + half_diagonal + kSignSlack;
  return field_.settings_.band == 0 || squared_distance <= reach * reach;
}

}  // namespace contactscope
