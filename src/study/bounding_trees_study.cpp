#include <Eigen/Eigenvalues>

#include "query/overlap.h"
#include "query/triangle_overlap.h"
#include "study/random_cases.h"
#include "study/study.h"

namespace contactscope {
namespace {

constexpr int kGapsInMillimetres[] = {3, 10, 30, 100, 300};
constexpr int kTreeRepetitions = 5;
constexpr int kBallMeridians = 48;

using TriangleList = std::vector<Triangle<float>>;

constexpr float kSlabNormals[9][3] = {{1, 0, 0}, {0, 1, 0},  {0, 0, 1},  {1, 1, 0}, {1, 0, 1},
                                      {0, 1, 1}, {1, -1, 0}, {1, 0, -1}, {0, 1, -1}};

/// The space between N pairs of planes with fixed normals: 3 are an axis-aligned box. Klosowski et
/// al. 1998, "Efficient Collision Detection Using Bounding Volume Hierarchies of k-DOPs".
template <std::size_t N> struct Slabs {
  std::array<float, N> lower, upper;

  explicit Slabs(const std::vector<Vec3f>& points) {
    for (std::size_t k = 0; k < N; ++k) {
      const std::vector<float> along = mapped(points, [&](const Vec3f& point) {
        return point.dot(Eigen::Map<const Vec3f>(kSlabNormals[k]));
      });
      std::tie(lower[k], upper[k]) = std::pair(std::ranges::min(along), std::ranges::max(along));
    }
  }
  bool overlaps(const Slabs& other) const {
    for (std::size_t k = 0; k < N; ++k)
      if (lower[k] > other.upper[k] || other.lower[k] > upper[k]) return false;
    return true;
  }
};

/// A box along the principal axes of its points. Gottschalk, Lin and Manocha 1996, "OBBTree".
struct OrientedBox {
  static constexpr float kRounding = 1e-5f;  // metres: the axes are not exactly orthogonal
  Obb<float> box;

