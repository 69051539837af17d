#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "trace/contact.h"
#include "trace/shape.h"

/// Stages that go by earlier frames, or tell what comes of a manifold in later ones.
namespace contactscope::trace {

/// Temporal coherence: what was kept of an earlier frame was tried before the full test.
struct Cache {
  bool hit = false;             // it gave the result, and the full test did not run
  std::string kind;             // "separating_axis", or "features": those that touched
  std::string axis;             // "face_a", "face_b", "edge_edge"; that was tried
  std::optional<Vec3d> normal;  // unit, from a to b; of a hit
  /// Metres, of features: no point of one shape, seen from the other, has moved farther since the
  /// full test that found them.
  std::optional<double> moved;

  static constexpr auto fields() {
    return std::tuple(
        field::exact("hit", &Cache::hit).says("").called("miss", "hit"),
        field::exact("kind", &Cache::kind), field::axis("axis", &Cache::axis).optional(),
        field::direction_to_b("normal", &Cache::normal), field::length("moved", &Cache::moved));
  }
};

/// A point of an incremental manifold, and what became of it in this frame.
struct PersistentPoint {
  Point point;
  Vec3d on_a = Vec3d::Zero();  // the places of both shapes that met when it was found
  Vec3d on_b = Vec3d::Zero();
  std::string state;   // "new", "persisted", "broken"
  std::string reason;  // of "broken": "apart", "slid", "other features", "replaced", "reduced"
  int age = 0;         // frames since it was found

  static constexpr auto fields() {
    using P = PersistentPoint;
    return std::tuple(field::merged(&P::point),
                      field::position("on_a", &P::on_a).swaps(&P::on_b).says("place on a"),
                      field::position("on_b", &P::on_b).says("place on b"),
                      field::exact("state", &P::state),
                      field::exact("reason", &P::reason).where_set(), field::exact("age", &P::age));
  }
};

struct Incremental {
  std::string confirm;  // "distance", "ids": how old points are confirmed
  std::string query;    // "gjk": the cores were apart; else the method that measured their overlap
  double margin_a = 0;  // metres about the core of a
  double margin_b = 0;
  std::vector<PersistentPoint> points;  // those of the manifold, then the broken ones

  static constexpr auto fields() {
    using I = Incremental;
    return std::tuple(
        field::exact("confirm", &I::confirm), field::exact("query", &I::query),
        field::length("margin_a", &I::margin_a).swaps(&I::margin_b).says("margin of a"),
        field::length("margin_b", &I::margin_b).says("margin of b"),
        field::facts("points", &I::points).entries("persistent point"));
  }
};

/// Whether a body can rest on a manifold: whether its centre of mass, moved along the normal,
/// is within the contact points (Gregorius 2015, "Incremental Manifold Stability").
struct Stability {
  std::string shape;  // whose centre of mass
  Vec3d center_of_mass = Vec3d::Zero();
  Vec3d projection = Vec3d::Zero();  // into the contact plane
  Polygon support;                   // corners of the convex hull of the points in that plane
  double margin = 0;    // metres from the projection to the border of the support, negative outside
  std::string verdict;  // "stable", "turns about a point", "turns about a line", "no contact"
  std::optional<std::array<Vec3d, 2>> axis;  // of "turns about a line": two points on it

  static constexpr auto fields() {
    using S = Stability;
    return std::tuple(field::exact("shape", &S::shape),
                      field::position("center_of_mass", &S::center_of_mass).says("centre of mass"),
                      field::position("projection", &S::projection),
                      field::position("support", &S::support), field::length("margin", &S::margin),
                      field::exact("verdict", &S::verdict).told_first(),
                      field::position("axis", &S::axis));
  }
};

}  // namespace contactscope::trace
