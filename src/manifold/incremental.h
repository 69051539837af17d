#pragma once

#include "manifold/dispatch.h"

/// Incremental manifolds. Sources: Gregorius 2015, "Building Incremental Manifolds (1)" to (3);
/// Catto 2007, "GJK Contact Margins" to "Manifold Reduction".
///
/// Supported by spheres, capsules, hulls and planes, but not by meshes (points would have to be
/// kept per triangle). The margin of spheres and capsules is their radius, that of hulls
/// IncrementalSettings::core_margin, less for a hull too thin for it; a plane needs none. The price
/// is round corners: a contact at a corner lies within it by the margin.
///
/// **One normal.** A manifold has the normal of its newest query. Old points are measured along it,
/// as in engines, although they were found with other normals.
///
/// **Ids.** A point's id is the two features that met when it was found. It keeps this id for as
/// long as it persists, also when a newer point replaces it: solvers join impulses to ids. No two
/// points of a manifold have the same id. A new point with features or an id of another is the same
/// point at another position, since two features meet in one point (see closest_patch).
///
/// **Choice of the point.** Parallel faces are equally close at many points, and GJK returns any of
/// them. We take the candidate farthest from the existing points; the first point is farthest from
/// the middle; ties are broken by features. So a box that comes down level gets its corners one by
/// one, the second across the diagonal.
///
/// A contact persists until the two points that met are farther from each other than the breaking
/// distance. So the separation of a manifold's points may be up to that, or the margin if larger.
namespace contactscope {

/// Without a reducer this many points are kept; then the oldest is dropped.
inline constexpr std::size_t kMaxPersistentPoints = 64;

/// A vertex, an edge or a face of a core, by its index there.
struct CoreFeature {
  FeatureKind kind = FeatureKind::Vertex;
  int index = 0;
  friend bool operator==(const CoreFeature&, const CoreFeature&) = default;
};

/// A contact point kept between frames, in both bodies.
template <class S> struct PersistentContact {
  FeatureId id;                    // its id in manifolds
  FeatureId found;                 // the features of the shapes that meet there now ...
  CoreFeature of_a, of_b;          // ... and those of their cores
  Vec3<S> on_a = Vec3<S>::Zero();  // the points that met, on the surfaces: A's own frame
  Vec3<S> on_b = Vec3<S>::Zero();  // B's own frame
  int age = 0;                     // frames since it was found
};

template <class S> struct ShapeCore;

/// Persisted state of a pair, always in the same order; its cores are built at the first call.
template <class S> struct PersistentManifold {
  StaticVector<PersistentContact<S>, kMaxPersistentPoints> points;
  std::shared_ptr<const ShapeCore<S>> core_a, core_b;
};

/// Whether shapes of these kinds, in either order, make incremental manifolds.
bool can_persist(ShapeKind one, ShapeKind other);

struct IncrementalOptions {
  IncrementalSettings settings;
  PenetrationMethod penetration = PenetrationMethod::Sat;  // for cores that overlap
};

/// One frame of a pair placed in the world: confirms the points in `persistent`, adds at most one
/// point and returns the manifold, with the guarantees of collide() in dispatch.h about order. Uses
/// only the margin, reducer and reduction of `options`. Steps:
///   1. GJK on the cores; if they overlap, options.penetration;
///   2. each old point is moved with its bodies and measured along the new normal. It is dropped
///      if it is separated, has slid, or its features no longer face each other;
///   3. up to the margin there is one new point; it replaces an old one that has the same features
///      or is nearer than the breaking distance. With TooClose::Reject the nearer one stays instead;
///   4. the reducer keeps at most max_points (4 by default) of all these points, in their order,
///      the oldest first.
///
/// Shapes of one kind are processed in the given order, or the opposite one with options.b_first.
/// `record` is null when not recording. Otherwise it gets the fate of each point, GJK and the
/// reduction, as in collide(). A replaced point is listed as broken if it differs from its
/// replacement by more than a hundredth of the breaking distance; less is invisible in pictures.
template <class S>
void collide_incremental(const Shape<S>& a, const Pose<S>& pose_a, const Shape<S>& b,
                         const Pose<S>& pose_b, const CollideOptions& options,
                         const IncrementalOptions& incremental, PersistentManifold<S>& persistent,
                         Manifolds<S>& manifolds, trace::Pair* record = nullptr,
                         const trace::Stages& stages = kUsualStages);

}  // namespace contactscope
