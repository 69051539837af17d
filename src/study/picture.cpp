#include "study/picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "core/at.h"

namespace contactscope::record {
namespace {

/// Index in the list of all methods of the study, without duplicates.
int look_of(const trace::Study& study, const std::string& method) {
  std::vector<std::string> methods;
  for (const trace::StudySeries& series : study.series)
    if (std::ranges::find(methods, series.method) == methods.end())
      methods.push_back(series.method);
  return static_cast<int>(std::ranges::find(methods, method) - methods.begin());
}

bool is_at(const trace::StudyPoint& point, double parameter) {
  return std::abs(point.parameter - parameter) <= 1e-9 * std::abs(parameter);
}

bool same_places(const trace::StudySeries& one, const trace::StudySeries& other) {
  return one.panel == other.panel &&
         std::ranges::equal(one.points, other.points,
                            [](const trace::StudyPoint& a, const trace::StudyPoint& b) {
                              return a.parameter == b.parameter && a.error == b.error &&
                                     a.error_worst == b.error_worst && a.failed == b.failed;
                            });
}

/// Keeps the series with one of these names, which they then get; colours as in the full study.
void keep(trace::Study& study, const std::vector<Named>& named,
          std::string trace::StudySeries::*name) {
  std::vector<trace::StudySeries> kept;
  for (const auto& [from, to] : named) {
    for (const trace::StudySeries& series : study.series) {
      if (series.*name != from) continue;
      kept.push_back(series);
      if (!series.look) kept.back().look = look_of(study, series.method);
      kept.back().*name = to;
    }
  }
  study.series = std::move(kept);
}

/// Units, the largest first; a value uses the first in which it is at least one.
struct Unit {
  double size;
  const char* name;
};

template <std::size_t Count>
std::string in_unit(double value, int digits, const std::array<Unit, Count>& units) {
  const auto fits = [&](const Unit& unit) { return value >= unit.size * 0.9995; };
  const auto found = std::ranges::find_if(units, fits);
  const Unit& unit = found == units.end() ? units.back() : *found;
  return number(value / unit.size, digits) + " " + unit.name;
}

std::string superscript(int exponent) {
  constexpr std::array<const char*, 10> kDigits = {"⁰", "¹", "²", "³", "⁴",
                                                   "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(exponent))) text += at(kDigits, digit - '0');
  return text;
}

}  // namespace

const trace::StudySeries& series_of(const trace::Study& study, const std::string& method,
                                    const std::string& panel) {
  for (const trace::StudySeries& series : study.series)
    if (series.method == method && series.panel == panel) return series;
  throw std::out_of_range(study.study + ": no series '" + method + "' in panel '" + panel + "'");
}

const trace::StudyPoint& point_at(const trace::StudySeries& series, double parameter) {
  for (const trace::StudyPoint& point : series.points)
    if (is_at(point, parameter)) return point;
  throw std::out_of_range("'" + series.method + "' has no point at " + number(parameter));
}

double error_at(const trace::StudySeries& series, double parameter) {
  const trace::StudyPoint& point = point_at(series, parameter);
  if (!point.error) throw std::out_of_range("'" + series.method + "' failed in all cases");
  return *point.error;
}

void keep_methods(trace::Study& study, const std::vector<Named>& named) {
  keep(study, named, &trace::StudySeries::method);
}

void keep_panels(trace::Study& study, const std::vector<Named>& named) {
  keep(study, named, &trace::StudySeries::panel);
}

void join_equal(trace::Study& study) {
  struct Group {
    std::vector<std::string> methods;
    std::vector<trace::StudySeries> series;  // of the first method, one per panel
  };
  std::vector<Group> methods, groups;
  for (const trace::StudySeries& series : study.series) {
    const auto known = std::ranges::find_if(
        methods, [&](const Group& one) { return one.methods.front() == series.method; });
    if (known == methods.end())
      methods.push_back({{series.method}, {series}});
    else
      known->series.push_back(series);
  }
  for (Group& one : methods) {
    const auto same = std::ranges::find_if(groups, [&](const Group& group) {
      return std::ranges::equal(group.series, one.series, same_places);
    });
    if (same == groups.end())
      groups.push_back(std::move(one));
    else
      same->methods.push_back(one.methods.front());
  }
  std::vector<trace::StudySeries> joined;
  for (trace::StudySeries& series : study.series)
    for (const Group& group : groups)
      if (group.methods.front() == series.method) {
        joined.push_back(std::move(series));
        joined.back().method = listed(group.methods);
        break;
      }
  study.series = std::move(joined);
}

void mark(trace::Study& study, const std::string& method, const std::string& panel,
          double parameter, const std::string& words) {
  for (trace::StudySeries& series : study.series) {
    if (series.method != method || series.panel != panel) continue;
    for (trace::StudyPoint& point : series.points)
      if (is_at(point, parameter)) point.mark = words;
  }
}

void name_parameter(trace::Study& study, const std::string& name) {
  for (trace::StudySeries& series : study.series) series.parameter = name;
}

void drop_worst(trace::Study& study) {
  each_point(study, [](trace::StudyPoint& point) { point.error_worst.reset(); });
}

double largest_error(const trace::StudySeries& series) {
  double largest = 0;
  for (const trace::StudyPoint& point : series.points) largest = std::max(largest, error_of(point));
  return largest;
}

void scale_errors(trace::Study& study, double factor) {
  each_point(study, [&](trace::StudyPoint& point) {
    for (std::optional<double>* error : {&point.error, &point.error_worst})
      if (*error) **error *= factor;
  });
}

void show_least_times(trace::Study& study) {
  each_point(study, [](trace::StudyPoint& point) {
    point.nanoseconds.median = point.nanoseconds.max = point.nanoseconds.min;
  });
}

void drop_resolution(trace::Study& study) {
  each_point(study, [&](trace::StudyPoint& point) {
    for (std::optional<double>* error : {&point.error, &point.error_worst})
      if (*error && **error <= study.resolution) *error = 0;
  });
}

std::string number(double value, int digits) {
  if (value == 0) return "0";
  const double size = std::abs(value);
  int decimals = digits - 1 - static_cast<int>(std::floor(std::log10(size) + 1e-9));
  // Rounding may add a digit: 9.96 is "10".
  if (std::round(size * std::pow(10, decimals)) >= std::pow(10, digits)) --decimals;
  const double unit = std::pow(10, -decimals);
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", std::max(decimals, 0),
                std::round(size / unit) * unit);
  std::string spelled = text.data();
  if (spelled.find('.') != std::string::npos) {
    spelled.erase(spelled.find_last_not_of('0') + 1);
    if (spelled.back() == '.') spelled.pop_back();
  }
  return (value < 0 ? "−" : "") + spelled;
}

std::string percent(double share) {
  // Rounds halves up, even if their double is slightly below, as for 57.5 % and 68.5 %.
  return number(100 * share * (1 + 1e-12)) + " %";
}

std::string count(double value) {
  std::string digits = std::to_string(std::llround(value));
  for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, ",");
  return digits;
}

std::string length(double metres, int digits) {
  constexpr std::array<Unit, 5> kUnits = {
      {{1e3, "km"}, {1, "m"}, {1e-2, "cm"}, {1e-3, "mm"}, {1e-6, "µm"}}};
  return in_unit(metres, digits, kUnits);
}

std::string duration(double nanoseconds, int digits) {
  constexpr std::array<Unit, 4> kUnits = {{{1e9, "s"}, {1e6, "ms"}, {1e3, "µs"}, {1, "ns"}}};
  return in_unit(nanoseconds, digits, kUnits);
}

std::string power(double value) {
  const int exponent = static_cast<int>(std::floor(std::log10(value) + 1e-9));
  const double factor = value / std::pow(10.0, exponent);
  if (exponent >= -3 && exponent < 4) return number(value);
  return (std::abs(factor - 1) < 0.05 ? "" : number(factor) + " × ") + "10" + superscript(exponent);
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

}  // namespace contactscope::record
