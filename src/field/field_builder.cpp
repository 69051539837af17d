#include "field/field_builder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/at.h"
#include "core/input_error.h"
#include "query/winding.h"

namespace contactscope {
namespace {

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
  sieve_.emplace(field_.triangles_, size.maxCoeff());
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
      sizeof(NodePair) * DistanceField::kPairs + (field_.settings_.exact ? 4.0 * kCells : 0.0);
  const double bytes = nodes * sizeof(NodePair) + blocks * sizeof(int) + fine_blocks * per_block;
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
  lay_out();
  Block block;
  for (block.fine = 0; block.fine < count_of(blocks_); ++block.fine) fill_block(block);
  field_.front_ = winding_ < 0 ? -1 : 1;
  field_.regular_ = one_front_ && !(fronts_[0] && fronts_[1]);
  ask_triangles();
  return std::move(field_);
}

FieldBuilder::Node FieldBuilder::unsigned_node(const Vec3d& point,
                                               const NearestPoint& nearest) const {
  const double distance = std::sqrt(nearest.squared);
  const Vec3d gradient = distance > 0x1p-30 ? Vec3d((point - nearest.point) / distance)
                                            : field_.triangles_.normal(nearest.triangle);
  return Node{static_cast<float>(distance), static_cast<float>(gradient.x()),
              static_cast<float>(gradient.y()), static_cast<float>(gradient.z())};
}

FieldBuilder::Node FieldBuilder::unsigned_node_of_core(const Vec3d& point) const {
  const FieldSample sample = field_.by_core(point);
  const Node node{static_cast<float>(sample.distance), static_cast<float>(sample.gradient.x()),
                  static_cast<float>(sample.gradient.y()), static_cast<float>(sample.gradient.z())};
  return sample.distance < 0 ? -node : node;
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
  const std::size_t count = static_cast<std::size_t>(nx + 1) * static_cast<std::size_t>(ny + 1) *
                            static_cast<std::size_t>(nz + 1);
  coarse_.reserve(count);
  coarse_triangles_.reserve(count);
  for (int z = 0; z <= nz; ++z) {
    for (int y = 0; y <= ny; ++y) {
      for (int x = 0; x <= nx; ++x) {
        const Vec3d point = kBlock * Vec3d(x, y, z);
        if (field_.core_) {
          coarse_.push_back(unsigned_node_of_core(point));
          continue;
        }
        // The one before: of equally near triangles neighbours then take the same.
        const int seed = coarse_triangles_.empty() ? 0 : coarse_triangles_.back();
        const NearestPoint nearest = sieve_->nearest(point, seed);
        coarse_triangles_.push_back(nearest.triangle);
        coarse_.push_back(unsigned_node(point, nearest));
      }
    }
  }
}

void FieldBuilder::sign_coarse() {
  std::vector<NodeSign> signs(coarse_.size(), NodeSign::Unknown);
  const auto [nx, ny, nz] = field_.blocks_;
  spread_signs({nx + 1, ny + 1, nz + 1}, kBlock, coarse_, signs,
               [&](int x, int y, int z) { return is_inside(kBlock * Vec3d(x, y, z)); });
  for (std::size_t i = 0; i < signs.size(); ++i)
    if (signs[i] == NodeSign::Inside) coarse_[i] = -coarse_[i];
}

void FieldBuilder::choose_blocks() {
  const auto [nx, ny, nz] = field_.blocks_;
  const double reach = field_.settings_.band + kHalfBlock + kSignSlack;
  fine_of_block_.assign(
      static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny) * static_cast<std::size_t>(nz),
      -1);
  for (int z = 0; z < nz; ++z) {
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x) {
        // The middle is no nearer to the surface than a corner is, less half a diagonal.
        int seed = 0;
        float most = 0, least = std::numeric_limits<float>::infinity();
        for (int corner = 0; corner < 8; ++corner) {
          const int node =
              coarse_number(x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2));
          const float distance = std::abs(at(coarse_, node)[0]);
          most = std::max(most, distance);
          if (field_.core_ || distance >= least) continue;
          least = distance;
          seed = at(coarse_triangles_, node);
        }
        const bool dense = field_.settings_.band == 0;
        if (!dense && most - kHalfBlock > reach) continue;
        const Vec3d middle = kBlock * Vec3d(x + 0.5, y + 0.5, z + 0.5);
        NearestPoint nearest;
        if (field_.core_)
          nearest.squared = std::pow(field_.by_core(middle).distance, 2);
        else
          nearest = sieve_->nearest(middle, seed);
        if (!dense && nearest.squared > reach * reach) continue;
        at(fine_of_block_, block_number(x, y, z)) = count_of(blocks_);
        blocks_.push_back(block_number(x, y, z));
        middles_.push_back(nearest);
      }
    }
  }
}

