#pragma once

#include <memory>

#include "core/static_vector.h"
#include "manifold/dispatch.h"

/// Incremental manifolds. Sources: Gregorius 2015, "Building Incremental Manifolds (1)" to (3);
/// Catto 2007, "GJK Contact Margins" to "Manifold Reduction".
///
/// Spheres, capsules, hulls and planes have them; meshes do not (their points would have to be kept
/// for each triangle). The margin of spheres and capsules is their radius, that of hulls
/// IncrementalSettings::core_margin, less for a hull too thin for it; a plane needs none. Round
/// corners are the price: a contact lies by the margin within the corner that makes it.
///
/// **One normal.** A manifold has that of its newest query. Old points are measured along it, as
/// engines do, so their separations follow a normal that none of them was found with.
///
/// **Ids.** A point is called after the two features whose meeting it was when it was found, and
/// keeps this name for as long as it persists, also when a newer point takes its place: a solver
/// that joins impulses to ids keeps them. No two points of a manifold have the same id. Two features
/// meet in one place (parallel ones are told apart by their corners, see closest_patch), so a new
/// point with features or an id that the manifold has already is the same point, elsewhere.
///
/// **Which point.** Parallel faces are equally close in many places, and GJK gives any of them. Of
/// such places the one farthest from the points that are there already is taken, of the first the
/// one farthest from the middle, and of those as far the first by its features. So a box that
/// comes down level gets its corners one by one, the second across the diagonal.
///
/// A point persists until its two places are farther apart than the breaking distance, so the
/// separation of a manifold's points may be up to that, or the margin if larger.
namespace contactscope {

/// Without a reducer all points are kept, as of one-shot manifolds, up to so many; then the oldest
/// goes.
inline constexpr std::size_t kMaxPersistentPoints = 64;

/// A vertex, an edge or a face of a core, by its number there.
struct CoreFeature {
  FeatureKind kind = FeatureKind::Vertex;
  int index = 0;

  friend bool operator==(const CoreFeature&, const CoreFeature&) = default;
};

/// A point of the manifold as it is kept between frames: in both bodies.
template <class S>
struct PersistentContact {
  FeatureId id;                    // what it is called
  FeatureId found;                 // the features that meet there now, of the shapes ...
  CoreFeature of_a, of_b;          // ... and of their cores
  Vec3<S> on_a = Vec3<S>::Zero();  // the places that met, on the surfaces: A's own frame
  Vec3<S> on_b = Vec3<S>::Zero();  // B's own frame
  int age = 0;                     // frames since it was found
};

template <class S>
struct ShapeCore;

/// What one pair keeps from frame to frame; one for each pair, always in the same order. The cores
/// are built at the first call, for the shapes and the margin of that call.
template <class S>
struct PersistentManifold {
  StaticVector<PersistentContact<S>, kMaxPersistentPoints> points;
  std::shared_ptr<const ShapeCore<S>> core_a, core_b;
};

/// Whether shapes of these kinds, in whichever order, make incremental manifolds.
bool can_persist(ShapeKind one, ShapeKind other);

struct IncrementalOptions {
  IncrementalSettings settings;
  PenetrationMethod penetration = PenetrationMethod::Sat;  // of cores that overlap
};

/// One frame of a pair placed in the world: confirms what `persistent` holds, adds one point at
/// most, and gives the manifold, as collide() of dispatch.h does and with the same promises about
/// order. Of `options` margin, reducer and reduction count: cores that overlap always have a depth,
/// and the preference of the one-shot test has no part in it. Steps:
///   1. GJK on the cores; where they overlap, options.penetration;
///   2. each old point is moved with its bodies, measured along the new normal, and dropped if it
///      is apart, has slid, or its features no longer face each other;
///   3. up to the margin there is one new point; it takes the place of an old one that has the same
///      features or is nearer than the breaking distance;
///   4. the reducer leaves at most max_points (4, unless told otherwise) of those and the new one;
///      they stay in their order, the oldest first.
///
/// Shapes of one kind are worked on in the order given, or the other one with options.b_first. `record`
/// is null when nobody watches. Else what became of each point is written there, beside GJK and the
/// reduction, as collide() does it. A point that another has replaced is listed as broken where
/// their places differ by more than a hundredth of the breaking distance, which no picture shows.
template <class S>
void collide_incremental(const Shape<S>& a, const Pose<S>& pose_a, const Shape<S>& b,
                         const Pose<S>& pose_b, const CollideOptions& options,
                         const IncrementalOptions& incremental, PersistentManifold<S>& persistent,
                         Manifolds<S>& manifolds, trace::Pair* record = nullptr,
                         const trace::Stages& stages = kUsualStages);

}  // namespace contactscope
