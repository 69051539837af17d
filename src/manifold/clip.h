#pragma once

#include "core/manifold.h"
#include "query/hull_pair.h"

namespace contactscope {

/// Corner of the polygon that clipping works on, in A's frame, metres.
template <class S>
struct ClipVertex {
  Vec3<S> position;
  EdgeRef leaving;  // the edge along which the polygon goes on from here
  FeatureId id;     // the two edges whose crossing made this corner; never changed by later clips
};

/// Counter-clockwise seen from outside the face that it came from. A reference face adds at most
/// one corner a side, so both faces together bound the size.
template <class S>
using ClipPolygon = StaticVector<ClipVertex<S>, kMaxManifoldPoints>;

/// A face as a polygon that starts at its face_edges entry; each corner's id is the two edges of
/// the face that meet there.
template <class S>
void face_polygon(const PlacedHull<S>& hull, Owner owner, int face, ClipPolygon<S>& polygon);

/// The plane through a half-edge of a face, at right angles to the face. Unit normal, outward.
template <class S>
Plane<S> side_plane(const PlacedHull<S>& hull, int half_edge);

/// What is left of a convex `polygon` on the inner side of a side plane, into `result` (emptied
/// first). `side_edge` is the edge that the plane belongs to. Corners within `thickness` (metres,
/// > 0) of the plane are on it: they stay, and no second corner is made beside them.
///
/// Returns false, and leaves `result` alone, when nothing lies outside.
template <class S>
bool clip(const ClipPolygon<S>& polygon, const Plane<S>& side, EdgeRef side_edge, S thickness,
          ClipPolygon<S>& result);

}  // namespace contactscope