  explicit OrientedBox(const std::vector<Vec3f>& points) {
    const Vec3f sum = std::accumulate(points.begin(), points.end(), Vec3f(Vec3f::Zero()));
    const Vec3f mean = sum / static_cast<float>(points.size());
    Mat3<float> spread = Mat3<float>::Zero();
    for (const Vec3f& point : points) spread += (point - mean) * (point - mean).transpose();
    box.axes = Eigen::SelfAdjointEigenSolver<Mat3<float>>(spread).eigenvectors();
    Aabb<float> own;
    for (const Vec3f& point : points) own.include(Vec3f(box.axes.transpose() * point));
    box.center = box.axes * own.center();
    box.half_extents = 0.5f * own.extent() + Vec3f::Constant(kRounding);
  }
  bool overlaps(const OrientedBox& other) const {
    return contactscope::overlaps(box, other.box, Comparison<float>::inclusive());
  }
};

// The sizes in README.md.
static_assert(sizeof(Slabs<3>) == 24 && sizeof(OrientedBox) == 60 && sizeof(Slabs<9>) == 72);

/// A binary tree, split at the median along the longest side: the same nodes for every volume.
template <class Volume> struct VolumeTree {
  struct Node {
    Volume volume;
    std::size_t count;
    Triangle<float> first;
    std::array<int, 2> children{-1, -1};
  };
  std::vector<Node> nodes;

  explicit VolumeTree(TriangleList triangles) { build(triangles); }

  int build(std::span<Triangle<float>> triangles) {
    std::vector<Vec3f> points;
    Aabb<float> bounds;
    for (const Triangle<float>& triangle : triangles)
      points.insert(points.end(), triangle.begin(), triangle.end());
    for (const Vec3f& point : points) bounds.include(point);
    const int place = count_of(nodes);
    nodes.push_back({Volume(points), triangles.size(), triangles[0]});
    if (triangles.size() == 1) return place;
    int axis = 0;
    bounds.extent().maxCoeff(&axis);
    const std::size_t half = triangles.size() / 2;
    std::ranges::nth_element(
        triangles, triangles.begin() + static_cast<std::ptrdiff_t>(half), {},
        [&](const Triangle<float>& t) { return t[0][axis] + t[1][axis] + t[2][axis]; });
    const int left = build(triangles.first(half)), right = build(triangles.subspan(half));
    at(nodes, place).children = {left, right};
    return place;
  }

  /// Calls leaf(triangle, triangle of other) where volumes overlap. Returns the number of tests.
  template <class Leaf> int query(const VolumeTree& other, const Leaf& leaf) const {
    int tests = 0;
    std::vector<std::pair<int, int>> open{{0, 0}};
    while (!open.empty()) {
      const auto [a, b] = open.back();
      open.pop_back();
      ++tests;
      const Node &of_a = at(nodes, a), &of_b = at(other.nodes, b);
      if (!of_a.volume.overlaps(of_b.volume)) continue;
      if (of_a.count == 1 && of_b.count == 1) leaf(of_a.first, of_b.first);
      for (const int child : of_a.count >= of_b.count ? of_a.children : of_b.children)
        if (child >= 0)
          open.push_back(of_a.count >= of_b.count ? std::pair(child, b) : std::pair(a, child));
    }
    return tests;
  }
};

TriangleList turned_ball(double radius, const Vec3d& center, const Quatd& rotation) {
  const Mesh<double> mesh = ball_mesh(kBallMeridians, radius);
  return mapped(mesh.triangles, [&](const std::array<int, 3>& corners) {
    Triangle<float> triangle;
    for (std::size_t k = 0; k < 3; ++k)
      triangle[k] = (rotation * at(mesh.vertices, corners[k]) + center).cast<float>();
    return triangle;
  });
}

/// Pairs of triangles that share a point and that the trees find.
template <class Volume> int shared_by_trees(const TriangleList& one, const TriangleList& other) {
  int found = 0;
  VolumeTree<Volume>(one).query(VolumeTree<Volume>(other), [&](const auto& a, const auto& b) {
    found += triangle_overlap_kind<float>(a, b) != TriangleOverlapKind::None;
  });
  return found;
}

/// `shared`: of two balls that cross, from the first kind of volume.
template <class Volume>
void add_volume(const char* name, const StudyOptions& options, std::optional<int>& shared,
                std::vector<trace::Study>& results) {
  std::mt19937_64 engine(options.seed);
  const Quatd outer = uniform_rotation(engine), inner = uniform_rotation(engine);
  const TriangleList first = turned_ball(1, Vec3d::Zero(), outer),
                     crossing = turned_ball(1, {.9, .7, .5}, inner);
  const int found = shared_by_trees<Volume>(first, crossing);
  const bool missed = found != shared.value_or(found);
  shared = shared.value_or(found);
  const VolumeTree<Volume> tree(first);
  add_line(results, {name, {}}, kGapsInMillimetres, [&](int gap) {
    const VolumeTree<Volume> within(turned_ball(1 - 1e-3 * gap, Vec3d::Zero(), inner));
    Measurement measured(1, 1);
    const auto tests = [&](int) { return tree.query(within, [](const auto&, const auto&) {}); };
    measured.times.measure(options.repetitions.value_or(kTreeRepetitions), 1, tests);
    measured.errors[0].add(tests(0));
    measured.failed = missed;
    return measured;
  });
}

}  // namespace

/// Trees of axis-aligned boxes, oriented boxes and polytopes of eighteen planes over two balls, one
/// within the other (Gottschalk et al. 1996). Over the gap between them: compared volumes, and the
/// time to find all pairs of triangles whose volumes overlap. Missed intersections are failures.
std::vector<trace::Study> study_bounding_trees(const StudyOptions& options,
                                               const StudyProgress& progress) {
  std::vector<trace::Study> results =
      results_of("bounding_trees", "float", "millimetres between the surfaces",
                 "two balls of 2,208 triangles; seed " + std::to_string(options.seed),
                 {{"tests", "How many volumes of two trees are compared", "compared volumes"}},
                 trace::StudyForm::Curves);
  std::optional<int> shared;
  const StudyStep step = counted(progress, 3);
  add_volume<Slabs<3>>("axis-aligned boxes (AABBs)", options, shared, results);
  step("axis-aligned boxes");
  add_volume<OrientedBox>("oriented boxes (OBBs)", options, shared, results);
  step("oriented boxes");
  add_volume<Slabs<9>>("k-DOPs (k = 18 planes)", options, shared, results);
  step("k-DOPs");
  return results;
}

}  // namespace contactscope
