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
  return std::ranges::equal(one.points, other.points,
                            [](const trace::StudyPoint& a, const trace::StudyPoint& b) {
                              return a.parameter == b.parameter && a.error == b.error &&
                                     a.error_worst == b.error_worst && a.failed == b.failed;
                            });
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
  std::vector<trace::StudySeries> kept;
  for (const Named& one : named) {
    for (const trace::StudySeries& series : study.series) {
      if (series.method != one.first) continue;
      kept.push_back(series);
      kept.back().look = look_of(study, series.method);
      kept.back().method = one.second;
    }
  }
  study.series = std::move(kept);
}

void keep_panels(trace::Study& study, const std::vector<Named>& named) {
  std::vector<trace::StudySeries> kept;
  for (const Named& one : named) {
    for (const trace::StudySeries& series : study.series) {
      if (series.panel != one.first) continue;
      kept.push_back(series);
      if (!kept.back().look) kept.back().look = look_of(study, series.method);
      kept.back().panel = one.second;
    }
  }
  study.series = std::move(kept);
}

void join_equal(trace::Study& study) {
  const auto of_method = [&](const std::string& method) {
    std::vector<const trace::StudySeries*> list;
    for (const trace::StudySeries& series : study.series)
      if (series.method == method) list.push_back(&series);
    return list;
  };
  const auto equal = [&](const std::string& one, const std::string& other) {
    return std::ranges::equal(of_method(one), of_method(other),
                              [](const trace::StudySeries* a, const trace::StudySeries* b) {
                                return a->panel == b->panel && same_places(*a, *b);
                              });
  };
  std::vector<std::vector<std::string>> groups;
  for (const trace::StudySeries& series : study.series) {
    const auto is_in = [&](const std::vector<std::string>& group) {
      return std::ranges::find(group, series.method) != group.end();
    };
    if (std::ranges::any_of(groups, is_in)) continue;
    const auto same = std::ranges::find_if(
        groups, [&](const auto& group) { return equal(group.front(), series.method); });
    if (same == groups.end())
      groups.push_back({series.method});
    else
      same->push_back(series.method);
  }
  for (const std::vector<std::string>& group : groups) {
    std::erase_if(study.series, [&](const trace::StudySeries& series) {
      return series.method != group.front() &&
             std::ranges::find(group, series.method) != group.end();
    });
    for (trace::StudySeries& series : study.series)
      if (series.method == group.front()) series.method = listed(group);
  }
}

void mark(trace::Study& study, const std::string& method, const std::string& panel,
          double parameter, const std::string& words) {
  for (trace::StudySeries& series : study.series) {
    if (series.method != method || series.panel != panel) continue;
    for (trace::StudyPoint& point : series.points)
      if (is_at(point, parameter)) point.mark = words;
  }
}

void show_least_times(trace::Study& study) {
  for (trace::StudySeries& series : study.series)
    for (trace::StudyPoint& point : series.points)
      point.nanoseconds.median = point.nanoseconds.max = point.nanoseconds.min;
}

void drop_resolution(trace::Study& study) {
  for (trace::StudySeries& series : study.series) {
    for (trace::StudyPoint& point : series.points) {
      for (std::optional<double>* error : {&point.error, &point.error_worst})
        if (*error && **error <= study.resolution) *error = 0;
    }
  }
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
