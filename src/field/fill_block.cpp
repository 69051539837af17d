#include "field/block_filler.h"

namespace contactscope {

void BlockFiller::fill(int fine, FieldBuilder::Layer& layer) {
  const auto [bx, by, bz] = shared_.block_at(at(shared_.blocks_, fine));
  corner_ = kBlock * Vec3d(bx, by, bz);
  nodes_ = shared_.fine_nodes(fine);
  copy_known(fine);
  if (field_.core_)
    fill_by_core();
  else
    fill_by_triangles(*at(shared_.near_, at(shared_.blocks_, fine)));
  spread_signs({kSide, kSide, kSide}, 1, nodes_, signs_, [&](int x, int y, int z) {
    return shared_.is_inside(corner_ + Vec3d(x, y, z), layer.fronts);
  });
  compare_sides(layer.fronts);
  for (int i = 0; i < kNodes; ++i)
    if (at(signs_, i) == NodeSign::Inside) at(nodes_, i) = -at(nodes_, i);
  FieldBuilder::write_pairs(nodes_, kSide, field_.layouts_[1].step, pairs_of(fine));
  if (!field_.settings_.exact) return;
  for (std::vector<int>& triangles : triangles_) {
    layer.counts.push_back(static_cast<std::uint32_t>(triangles.size()));
    layer.triangles.insert(layer.triangles.end(), triangles.begin(), triangles.end());
    triangles.clear();
  }
}

/// Copies the nodes and signs that a block shares with the coarse lattice and earlier blocks.
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
  constexpr std::array<int, 3> kStep = {1, kSide, kSide * kSide};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (here[axis] == 0) continue;
    std::array<int, 3> next = here;
    --next[axis];
    const int before = at(shared_.fine_of_block_, shared_.block_number(next[0], next[1], next[2]));
    if (before < 0) continue;
    const std::span<const Node> nodes = shared_.fine_nodes(before);
    const int along = kStep[(axis + 1) % 3], across = kStep[(axis + 2) % 3];
    for (int v = 0; v < kSide; ++v)
      for (int u = 0; u < kSide; ++u)
        take(u * along + v * across, at(nodes, kBlock * kStep[axis] + u * along + v * across));
  }
}

/// Finds whether fronts are outside: not if the surface crosses itself or is inside out in parts.
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

void BlockFiller::fill_by_triangles(const FieldBuilder::NearBlock& near) {
  sieve_->fill(near.triangles, of_block_);
  last_ = near.to_middle.point;
  for (const int k : {0, 1})
    for (const int j : {0, 1})
      for (const int i : {0, 1}) fill_part({i, j, k});
}

/// Fills a part, two cells along each axis, and sifts its triangles for groups of nodes and cells.
void BlockFiller::fill_part(const std::array<int, 3>& part) {
  const auto [x, y, z] = part;
  part_middle_ = corner_ + Vec3d(2 * x + 1, 2 * y + 1, 2 * z + 1);
  part_sifted_ = false;
  // Groups along an axis: the first node, usually known from the block before, then pairs.
  for (int k = 2 * z; k <= z + 1; ++k)
    for (int j = 2 * y; j <= y + 1; ++j)
      for (int i = 2 * x; i <= x + 1; ++i) fill_nodes({i, j, k});
  if (!field_.settings_.exact) return;
  for (const int k : {2 * z, 2 * z + 1})
    for (const int j : {2 * y, 2 * y + 1})
      for (const int i : {2 * x, 2 * x + 1})
        if (may_have_surface({i, j, k})) find_triangles({i, j, k});
}

/// The triangles that can be nearest to a point of the part.
TriangleSieve::List& BlockFiller::triangles_of_part() {
  if (!part_sifted_) sieve_->fill_within(of_block_, part_middle_, 1, last_, of_part_);
  part_sifted_ = true;
  return of_part_;
}

/// Fills a group: the nodes of a cell, or of its last face or edge.
void BlockFiller::fill_nodes(const std::array<int, 3>& group) {
  const std::array<int, 3> last = {2 * group[0], 2 * group[1], 2 * group[2]};
  const auto first = [&](std::size_t axis) { return std::max(last[axis] - 1, 0); };
  std::array<std::array<int, 3>, 8> open;
  std::size_t count = 0;
  for (int k = first(2); k <= last[2]; ++k)
    for (int j = first(1); j <= last[1]; ++j)
      for (int i = first(0); i <= last[0]; ++i)
        if (!at(known_, node_in_block(i, j, k))) open[count++] = {i, j, k};
  if (count == 0) return;
  TriangleSieve::List* list = of_block_.leaning() ? &of_block_ : &triangles_of_part();
  // Sifting costs as much as queries for four nodes.
  if (count > 4) {
    const Vec3d middle = corner_ + Vec3d(last[0], last[1], last[2]) - Vec3d::Constant(0.5);
    sieve_->fill_within(*list, middle, 0.5, last_, of_group_);
    list = &of_group_;
  }
  for (const auto& [i, j, k] : std::span(open).first(count)) {
    const int here = node_in_block(i, j, k);
    const Vec3d point = corner_ + Vec3d(i, j, k);
    const NearestPoint nearest = sieve_->nearest(*list, point);
    last_ = nearest.point;
    at(known_, here) = true;
    at(nodes_, here) = shared_.unsigned_node(point, nearest);
    if (nearest.on_face && nearest.squared > kSignSlack * kSignSlack)
      at(side_, here) = field_.triangles_.height_over(nearest.triangle, point) > 0 ? 1 : -1;
  }
}

/// The middle of a cell is no nearer to the surface than a corner, minus half a diagonal.
bool BlockFiller::may_have_surface(const std::array<int, 3>& cell) const {
  const auto [i, j, k] = cell;
  for (const int w : {k, k + 1})
    for (const int v : {j, j + 1})
      for (const int u : {i, i + 1})
        if (at(nodes_, node_in_block(u, v, w))[0] > 2 * kHalfCell + kSignSlack) return false;
  return true;
}

/// If the surface may pass through a cell, finds all triangles that can be nearest to its points.
void BlockFiller::find_triangles(const std::array<int, 3>& cell) {
  const auto [i, j, k] = cell;
  const Vec3d middle = corner_ + Vec3d(i + 0.5, j + 0.5, k + 0.5);
  TriangleSieve::List& list = triangles_of_part();
  const NearestPoint nearest = sieve_->nearest(list, middle);
  if (nearest.squared > kHalfCell * kHalfCell + kSignSlack) return;
  sieve_->append(list, middle, 0.5, nearest.point, at(triangles_, (k * kBlock + j) * kBlock + i));
}

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
/// surface in the cell once, from inside to outside: no plate or gap is within the cell.
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
