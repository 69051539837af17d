#pragma once

#include "geometry/shape.h"

/// Which methods here answer which query of a pair of shapes, as a table. A query that no method
/// answers is refused; the reason names an alternative.
namespace contactscope {

/// The query of a pair.
enum class QueryKind {
  Overlap,      // do they share a point?
  Touching,     // do the surfaces meet within a tolerance, without deeper overlap?
  Distance,     // how far are they from each other?
  Penetration,  // how deep are they in each other, and along which normal?
  Manifold,     // where do they touch: points with ids and depths, along one normal
};
inline constexpr int kQueryKinds = 5;

constexpr const char* to_string(QueryKind kind) {
  constexpr const char* kNames[] = {"overlap", "touching", "distance", "penetration", "manifold"};
  return kNames[static_cast<int>(kind)];
}

/// The method that answers a query.
enum class QueryMethod {
  Aabb,            // overlaps() of the bounding boxes: the bounds, not the shapes
  Obb,             // likewise the oriented boxes
  BoundingSphere,  // likewise the bounding spheres
  Support,         // the farthest point of a convex shape against a plane's normal
  Gjk,             // gjk() of the cores, less their radii
  Sat,             // penetration() by the separating axis test
  Epa,             // by the expanding polytope
  Mpr,             // by Minkowski portal refinement
  Sampling,        // by random directions
  VClip,           // v_clip() of two hulls
  Triangles,       // mesh_overlap() and mesh_containment()
  Contacts,        // collide(): the table of shape against shape
};
inline constexpr int kQueryMethods = 12;

constexpr const char* to_string(QueryMethod method) {
  constexpr const char* kNames[] = {"aabb", "obb", "sphere",   "support", "gjk",       "sat",
                                    "epa",  "mpr", "sampling", "v-clip",  "triangles", "contacts"};
  return kNames[static_cast<int>(method)];
}

/// Why a method cannot answer for two shapes of these kinds, in either order: a sentence for a
/// reader, without a full stop; empty if it can.
std::optional<std::string> refusal(QueryMethod method, QueryKind query, ShapeKind one,
                                   ShapeKind other);

/// The methods that answer for the shapes themselves, preferred first: the least work beyond the
/// query. Empty for refused queries; never includes bounds.
std::vector<QueryMethod> methods_for(QueryKind query, ShapeKind one, ShapeKind other);

/// Why no method answers for the shapes themselves; empty if one does.
std::optional<std::string> refusal(QueryKind query, ShapeKind one, ShapeKind other);

}  // namespace contactscope