/// Chooses the steps of the distances, so that all fit, and where the nodes of each block are.
void FieldBuilder::lay_out() {
  const auto [nx, ny, nz] = field_.blocks_;
  float most = 1;
  for (const Node& node : coarse_) most = std::max(most, std::abs(node[0]));
  // No fine node is farther from a coarse one than half the diagonal of a block.
  auto most_fine = static_cast<float>(most + kHalfBlock);
  if (field_.settings_.band > 0)
    most_fine = std::min(
        most_fine, static_cast<float>(field_.settings_.band + 2 * kHalfBlock + 2 * kSignSlack));
  field_.layouts_ = {NodeLayout(nx, std::ptrdiff_t{nx} * (ny + 1), 2, most),
                     NodeLayout(kBlock, kBlock * kSide, 0, most_fine)};
  field_.blocks_of_layer_ = nx * ny;
  field_.last_part_ = node_blend::parts_of(field_.size_);
  for (int i = 0; i < 3; ++i) --field_.last_part_[i];
  const std::size_t coarse_pairs = static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny + 1) *
                                   static_cast<std::size_t>(nz + 1);
  field_.nodes_.reserve(coarse_pairs + blocks_.size() * DistanceField::kPairs);
  add_pairs(coarse_, nx + 1, field_.layouts_[0].step);
  field_.coarse_count_ = count_of(field_.nodes_);
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x) {
        const int fine = at(fine_of_block_, block_number(x, y, z));
        const int first = fine < 0 ? (z * (ny + 1) + y) * nx + x
                                   : field_.coarse_count_ + fine * DistanceField::kPairs;
        field_.first_node_of_block_.push_back(2 * static_cast<std::uint32_t>(first) +
                                              (fine < 0 ? 0 : 1));
      }
  field_.fine_block_count_ = count_of(blocks_);
  // A block takes nodes from blocks of its layer and of the one below: older ones are written over.
  std::vector<int> of_layer(static_cast<std::size_t>(nz), 0);
  for (const int block : blocks_) ++at(of_layer, block_at(block)[2]);
  kept_blocks_ = 1;
  for (int z = 0; z < nz; ++z)
    kept_blocks_ = std::max(kept_blocks_, at(of_layer, z) + (z > 0 ? at(of_layer, z - 1) : 0));
  fine_.resize(static_cast<std::size_t>(kept_blocks_) * kNodes);
  if (field_.settings_.exact) field_.first_triangle_.push_back(0);
}

void FieldBuilder::add_pairs(std::span<const Node> nodes, int row, float step) {
  for (std::size_t first = 0; first < nodes.size(); first += static_cast<std::size_t>(row)) {
    FieldNode near = rounded_node(nodes[first], 1 / step);
    for (std::size_t i = 1; i < static_cast<std::size_t>(row); ++i) {
      const FieldNode far = rounded_node(nodes[first + i], 1 / step);
      field_.nodes_.emplace_back(near, far);
      near = far;
    }
  }
}

}  // namespace contactscope
