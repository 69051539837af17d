#include "trace/exploration.h"

#include "trace/json_values.h"

namespace contactscope::trace {
namespace {

Json answer(const ReducerAnswer& a) {
  Json result = {{"name", a.name},
                 {"kept", a.kept},
                 {"area", number(a.area, "area")},
                 {"area_ratio", number(a.area_ratio, "area_ratio")},
                 {"deepest_kept", a.deepest_kept},
                 {"supports_center_of_mass", a.supports_center_of_mass},
                 {"wrench_error", number(a.wrench_error, "wrench_error")},
                 {"depth_error", number(a.depth_error, "depth_error")},
                 {"ids_changed", a.ids_changed},
                 {"patch_moved", number(a.patch_moved, "patch_moved")}};
  if (a.median) {
    result["nanoseconds"] = {
        {"median", number(*a.median, "median")},
        {"min", number(a.min.value_or(*a.median), "min")},
        {"upper_quartile", number(a.quarter.value_or(*a.median), "upper_quartile")}};
  }
  return result;
}

}  // namespace

std::string to_json_line(const Exploration& e) {
  Json line = {{"schema", "contactscope.explore/1"},
               {"scenario", e.scenario},
               {"frame", e.frame},
               {"a", e.a},
               {"b", e.b}};
  if (!e.label.empty()) line["label"] = e.label;
  if (e.triangle) line["triangle"] = *e.triangle;
  line["points"] = points(e.points);
  line["normal"] = vector(e.normal, "normal");
  line["best_area"] = number(e.best_area, "best_area");
  line["best"] = e.best;
  line["bodies_moved"] = number(e.bodies_moved, "bodies_moved");
  Json answers = Json::array();
  for (const ReducerAnswer& a : e.reducers) answers.push_back(answer(a));
  line["reducers"] = std::move(answers);
  return line.dump();
}

}  // namespace contactscope::trace
