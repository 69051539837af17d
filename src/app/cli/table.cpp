#include "app/cli/table.h"

#include "image/font.h"

namespace contactscope::app {

namespace {

struct Range {
  char32_t first, last;
};
/// Unicode 15, East Asian Width W and F, as whole blocks.
constexpr Range kWide[] = {{0x1100, 0x115f}, {0x2e80, 0xa4cf},   {0xac00, 0xd7a3},
                           {0xf900, 0xfaff}, {0xfe30, 0xfe6f},   {0xff00, 0xff60},
                           {0xffe0, 0xffe6}, {0x1f300, 0x1faff}, {0x20000, 0x3fffd}};
/// Combining marks, joiners and variation selectors.
constexpr Range kNone[] = {{0x0300, 0x036f}, {0x0483, 0x0489}, {0x0591, 0x05bd}, {0x064b, 0x065f},
                           {0x200b, 0x200f}, {0x20d0, 0x20ff}, {0xfe00, 0xfe0f}, {0xfe20, 0xfe2f}};

template <std::size_t Count> bool is_in(const Range (&ranges)[Count], char32_t character) {
  return std::ranges::any_of(ranges, [&](const Range& range) {
    return character >= range.first && character <= range.last;
  });
}

/// True if both fit into one table, which has a column per parameter.
bool share_table(const trace::StudySeries& one, const trace::StudySeries& other) {
  return one.panel == other.panel &&
         std::ranges::equal(one.points, other.points, {}, &trace::StudyPoint::parameter,
                            &trace::StudyPoint::parameter);
}

/// Groups series by panel; without panels all are one group.
using SeriesRange = std::span<const trace::StudySeries>;
std::vector<SeriesRange> by_panel(const trace::Study& result) {
  std::vector<SeriesRange> panels;
  const SeriesRange all(result.series);
  for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
    while (end < all.size() && share_table(all[begin], all[end])) ++end;
    panels.push_back(all.subspan(begin, end - begin));
  }
  return panels;
}

/// Columns to print: all if there are few, else whole decades, or if those are fewer than three,
/// evenly spaced ones and the last.
std::vector<bool> columns_shown(const SeriesRange& panel) {
  constexpr std::size_t kMax = 8, kMin = 3;
  const std::vector<trace::StudyPoint>& points = panel.front().points;
  std::vector<bool> shown(points.size(), points.size() <= kMax);
  if (points.size() <= kMax) return shown;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double decade = std::log10(points[i].parameter);
    shown[i] = points[i].parameter > 0 && std::abs(std::remainder(decade, 1)) < 1e-6;
  }
  if (std::ranges::count(shown, true) >= static_cast<std::ptrdiff_t>(kMin)) return shown;
  const std::size_t step = (points.size() + kMax - 1) / kMax;
  for (std::size_t i = 0; i < points.size(); ++i) shown[i] = (points.size() - 1 - i) % step == 0;
  return shown;
}

/// One row per series with a cell per parameter (or a selection of many). `sum` formats the
/// failures of all points for the column "failed"; null without such a column.
void print_panel(const SeriesRange& panel, std::ostream& out, bool may_leave_out,
                 const std::function<std::string(const trace::StudyPoint&)>& cell,
                 std::string (*sum)(int failed, int of)) {
  const std::vector<bool> shown =
      may_leave_out ? columns_shown(panel) : std::vector<bool>(panel.front().points.size(), true);
  std::vector<std::string> heads = {panel.front().panel.empty() ? "method" : panel.front().panel};
  for (std::size_t i = 0; i < shown.size(); ++i)
    if (shown[i]) heads.push_back(printed("%g", panel.front().points[i].parameter));
  if (sum != nullptr) heads.push_back("failed");
  Table table = {heads};
  for (const trace::StudySeries& series : panel) {
    std::vector<std::string> cells = {series.method};
    int failed = 0, of = 0;
    for (std::size_t i = 0; i < series.points.size(); ++i) {
      const trace::StudyPoint& point = series.points[i];
      if (shown[i]) cells.push_back(cell(point));
      failed += point.failed;
      of += point.of;
    }
    if (sum != nullptr) cells.push_back(sum(failed, of));
    table.push_back(cells);
  }
  print(table, out);
}

std::string parameter_of(const trace::Study& result, const SeriesRange& panel) {
  return panel.front().parameter.empty() ? result.parameter : panel.front().parameter;
}

