#include "field/field_builder.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/at.h"
#include "core/input_error.h"
#include "query/winding.h"

namespace contactscope {
namespace {

constexpr int kBlock = DistanceField::kBlock;
constexpr int kSide = DistanceField::kSide;
constexpr int kNodes = DistanceField::kNodes;

// Half the diagonal of a cell and of a block, rounded up.
constexpr double kHalfCell = 0.8660254037844388;
constexpr double kHalfBlock = kBlock * kHalfCell;

/// What rounding may add to two distances of nodes, cells.
constexpr double kSlack = 0x1p-12;

enum class Sign : std::uint8_t { Unknown, Outside, Inside };

/// Gives each node the sign of a neighbour, next to it along axes or diagonals, to which the surface
/// leaves a way: their distances together are larger than the one between them, `side` times the
/// lattice's. Where no known node does so, the sign of one unknown node is asked. `nodes` are distances
/// without sign, x first.
template <class Node, class IsInside>
void spread_signs(const std::array<int, 3>& counts, double side, const Node* nodes,
                  std::vector<Sign>& signs, const IsInside& is_inside) {
  const auto index = [&](int x, int y, int z) { return (z * counts[1] + y) * counts[0] + x; };
  std::vector<std::array<int, 3>> open;
  const auto spread = [&] {
    while (!open.empty()) {
      const auto [x, y, z] = open.back();
      open.pop_back();
      const int from = index(x, y, z);
      for (int w = std::max(z - 1, 0); w <= std::min(z + 1, counts[2] - 1); ++w) {
        for (int v = std::max(y - 1, 0); v <= std::min(y + 1, counts[1] - 1); ++v) {
          for (int u = std::max(x - 1, 0); u <= std::min(x + 1, counts[0] - 1); ++u) {
            const int to = index(u, v, w);
            if (at(signs, to) != Sign::Unknown) continue;
            constexpr double kWays[] = {0, 1, 1.4142135623730951, 1.7320508075688772};
            const int axes = (u != x) + (v != y) + (w != z);
            if (nodes[from][0] + nodes[to][0] <= side * kWays[axes] + kSlack) continue;
            at(signs, to) = at(signs, from);
            open.push_back({u, v, w});
          }
        }
      }
    }
  };
  for (int z = 0; z < counts[2]; ++z)
    for (int y = 0; y < counts[1]; ++y)
      for (int x = 0; x < counts[0]; ++x)
        if (at(signs, index(x, y, z)) != Sign::Unknown) open.push_back({x, y, z});
  spread();
  for (int z = 0; z < counts[2]; ++z) {
    for (int y = 0; y < counts[1]; ++y) {
      for (int x = 0; x < counts[0]; ++x) {
        Sign& sign = at(signs, index(x, y, z));
        if (sign != Sign::Unknown) continue;
        sign = is_inside(x, y, z) ? Sign::Inside : Sign::Outside;
        open.push_back({x, y, z});
        spread();
      }
    }
  }
}

std::string in_mebibytes(double bytes) {
  return std::to_string(std::llround(std::ceil(bytes / 0x1p20))) + " MiB";
}

}  // namespace

FieldBuilder::FieldBuilder(std::shared_ptr<const Mesh<double>> surface, bool watertight,
                           const Vec3d& size, const FieldSettings& settings)
    : one_front_(watertight) {
  field_.settings_ = settings;
  field_.size_ = size;
  field_.surface_box_ = surface->tree.bounds();
  field_.triangles_ = NearestTriangles(std::move(surface));
}

FieldBuilder::FieldBuilder(const Capsule<double>& core, const Vec3d& size,
                           const FieldSettings& settings) {
  field_.settings_ = settings;
  field_.size_ = size;
  for (const Vec3d& end : core.points) {
    field_.surface_box_.include(Vec3d(end - Vec3d::Constant(core.radius)));
    field_.surface_box_.include(Vec3d(end + Vec3d::Constant(core.radius)));
  }
  field_.core_ = core;
}

void FieldBuilder::check_bytes(double fine_blocks) const {
  double blocks = 1, nodes = 1;
  for (const int count : field_.blocks_) {
    blocks *= count;
    nodes *= count + 1;
  }
  const double per_block =
      sizeof(Node) * kNodes + (field_.settings_.exact ? 4.0 * DistanceField::kCells : 0.0);
  const double bytes = nodes * sizeof(Node) + blocks * sizeof(int) + fine_blocks * per_block;
  if (bytes > static_cast<double>(field_.settings_.most_bytes))
    throw ShapeError("a field of " + std::to_string(field_.settings_.cells) +
                     " cells along its longest side takes " + in_mebibytes(bytes) + " (" +
                     std::to_string(std::llround(bytes)) + " bytes), and " +
                     in_mebibytes(static_cast<double>(field_.settings_.most_bytes)) +
                     " are allowed; give fewer 'cells', or a narrower 'band'");
}

DistanceField FieldBuilder::build() {
  for (std::size_t i = 0; i < 3; ++i)
    field_.blocks_[i] = static_cast<int>(field_.size_[static_cast<int>(i)]) / kBlock;
  const bool dense = field_.settings_.band == 0;
  const double all_blocks = double{1} * field_.blocks_[0] * field_.blocks_[1] * field_.blocks_[2];
  check_bytes(dense ? all_blocks : 0);
  fill_coarse();
  sign_coarse();
  choose_blocks();
  check_bytes(count_of(blocks_));
  field_.fine_block_count_ = count_of(blocks_);
  field_.fine_.resize(blocks_.size() * kNodes);
  for (int fine = 0; fine < count_of(blocks_); ++fine) fill_block(fine);
  field_.front_ = winding_ < 0 ? -1 : 1;
  field_.regular_ = one_front_;
  return std::move(field_);
}

FieldBuilder::Node FieldBuilder::unsigned_node(const Vec3d& point, int& seed) const {
  double distance;
  Vec3d gradient;
  if (field_.core_) {
    const FieldSample sample = field_.by_core(point);
    distance = std::abs(sample.distance);
    gradient = sample.distance < 0 ? Vec3d(-sample.gradient) : sample.gradient;
  } else {
    const NearestPoint nearest = field_.triangles_.nearest(point, seed);
    seed = nearest.triangle;
    distance = std::sqrt(nearest.squared);
    gradient = distance > 0x1p-30 ? Vec3d((point - nearest.point) / distance)
                                  : field_.triangles_.normal(seed);
  }
  return Node{static_cast<float>(distance), static_cast<float>(gradient.x()),
              static_cast<float>(gradient.y()), static_cast<float>(gradient.z())};
}

bool FieldBuilder::is_inside(const Vec3d& point) {
  if (field_.core_) return field_.by_core(point).distance < 0;
  const Winding winding = winding_number(field_.triangles_.mesh(), point);
  if (winding.on_surface) return false;
  if (winding.number != 0) {
    if (winding_ != 0 && winding.number != winding_) one_front_ = false;
    if (std::abs(winding.number) != 1) one_front_ = false;
    winding_ = winding.number;
  }
  return winding.number != 0;
}

void FieldBuilder::fill_coarse() {
  const auto [nx, ny, nz] = field_.blocks_;
  field_.coarse_.reserve(static_cast<std::size_t>(nx + 1) * static_cast<std::size_t>(ny + 1) *
                         static_cast<std::size_t>(nz + 1));
  int seed = -1;
  for (int z = 0; z <= nz; ++z)
    for (int y = 0; y <= ny; ++y)
      for (int x = 0; x <= nx; ++x)
        field_.coarse_.push_back(unsigned_node(kBlock * Vec3d(x, y, z), seed));
}

void FieldBuilder::sign_coarse() {
  std::vector<Sign> signs(field_.coarse_.size(), Sign::Unknown);
  const auto [nx, ny, nz] = field_.blocks_;
  spread_signs({nx + 1, ny + 1, nz + 1}, kBlock, field_.coarse_.data(), signs,
               [&](int x, int y, int z) { return is_inside(kBlock * Vec3d(x, y, z)); });
  for (std::size_t i = 0; i < signs.size(); ++i)
    if (signs[i] == Sign::Inside) turn_inside(field_.coarse_[i]);
}

void FieldBuilder::choose_blocks() {
  const auto [nx, ny, nz] = field_.blocks_;
  const double reach = field_.settings_.band + kHalfBlock + kSlack;
  field_.fine_of_block_.assign(
      static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny) * static_cast<std::size_t>(nz),
      -1);
  int seed = -1;
  for (int z = 0; z < nz; ++z) {
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x) {
        if (field_.settings_.band > 0) {
          // The centre is no nearer to the surface than a corner is, less half a diagonal.
          if (std::abs(coarse_node(x, y, z)[0]) - kHalfBlock > reach) continue;
          const Vec3d center = kBlock * Vec3d(x + 0.5, y + 0.5, z + 0.5);
          if (unsigned_node(center, seed)[0] > reach) continue;
        }
        at(field_.fine_of_block_, block_number(x, y, z)) = count_of(blocks_);
        blocks_.push_back(block_number(x, y, z));
      }
    }
  }
}

