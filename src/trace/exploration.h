#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trace/trace.h"

/// What every reducer makes of the same points. FORMATS.md, "Explore".
namespace contactscope::trace {

/// One reducer's answer. Areas in square metres, of the convex hull in the contact plane.
struct ReducerAnswer {
  std::string name;
  std::vector<int> kept;  // indices into the points, in the order of choice
  double area = 0;
  double area_ratio = 1;  // to the best that as many points can span
  bool deepest_kept = false;
  bool supports_center_of_mass = false;
  double wrench_error = 0;  // lost reach for moments, in radii of the patch
  double depth_error = 0;   // metres
  int ids_changed = 0;      // kept now and not in the frame before, or the other way
  double patch_moved = 0;   // metres that a kept point, or the middle of all, moved at most
  /// Nanoseconds a call: median, the least, and the upper quartile. Empty when not measured.
  std::optional<double> median, min, quarter;
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
  std::vector<int> best;  // indices of the points that span it
  /// Metres that a surface point of either body moved since the frame before, at most.
  double bodies_moved = 0;
  std::vector<ReducerAnswer> reducers;
};

/// One line of JSON without the newline, keys in the order of FORMATS.md. Beyond it: "label" where
/// one is set, "triangle" of a mesh, "best", "bodies_moved", and of each reducer "wrench_error",
/// "depth_error", "ids_changed", "patch_moved" and the "upper_quartile" of "nanoseconds".
std::string to_json_line(const Exploration& exploration);

}  // namespace contactscope::trace
