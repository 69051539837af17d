#include <algorithm>
#include <cmath>

#include "core/at.h"
#include "field/block_filler.h"

namespace contactscope {

void BlockFiller::fill(int fine, FieldBuilder::Row& row) {
  const auto [bx, by, bz] = shared_.block_at(at(shared_.blocks_, fine));
  corner_ = kBlock * Vec3d(bx, by, bz);
  nodes_ = shared_.fine_nodes(fine);
  copy_known(fine);
  if (field_.core_)
    fill_by_core();
  else
    fill_by_triangles(at(shared_.middles_, fine));
  spread_signs({kSide, kSide, kSide}, 1, nodes_, signs_, [&](int x, int y, int z) {
    return shared_.is_inside(corner_ + Vec3d(x, y, z), row.fronts);
  });
  compare_sides(row.fronts);
  for (int i = 0; i < kNodes; ++i)
    if (at(signs_, i) == NodeSign::Inside) at(nodes_, i) = -at(nodes_, i);
  FieldBuilder::write_pairs(nodes_, kSide, field_.layouts_[1].step, pairs_of(fine));
  at(shared_.filled_, fine) = 1;
  if (!field_.settings_.exact) return;
  for (std::vector<int>& triangles : triangles_) {
    row.counts.push_back(static_cast<std::uint32_t>(triangles.size()));
    row.triangles.insert(row.triangles.end(), triangles.begin(), triangles.end());
    triangles.clear();
  }
}

/// Copies the nodes that the coarse lattice and the blocks that are filled have in common with a block, and
/// their signs.
void BlockFiller::copy_known(int fine) {
  const auto [bx, by, bz] = shared_.block_at(at(shared_.blocks_, fine));
  signs_.fill(NodeSign::Unknown);
  known_.fill(false);
  side_.fill(0);
  const auto take = [&](int here, const Node& node) {
    const bool inside = std::signbit(node[0]);
    at(signs_, here) = inside ? NodeSign::Inside : NodeSign::Outside;
    at(nodes_, here) = inside ? -node : node;
    at(known_, here) = true;
  };
  for (const int k : {0, kBlock})
    for (const int j : {0, kBlock})
      for (const int i : {0, kBlock})
        take(node_in_block(i, j, k),
             at(shared_.coarse_,
                shared_.coarse_number(bx + i / kBlock, by + j / kBlock, bz + k / kBlock)));
  const std::array<int, 3> here = {bx, by, bz};
  const std::array<int, 3> step = {1, kSide, kSide * kSide};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const int side : {-1, 1}) {
      std::array<int, 3> next = here;
      next[axis] += side;
      if (next[axis] < 0 || next[axis] == field_.blocks_[axis]) continue;
      const int other = at(shared_.fine_of_block_, shared_.block_number(next[0], next[1], next[2]));
      if (other < 0 || at(shared_.filled_, other) == 0) continue;
      const std::span<const Node> nodes = shared_.fine_nodes(other);
      const int own_face = side < 0 ? 0 : kBlock * step[axis];
      const int other_face = kBlock * step[axis] - own_face;
      const int along = step[(axis + 1) % 3], across = step[(axis + 2) % 3];
      for (int v = 0; v < kSide; ++v)
        for (int u = 0; u < kSide; ++u)
          take(own_face + u * along + v * across, at(nodes, other_face + u * along + v * across));
    }
  }
}

/// Finds out whether fronts are outside: not everywhere, where the surface crosses itself, or parts of it
/// are inside out.
void BlockFiller::compare_sides(FieldBuilder::Fronts& fronts) const {
  for (int i = 0; i < kNodes; ++i) {
    if (at(side_, i) == 0) continue;
    const bool outside = at(signs_, i) == NodeSign::Outside;
    fronts.seen[outside == (at(side_, i) > 0) ? 1 : 0] = true;
  }
}

void BlockFiller::fill_by_core() {
  for (int k = 0; k < kSide; ++k)
    for (int j = 0; j < kSide; ++j)
      for (int i = 0; i < kSide; ++i)
        if (const int here = node_in_block(i, j, k); !at(known_, here))
          at(nodes_, here) = shared_.unsigned_node_of_core(corner_ + Vec3d(i, j, k));
  if (!field_.settings_.exact) return;
  for (int cell = 0; cell < kCells; ++cell) {
    const Vec3d middle(cell % kBlock + 0.5, cell / kBlock % kBlock + 0.5,
                       cell / (kBlock * kBlock) + 0.5);
    if (std::abs(field_.by_core(corner_ + middle).distance) <= kHalfCell + kSignSlack)
      at(triangles_, cell).push_back(0);
  }
}