/// Distances of the nodes of a block. What the blocks before it have in common with it is copied.
void FieldBuilder::fill_block(int fine) {
  const auto [bx, by, bz] = block_at(at(blocks_, fine));
  Node* nodes = fine_nodes(fine);
  std::vector<Sign> signs(kNodes, Sign::Unknown);
  const auto fine_of = [&](int x, int y, int z) {
    return x < 0 || y < 0 || z < 0 ? -1 : at(field_.fine_of_block_, block_number(x, y, z));
  };
  const std::array<int, 3> before = {fine_of(bx - 1, by, bz), fine_of(bx, by - 1, bz),
                                     fine_of(bx, by, bz - 1)};
  const auto index = [](int i, int j, int k) { return (k * kSide + j) * kSide + i; };
  int seed = -1;
  for (int k = 0; k < kSide; ++k) {
    for (int j = 0; j < kSide; ++j) {
      for (int i = 0; i < kSide; ++i) {
        const int here = index(i, j, k);
        const Node* known = nullptr;
        if (i % kBlock == 0 && j % kBlock == 0 && k % kBlock == 0)
          known = &coarse_node(bx + i / kBlock, by + j / kBlock, bz + k / kBlock);
        else if (i == 0 && before[0] >= 0)
          known = fine_nodes(before[0]) + index(kBlock, j, k);
        else if (j == 0 && before[1] >= 0)
          known = fine_nodes(before[1]) + index(i, kBlock, k);
        else if (k == 0 && before[2] >= 0)
          known = fine_nodes(before[2]) + index(i, j, kBlock);
        if (known == nullptr) {
          nodes[here] = unsigned_node(kBlock * Vec3d(bx, by, bz) + Vec3d(i, j, k), seed);
          continue;
        }
        const bool inside = std::signbit((*known)[0]);
        at(signs, here) = inside ? Sign::Inside : Sign::Outside;
        nodes[here] = inside ? -*known : *known;
      }
    }
  }
  const Vec3d corner = kBlock * Vec3d(bx, by, bz);
  spread_signs({kSide, kSide, kSide}, 1, nodes, signs,
               [&](int x, int y, int z) { return is_inside(corner + Vec3d(x, y, z)); });
  if (field_.settings_.exact) find_triangles(corner, nodes);
  for (int i = 0; i < kNodes; ++i)
    if (at(signs, i) == Sign::Inside) turn_inside(nodes[i]);
}

