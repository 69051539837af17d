#pragma once

#include "reduce/reducer.h"

namespace contactscope {

/// Handling of geometry without a normal: coincident centres, crossing axes.
enum class Degenerate {
  Fallback,  // an arbitrary normal that changes continuously where possible
  Skip,      // no contact
  Up,        // for centres in one place `up`; otherwise as Fallback
};

constexpr const char* to_string(Degenerate degenerate) {
  constexpr const char* kNames[] = {"fallback", "skip", "up"};
  return kNames[static_cast<int>(degenerate)];
}

/// How the overlap of a shape's surface with a distance field is searched.
enum class FieldSearch {
  Conservative,  // subdivides what the field's bounds do not decide: misses nothing
  Sampled,       // samples vertices and points about one cell from each other: may miss overlaps
};

constexpr const char* to_string(FieldSearch search) {
  return search == FieldSearch::Conservative ? "conservative" : "sampled";
}

/// The manifolds of a convex shape and a mesh.
enum class MeshManifolds {
  Pair,      // of all triangles: one per direction, see merge_triangles.h
  Triangle,  // one per triangle (Gregorius 2015, "Mesh Contacts")
};

constexpr const char* to_string(MeshManifolds manifolds) {
  return manifolds == MeshManifolds::Pair ? "pair" : "triangle";
}

struct CollideOptions {
  double margin = 0;  // metres; points up to this separation are kept
  Preference preference = Preference::Relative;
  Degenerate degenerate = Degenerate::Fallback;
  Vec3d up = Vec3d::UnitY();  // unit, world: the normal of Degenerate::Up, in processing order
  FieldSearch field = FieldSearch::Conservative;
  bool internal_edges = true;  // replaces contacts with edges and faces that the surface lacks
  MeshManifolds mesh_manifolds = MeshManifolds::Pair;
  int recorded_triangle = -1;  // of a mesh: the one whose stages a record has; -1: the deepest
  /// For two overlapping hulls. Meshes and round shapes have methods of their own.
  PenetrationMethod penetration = PenetrationMethod::Sat;
  /// Processes two shapes without an order in the table as if the arguments were swapped.
  bool b_first = false;
  const ReducerInfo* reducer = nullptr;  // null keeps all points
  ReduceOptions reduction{};             // `previous` in the order of the arguments, like results

  /// `reduction` for points computed from coordinates up to `scale`, metres (ReduceOptions::scale).
  template <class S> ReduceOptions reduction_at(S scale) const {
    ReduceOptions scaled = reduction;
    scaled.scale = static_cast<double>(scale);
    return scaled;
  }
};

/// How points of an incremental manifold are confirmed in the next frame.
enum class Confirm {
  Distance,  // the two points that met are still near each other, along and across the normal
  Ids,       // the features that met are still the query's, or still touch
};

/// "distance", "ids", as in scenarios and traces.
constexpr const char* to_string(Confirm confirm) {
  return confirm == Confirm::Distance ? "distance" : "ids";
}

/// Treatment of a new point nearer than the breaking distance to an old one.
enum class TooClose {
  Replace,  // it takes the place of the old one, and its id
  Reject,   // Catto 2007, "Adding New Points": it is not added, and the old one stays
};

/// Gregorius 2015, "Building Incremental Manifolds". Lengths in metres.
struct IncrementalSettings {
  Confirm confirm = Confirm::Distance;
  /// For hulls: depth of the core below the surface. Spheres and capsules have their radius.
  double core_margin = 0.02;
  /// Largest distance of the two points that met, along or across the normal, before the contact
  /// breaks. A new point nearer than this to an old one is too close to it.
  double breaking_distance = 0.02;
  TooClose too_close = TooClose::Replace;
  friend bool operator==(const IncrementalSettings&, const IncrementalSettings&) = default;
};

}  // namespace contactscope
