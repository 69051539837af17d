#include "broadphase/broad_phase.h"

namespace contactscope {
namespace {

/// The reference: compares every box with every other one, n (n - 1) / 2 comparisons.
class BruteForce : public Clonable<BruteForce> {
  void find_pairs(BroadPhaseRecord* /*record*/) override {
    for (int i = 0; i < handles(); ++i)
      for (int j = i + 1; j < handles(); ++j) compare(i, j);
  }
};

void refuse_empty(const Aabb<float>& box) {
  if (box.empty()) throw std::invalid_argument("a box of a broad phase is empty or has NaN");
}

/// For a transformed point: three products and four sums of numbers up to `scale` below.
constexpr double kRoundings = 8;

/// World box of a shape before rounding.
template <class S> struct Reach {
  Pose<double> pose;
  Aabb<double> box{};
  double scale = 0;  // metres, largest number that the narrow phase adds for a point

  void add(const Vec3<S>& local, S radius = S(0)) {
    const Vec3d point = local.template cast<double>();
    const Vec3d center = pose.transform(point);
    const Vec3d around = Vec3d::Constant(static_cast<double>(radius));
    box.include(center - around);
    box.include(center + around);
    grow_scale(point.norm() + static_cast<double>(radius));
  }
  void grow_scale(double length) {
    scale = std::max(scale, length + pose.position.cwiseAbs().maxCoeff());
  }

  void operator()(const Sphere<S>& sphere) { add(Vec3<S>::Zero(), sphere.radius); }
  void operator()(const Capsule<S>& capsule) {
    for (const Vec3<S>& end : capsule.points) add(end, capsule.radius);
  }
  void operator()(const Hull<S>& hull) {
    for (const Vec3<S>& vertex : hull.vertices) add(vertex);
  }
  void operator()(const Mesh<S>& mesh) {
    const Aabb<S> bounds = mesh.tree.bounds();
    for (int corner = 0; corner < 8; ++corner) {
      Vec3<S> point;
      for (int axis = 0; axis < 3; ++axis)
        point[axis] = corner >> axis & 1 ? bounds.upper[axis] : bounds.lower[axis];
      add(point);
    }
  }
  void operator()(const Field<S>& field) { std::visit(*this, field.source->shape); }
  /// Infinite, except along an axis parallel to its normal.
  void operator()(const HalfSpace<S>& half_space) {
    constexpr double kNoEnd = std::numeric_limits<double>::infinity();
    const Plane<double> plane = half_space.plane.template cast<double>();
    const Vec3d normal = pose.rotate(plane.normal);
    const double offset = plane.offset + normal.dot(pose.position);
    box = {Vec3d::Constant(-kNoEnd), Vec3d::Constant(kNoEnd)};
    for (int axis = 0; axis < 3; ++axis) {
      if (normal[axis] == 1) box.upper[axis] = offset;
      if (normal[axis] == -1) box.lower[axis] = -offset;
    }
    grow_scale(std::abs(plane.offset));
  }
};

}  // namespace

// Each is defined in the file of its name.
BroadPhaseInfo grid_broad_phase(), sweep_and_prune_broad_phase(), octree_broad_phase(),
    tree_broad_phase(), columns_broad_phase();

const std::vector<BroadPhaseInfo>& broad_phases() {
  static const std::vector<BroadPhaseInfo> all = {
      info_of<BruteForce>("brute_force", "every box with every other one"),
      grid_broad_phase(),
      sweep_and_prune_broad_phase(),
      octree_broad_phase(),
      tree_broad_phase(),
      columns_broad_phase()};
  return all;
}

std::unique_ptr<BroadPhase> make_broad_phase(std::string_view name) {
  const auto found = std::ranges::find(broad_phases(), name, &BroadPhaseInfo::name);
  return found == broad_phases().end() ? nullptr : found->make();
}

bool is_bounded(const Aabb<float>& box) {
  return box.lower.minCoeff() >= -kLargestCoordinate && box.upper.maxCoeff() <= kLargestCoordinate;
}

Aabb<float> outward_box(const Aabb<double>& box) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Aabb<float> rounded = box.cast<float>();
  for (int i = 0; i < 3; ++i) {
    if (static_cast<double>(rounded.lower[i]) > box.lower[i])
      rounded.lower[i] = std::nextafter(rounded.lower[i], -kInfinity);
    if (static_cast<double>(rounded.upper[i]) < box.upper[i])
      rounded.upper[i] = std::nextafter(rounded.upper[i], kInfinity);
  }
  return rounded;
}

int BroadPhase::add(const Aabb<float>& box) {
  refuse_empty(box);
  boxes_.push_back(box);
  added(handles() - 1);
  return handles() - 1;
}

void BroadPhase::move(int handle, const Aabb<float>& box) {
  refuse_empty(box);
  at(boxes_, handle) = box;
  moved(handle);
}

void BroadPhase::compare_with_all(std::vector<int> large, BroadPhaseRecord* record) {
  std::ranges::sort(large);
  for (const int i : large) {
    for (int j = 0; j < handles(); ++j)
      if (j > i || (j < i && !std::ranges::binary_search(large, j))) compare(i, j);
  }
  if (record != nullptr) record->large = std::move(large);
}

const std::vector<BoxPair>& BroadPhase::pairs(BroadPhaseRecord* record) {
  if (record != nullptr) *record = {};
  found_.clear();
  find_pairs(record);
  sorter_.sort(found_, handles());
  return found_;
}

std::size_t BroadPhase::memory() const {
  return bytes_of(boxes_) + bytes_of(found_) + sorter_.memory() + own_memory();
}

void PairSorter::sort(std::vector<BoxPair>& pairs, int handles) {
  if (count_of(pairs) < handles / 4) {
    std::ranges::sort(pairs);
    return;
  }
  // Counting sort by b, then a stable one by a. Neither has unpredictable branches.
  const auto numbers = static_cast<std::size_t>(handles) + 1;
  first_of_a_.assign(numbers, 0);
  first_of_b_.assign(numbers, 0);
  for (const BoxPair& pair : pairs) {
    ++at(first_of_a_, pair.a + 1);
    ++at(first_of_b_, pair.b + 1);
  }
  std::partial_sum(first_of_a_.begin(), first_of_a_.end(), first_of_a_.begin());
  std::partial_sum(first_of_b_.begin(), first_of_b_.end(), first_of_b_.begin());
  by_b_.resize(pairs.size());
  for (const BoxPair& pair : pairs) at(by_b_, at(first_of_b_, pair.b)++) = pair;
  for (const BoxPair& pair : by_b_) at(pairs, at(first_of_a_, pair.a)++) = pair;
}

std::size_t PairSorter::memory() const {
  return sizeof(int) * (first_of_a_.capacity() + first_of_b_.capacity()) +
         sizeof(BoxPair) * by_b_.capacity();
}

template <class S>
Aabb<float> world_box(const Shape<S>& shape, const Pose<S>& pose, double margin) {
  Reach<S> reach{pose.template cast<double>()};
  std::visit(reach, shape);
  const double epsilon = static_cast<double>(std::numeric_limits<S>::epsilon());
  const Vec3d out = Vec3d::Constant(margin + kRoundings * epsilon * reach.scale);
  return outward_box({reach.box.lower - out, reach.box.upper + out});
}

template Aabb<float> world_box(const Shape<float>&, const Pose<float>&, double);
template Aabb<float> world_box(const Shape<double>&, const Pose<double>&, double);

}  // namespace contactscope
