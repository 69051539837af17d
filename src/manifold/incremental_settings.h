#pragma once

namespace contactscope {

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
