#include "app/study_tables.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "app/table.h"

namespace contactscope::app {
namespace {

/// Whether both fit into one table, which has a column for each parameter.
bool share_table(const trace::StudySeries& one, const trace::StudySeries& other) {
  return one.panel == other.panel &&
         std::ranges::equal(one.points, other.points, {}, &trace::StudyPoint::parameter,
                            &trace::StudyPoint::parameter);
}

/// Series of one panel stand together; without panels all are one.
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

/// What the first column of a panel's table is called, and what is told apart by the others.
std::string head_of(const trace::StudySeries& series) {
  return series.panel.empty() ? "method" : series.panel;
}
std::string parameter_of(const trace::Study& result, const trace::StudySeries& series) {
  return series.parameter.empty() ? result.parameter : series.parameter;
}

void print_errors(const trace::Study& result, const SeriesRange& panel, std::ostream& out) {
  const std::vector<trace::StudyPoint>& parameters = panel.front().points;
  const bool has_worst = std::ranges::any_of(
      parameters, [](const trace::StudyPoint& point) { return point.error_worst.has_value(); });
  out << result.error << (result.unit.empty() ? "" : " (" + result.unit + ")")
      << (has_worst ? ": mean / worst" : ": mean") << ", by " << parameter_of(result, panel.front())
      << '\n';
  std::vector<std::string> heads = {head_of(panel.front())};
  for (const trace::StudyPoint& point : parameters) heads.push_back(spelled("%g", point.parameter));
  heads.push_back("failed");
  Table table(heads);
  for (const trace::StudySeries& series : panel) {
    std::vector<std::string> cells = {series.method};
    int failed = 0;
    for (const trace::StudyPoint& point : series.points) {
      std::string cell = point.error ? spelled("%.2g", *point.error) : "-";
      if (has_worst) cell += point.error_worst ? spelled(" / %.2g", *point.error_worst) : " / -";
      cells.push_back(cell);
      failed += point.failed;
    }
    cells.push_back(std::to_string(failed));
    table.add(cells);
  }
  table.print(out);
}

void print_times(const trace::Study& result, const SeriesRange& panel, std::ostream& out) {
  out << "nanoseconds a call: median / least, by " << parameter_of(result, panel.front()) << '\n';
  std::vector<std::string> heads = {head_of(panel.front())};
  for (const trace::StudyPoint& point : panel.front().points) {
    heads.push_back(spelled("%g", point.parameter));
  }
  Table table(heads);
  for (const trace::StudySeries& series : panel) {
    std::vector<std::string> cells = {series.method};
    for (const trace::StudyPoint& point : series.points) {
      cells.push_back(spelled("%.0f", point.nanoseconds.median) +
                      spelled(" / %.0f", point.nanoseconds.min));
    }
    table.add(cells);
  }
  table.print(out);
}

bool is_whole_decade(double value) {
  const double exponent = std::log10(value);
  return std::abs(exponent - std::round(exponent)) < 1e-6;
}

/// The series of one panel stand together.
void print_curves(const trace::Study& result, std::ostream& out) {
  for (std::size_t i = 0; i < result.series.size();) {
    const std::string& panel = result.series[i].panel;
    out << "largest " << result.error << ", by " << result.series[i].parameter << '\n';
    std::vector<std::string> heads = {panel};
    for (const trace::StudyPoint& point : result.series[i].points) {
      if (is_whole_decade(point.parameter)) heads.push_back(spelled("%g", point.parameter));
    }
    heads.push_back("failed");
    Table table(heads);
    for (; i < result.series.size() && result.series[i].panel == panel; ++i) {
      const trace::StudySeries& series = result.series[i];
      std::vector<std::string> cells = {series.method};
      int failed = 0, of = 0;
      for (const trace::StudyPoint& point : series.points) {
        failed += point.failed;
        of += point.of;
        if (!is_whole_decade(point.parameter)) continue;
        std::string cell = point.error_worst ? spelled("%.1e", *point.error_worst) : "-";
        if (point.failed > 0) cell += "!";
        cells.push_back(cell);
      }
      cells.push_back(std::to_string(failed) + " of " + std::to_string(of));
      table.add(cells);
    }
    table.print(out);
    out << '\n';
  }
}

void print_map(const trace::Study& result, std::ostream& out) {
  out << result.title << ": " << result.error << '\n';
  Table table({"panel", "median", "worst", "cells", "cells with failures", "failed"});
  for (std::size_t i = 0; i < result.series.size();) {
    const std::string& panel = result.series[i].panel;
    std::vector<double> errors;
    int cells = 0, failing = 0, failed = 0, of = 0;
    for (; i < result.series.size() && result.series[i].panel == panel; ++i) {
      for (const trace::StudyPoint& point : result.series[i].points) {
        if (point.error_worst) errors.push_back(*point.error_worst);
        ++cells;
        failing += point.failed > 0 ? 1 : 0;
        failed += point.failed;
        of += point.of;
      }
    }
    std::ranges::sort(errors);
    table.add({panel, errors.empty() ? "-" : spelled("%.2g", errors[errors.size() / 2]),
               errors.empty() ? "-" : spelled("%.2g", errors.back()), std::to_string(cells),
               std::to_string(failing), std::to_string(failed) + " of " + std::to_string(of)});
  }
  table.print(out);
  out << '\n';
}

}  // namespace

// Times are those of the same runs in all results of a study.
void print_tables(const std::vector<trace::Study>& results, std::ostream& out) {
  for (const trace::Study& result : results) {
    switch (result.form) {
      case trace::StudyForm::Curves:
        print_curves(result, out);
        break;
      case trace::StudyForm::Map:
        print_map(result, out);
        break;
      case trace::StudyForm::WorkPrecision:
        for (const SeriesRange& panel : by_panel(result)) {
          print_errors(result, panel, out);
          out << '\n';
        }
        break;
    }
  }
  if (results.front().form != trace::StudyForm::WorkPrecision) return;
  const std::vector<SeriesRange> panels = by_panel(results.front());
  for (const SeriesRange& panel : panels) {
    print_times(results.front(), panel, out);
    if (&panel != &panels.back()) out << '\n';
  }
}

}  // namespace contactscope::app
