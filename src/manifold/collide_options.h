#pragma once

#include "core/manifold.h"
#include "reduce/reducer.h"

namespace contactscope {

/// What to do where geometry gives no normal: coincident centres, crossing axes.
enum class Degenerate {
  Fallback,  // a normal that is as good as any other and changes continuously where it can
  Skip,      // no contact
};

/// "fallback", "skip", as scenarios spell it.
constexpr const char* to_string(Degenerate degenerate) {
  return degenerate == Degenerate::Fallback ? "fallback" : "skip";
}

/// How a shape looks for where its surface is inside a distance field.
enum class FieldSearch {
  Conservative,  // parts that the field's bounds leave are cut until it is decided: none is missed
  Sampled,       // at its vertices and at points about a cell apart: what is between is missed
};

/// "conservative", "sampled", as scenarios spell it.
constexpr const char* to_string(FieldSearch search) {
  return search == FieldSearch::Conservative ? "conservative" : "sampled";
}

struct CollideOptions {
  double margin = 0;  // metres; points up to this separation are kept
  Preference preference = Preference::Relative;
  Degenerate degenerate = Degenerate::Fallback;
  FieldSearch field = FieldSearch::Conservative;
  bool internal_edges = true;  // of meshes: contacts on edges that the surface lacks are mended
  /// Of two hulls that overlap. Meshes and round shapes have ways of their own.
  PenetrationMethod penetration = PenetrationMethod::Sat;
  /// Two shapes between which the table has no order are worked on as if given the other way round.
  bool b_first = false;
  const ReducerInfo* reducer = nullptr;  // nullptr keeps all points
  ReduceOptions reduction{};             // `previous` in the order of the arguments, as results are

  /// `reduction` of points from coordinates up to `scale`, metres (ReduceOptions::scale).
  template <class S>
  ReduceOptions reduction_at(S scale) const {
    ReduceOptions scaled = reduction;
    scaled.scale = static_cast<double>(scale);
    return scaled;
  }
};

/// How points of an incremental manifold are confirmed in the next frame.
enum class Confirm {
  Distance,  // the two places that met are still near each other, along and across the normal
  Ids,       // the features that made it are still those that the query finds, or still touch
};

/// "distance", "ids", as scenarios and traces spell it.
constexpr const char* to_string(Confirm confirm) {
  return confirm == Confirm::Distance ? "distance" : "ids";
}

/// Gregorius 2015, "Building Incremental Manifolds". Lengths in metres.
struct IncrementalSettings {
  Confirm confirm = Confirm::Distance;
  /// Of hulls: how far the core lies within the surface. Spheres and capsules have their radius.
  double core_margin = 0.02;
  /// Two places that met are taken apart when they are farther than this, along the normal or
  /// across it; a new point nearer than this to an old one replaces it.
  double breaking_distance = 0.02;

  friend bool operator==(const IncrementalSettings&, const IncrementalSettings&) = default;
};

}  // namespace contactscope