/// For each cell that the surface may pass all triangles that can be nearest to a point of it. From its
/// centre, which has the distance d, no such triangle is farther than d and a diagonal.
void FieldBuilder::find_triangles(const Vec3d& corner, const Node* nodes) {
  std::vector<std::uint32_t>& first = field_.first_triangle_;
  if (first.empty()) first.push_back(0);
  int seed = -1;
  for (int k = 0; k < kBlock; ++k) {
    for (int j = 0; j < kBlock; ++j) {
      for (int i = 0; i < kBlock; ++i) {
        const float at_corner = nodes[(k * kSide + j) * kSide + i][0];
        if (at_corner <= 2 * kHalfCell + kSlack) {
          const Vec3d center = corner + Vec3d(i + 0.5, j + 0.5, k + 0.5);
          const double distance = unsigned_node(center, seed)[0] + kSlack;
          if (distance <= kHalfCell + 2 * kSlack) {
            const double reach = distance + 2 * kHalfCell + kSlack;
            if (field_.core_)
              field_.cell_triangles_.push_back(0);
            else
              field_.triangles_.within(center, reach * reach, field_.cell_triangles_);
          }
        }
        first.push_back(static_cast<std::uint32_t>(field_.cell_triangles_.size()));
      }
    }
  }
}

}  // namespace contactscope