void print_errors(const trace::Study& result, const SeriesRange& panel, std::ostream& out) {
  const bool has_worst = std::ranges::any_of(
      panel.front().points,
      [](const trace::StudyPoint& point) { return point.error_worst.has_value(); });
  out << result.error << (result.unit.empty() ? "" : " (" + result.unit + ")")
      << (has_worst ? ": mean / worst" : ": mean") << ", by " << parameter_of(result, panel)
      << '\n';
  const auto cell = [&](const trace::StudyPoint& point) {
    std::string text = point.error ? printed("%.2g", *point.error) : "-";
    if (has_worst) text += point.error_worst ? printed(" / %.2g", *point.error_worst) : " / -";
    return text;
  };
  print_panel(panel, out, false, cell, [](int failed, int) { return std::to_string(failed); });
}

void print_times(const trace::Study& result, const SeriesRange& panel, std::ostream& out) {
  out << "nanoseconds per call: median / minimum, by " << parameter_of(result, panel) << '\n';
  const auto cell = [](const trace::StudyPoint& point) {
    return printed("%.0f", point.nanoseconds.median) + printed(" / %.0f", point.nanoseconds.min);
  };
  print_panel(panel, out, false, cell, nullptr);
}

std::string share(int failed, int of) {
  return std::to_string(failed) + " of " + std::to_string(of);
}

void print_curves(const trace::Study& result, const SeriesRange& panel, std::ostream& out) {
  const bool says_unit = result.unit.empty() || result.error.ends_with(')');
  out << result.error << (says_unit ? "" : " (" + result.unit + ")") << ": largest, by "
      << parameter_of(result, panel) << '\n';
  const auto cell = [](const trace::StudyPoint& point) {
    return (point.error_worst ? printed("%.1e", *point.error_worst) : "-") +
           (point.failed > 0 ? "!" : "");
  };
  print_panel(panel, out, true, cell, share);
}

void print_map(const trace::Study& result, std::ostream& out) {
  out << result.title << ": " << result.error << '\n';
  Table table = {{"panel", "median", "worst", "cells", "cells with failures", "failed"}};
  for (const SeriesRange& panel : by_panel(result)) {
    std::vector<double> errors;
    int cells = 0, failing = 0, failed = 0, of = 0;
    for (const trace::StudySeries& series : panel) {
      for (const trace::StudyPoint& point : series.points) {
        if (point.error_worst) errors.push_back(*point.error_worst);
        ++cells;
        failing += point.failed > 0 ? 1 : 0;
        failed += point.failed;
        of += point.of;
      }
    }
    std::ranges::sort(errors);
    table.push_back({panel.front().panel,
                     errors.empty() ? "-" : printed("%.2g", errors[errors.size() / 2]),
                     errors.empty() ? "-" : printed("%.2g", errors.back()), std::to_string(cells),
                     std::to_string(failing), share(failed, of)});
  }
  print(table, out);
  out << '\n';
}

}  // namespace

std::size_t columns_of(std::string_view text) {
  std::size_t columns = 0;
  for (const char32_t character : code_points(text))
    columns += is_in(kNone, character) ? 0 : (is_in(kWide, character) ? 2 : 1);
  return columns;
}

void print(const Table& table, std::ostream& out) {
  std::vector<std::size_t> widths(table.front().size(), 0);
  for (const std::vector<std::string>& row : table) {
    for (std::size_t i = 0; i < row.size(); ++i)
      widths[i] = std::max(widths[i], columns_of(row[i]));
  }
  for (const std::vector<std::string>& row : table) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string space(widths[i] - columns_of(row[i]), ' ');
      out << (i == 0 ? row[i] + space : "  " + space + row[i]);
    }
    out << '\n';
  }
}

void print_tables(const std::vector<trace::Study>& results, std::ostream& out) {
  for (const trace::Study& result : results) {
    if (trace::has_cells(result.form)) {
      print_map(result, out);
      continue;
    }
    for (const SeriesRange& panel : by_panel(result)) {
      const bool curves = result.form == trace::StudyForm::Curves;
      (curves ? print_curves : print_errors)(result, panel, out);
      out << '\n';
    }
  }
  if (results.front().form != trace::StudyForm::WorkPrecision) return;
  // Times are of the same runs in all results of a study.
  const std::vector<SeriesRange> panels = by_panel(results.front());
  for (const SeriesRange& panel : panels) {
    print_times(results.front(), panel, out);
    if (&panel != &panels.back()) out << '\n';
  }
}

}  // namespace contactscope::app
