#pragma once

#include <memory_resource>

#include "manifold/dispatch.h"
#include "manifold/recorder.h"

namespace contactscope {

/// Contacts of a mesh keep at most this many times ReduceOptions::max_points points.
inline constexpr int kMergedManifolds = 3;

/// The contacts of a convex shape with the triangles of a mesh, merged into manifolds of the pair:
/// one per direction, however fine the mesh is. A solver's cost and warm starting then do not
/// depend on the triangulation. Steps:
/// 1. features of the mesh are numbered in the mesh: a vertex by its index; an edge by 3 t + k, as
///    edge k of its lower triangle t; a face by the lowest triangle of its flat region. So an id
///    stays the same while a shape slides from triangle to triangle of a flat floor;
/// 2. contacts whose normals differ by at most kFlatEdgeAngle from the deepest one's form a group
///    with the deepest one's normal, axis and rounding;
/// 3. points of different triangles with the same id become one, the deepest of them;
/// 4. points within the outline of the others, seen along the normal, add no support and are left
///    out, except the deepest one;
/// 5. the reducer keeps at most max_points of a group;
/// 6. of more than kMergedManifolds * max_points points in all groups, those remain whose wrenches
///    differ most (farthest-first traversal, from the deepest point on). No direction is given up
///    for a limit on manifolds: on rough ground four corners may stand on four different slopes.
///
/// Without a reducer all points of step 3 remain, in several manifolds if there are too many for
/// one. Manifolds are in the order of their depth.
template <class S> class TriangleContacts {
 public:
  /// Both must outlive this.
  TriangleContacts(const Shape<S>& a, const Mesh<S>& b);

  /// Appends a contact with points, in A's frame: step 1.
  void add(const Contact<S>& contact, int triangle);

  /// Steps 2 to 6, into the world. `recorder` is null when not recording.
  void merge(const ToWorld<S>& to_world, const CollideOptions& options, Manifolds<S>& manifolds,
             Recorder<S>* recorder);

 private:
  /// The contact of one triangle: what its points have in common, and their range.
  struct Part {
    Vec3<S> normal;
    AxisKind axis;
    ContactType type;
    S scale, deepest;
    int triangle, begin, end;
    int facing = -1;  // the face of a hull that looks most along the normal; -1: not yet searched
  };

  FeatureRef in_mesh(const FeatureRef& ref, int triangle) const;
  FeatureId in_mesh(const FeatureId& id, Part& part) const;
  ContactPoints<S> points_of(const Part& part) const;
  void finish_group(std::span<Part* const> parts, const ToWorld<S>& to_world,
                    const CollideOptions& options, Manifolds<S>& manifolds, Recorder<S>* recorder);

  const Hull<S>* hull_;  // A, if it is one
  const Mesh<S>& b_;
  std::array<std::byte, 16384> memory_;  // enough for most pairs, without the heap
  std::pmr::monotonic_buffer_resource arena_{memory_.data(), memory_.size()};
  std::pmr::vector<Part> parts_{&arena_};
  std::pmr::vector<ContactPoint<S>> points_{&arena_};
};

}  // namespace contactscope
