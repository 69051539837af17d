#pragma once

#include "geometry/obb.h"

/// Overlap tests of bounding volumes, in one frame, metres. Each can record its axes.
namespace contactscope {

/// Definition of overlap, the same for all pairs of bounds. An axis is a unit direction; the gap
/// along it is the distance between both projections, negative in overlap.
template <class S> struct Comparison {
  bool touching = true;  // a gap of 0 counts as overlap
  S tolerance = 0;       // metres, >= 0: gaps up to this count as overlap

  /// Touching bounds overlap: no gap is larger than 0.
  static constexpr Comparison inclusive() { return {}; }
  /// Touching bounds do not overlap: every gap is less than 0.
  static constexpr Comparison exclusive() { return {false, 0}; }
  /// No gap is larger than the tolerance. Bounds farther than sqrt(3) times it do not overlap,
  /// since a corner may be off along three axes. For spheres the distance is compared.
  static constexpr Comparison within(S tolerance) { return {true, tolerance}; }
};

/// Axes tested for two oriented boxes.
enum class ObbAxes {
  Faces,    // only the six face normals, as a filter: separated boxes may pass
  Fifteen,  // plus the nine cross products of edges: Gottschalk, Lin and Manocha 1996
  Guarded,  // the same axes, compared such that rounding misses no overlap
};

constexpr const char* to_string(ObbAxes axes) {
  constexpr const char* kNames[] = {"faces", "fifteen", "guarded"};
  return kNames[static_cast<int>(axes)];
}

/// Method for testing two oriented boxes.
template <class S> struct ObbTest {
  ObbAxes axes = ObbAxes::Guarded;
  /// Fifteen only: skip cross products up to this sine of the edges' angle; 0: only null vectors.
  S skip_up_to = 0;
  friend bool operator==(const ObbTest&, const ObbTest&) = default;
};

/// Source of an axis of an overlap test.
enum class OverlapAxisKind {
  FaceA,    // `a`: axis of A, 0 to 2; x, y, z for an Aabb
  FaceB,    // `b`: axis of B
  Edges,    // the cross product of axis `a` of A and axis `b` of B
  Closest,  // of two spheres: from centre to centre
};

constexpr const char* to_string(OverlapAxisKind kind) {
  constexpr const char* kNames[] = {"face_a", "face_b", "edges", "closest"};
  return kNames[static_cast<int>(kind)];
}

/// Measurements along one axis.
template <class S> struct OverlapAxis {
  OverlapAxisKind kind = OverlapAxisKind::FaceA;
  int a = -1, b = -1;
  /// Unit, from A towards B; zero if a cross product vanishes. The fields below are then undefined.
  Vec3<S> direction = Vec3<S>::Zero();
  S length =
      1;  // of the cross product before normalization: the sine of the angle between both edges
  std::array<S, 2> interval_a{}, interval_b{};  // metres along the direction from A's centre
  S gap = 0;                                    // metres, negative in overlap
  bool skipped = false;                         // the cross product is too short
  bool separates = false;                       // decision of the test

  bool is_of_edges() const { return kind == OverlapAxisKind::Edges; }
};

/// Record of an overlap test: all axes, including those after the first that separates.
template <class S> struct OverlapRecord { std::vector<OverlapAxis<S>> axes; };

// All tests: an empty bound, one with NaN, or an oriented box with an infinity overlaps nothing,
// and its record has no axes. `record` may be null; it is cleared first and does not affect the
// result. Swapping A and B does not change the result.

/// Exact, except for adding the tolerance; without it the same as overlaps(a, b) of aabb.h.
template <class S>
bool overlaps(const Aabb<S>& a, const Aabb<S>& b, const Comparison<S>& comparison,
              OverlapRecord<S>* record = nullptr);

// The tests below round by a few epsilon of the lengths added: the sizes of both bounds and the
// distance between their centres. Anything within that counts as touching. So inclusive tests never
// miss an overlap, and exclusive tests never report separated bounds as overlapping.

template <class S>
bool overlaps(const BoundingSphere<S>& a, const BoundingSphere<S>& b,
              const Comparison<S>& comparison, OverlapRecord<S>* record = nullptr);

/// The separating axis test for two oriented boxes: Gottschalk, Lin and Manocha 1996, "OBBTree".
/// Fifteen axes; the largest gap is at least the distance over sqrt(3).
///
/// `test` selects the axes. The first two choices are what engines do:
/// - Faces: boxes separated only by edges are reported as overlapping.
/// - Fifteen: rounded gaps are compared with 0. Along a cross product of length s their error is
///   about epsilon (size of the pair) / s: boxes that overlap by up to their size are reported as
///   separated, unless s up to about ten epsilon are skipped. Skipping s up to t in turn reports
///   boxes as overlapping that are separated by up to sqrt(2) t (size of the pair).
///
/// Guarded misses no overlap. Let D, metres, be the sum of the coordinates of the offset between
/// the centres, the half extents of both boxes and the tolerance:
/// 1. Inclusive and within: boxes that overlap, or are within the tolerance, are never missed.
/// 2. Boxes with a gap of more than 32 epsilon D along one of the fifteen axes are reported as
///    separated, and so is every pair at a distance of more than 56 epsilon D.
/// 3. Exclusive: boxes that touch or are separated are never reported as overlapping. Boxes that
///    overlap by more than 48 epsilon D along all fifteen axes are.
/// All three refer to the boxes given by the exact numbers of `a` and `b`, for any angles and
/// sizes, including parallel, nearly parallel and flat boxes. Derived in overlap.cpp.
template <class S>
bool overlaps(const Obb<S>& a, const Obb<S>& b, const Comparison<S>& comparison,
              const ObbTest<S>& test, OverlapRecord<S>* record = nullptr);
template <class S>
bool overlaps(const Obb<S>& a, const Obb<S>& b, const Comparison<S>& comparison,
              OverlapRecord<S>* record = nullptr) {
  return overlaps(a, b, comparison, ObbTest<S>{}, record);
}

}  // namespace contactscope
