#include "field/field_builder.h"

#include "field/block_filler.h"
#include "field/closed_surface.h"
#include "query/winding.h"

namespace contactscope {
namespace {

/// Number of blocks, fine or not, that justify a thread.
constexpr int kBlocksOfThread = 256;

std::string in_mebibytes(double bytes) {
  return std::to_string(std::llround(std::ceil(bytes / 0x1p20))) + " MiB";
}

/// Placement of a shape's lattice.
struct Lattice {
  Vec3d origin, size;
  double cell;
};

/// Cells around the surface in a dense lattice; otherwise the band and one more.
constexpr int kDenseRim = 2;

Lattice lattice_around(const Aabb<double>& box, const FieldSettings& settings) {
  Lattice lattice;
  lattice.cell = box.extent().maxCoeff() / settings.cells;
  const int rim = settings.band > 0 ? settings.band + 1 : kDenseRim;
  for (int axis = 0; axis < 3; ++axis) {
    const double cells = std::ceil(box.extent()[axis] / lattice.cell) + 2 * rim;
    lattice.size[axis] = DistanceField::kBlock * std::ceil(cells / DistanceField::kBlock);
  }
  lattice.origin = box.center() - 0.5 * lattice.cell * lattice.size;
  return lattice;
}

PlacedField build_on_mesh(const Mesh<double>& mesh, const FieldSettings& settings) {
  ClosedSurface closed = close_surface(mesh);
  const Lattice lattice = lattice_around(closed.mesh.tree.bounds(), settings);
  const bool watertight = closed.mesh.triangle_count() == closed.own_triangles;
  auto surface = std::make_shared<Mesh<double>>(std::move(closed.mesh));
  for (Vec3d& vertex : surface->vertices) vertex = (vertex - lattice.origin) / lattice.cell;
  // The normals do not change.
  surface->tree.refit(surface->vertices, surface->triangles);
  FieldBuilder builder(std::move(surface), watertight, lattice.size, settings);
  return {std::make_shared<const DistanceField>(builder.build()), lattice.origin, lattice.cell};
}

PlacedField build_on_core(const Capsule<double>& core, const FieldSettings& settings) {
  Aabb<double> box;
  for (const Vec3d& end : core.points) {
    box.include(Vec3d(end - Vec3d::Constant(core.radius)));
    box.include(Vec3d(end + Vec3d::Constant(core.radius)));
  }
  const Lattice lattice = lattice_around(box, settings);
  Capsule<double> in_lattice{core.points, core.radius / lattice.cell};
  for (Vec3d& end : in_lattice.points) end = (end - lattice.origin) / lattice.cell;
  FieldBuilder builder(in_lattice, lattice.size, settings);
  return {std::make_shared<const DistanceField>(builder.build()), lattice.origin, lattice.cell};
}

}  // namespace

FieldBuilder::FieldBuilder(std::shared_ptr<const Mesh<double>> surface, bool watertight,
                           const Vec3d& size, const FieldSettings& settings) {
  fronts_.one = watertight;
  field_.settings_ = settings;
  field_.size_ = size;
  field_.surface_box_ = surface->tree.bounds();
  field_.triangles_ = NearestTriangles(std::move(surface));
  sieve_.emplace(field_.triangles_, size.maxCoeff() + 2 * kBlock);
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

int FieldBuilder::thread_count() const {
  if (field_.settings_.threads > 0) return field_.settings_.threads;
  const int blocks = field_.blocks_[0] * field_.blocks_[1] * field_.blocks_[2];
  return std::clamp(blocks / kBlocksOfThread, 1, hardware_threads());
}

DistanceField FieldBuilder::build() {
  for (std::size_t i = 0; i < 3; ++i)
    field_.blocks_[i] = static_cast<int>(field_.size_[static_cast<int>(i)]) / kBlock;
  const bool dense = field_.settings_.band == 0;
  const double all_blocks = double{1} * field_.blocks_[0] * field_.blocks_[1] * field_.blocks_[2];
  check_bytes(dense ? all_blocks : 0);
  workers_.emplace(thread_count());
  survey();
  sign_coarse();
  number_blocks();
  check_bytes(count_of(blocks_));
  lay_out();
  fill_blocks();
  return std::move(field_);
}

void FieldBuilder::Fronts::add_winding(int number) {
  if (number == 0) return;
  if ((winding != 0 && number != winding) || std::abs(number) != 1) one = false;
  winding = number;
}

void FieldBuilder::Fronts::add(const Fronts& other) {
  one = one && other.one;
  add_winding(other.winding);
  for (std::size_t side = 0; side < 2; ++side) seen[side] = seen[side] || other.seen[side];
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

bool FieldBuilder::is_inside(const Vec3d& point, Fronts& fronts) const {
  if (field_.core_) return field_.by_core(point).distance < 0;
  const Winding winding = winding_number(field_.triangles_.mesh(), point);
  if (winding.on_surface) return false;
  fronts.add_winding(winding.number);
  return winding.number != 0;
}

void FieldBuilder::sign_coarse() {
  std::vector<NodeSign> signs(coarse_.size(), NodeSign::Unknown);
  const auto [nx, ny, nz] = field_.blocks_;
  spread_signs({nx + 1, ny + 1, nz + 1}, kBlock, coarse_, signs,
               [&](int x, int y, int z) { return is_inside(kBlock * Vec3d(x, y, z), fronts_); });
  for (std::size_t i = 0; i < signs.size(); ++i)
    if (signs[i] == NodeSign::Inside) coarse_[i] = -coarse_[i];
}

void FieldBuilder::number_blocks() {
  const int of_layer = field_.blocks_[0] * field_.blocks_[1];
  layers_ = std::vector<Layer>(static_cast<std::size_t>(field_.blocks_[2]));
  for (int z = 0; z < count_of(layers_); ++z) {
    at(layers_, z).first = count_of(blocks_);
    for (int block = z * of_layer; block < (z + 1) * of_layer; ++block) {
      fine_of_block_.push_back(at(near_, block) ? count_of(blocks_) : -1);
      if (at(near_, block)) blocks_.push_back(block);
    }
    at(layers_, z).end = count_of(blocks_);
  }
}

/// Chooses the distance steps, so that all distances fit, and the place of each block's nodes.
void FieldBuilder::lay_out() {
  const auto [nx, ny, nz] = field_.blocks_;
  float most = 1;
  for (const Node& node : coarse_) most = std::max(most, std::abs(node[0]));
  // Fine nodes are at most half a block's diagonal from a coarse node.
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
  field_.nodes_.resize(coarse_pairs + blocks_.size() * DistanceField::kPairs);
  write_pairs(coarse_, nx + 1, field_.layouts_[0].step, field_.nodes_.data());
  field_.coarse_count_ = static_cast<int>(coarse_pairs);
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
}

/// Allocates unrounded nodes for the layers that are filled at a time, and the one below.
void FieldBuilder::make_room() {
  kept_blocks_ = 1;
  for (int z = 0; z < count_of(layers_); ++z) {
    const int last = std::min(z + workers_->count(), count_of(layers_) - 1);
    kept_blocks_ = std::max(kept_blocks_, at(layers_, last).end - at(layers_, z).first);
  }
  fine_.resize(static_cast<std::size_t>(kept_blocks_) * kNodes);
}

void FieldBuilder::Layer::fill_rows_to(int y) {
  filled_rows = y;
  filled_rows.notify_all();
}

void FieldBuilder::Layer::wait_for_row(int y) const {
  for (int filled = filled_rows; filled <= y; filled = filled_rows) filled_rows.wait(filled);
}

void FieldBuilder::fill_layer(int z, BlockFiller& filler) {
  Layer& layer = at(layers_, z);
  int filled = 0;
  try {
    for (int fine = layer.first; fine < layer.end; ++fine) {
      const int y = block_at(at(blocks_, fine))[1];
      if (y > filled) layer.fill_rows_to(filled = y);
      if (z > 0) at(layers_, z - 1).wait_for_row(y);
      filler.fill(fine, layer);
    }
  } catch (...) {
    layer.fill_rows_to(field_.blocks_[1]);  // so that no thread waits forever
    throw;
  }
  // When this layer is filled, the one below is no longer needed: its memory may be reused.
  if (z > 0) at(layers_, z - 1).wait_for_row(field_.blocks_[1] - 1);
  layer.fill_rows_to(field_.blocks_[1]);
}

void FieldBuilder::fill_blocks() {
  make_room();
  std::vector<BlockFiller> fillers(static_cast<std::size_t>(workers_->count()), BlockFiller(*this));
  workers_->for_each(count_of(layers_),
                     [&](int z, int worker) { fill_layer(z, at(fillers, worker)); });
  for (const Layer& layer : layers_) fronts_.add(layer.fronts);
  field_.front_ = fronts_.winding < 0 ? -1 : 1;
  field_.regular_ = fronts_.one && !(fronts_.seen[0] && fronts_.seen[1]);
  if (!field_.settings_.exact) return;
  gather_triangles();
  workers_->for_each(count_of(layers_), [&](int z, int worker) {
    for (int fine = at(layers_, z).first; fine < at(layers_, z).end; ++fine)
      at(fillers, worker).query_triangles(fine);
  });
}

void FieldBuilder::gather_triangles() {
  std::size_t all = 0;
  for (const Layer& layer : layers_) all += layer.triangles.size();
  field_.cell_triangles_.reserve(all);
  field_.first_triangle_.reserve(blocks_.size() * kCells + 1);
  std::uint32_t first = 0;
  field_.first_triangle_.push_back(first);
  for (Layer& layer : layers_) {
    for (const std::uint32_t count : layer.counts) field_.first_triangle_.push_back(first += count);
    field_.cell_triangles_.insert(field_.cell_triangles_.end(), layer.triangles.begin(),
                                  layer.triangles.end());
    layer.triangles = {};
  }
}

void FieldBuilder::write_pairs(std::span<const Node> nodes, int row, float step, NodePair* to) {
  for (std::size_t first = 0; first < nodes.size(); first += static_cast<std::size_t>(row)) {
    FieldNode near = rounded_node(nodes[first], 1 / step);
    for (std::size_t i = 1; i < static_cast<std::size_t>(row); ++i) {
      const FieldNode far = rounded_node(nodes[first + i], 1 / step);
      *to++ = NodePair(near, far);
      near = far;
    }
  }
}

PlacedField build_distance_field(const Shape<double>& shape, const FieldSettings& settings) {
  if (settings.cells < kFewestFieldCells || settings.cells > kMaxFieldCells)
    throw ShapeError("a field has " + std::to_string(kFewestFieldCells) + " to " +
                     std::to_string(kMaxFieldCells) + " cells along its longest side");
  if (settings.band < 0) throw ShapeError("the band of a field is 1 cell or more; 0 is dense");
  if (const auto* sphere = std::get_if<Sphere<double>>(&shape))
    return build_on_core({{Vec3d::Zero(), Vec3d::Zero()}, sphere->radius}, settings);
  if (const auto* capsule = std::get_if<Capsule<double>>(&shape))
    return build_on_core(*capsule, settings);
  if (const auto* hull = std::get_if<Hull<double>>(&shape)) {
    if (hull->flat()) throw ShapeError("a flat hull has no inside; give one with a volume");
    return build_on_mesh(surface_of(*hull), settings);
  }
  if (const auto* mesh = std::get_if<Mesh<double>>(&shape)) return build_on_mesh(*mesh, settings);
  throw ShapeError("a plane is infinite, and a lattice is not; give a box or a mesh instead");
}

}  // namespace contactscope
