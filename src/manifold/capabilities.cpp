#include "manifold/capabilities.h"

#include "manifold/dispatch.h"

namespace contactscope {
namespace {

/// The queries that a method answers for shapes it supports, and why it does not answer the others.
struct MethodRow {
  bool answers[kQueryKinds];  // overlap, touching, distance, penetration, manifold
  const char* otherwise;
};

constexpr const char* kYesOrNo =
    "an overlap test of bounds says yes or no; ask the shapes themselves for more";
constexpr const char* kOnePointSeparated =
    "it finds a normal and a depth, and no points; ask \"contacts\", which clips the features "
    "there";

constexpr MethodRow kRows[kQueryMethods] = {
    {{true, true, false, false, false}, kYesOrNo},
    {{true, true, false, false, false}, kYesOrNo},
    {{true, true, false, false, false}, kYesOrNo},
    {{true, true, true, true, false}, kOnePointSeparated},
    {{true, true, true, false, false},
     "GJK ends where the shapes overlap, and finds one pair of points where they do not; ask "
     "\"sat\" or \"epa\" for the depth, \"contacts\" for a manifold"},
    {{true, true, false, true, false}, kOnePointSeparated},
    {{true, true, false, true, false}, kOnePointSeparated},
    {{true, true, false, true, false}, kOnePointSeparated},
    {{true, true, false, true, false}, kOnePointSeparated},
    {{true, false, true, false, false},
     "V-Clip ends where the hulls overlap, without a depth; ask \"sat\" or \"epa\" for it"},
    {{true, false, false, false, false},
     "of two meshes the triangles that share a point are found, and neither a gap nor a depth; ask "
     "for the overlap of their triangles, query = \"overlap\""},
    {{true, true, false, true, true},
     "contacts end where the shapes are apart by more than the margin; ask \"gjk\" for a distance"},
};

constexpr const char* kNoDistance =
    "the largest gap over its axes is less than the distance where corners are closest; ask "
    "\"gjk\"";

constexpr const char* kNoTouch =
    "of two shapes without a radius GJK says that they meet, touching or not; ask \"sat\" or "
    "\"contacts\"";

bool is_bound(QueryMethod method) { return method <= QueryMethod::BoundingSphere; }

/// Why a method does not support shapes of these kinds, `one` first in the table; null: it does.
const char* unknown_shapes(QueryMethod method, ShapeKind one, ShapeKind other) {
  if (is_bound(method))
    return one == ShapeKind::Plane || other == ShapeKind::Plane
               ? "a plane has no end, and so no bounds; leave it out of the broad phase"
               : nullptr;
  if (method == QueryMethod::Contacts) {
    if (can_collide(one, other)) return nullptr;
    if (one == ShapeKind::Plane && other == ShapeKind::Plane)
      return "two planes have no end: they overlap or are parallel";
    if (one == ShapeKind::Plane)
      return "a plane and a mesh both stand for the ground; use a hull for what lies on it";
    return kRows[static_cast<int>(QueryMethod::Triangles)].otherwise;
  }
  if (method == QueryMethod::Triangles)
    return one == ShapeKind::Mesh && other == ShapeKind::Mesh
               ? nullptr
               : "it compares the triangles of two meshes; ask \"contacts\"";
  if (method == QueryMethod::VClip)
    return one == ShapeKind::Hull && other == ShapeKind::Hull
               ? nullptr
               : "it walks over the features of two hulls; ask \"gjk\" or \"contacts\"";
  if (method == QueryMethod::Support)
    return is_convex(one) && other == ShapeKind::Plane
               ? nullptr
               : "it is of a convex shape and a plane, whose normal is the one axis that counts; "
                 "ask \"gjk\" or \"contacts\"";
  if (other == ShapeKind::Field)
    return "a distance field is not convex; ask \"contacts\", which looks for where it is negative";
  if (!is_convex(other))
    return other == ShapeKind::Plane
               ? "a plane has no end, and so no farthest point along a direction; ask \"support\""
               : "a mesh is not convex; ask \"contacts\", which works on its triangles";
  if (method == QueryMethod::Gjk) return nullptr;
  return other == ShapeKind::Hull
             ? nullptr
             : "the cores of spheres and capsules have no volume, and the depth is their radii "
               "less a distance; ask \"gjk\"";
}

}  // namespace

std::optional<std::string> refusal(QueryMethod method, QueryKind query, ShapeKind one,
                                   ShapeKind other) {
  if (one > other) std::swap(one, other);
  if (const char* reason = unknown_shapes(method, one, other)) return reason;
  if (method == QueryMethod::Gjk && query == QueryKind::Touching && one == ShapeKind::Hull)
    return kNoTouch;
  // Without a hull it is the radii less the distance, wherever the cores are.
  if (method == QueryMethod::Gjk && query == QueryKind::Penetration && other != ShapeKind::Hull)
    return std::nullopt;
  const MethodRow& row = kRows[static_cast<int>(method)];
  if (row.answers[static_cast<int>(query)]) return std::nullopt;
  const bool searches_depth = method >= QueryMethod::Sat && method <= QueryMethod::Sampling;
  return searches_depth && query == QueryKind::Distance ? kNoDistance : row.otherwise;
}

std::vector<QueryMethod> methods_for(QueryKind query, ShapeKind one, ShapeKind other) {
  std::vector<QueryMethod> methods;
  for (int m = static_cast<int>(QueryMethod::Support); m < kQueryMethods; ++m) {
    const auto method = static_cast<QueryMethod>(m);
    if (!refusal(method, query, one, other)) methods.push_back(method);
  }
  return methods;
}

std::optional<std::string> refusal(QueryKind query, ShapeKind one, ShapeKind other) {
  if (!methods_for(query, one, other).empty()) return std::nullopt;
  if (one == ShapeKind::Mesh && other == ShapeKind::Mesh)
    return refusal(QueryMethod::Triangles, query, one, other);
  // Contacts support every other pair that any method supports.
  return refusal(QueryMethod::Contacts, QueryKind::Manifold, one, other)
      .value_or(
          other == ShapeKind::Field || one == ShapeKind::Field
              ? "contacts of a distance field end at the margin; ask for \"manifold\" with a "
                "margin "
                "and read its separations"
              : "the distance from a mesh is not known beyond the margin of its contacts; ask for "
                "\"manifold\" and read its separations");
}

}  // namespace contactscope