/// From the triangles that can be nearest to a point of the block those of small groups of nodes are taken,
/// and those of its eight parts where cells are to know theirs.
void BlockFiller::fill_by_triangles(const NearestPoint& nearest_to_middle) {
  constexpr double kHalf = 0.5 * kBlock;
  sieve_->fill_around(corner_ + Vec3d::Constant(kHalf), kHalf, nearest_to_middle, of_block_);
  constexpr int kGroups = kSide / 2 + 1;
  for (int k = 0; k < kGroups; ++k)
    for (int j = 0; j < kGroups; ++j)
      for (int i = 0; i < kGroups; ++i) fill_nodes({i, j, k});
  if (!field_.settings_.exact) return;
  constexpr int kPart = kBlock / 2;
  for (const int k : {0, kPart})
    for (const int j : {0, kPart})
      for (const int i : {0, kPart}) find_triangles_of_part({i, j, k});
}

/// A group has the nodes of a cell, or those of its last face or edge. Along an axis the first group is
/// the first node, which mostly is known from the block before, the others are pairs.
void BlockFiller::fill_nodes(const std::array<int, 3>& group) {
  const std::array<int, 3> last = {2 * group[0], 2 * group[1], 2 * group[2]};
  const auto first = [&](std::size_t axis) { return std::max(last[axis] - 1, 0); };
  const Vec3d of_block(last[0], last[1], last[2]);
  std::array<std::array<int, 3>, 8> open;
  std::size_t count = 0;
  for (int k = first(2); k <= last[2]; ++k)
    for (int j = first(1); j <= last[1]; ++j)
      for (int i = first(0); i <= last[0]; ++i)
        if (!at(known_, node_in_block(i, j, k))) open[count++] = {i, j, k};
  if (count == 0) return;
  // To sift the block's triangles costs as much as to ask them for two nodes.
  TriangleSieve::List& list = count > 2 ? of_part_ : of_block_;
  if (count > 2) {
    const Vec3d middle = corner_ + of_block - Vec3d::Constant(0.5);
    sieve_->fill_within(of_block_, middle, 0.5, sieve_->nearest(of_block_, middle), list);
  }
  for (const auto& [i, j, k] : std::span(open).first(count)) {
    const int here = node_in_block(i, j, k);
    const Vec3d point = corner_ + Vec3d(i, j, k);
    at(known_, here) = true;
    const NearestPoint nearest = sieve_->nearest(list, point);
    at(nodes_, here) = shared_.unsigned_node(point, nearest);
    if (nearest.on_face && nearest.squared > kSignSlack * kSignSlack)
      at(side_, here) = field_.triangles_.height_over(nearest.triangle, point) > 0 ? 1 : -1;
  }
}

/// A part from a node on: two cells along each axis.
void BlockFiller::find_triangles_of_part(const std::array<int, 3>& first) {
  const auto [x, y, z] = first;
  bool sifted = false;
  for (int k = z; k < z + 2; ++k) {
    for (int j = y; j < y + 2; ++j) {
      for (int i = x; i < x + 2; ++i) {
        if (!may_have_surface({i, j, k})) continue;
        const Vec3d middle = corner_ + Vec3d(x + 1, y + 1, z + 1);
        if (!sifted)
          sieve_->fill_within(of_block_, middle, 1, sieve_->nearest(of_block_, middle), of_part_);
        sifted = true;
        find_triangles({i, j, k});
      }
    }
  }
}

/// The middle of a cell is no nearer to the surface than a corner is, less half a diagonal.
bool BlockFiller::may_have_surface(const std::array<int, 3>& cell) const {
  const auto [i, j, k] = cell;
  for (const int w : {k, k + 1})
    for (const int v : {j, j + 1})
      for (const int u : {i, i + 1})
        if (at(nodes_, node_in_block(u, v, w))[0] > 2 * kHalfCell + kSignSlack) return false;
  return true;
}

/// Where the surface may pass a cell, all triangles that can be nearest to a point of it.
void BlockFiller::find_triangles(const std::array<int, 3>& cell) {
  const auto [i, j, k] = cell;
  const Vec3d middle = corner_ + Vec3d(i + 0.5, j + 0.5, k + 0.5);
  const NearestPoint nearest = sieve_->nearest(of_part_, middle);
  if (nearest.squared > kHalfCell * kHalfCell + kSignSlack) return;
  sieve_->append(of_part_, middle, 0.5, nearest, at(triangles_, (k * kBlock + j) * kBlock + i));
}

}  // namespace contactscope
