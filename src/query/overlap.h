#pragma once

#include <array>
#include <vector>

#include "geometry/aabb.h"
#include "geometry/bounding_sphere.h"
#include "geometry/obb.h"

/// Overlap tests of bounding volumes, in one frame, metres: yes or no, and to who watches why.
namespace contactscope {

/// What counts as an overlap, the same for every pair of bounds. An axis is a unit direction, the
/// gap along it what lies between the projections of both, negative where they overlap.
template <class S>
struct Comparison {
  bool touching = true;  // a gap of 0 counts
  S tolerance = 0;       // metres, >= 0: gaps of up to this count

  /// Bounds that touch overlap: no gap is larger than 0.
  static constexpr Comparison inclusive() { return {}; }
  /// Bounds that touch do not: every gap is less than 0.
  static constexpr Comparison exclusive() { return {false, 0}; }
  /// No gap is larger than the tolerance. Bounds whose distance is that or less overlap, and none
  /// farther apart than sqrt(3) times that: a corner may lie so far out along two or three axes.
  /// About a sphere the distance itself is compared.
  static constexpr Comparison within(S tolerance) { return {true, tolerance}; }
};

/// Which axes the test of two oriented boxes tries.
enum class ObbAxes {
  Faces,    // the six face normals alone, a filter: separated boxes may pass
  Fifteen,  // and the nine cross products of edges, as Gottschalk, Lin and Manocha 1996 have them
  Guarded,  // the fifteen, compared so that rounding loses nothing
};

/// "faces", "fifteen", "guarded".
constexpr const char* to_string(ObbAxes axes) {
  constexpr const char* kNames[] = {"faces", "fifteen", "guarded"};
  return kNames[static_cast<int>(axes)];
}

/// How two oriented boxes are tested.
template <class S>
struct ObbTest {
  ObbAxes axes = ObbAxes::Guarded;
  /// Of Fifteen: cross products no longer than this, the sine of the angle between two edges, are
  /// skipped; 0 skips none that has a direction.
  S skip_up_to = 0;

  friend bool operator==(const ObbTest&, const ObbTest&) = default;
};

/// Where an axis of an overlap test comes from.
enum class OverlapAxisKind {
  FaceA,    // `a`: axis of A, 0 to 2; of an Aabb x, y, z
  FaceB,    // `b`: axis of B
  Edges,    // the cross product of axis `a` of A and axis `b` of B
  Closest,  // from the point of A nearest to the middle of a sphere to that middle
};

/// "face_a", "face_b", "edges", "closest".
constexpr const char* to_string(OverlapAxisKind kind) {
  constexpr const char* kNames[] = {"face_a", "face_b", "edges", "closest"};
  return kNames[static_cast<int>(kind)];
}

/// What a test found along one axis.
template <class S>
struct OverlapAxis {
  OverlapAxisKind kind = OverlapAxisKind::FaceA;
  int a = -1, b = -1;
  /// Unit, from A towards B; zero where a cross product vanishes, and then nothing below has a
  /// meaning.
  Vec3<S> direction = Vec3<S>::Zero();
  S length =
      1;  // of the cross product before it was made unit: the sine of the angle of both edges
  std::array<S, 2> interval_a{}, interval_b{};  // metres along the direction from the middle of A
  S gap = 0;                                    // metres, negative in overlap
  bool skipped = false;                         // its cross product is too short
  bool separates = false;                       // what the test made of it
};

/// What an overlap test did, for somebody who watches: every axis of it, also those after the first
/// that separates. The answer is that no axis separates.
template <class S>
struct OverlapRecord {
  std::vector<OverlapAxis<S>> axes;
};

// All tests: an empty bound, one with NaN and an oriented box with an infinity overlap nothing, and
// then a record stays without axes. `record`: null when nobody watches, which costs nothing; it
// changes no answer and is emptied first. Trading A and B changes no answer.

/// Compares coordinates: no rounding at all, but that of adding the tolerance. Without tolerance it
/// is what overlaps(a, b) of aabb.h says.
template <class S>
bool overlaps(const Aabb<S>& a, const Aabb<S>& b, const Comparison<S>& comparison,
              OverlapRecord<S>* record = nullptr);

// The tests below round. Each has a bound of what it rounds by, a few epsilon of the lengths that
// it adds: the sizes of both bounds and the way between their middles, wherever the origin is. What
// lies within that bound of touching counts as touching. So, inclusive, no bounds that overlap are
// called apart, and exclusive, none that are apart are called overlapping.

template <class S>
bool overlaps(const BoundingSphere<S>& a, const BoundingSphere<S>& b,
              const Comparison<S>& comparison, OverlapRecord<S>* record = nullptr);

/// By the distance of the sphere's middle from the box (Arvo 1990, "A Simple Method for Box-Sphere
/// Intersection Testing"), which no set of fixed axes gives.
template <class S>
bool overlaps(const Aabb<S>& a, const BoundingSphere<S>& b, const Comparison<S>& comparison,
              OverlapRecord<S>* record = nullptr);

/// The same in the frame of the box.
template <class S>
bool overlaps(const Obb<S>& a, const BoundingSphere<S>& b, const Comparison<S>& comparison,
              OverlapRecord<S>* record = nullptr);

/// The separating axis test of two oriented boxes: Gottschalk, Lin and Manocha 1996, "OBBTree".
/// Boxes are apart exactly if one of fifteen axes has a gap, which is at least the distance over
/// sqrt(3).
///
/// `test` says which axes are tried. The first two give what engines give:
/// - Faces: boxes that only edges keep apart are called overlapping.
/// - Fifteen: gaps are compared with 0 as they were rounded. Along a cross product of length s they
///   are wrong by some epsilon (size of the pair) / s: boxes that overlap are called apart, by up
///   to their size, unless s up to some ten epsilon are skipped. Skipping s up to t in turn calls
///   boxes overlapping that are apart by up to sqrt(2) t (size of the pair).
///
/// Guarded loses nothing. With D, metres, the sum of the coordinates of the way between the
/// middles, of the half extents of both and of the tolerance:
/// 1. Inclusive and within: no boxes that overlap, or are within the tolerance, are called apart.
/// 2. Boxes with a gap of more than 32 epsilon D along one of the fifteen axes are called apart:
///    those at a distance of more than 56 epsilon D.
/// 3. Exclusive: no boxes that touch or are apart are called overlapping. Those that overlap by
///    more than 48 epsilon D along all fifteen axes are.
/// All three are of the boxes that the numbers of `a` and `b` stand for, taken as exact, and hold
/// for any angles and sizes, parallel, nearly parallel and flat boxes among them. overlap_boxes.cpp
/// derives them.
template <class S>
bool overlaps(const Obb<S>& a, const Obb<S>& b, const Comparison<S>& comparison,
              const ObbTest<S>& test, OverlapRecord<S>* record = nullptr);
template <class S>
bool overlaps(const Obb<S>& a, const Obb<S>& b, const Comparison<S>& comparison,
              OverlapRecord<S>* record = nullptr) {
  return overlaps(a, b, comparison, ObbTest<S>{}, record);
}

/// As two oriented boxes, see obb_of(): what touches within half an ulp of the Aabb's coordinates
/// counts as touching.
template <class S>
bool overlaps(const Aabb<S>& a, const Obb<S>& b, const Comparison<S>& comparison,
              OverlapRecord<S>* record = nullptr) {
  return overlaps(obb_of(a), b, comparison, record);
}

}  // namespace contactscope
