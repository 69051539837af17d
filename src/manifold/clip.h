#pragma once

#include "core/manifold.h"
#include "query/hull_pair.h"

namespace contactscope {

/// FeatureRef in one word, in the same order. Clipping copies corners often. Writing a FeatureRef
/// as a byte and an int and reading it as eight bytes stalls the processor each time.
enum class EdgeKey : std::uint32_t {};

constexpr EdgeKey edge_key(Owner owner, int half_edge) {
  const auto edge = static_cast<std::uint32_t>(half_edge / 2);
  return static_cast<EdgeKey>((owner == Owner::B ? 0x80000000u : 0u) | edge);
}

constexpr FeatureRef edge_ref(EdgeKey key) {
  const auto word = static_cast<std::uint32_t>(key);
  return {word >> 31 != 0 ? Owner::B : Owner::A, word & 0x7fffffffu};
}

/// FeatureId as keys: the two edges whose crossing made a corner, sorted.
struct Crossing {
  EdgeKey first;
  EdgeKey second;

  static constexpr Crossing of(EdgeKey one, EdgeKey two) {
    return one < two ? Crossing{one, two} : Crossing{two, one};
  }
  constexpr FeatureId id() const { return {edge_ref(first), edge_ref(second)}; }
  friend constexpr bool operator==(const Crossing&, const Crossing&) = default;
};

/// Corner of the clipped polygon, in A's frame, metres.
template <class S> struct ClipVertex {
  Vec3<S> position;
  EdgeKey leaving;    // the polygon's edge that starts here
  Crossing crossing;  // origin of this corner; later clips do not change it
};

/// Counter-clockwise seen from outside its face. A reference face adds at most a corner per side.
template <class S> using ClipPolygon = StaticVector<ClipVertex<S>, kMaxManifoldPoints>;

/// A face of one of two hulls that are clipped, for the record: its outward normal in A's frame.
template <class S> struct ClipFace {
  int face;
  Vec3<S> normal;
  const ClipPolygon<S>& polygon;
};

/// A face as a polygon that starts at its face_edges entry. A corner's id is the two edges of the
/// face that meet there. `Placed` is PlacedHull or PlacedFeatures.
template <class Placed>
void face_polygon(const Placed& hull, Owner owner, int face,
                  ClipPolygon<typename Placed::Scalar>& polygon);

/// The plane through a half-edge of a face, perpendicular to the face. Unit normal, outward.
template <class Placed, class S = typename Placed::Scalar>
inline Plane<S> side_plane(const Placed& hull, int half_edge) {
  const Vec3<S> face_normal = hull.normal(hull.half_edge(half_edge).face);
  const Vec3<S> normal = hull.direction(half_edge).cross(face_normal);
  return {normal, normal.dot(hull.origin(half_edge))};
}

/// Clips a convex `polygon` to the inner side of a side plane, into `result` (emptied first).
/// `side_edge` is the plane's edge. Corners within `thickness` (metres, > 0) of the plane count as
/// on it: they stay, and no second corner is added next to them.
///
/// Returns false and leaves `result` unchanged if no corner is outside.
template <class S>
bool clip(const ClipPolygon<S>& polygon, const Plane<S>& side, EdgeKey side_edge, S thickness,
          ClipPolygon<S>& result);

}  // namespace contactscope
