#include <algorithm>
#include <cmath>

#include "core/at.h"
#include "field/field_builder.h"

namespace contactscope {

void FieldBuilder::fill_block(Block& block) {
  const auto [bx, by, bz] = block_at(at(blocks_, block.fine));
  block.corner = kBlock * Vec3d(bx, by, bz);
  block.nodes = fine_nodes(block.fine);
  copy_known(block);
  if (field_.core_)
    fill_by_core(block);
  else
    fill_by_triangles(block);
  spread_signs({kSide, kSide, kSide}, 1, block.nodes, block.signs,
               [&](int x, int y, int z) { return is_inside(block.corner + Vec3d(x, y, z)); });
  compare_sides(block);
  for (int i = 0; i < kNodes; ++i)
    if (at(block.signs, i) == NodeSign::Inside) at(block.nodes, i) = -at(block.nodes, i);
  add_pairs(block.nodes, kSide, field_.layouts_[1].step);
  if (!field_.settings_.exact) return;
  for (std::vector<int>& triangles : block.triangles) {
    field_.cell_triangles_.insert(field_.cell_triangles_.end(), triangles.begin(), triangles.end());
    field_.first_triangle_.push_back(static_cast<std::uint32_t>(field_.cell_triangles_.size()));
    triangles.clear();
  }
}

/// Copies the nodes that the coarse lattice and the blocks before have in common with a block, and their
/// signs.
void FieldBuilder::copy_known(Block& block) {
  const auto [bx, by, bz] = block_at(at(blocks_, block.fine));
  block.signs.fill(NodeSign::Unknown);
  block.known.fill(false);
  block.side.fill(0);
  const auto take = [&](int here, const Node& node) {
    const bool inside = std::signbit(node[0]);
    at(block.signs, here) = inside ? NodeSign::Inside : NodeSign::Outside;
    at(block.nodes, here) = inside ? -node : node;
    at(block.known, here) = true;
  };
  for (const int k : {0, kBlock})
    for (const int j : {0, kBlock})
      for (const int i : {0, kBlock})
        take(node_in_block(i, j, k),
             at(coarse_, coarse_number(bx + i / kBlock, by + j / kBlock, bz + k / kBlock)));
  const auto take_face = [&](int x, int y, int z, const auto& node) {
    if (x < 0 || y < 0 || z < 0) return;
    const int before = at(fine_of_block_, block_number(x, y, z));
    if (before < 0) return;
    const std::span<const Node> nodes = fine_nodes(before);
    for (int v = 0; v < kSide; ++v)
      for (int u = 0; u < kSide; ++u) take(node(u, v, 0), at(nodes, node(u, v, kBlock)));
  };
  take_face(bx - 1, by, bz, [](int u, int v, int w) { return node_in_block(w, u, v); });
  take_face(bx, by - 1, bz, [](int u, int v, int w) { return node_in_block(u, w, v); });
  take_face(bx, by, bz - 1, [](int u, int v, int w) { return node_in_block(u, v, w); });
}

/// Finds out whether fronts are outside: not everywhere, where the surface crosses itself, or parts of it
/// are inside out.
void FieldBuilder::compare_sides(const Block& block) {
  for (int i = 0; i < kNodes; ++i) {
    if (at(block.side, i) == 0) continue;
    const bool outside = at(block.signs, i) == NodeSign::Outside;
    fronts_[outside == (at(block.side, i) > 0) ? 1 : 0] = true;
  }
}

void FieldBuilder::fill_by_core(Block& block) {
  for (int k = 0; k < kSide; ++k)
    for (int j = 0; j < kSide; ++j)
      for (int i = 0; i < kSide; ++i)
        if (const int here = node_in_block(i, j, k); !at(block.known, here))
          at(block.nodes, here) = unsigned_node_of_core(block.corner + Vec3d(i, j, k));
  if (!field_.settings_.exact) return;
  for (int cell = 0; cell < kCells; ++cell) {
    const Vec3d middle(cell % kBlock + 0.5, cell / kBlock % kBlock + 0.5,
                       cell / (kBlock * kBlock) + 0.5);
    if (std::abs(field_.by_core(block.corner + middle).distance) <= kHalfCell + kSignSlack)
      at(block.triangles, cell).push_back(0);
  }
}

/// From the triangles that can be nearest to a point of the block those of small groups of nodes are taken,
/// and those of its eight parts where cells are to know theirs.
void FieldBuilder::fill_by_triangles(Block& block) {
  constexpr double kHalf = 0.5 * kBlock;
  sieve_->fill_around(block.corner + Vec3d::Constant(kHalf), kHalf, at(middles_, block.fine),
                      of_block_);
  constexpr int kGroups = kSide / 2 + 1;
  for (int k = 0; k < kGroups; ++k)
    for (int j = 0; j < kGroups; ++j)
      for (int i = 0; i < kGroups; ++i) fill_nodes(block, {i, j, k});
  if (!field_.settings_.exact) return;
  constexpr int kPart = kBlock / 2;
  for (const int k : {0, kPart})
    for (const int j : {0, kPart})
      for (const int i : {0, kPart}) find_triangles_of_part(block, {i, j, k});
}

/// A group has the nodes of a cell, or those of its last face or edge. Along an axis the first group is
/// the first node, which mostly is known from the block before, the others are pairs.
void FieldBuilder::fill_nodes(Block& block, const std::array<int, 3>& group) {
  const std::array<int, 3> last = {2 * group[0], 2 * group[1], 2 * group[2]};
  const auto first = [&](std::size_t axis) { return std::max(last[axis] - 1, 0); };
  const Vec3d of_block(last[0], last[1], last[2]);
  std::array<std::array<int, 3>, 8> open;
  std::size_t count = 0;
  for (int k = first(2); k <= last[2]; ++k)
    for (int j = first(1); j <= last[1]; ++j)
      for (int i = first(0); i <= last[0]; ++i)
        if (!at(block.known, node_in_block(i, j, k))) open[count++] = {i, j, k};
  if (count == 0) return;
  // To sift the block's triangles costs as much as to ask them for two nodes.
  TriangleSieve::List& list = count > 2 ? of_part_ : of_block_;
  if (count > 2) {
    const Vec3d middle = block.corner + of_block - Vec3d::Constant(0.5);
    sieve_->fill_within(of_block_, middle, 0.5, sieve_->nearest(of_block_, middle), list);
  }
  for (const auto& [i, j, k] : std::span(open).first(count)) {
    const int here = node_in_block(i, j, k);
    const Vec3d point = block.corner + Vec3d(i, j, k);
    at(block.known, here) = true;
    const NearestPoint nearest = sieve_->nearest(list, point);
    at(block.nodes, here) = unsigned_node(point, nearest);
    if (nearest.on_face && nearest.squared > kSignSlack * kSignSlack)
      at(block.side, here) = field_.triangles_.height_over(nearest.triangle, point) > 0 ? 1 : -1;
  }
}

/// A part from a node on: two cells along each axis.
void FieldBuilder::find_triangles_of_part(Block& block, const std::array<int, 3>& first) {
  const auto [x, y, z] = first;
  bool sifted = false;
  for (int k = z; k < z + 2; ++k) {
    for (int j = y; j < y + 2; ++j) {
      for (int i = x; i < x + 2; ++i) {
        if (!may_have_surface(block, {i, j, k})) continue;
        const Vec3d middle = block.corner + Vec3d(x + 1, y + 1, z + 1);
        if (!sifted)
          sieve_->fill_within(of_block_, middle, 1, sieve_->nearest(of_block_, middle), of_part_);
        sifted = true;
        find_triangles(block, {i, j, k});
      }
    }
  }
}

/// The middle of a cell is no nearer to the surface than a corner is, less half a diagonal.
bool FieldBuilder::may_have_surface(const Block& block, const std::array<int, 3>& cell) {
  const auto [i, j, k] = cell;
  for (const int w : {k, k + 1})
    for (const int v : {j, j + 1})
      for (const int u : {i, i + 1})
        if (at(block.nodes, node_in_block(u, v, w))[0] > 2 * kHalfCell + kSignSlack) return false;
  return true;
}

/// Where the surface may pass a cell, all triangles that can be nearest to a point of it.
void FieldBuilder::find_triangles(Block& block, const std::array<int, 3>& cell) {
  const auto [i, j, k] = cell;
  const Vec3d middle = block.corner + Vec3d(i + 0.5, j + 0.5, k + 0.5);
  const NearestPoint nearest = sieve_->nearest(of_part_, middle);
  if (nearest.squared > kHalfCell * kHalfCell + kSignSlack) return;
  sieve_->append(of_part_, middle, 0.5, nearest,
                 at(block.triangles, (k * kBlock + j) * kBlock + i));
}

}  // namespace contactscope
