#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trace/trace.h"

/// What every reducer makes of the same points. README.md, "Exploration".
namespace contactscope::trace {

/// First words of every line.
inline constexpr const char* kExplorationSchema = "contactscope.explore/1";

/// One reducer's answer. Areas in square metres, of the convex hull in the contact plane.
struct ReducerAnswer {
  std::string name;
  std::vector<int> kept;  // indices into the points, in the order of choice
  double area = 0;
  double area_ratio = 1;  // to the best that as many points can span
  bool deepest_kept = false;
  std::optional<bool> supports_center_of_mass = false;  // empty of points without bodies
  double wrench_error = 0;  // lost reach for moments, in radii of the patch
  double depth_error = 0;   // metres
  int ids_changed = 0;      // kept now and not in the frame before, or the other way
  double patch_moved = 0;   // metres that a kept point, or the middle of all, moved at most
  /// Nanoseconds a call: median, the least, and the upper quartile. Empty when not measured.
  std::optional<double> median, min, quarter;

  static constexpr auto fields() {
    using A = ReducerAnswer;
    return field::list(
        field::exact("name", &A::name), field::exact("kept", &A::kept).into("points"),
        field::area("area", &A::area), field::exact("area_ratio", &A::area_ratio),
        field::exact("deepest_kept", &A::deepest_kept),
        field::exact("supports_center_of_mass", &A::supports_center_of_mass),
        field::exact("wrench_error", &A::wrench_error),
        field::length("depth_error", &A::depth_error), field::exact("ids_changed", &A::ids_changed),
        field::length("patch_moved", &A::patch_moved),
        field::exact("median", &A::median).in("nanoseconds"),
        field::exact("min", &A::min).in("nanoseconds"),
        field::exact("upper_quartile", &A::quarter).in("nanoseconds"));
  }
};

/// One pair in one frame; of a mesh one of its triangles.
struct Exploration {
  std::string scenario;
  int frame = 0;
  std::string a, b, label;
  std::optional<int> triangle{};  // of the mesh, where one of the pair is one
  std::vector<Point> points;      // all, before any reduction
  Vec3d normal = Vec3d::Zero();
  double best_area = 0;
  std::vector<int> best{};  // indices of the points that span it
  /// Metres that a surface point of either body moved since the frame before, at most.
  double bodies_moved = 0;
  std::vector<ReducerAnswer> reducers{};

  static constexpr auto fields() {
    using E = Exploration;
    return field::list(
        field::exact("scenario", &E::scenario), field::exact("frame", &E::frame),
        field::exact("a", &E::a).where_set(), field::exact("b", &E::b).where_set(),
        field::exact("label", &E::label).where_set(), field::exact("triangle", &E::triangle),
        field::facts("points", &E::points), field::direction_to_b("normal", &E::normal),
        field::area("best_area", &E::best_area), field::exact("best", &E::best).into("points"),
        field::length("bodies_moved", &E::bodies_moved), field::facts("reducers", &E::reducers));
  }
};

/// One line of JSON without the newline, as README.md lays it out; keys in that order.
std::string to_json_line(const Exploration& exploration);

}  // namespace contactscope::trace
