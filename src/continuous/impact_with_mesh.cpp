#include "continuous/impact_with_mesh.h"

#include "broadphase/broad_phase.h"
#include "continuous/portal_cast.h"
#include "query/mesh_overlap.h"

namespace contactscope {
namespace {

/// Box in the mesh's frame around the shape's whole sweep. Between two samples, a point with an
/// acceleration of at most k is off the straight line by at most k / 8 times the squared interval.
Aabb<double> swept_box(const MovingShape<double>& shape, const Sweep<double>& of_mesh) {
  const Turning<double> turning(shape);
  const bool turns = !of_mesh.turn.isZero(0) || !shape.motion.turn.isZero(0);
  const Vec3d between = between_pivots(of_mesh, shape.motion);
  const Vec3d offset = shape.motion.displacement - of_mesh.displacement;
  const double angle = of_mesh.turn.norm();
  const double reach = std::max(between.norm(), Vec3d(between + offset).norm()) + turning.reach();
  const double acceleration = turning.acceleration() +
                              2 * angle * (offset.norm() + turning.speed()) + angle * angle * reach;
  // Enough samples that the box grows by no more than about a tenth of the shape.
  constexpr int kMaxLooks = 32;
  const double wanted = std::sqrt(acceleration / std::max(0.8 * turning.reach(), 1e-30));
  const int looks = turns ? static_cast<int>(std::clamp<double>(wanted, 1, kMaxLooks)) : 1;
  Aabb<double> box;
  for (int i = 0; i <= looks; ++i) {
    const double time = static_cast<double>(i) / static_cast<double>(looks);
    Sweep<double> turning_mesh;
    turning_mesh.start.rotation = of_mesh.start.rotation;
    turning_mesh.turn = of_mesh.turn;
    const Quatd to_mesh = turning_mesh.at(time).rotation.conjugate();
    const Quatd rotation = to_mesh * turning.rotation(time);
    const Vec3d pivot = to_mesh * Vec3d(between + time * offset) + of_mesh.pivot;
    for (int p = 0; p < shape.core.count; ++p)
      box.include(pivot + rotation * Vec3d(shape.core.points[p] - turning.pivot()));
  }
  const double rounding = tie_tolerance(reach + of_mesh.pivot.norm());
  const Vec3d grown = Vec3d::Constant(shape.radius + rounding +
                                      acceleration / static_cast<double>(8 * looks * looks));
  return {box.lower - grown, box.upper + grown};
}

/// Exact impact of a ball with one mesh triangle. No turn moves the triangle or the ball's centre.
ImpactResult<double> ball_against(const std::array<Vec3d, 3>& corners, const Sweep<double>& of_mesh,
                                  const MovingShape<double>& ball) {
  // In a frame that moves with the mesh's origin, with the world's axes.
  const Vec3d start = (ball.motion.start.position - of_mesh.start.position) +
                      ball.motion.start.rotate(ball.core.points[0]);
  std::array<Vec3d, 3> placed;
  for (std::size_t i = 0; i < 3; ++i) placed[i] = of_mesh.start.rotate(corners[i]);
  const Vec3d offset = ball.motion.displacement - of_mesh.displacement;
  const SweptSphereHit hit = sweep_sphere_triangle(start, offset, ball.radius, placed);
  ImpactResult<double> result;
  result.steps = 1;
  result.time = hit.time;
  result.status = hit.status == SweptStatus::Hit           ? ImpactStatus::Hit
                  : hit.status == SweptStatus::Overlapping ? ImpactStatus::Overlapping
                                                           : ImpactStatus::Separated;
  if (hit.status != SweptStatus::Hit) return result;
  const Vec3d origin = of_mesh.start.position + result.time * of_mesh.displacement;
  result.normal = hit.normal;
  result.on_a = origin + placed[0] + hit.point;
  result.on_b = result.on_a;
  return result;
}

/// Casts to the scalar of the queried tree, rounded outwards.
template <class S> Aabb<S> tree_box(const Aabb<double>& box) {
  if constexpr (std::is_same_v<S, float>)
    return outward_box(box);
  else
    return box;
}

/// Calls visit(triangle) for each triangle of `b` that may come near `a`, until it returns true.
template <class S, class Visit>
void visit_near(const Mesh<S>& a, const Sweep<double>& of_a, const Mesh<S>& b,
                const Sweep<double>& of_b, double gap, const Visit& visit) {
  const auto may_meet = [&](const MovingShape<double>& part) {
    return a.tree.any_of(tree_box<S>(swept_box(part, of_a)), [](int) { return true; });
  };
  for (int i = 0; i < count_of(b.tree.nodes);) {
    const typename AabbTree<S>::Node& node = at(b.tree.nodes, i);
    std::array<Vec3d, 8> corners;
    for (int k = 0; k < 8; ++k)
      for (int axis = 0; axis < 3; ++axis)
        at(corners, k)[axis] = (k >> axis & 1) != 0 ? node.box.upper[axis] : node.box.lower[axis];
    const bool near = may_meet({{corners.data(), 8, nullptr}, of_b, gap});
    if (near && node.leaf())
      for (int k = node.next; k < node.next + node.count; ++k)
        if (visit(at(b.tree.triangles, k))) return;
    i = near || node.leaf() ? i + 1 : node.next;
  }
}

constexpr double kNoOverlap = std::numeric_limits<double>::infinity();

/// A box at time 0 and one at time 1. The interpolated box contains points that move linearly.
template <class S> struct SweptBox { const Aabb<S>&start, &end; };

/// Lower bound of the first time at which two swept boxes overlap; kNoOverlap if never.
template <class S> double first_overlap(const SweptBox<S>& a, const SweptBox<S>& b) {
  constexpr double kUp = 0x1p-50;  // more than the rounding below
  double begin = 0, end = 1;
  const auto is_separated = [&](S low_at_start, S high_at_start, S low_at_end, S high_at_end) {
    const double at_start = static_cast<double>(low_at_start) - static_cast<double>(high_at_start);
    const double at_end = static_cast<double>(low_at_end) - static_cast<double>(high_at_end);
    if (at_start > 0 && at_end > 0) return true;
    const double crossing = at_start / (at_start - at_end);
    if (at_start > 0) begin = std::max(begin, crossing * (1 - kUp));
    if (at_end > 0) end = std::min(end, crossing + kUp);
    return begin > end;
  };
  for (int i = 0; i < 3; ++i)
    if (is_separated(b.start.lower[i], a.start.upper[i], b.end.lower[i], a.end.upper[i]) ||
        is_separated(a.start.lower[i], b.start.upper[i], a.end.lower[i], b.end.upper[i]))
      return kNoOverlap;
  return begin;
}

/// A mesh with its tree at both ends of the step, and the features that each triangle owns.
template <class S> class SweptMesh {
 public:
  explicit SweptMesh(const MovingMesh<S>& moving)
      : mesh_(moving.start), end_(moving.end), end_tree_(moving.start.tree) {
    assert(moving.end.size() == mesh_.vertices.size());
    end_tree_.refit(end_, mesh_.triangles);
    std::vector<bool> is_owned(mesh_.vertices.size());
    owned_.resize(mesh_.triangles.size());
    for (int t = 0; t < mesh_.triangle_count(); ++t) {
      for (int k = 0; k < 3; ++k) {
        const auto vertex = static_cast<std::size_t>(at(at(mesh_.triangles, t), k));
        at(owned_, t).vertex[static_cast<std::size_t>(k)] = !is_owned[vertex];
        is_owned[vertex] = true;
        at(owned_, t).edge[static_cast<std::size_t>(k)] = is_first_with_edge(t, k);
      }
    }
  }

  const AabbTree<S>& tree() const { return mesh_.tree; }
  SweptBox<S> node(int i) const { return {at(tree().nodes, i).box, at(end_tree_.nodes, i).box}; }
  SweptBox<S> leaf_box(int place) const {
    return {at(tree().boxes, place), at(end_tree_.boxes, place)};
  }
  bool owns_vertex(int triangle, int k) const { return at(at(owned_, triangle).vertex, k); }
  bool owns_edge(int triangle, int k) const { return at(at(owned_, triangle).edge, k); }

  MovingCorner<S> corner(int triangle, int k) const {
    const int vertex = at(at(mesh_.triangles, triangle), k);
    return {at(mesh_.vertices, vertex), at(end_, vertex)};
  }
  MovingFace<S> face(int triangle) const {
    return {corner(triangle, 0), corner(triangle, 1), corner(triangle, 2)};
  }
  MovingEdge<S> edge(int triangle, int k) const {
    return {corner(triangle, k), corner(triangle, (k + 1) % 3)};
  }

 private:
  /// A neighbour shares the edge if it has the same vertices, not others at the same place.
  bool is_first_with_edge(int triangle, int k) const {
    const int neighbour = mesh_.neighbour(triangle, k);
    if (neighbour < 0 || triangle < neighbour) return true;
    const auto& corners = at(mesh_.triangles, neighbour);
    const auto has = [&](int vertex) {
      return std::find(corners.begin(), corners.end(), vertex) != corners.end();
    };
    const auto& own = at(mesh_.triangles, triangle);
    return !(has(at(own, k)) && has(at(own, (k + 1) % 3)));
  }

  struct Owned {
    std::array<bool, 3> vertex, edge;
  };
  const Mesh<S>& mesh_;
  std::span<const Vec3<S>> end_;
  AabbTree<S> end_tree_;
  std::vector<Owned> owned_;  // by triangle
};

template <class S> class MeshSearch {
 public:
  MeshSearch(const MovingMesh<S>& a, const MovingMesh<S>& b) : a_(a), b_(b) {}

  MeshImpact first() {
    push(0, 0);
    while (!stack_.empty() && found_.impact.status != FeatureStatus::Overlapping) {
      const NodePair pair = stack_.back();
      stack_.pop_back();
      if (pair.begin >= best_) continue;
      const auto& node_a = at(a_.tree().nodes, pair.a);
      const auto& node_b = at(b_.tree().nodes, pair.b);
      if (node_a.leaf() && node_b.leaf()) {
        leaves(node_a, node_b);
        continue;
      }
      const bool splits_a =
          !node_a.leaf() && (node_b.leaf() || surface_area(node_a.box) >= surface_area(node_b.box));
      const std::size_t before = stack_.size();
      if (splits_a) {
        push(pair.a + 1, pair.b);
        push(a_.tree().right_of(pair.a), pair.b);
      } else {
        push(pair.a, pair.b + 1);
        push(pair.a, b_.tree().right_of(pair.b));
      }
      // The earlier one is popped first.
      if (stack_.size() == before + 2 && stack_[before].begin < stack_[before + 1].begin)
        std::swap(stack_[before], stack_[before + 1]);
    }
    return found_;
  }

 private:
  using Node = typename AabbTree<S>::Node;
  struct NodePair {
    int a, b;
    double begin;
  };

  void push(int a, int b) {
    ++found_.counts.node_pairs;
    const double begin = first_overlap(a_.node(a), b_.node(b));
    if (begin < best_) stack_.push_back({a, b, begin});
  }

  void leaves(const Node& node_a, const Node& node_b) {
    for (int i = node_a.next; i < node_a.next + node_a.count; ++i) {
      for (int j = node_b.next; j < node_b.next + node_b.count; ++j) {
        if (!(first_overlap(a_.leaf_box(i), b_.leaf_box(j)) < best_)) continue;
        ++found_.counts.triangle_pairs;
        triangles(at(a_.tree().triangles, i), at(b_.tree().triangles, j));
      }
    }
  }

  void triangles(int a, int b) {
    for (int i = 0; i < 3; ++i) {
      if (a_.owns_vertex(a, i))
        offer(impact_of_vertex_face(a_.corner(a, i), b_.face(b), best_), a, i, b, -1);
      if (b_.owns_vertex(b, i)) {
        FeatureImpact impact = impact_of_vertex_face(b_.corner(b, i), a_.face(a), best_);
        impact.normal = -impact.normal;  // from a to b
        offer(impact, a, -1, b, i);
      }
      if (!a_.owns_edge(a, i)) continue;
      const MovingEdge<S> edge = a_.edge(a, i);
      for (int j = 0; j < 3; ++j)
        if (b_.owns_edge(b, j)) offer(impact_of_edges(edge, b_.edge(b, j), best_), a, i, b, j);
    }
  }

  void offer(const FeatureImpact& impact, int a, int feature_a, int b, int feature_b) {
    ++found_.counts.feature_pairs;
    if (impact.status == FeatureStatus::Separated || impact.begin >= best_) return;
    best_ = impact.begin;
    found_ = {impact, a, b, feature_a, feature_b, feature_a >= 0 && feature_b >= 0, found_.counts};
  }

  SweptMesh<S> a_, b_;
  double best_ = kNoOverlap;  // time
  std::vector<NodePair> stack_;
  MeshImpact found_;
};

}  // namespace

template <class S>
ShapeImpact<double> impact_with_mesh(const Mesh<S>& mesh, const Sweep<double>& of_mesh,
                                     const MovingShape<double>& shape, ImpactMethod method,
                                     ImpactLimits<double> allowed, ImpactRun<double>* run) {
  ShapeImpact<double> found;
  found.result.status = ImpactStatus::Separated;
  found.result.time = allowed.until;
  // A ball may turn about its centre.
  const bool exact = shape.core.count == 1 && shape.radius > 0 && of_mesh.turn.isZero(0) &&
                     (shape.motion.turn.isZero(0) || shape.core.points[0] == shape.motion.pivot) &&
                     allowed.gap == 0;
  mesh.tree.any_of(tree_box<S>(swept_box(shape, of_mesh)), [&](int triangle) {
    const std::array<Vec3d, 3> corners = corners_of(mesh, triangle);
    ++found.triangles;
    const ImpactResult<double> one =
        exact ? ball_against(corners, of_mesh, shape)
              : impact_by(method, moving_triangle(corners, of_mesh), shape, allowed, nullptr);
    if (one.status == ImpactStatus::Separated ||
        (one.status == ImpactStatus::Overlapping && allowed.passes_overlaps))
      return false;
    const bool first = one.status == ImpactStatus::Overlapping || found.triangle < 0 ||
                       one.time < found.result.time;
    if (first) {
      found.result = one;
      found.triangle = triangle;
      allowed.until = std::max(one.time, std::numeric_limits<double>::min());
    }
    return one.status == ImpactStatus::Overlapping;
  });
  if (run != nullptr) [[unlikely]] {
    run->result = found.result;
    if (found.triangle >= 0 && !exact) {
      const std::array<Vec3d, 3> corners = corners_of(mesh, found.triangle);
      allowed.until = 1;
      impact_by(method, moving_triangle(corners, of_mesh), shape, allowed, run);
    }
  }
  return found;
}

template <class S>
ShapeImpact<double> impact_of_rigid_meshes(const Mesh<S>& a, const Sweep<double>& of_a,
                                           const Mesh<S>& b, const Sweep<double>& of_b,
                                           ImpactMethod method, ImpactLimits<double> allowed,
                                           ImpactRun<double>* run) {
  ShapeImpact<double> found;
  found.result.status = ImpactStatus::Separated;
  found.result.time = allowed.until;
  visit_near(a, of_a, b, of_b, allowed.gap, [&](int triangle) {
    const std::array<Vec3d, 3> corners = corners_of(b, triangle);
    const ShapeImpact<double> one =
        impact_with_mesh(a, of_a, moving_triangle(corners, of_b), method, allowed, nullptr);
    found.triangles += one.triangles;
    if (one.triangle < 0) return false;
    found.result = one.result;
    found.triangle = one.triangle;
    found.triangle_of_b = triangle;
    allowed.until = std::max(one.result.time, std::numeric_limits<double>::min());
    return one.result.status == ImpactStatus::Overlapping;
  });
  if (run != nullptr) [[unlikely]] {
    run->result = found.result;
    if (found.triangle >= 0) {
      const std::array<Vec3d, 3> first = corners_of(a, found.triangle),
                                 second = corners_of(b, found.triangle_of_b);
      allowed.until = 1;
      impact_by(method, moving_triangle(first, of_a), moving_triangle(second, of_b), allowed, run);
    }
  }
  return found;
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(impact_with_mesh, impact_of_rigid_meshes);

template <class S> MeshImpact impact_of_meshes(const MovingMesh<S>& a, const MovingMesh<S>& b) {
  const MeshOverlap<S> at_start = mesh_overlap(a.start, b.start, Pose<S>());
  if (at_start.overlapping()) {
    MeshImpact found;
    found.impact = {.status = FeatureStatus::Overlapping, .begin = 0, .end = 0};
    found.triangle_a = at_start.intersections[0].a;
    found.triangle_b = at_start.intersections[0].b;
    return found;
  }
  return MeshSearch<S>(a, b).first();
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(impact_of_meshes);

}  // namespace contactscope
