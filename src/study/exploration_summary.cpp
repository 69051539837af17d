#include <algorithm>
#include <limits>
#include <tuple>

#include "study/exploration.h"

namespace contactscope {

std::vector<ReducerSummary> summarize(const std::vector<trace::Exploration>& explorations) {
  std::vector<ReducerSummary> rows;
  if (explorations.empty()) return rows;
  for (std::size_t i = 0; i < explorations.front().reducers.size(); ++i) {
    ReducerSummary row;
    row.name = explorations.front().reducers[i].name;
    row.mean_area_ratio = row.deepest_kept = 0;
    std::vector<double> medians;
    std::vector<double> quarters;
    std::vector<double> least;
    const double share = 1.0 / static_cast<double>(explorations.size());
    for (const trace::Exploration& exploration : explorations) {
      const trace::ReducerAnswer& answer = exploration.reducers[i];
      row.mean_area_ratio += share * answer.area_ratio;
      row.worst_area_ratio = std::min(row.worst_area_ratio, answer.area_ratio);
      row.mean_wrench_error += share * answer.wrench_error;
      row.worst_wrench_error = std::max(row.worst_wrench_error, answer.wrench_error);
      row.worst_depth_error = std::max(row.worst_depth_error, answer.depth_error);
      row.deepest_kept += answer.deepest_kept ? share : 0;
      if (answer.supports_center_of_mass)
        row.supported = row.supported.value_or(0) + (*answer.supports_center_of_mass ? share : 0);
      row.ids_changed += answer.ids_changed;
      if (answer.patch_moved > 0 || exploration.bodies_moved > 0) {
        const double moves = exploration.bodies_moved > 0
                                 ? answer.patch_moved / exploration.bodies_moved
                                 : std::numeric_limits<double>::infinity();
        row.moves = std::max(row.moves.value_or(0), moves);
      }
      if (answer.median) medians.push_back(*answer.median);
      if (answer.quarter) quarters.push_back(*answer.quarter);
      if (answer.min) least.push_back(*answer.min);
    }
    std::ranges::sort(medians);
    std::ranges::sort(quarters);
    if (!medians.empty()) row.median = medians[medians.size() / 2];
    if (!quarters.empty()) row.quarter = quarters[quarters.size() / 2];
    if (!least.empty()) row.min = std::ranges::min(least);
    rows.push_back(row);
  }
  std::ranges::sort(rows, [](const ReducerSummary& a, const ReducerSummary& b) {
    return std::tuple(-a.mean_area_ratio, a.mean_wrench_error, a.name) <
           std::tuple(-b.mean_area_ratio, b.mean_wrench_error, b.name);
  });
  return rows;
}

}  // namespace contactscope
