#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/shape.h"

/// What can be asked of a pair of shapes, and which of the methods here answers it: the capability
/// map of collision detection as a table. A question that no method answers is refused with the
/// reason, and the reason says what to ask instead.
namespace contactscope {

/// What a pair is asked for.
enum class QueryKind {
  Overlap,      // do they share a point?
  Touching,     // do their surfaces meet within a tolerance, and no more than that?
  Distance,     // how far apart are they?
  Penetration,  // how deep are they in each other, and along which normal?
  Manifold,     // where do they touch: points with ids and depths, along one normal
};
inline constexpr int kQueryKinds = 5;

/// "overlap", "touching", "distance", "penetration", "manifold".
constexpr const char* to_string(QueryKind kind) {
  constexpr const char* kNames[] = {"overlap", "touching", "distance", "penetration", "manifold"};
  return kNames[static_cast<int>(kind)];
}

/// What answers.
enum class QueryMethod {
  Aabb,            // overlaps() of the bounding boxes: of the bounds, not of the shapes
  Obb,             // the same of the oriented ones
  BoundingSphere,  // the same of the spheres
  Support,         // the farthest point of a convex shape against a plane's normal
  Gjk,             // gjk() of the cores, less their radii
  Sat,             // penetration() by the separating axis test
  Epa,             // by the expanding polytope
  Mpr,             // by Minkowski portal refinement
  Sampling,        // by directions at random
  Triangles,       // mesh_overlap() and mesh_containment()
  Contacts,        // collide(): the table of shape against shape
};
inline constexpr int kQueryMethods = 11;

/// "aabb", "obb", "sphere", "support", "gjk", "sat", "epa", "mpr", "sampling", "triangles",
/// "contacts".
constexpr const char* to_string(QueryMethod method) {
  constexpr const char* kNames[] = {"aabb", "obb", "sphere",   "support",   "gjk",     "sat",
                                    "epa",  "mpr", "sampling", "triangles", "contacts"};
  return kNames[static_cast<int>(method)];
}

/// Why a method cannot answer for two shapes of these kinds, in whichever order: a sentence for a
/// reader, without a full stop; nothing where it answers.
std::optional<std::string> refusal(QueryMethod method, QueryKind query, ShapeKind one,
                                   ShapeKind other);

/// The methods that answer of the shapes themselves, in the order in which to prefer them: what
/// gives the least work beyond the question. None for what is refused; bounds are never among them.
std::vector<QueryMethod> methods_for(QueryKind query, ShapeKind one, ShapeKind other);

/// Why no method answers of the shapes themselves; nothing where one does.
std::optional<std::string> refusal(QueryKind query, ShapeKind one, ShapeKind other);

}  // namespace contactscope
