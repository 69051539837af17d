#pragma once

#include "trace/trace.h"

/// The points that each reducer keeps of the same input. README.md, "Exploration".
namespace contactscope::trace {

/// Value of "schema" in every line.
inline constexpr const char* kExplorationSchema = "contactscope.explore/1";

/// The result of one reducer. Areas in square metres, of the convex hull in the contact plane.
struct ReducerAnswer {
  std::string name;
  std::vector<int> kept;  // indices into the points, in order of choice
  double area = 0;
  double area_ratio = 1;  // to the largest area of as many points
  bool deepest_kept = false;
  std::optional<bool> supports_center_of_mass = false;  // empty without bodies
  double wrench_error = 0;  // loss of reachable moments, in radii of the patch
  double depth_error = 0;   // metres
  int ids_changed = 0;      // ids that are kept in only one of this frame and the previous one
  double patch_moved = 0;   // metres: largest movement of a kept point or of their centroid
  /// Nanoseconds per call: median, minimum, upper quartile. Empty if not measured.
  std::optional<double> median, min, quarter;

  static constexpr auto fields() {
    using A = ReducerAnswer;
    return field::list(field::exact<&A::name>, field::exact<&A::kept>.into("points"),
                       field::area<&A::area>, field::exact<&A::area_ratio>,
                       field::exact<&A::deepest_kept>, field::exact<&A::supports_center_of_mass>,
                       field::exact<&A::wrench_error>, field::length<&A::depth_error>,
                       field::exact<&A::ids_changed>, field::length<&A::patch_moved>,
                       field::exact<&A::median>.in("nanoseconds"),
                       field::exact<&A::min>.in("nanoseconds"),
                       field::exact<&A::quarter>.keyed("upper_quartile").in("nanoseconds"));
  }
};

/// One pair in one frame; for a mesh, one of its triangles.
struct Exploration {
  std::string scenario;
  int frame = 0;
  std::string a, b, label;
  std::optional<int> triangle{};  // set if one of the pair is a mesh
  std::vector<Point> points;      // all, before any reduction
  Vec3d normal = Vec3d::Zero();
  double best_area = 0;
  std::vector<int> best{};  // indices of the points with the largest area
  /// Metres: largest movement of a surface point of either body since the previous frame.
  double bodies_moved = 0;
  std::vector<ReducerAnswer> reducers{};

  static constexpr auto fields() {
    using E = Exploration;
    return field::list(field::exact<&E::scenario>, field::exact<&E::frame>,
                       field::exact<&E::a>.where_set(), field::exact<&E::b>.where_set(),
                       field::exact<&E::label>.where_set(), field::exact<&E::triangle>,
                       field::facts<&E::points>, field::direction_to_b<&E::normal>,
                       field::area<&E::best_area>, field::exact<&E::best>.into("points"),
                       field::length<&E::bodies_moved>, field::facts<&E::reducers>);
  }
};

/// One line of JSON without the newline; keys in the order of README.md.
std::string to_json_line(const Exploration& exploration);

}  // namespace contactscope::trace
