#include "study/picture.h"

#include "core/spell.h"

namespace contactscope::record {
namespace {

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

void keep(trace::Study& study, const std::vector<Kept>& list,
          std::string trace::StudySeries::*name) {
  if (list.empty()) return;
  std::vector<trace::StudySeries> lines;
  for (const Kept& kept : list) {
    const bool is_start = kept.from.ends_with('*');
    const std::string_view start(kept.from.data(), kept.from.size() - (is_start ? 1 : 0));
    for (const trace::StudySeries& series : study.series) {
      if (is_start ? !(series.*name).starts_with(start) : series.*name != start) continue;
      trace::StudySeries& line = lines.emplace_back(series);
      line.*name = kept.to;
      line.quiet = line.quiet || kept.quiet;
      if (kept.look || !line.look) line.look = kept.look.value_or(look_of(study, series.method));
    }
  }
  study.series = std::move(lines);
}

void set(std::string& text, const std::string& value) {
  if (!value.empty()) text = value;
}

void replace(std::string& text, std::string_view from, const std::string& to) {
  if (const std::size_t i = text.find(from); i != std::string::npos)
    text.replace(i, from.size(), to);
}

}  // namespace

void drop_worst(trace::Study& study) {
  each_point(study, [](trace::StudyPoint& point) { point.error_worst.reset(); });
}

void scale_errors(trace::Study& study, double factor) {
  each_point(study, [&](trace::StudyPoint& point) {
    for (std::optional<double>* error : {&point.error, &point.error_worst})
      if (*error) **error *= factor;
  });
}

std::string number(double value, int digits) {
  if (value == 0) return "0";
  const double size = std::abs(value);
  int decimals = digits - 1 - static_cast<int>(std::floor(std::log10(size) + 1e-9));
  // Rounding may add a digit: 9.96 is "10".
  if (std::round(size * std::pow(10, decimals)) >= std::pow(10, digits)) --decimals;
  const double unit = std::pow(10, -decimals);
  std::string spelled = printed("%.*f", std::max(decimals, 0), std::round(size / unit) * unit);
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

std::string count(double value) { return spell_count(std::llround(value)); }

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

Picture::Picture(const PictureRow& of, const trace::Study& study)
    : row(of), measured(study), drawn(study) {
  const PictureOptions& options = row.options;
  keep(drawn, row.methods, &trace::StudySeries::method);
  keep(drawn, row.panels, &trace::StudySeries::panel);
  if (options.only_at)
    drop_points([&](const trace::StudyPoint& point) { return point.parameter != options.at; });
  each_point(drawn, [&](trace::StudyPoint& point) {
    if (options.only_at) point.nanoseconds.median = point.nanoseconds.max = point.nanoseconds.min;
    if (options.only_at || options.drop_worst) point.error_worst.reset();
    for (std::optional<double>* error : {&point.error, &point.error_worst})
      if (options.drop_resolution && *error && **error <= drawn.resolution) *error = 0;
  });
  scale_errors(drawn, options.scale);
  drawn.resolution *= options.scale;
  for (trace::StudySeries& line : lines) set(line.parameter, row.parameter);
  set(drawn.unit, row.unit);
  set(drawn.error, options.error);
  set(drawn.failed, options.failed);
  set(drawn.shown, row.shown);
  replace(drawn.shown, "{error}", drawn.error);
  drawn.form = options.form.value_or(drawn.form);
  const auto& [first, last] = options.left_out;
  const std::size_t begin = drawn.reference.find(first), end = drawn.reference.rfind(last);
  if (!first.empty() && begin < end && end != std::string::npos)
    drawn.reference.erase(begin, end - begin);
}

const std::string& Picture::name_of(const std::string& method) const {
  const auto kept = std::ranges::find(row.methods, method, &Kept::from);
  return kept == row.methods.end() ? method : kept->to;
}

const trace::StudyPoint& Picture::point(const std::string& method) const {
  const std::string panel = row.panels.empty() ? "" : row.panels.front().from;
  return point_at(series_of(measured, method, panel), row.options.at);
}

double Picture::error(const std::string& method) const {
  if (const std::optional<double>& error = point(method).error) return *error;
  throw std::out_of_range("'" + method + "' failed in all cases");
}

std::string Picture::mark(const std::string& method, const std::string& words) {
  for (trace::StudySeries& line : lines)
    for (trace::StudyPoint& point : line.points)
      if (line.method == name_of(method) && is_at(point, row.options.at)) point.mark = words;
  return words;
}

void Picture::add_to_name(const std::string& method, const std::string& words) {
  for (trace::StudySeries& line : lines)
    if (line.method == name_of(method)) line.method += ": " + words;
}

void Picture::mark_with_name(const std::string& method, const std::string& words) {
  mark(method, name_of(method) + ": " + words);
  for (trace::StudySeries& line : lines)
    if (line.method == name_of(method)) line.method.clear();
}

void Picture::join_equal() {
  using Place = std::tuple<std::string, double, std::optional<double>, std::optional<double>, int>;
  std::map<std::string, std::vector<Place>> places;
  for (const trace::StudySeries& line : lines)
    for (const trace::StudyPoint& point : line.points)
      places[line.method].emplace_back(line.panel, point.parameter, point.error, point.error_worst,
                                       point.failed);
  std::map<std::vector<Place>, std::vector<std::string>> methods;
  for (const trace::StudySeries& line : lines) {
    std::vector<std::string>& same = methods[places[line.method]];
    if (std::ranges::find(same, line.method) == same.end()) same.push_back(line.method);
  }
  std::erase_if(lines, [&](const trace::StudySeries& line) {
    return methods[places[line.method]].front() != line.method;
  });
  for (trace::StudySeries& line : lines) line.method = listed(methods[places[line.method]]);
}

trace::Study drawn_by(const PictureRow& row, const trace::Study& measured) {
  Picture picture(row, measured);
  try {
    if (row.result != nullptr) set(picture.drawn.title, row.result(picture));
  } catch (const std::out_of_range&) {
  }
  return std::move(picture.drawn);
}

const trace::StudySeries& series_of(const trace::Study& study, std::string_view method,
                                    std::optional<std::string_view> panel) {
  for (const trace::StudySeries& series : study.series)
    if (series.method == method && series.panel == panel.value_or(series.panel)) return series;
  throw std::out_of_range(study.study + ": no series '" + std::string(method) + "'");
}

const trace::StudyPoint& point_at(const trace::StudySeries& series, double parameter) {
  for (const trace::StudyPoint& point : series.points)
    if (is_at(point, parameter)) return point;
  throw std::out_of_range("'" + series.method + "' has no point at " + number(parameter));
}

double error_at(const trace::StudySeries& series, double parameter) {
  if (const std::optional<double>& error = point_at(series, parameter).error) return *error;
  throw std::out_of_range("'" + series.method + "' failed in all cases");
}

double largest_error(const trace::Study& study, const std::vector<std::string>& methods) {
  double largest = 0;
  for (const trace::StudySeries& series : study.series)
    for (const trace::StudyPoint& point : series.points)
      if (std::ranges::find(methods, series.method) != methods.end())
        largest = std::max(largest, error_of(point));
  return largest;
}

}  // namespace contactscope::record
