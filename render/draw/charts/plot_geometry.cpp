#include "draw/charts/plot.h"

#include "draw/scene/palette.h"

namespace contactscope::draw {
namespace {

// Pixels at 720 lines.
constexpr Color kQuietLine = rgb(0xA9AEB5);
constexpr float kZeroSlot = 12, kFailureRow = 18, kCross = 5, kPlotMargin = 16;
constexpr float kMaxLabelShare = 0.2f;  // share of the width that is kept free on the right
constexpr float kMaxCountShare = 0.4f;  // if counts of failures have no other place

using Stretch = std::array<float, 2>;  // from, to

struct Mapping {
  const trace::Study& study;
  ErrorKind kind;
  const Rect& area;
  float scale;
  const trace::Study& whole;

  float left = static_cast<float>(area.x), right = static_cast<float>(area.right());
  float top = static_cast<float>(area.y);
  Axis x{};
  std::vector<std::vector<Stretch>> rows{};  // of failures: occupied stretches of each row

  PlotGeometry run() {
    choose_time_axis();
    std::vector<Course> courses;
    float failures_end = top;
    for (const trace::StudySeries& series : study.series) {
      Course& course = courses.emplace_back();
      course.method = series.method;
      course.style =
          method_style(series.look ? static_cast<std::size_t>(*series.look) : courses.size() - 1);
      if (series.quiet) course.style = {kQuietLine, kQuietText, course.style.marker};
      course.failures = failures_of(series);
      if (course.failures.empty()) continue;
      place_failures(series, course);
      failures_end = std::max(failures_end, course.failure_row);
    }
    if (failures_end > top) failures_end += 0.5f * px(kFailureRow);

    const auto bottom = static_cast<float>(area.bottom());
    const auto zero = [&](const trace::StudyPoint& point) { return is_zero(point); };
    float slots = 0;  // one row for each series with a zero
    for (const trace::StudySeries& series : study.series)
      slots += std::ranges::any_of(series.points, zero) ? 1 : 0;
    const float zeros_begin = slots == 0 ? bottom : bottom - px(kZeroSlot) * (slots + 0.6f);
    const Axis y = error_axis(zeros_begin, failures_end);
    const std::vector<bool> front = on_front(study, kind);
    float slot = 0;
    for (std::size_t i = 0; i < courses.size(); ++i) {
      courses[i].quiet = study.series[i].quiet;
      // Methods with a single point that the title mentions are strong too.
      const std::vector<trace::StudyPoint>& own = study.series[i].points;
      const bool is_named = own.size() == 1 && !own.front().mark.empty();
      courses[i].strong = (front[i] || is_named) && !courses[i].quiet;
      const std::vector<trace::StudyPoint>& points = study.series[i].points;
      const float zero_row = zeros_begin + px(kZeroSlot) * (slot + 0.8f);
      for (const trace::StudyPoint& point : points) {
        const std::optional<double>& error = error_of(point, kind);
        if (!error) continue;
        const auto& [median, least, most] = point.nanoseconds;
        courses[i].points.push_back({x.at(median), is_zero(point) ? zero_row : y.at(*error)});
        courses[i].spread.push_back({x.at(least), x.at(most)});
        courses[i].parameters.push_back(point.parameter);
        courses[i].marks.push_back(point.mark);
      }
      slot += std::ranges::any_of(points, zero) ? 1 : 0;
    }
    const bool rounded = std::ranges::any_of(points_of(study), [&](const trace::StudyPoint& point) {
      return is_zero(point) && *error_of(point, kind) > 0;
    });
    const std::string label = rounded ? "≤ " + spell_tick_error(study.resolution, study.unit) : "0";
    return {area, failures_end, zeros_begin, label, x, y, std::move(courses)};
  }

  float px(float at_720) const { return scale * at_720; }
  bool is_zero(const trace::StudyPoint& point) const {
    const std::optional<double>& error = error_of(point, kind);
    return error && *error <= study.resolution;
  }
  float width_of(const std::string& text, FontWeight weight = FontWeight::Regular) const {
    return text_width(text, px(kPlotText), weight);
  }

  void choose_time_axis() {
    PositiveRange times;
    for (const trace::StudyPoint& point : points_of(whole))
      for (const double time : {point.nanoseconds.min, point.nanoseconds.max}) times.include(time);
    float widest_name = 0, widest_count = 0;
    for (const trace::StudySeries& series : whole.series)
      widest_count = std::max(widest_count, width_of(count_of(series)));
    for (const trace::StudySeries& series : study.series)
      widest_name = std::max(widest_name, width_of(series.method, FontWeight::Bold));
    const auto leave_room = [&](float widest, float share) {
      const float room = std::min(widest + px(kPlotMargin), share * static_cast<float>(area.width));
      x = times.axis(left, right, px(kPlotMargin), room);
    };
    leave_room(widest_name, kMaxLabelShare);
    if (!failures_fit()) leave_room(widest_count, kMaxCountShare);
  }

  Axis error_axis(float from, float to) const {
    PositiveRange errors;
    for (const trace::StudyPoint& point : points_of(whole))
      if (!is_zero(point)) errors.include(error_of(point, kind).value_or(0));
    return errors.axis(from, to, px(kPlotMargin), px(kPlotMargin));
  }

  /// The text next to crosses.
  static std::string count_of(const trace::StudySeries& series) {
    return series.method + ": " + spell_failures(series);
  }

  std::vector<float> failures_of(const trace::StudySeries& series) const {
    std::vector<float> places;
    for (const trace::StudyPoint& point : series.points)
      if (point.failed > 0) places.push_back(x.at(point.nanoseconds.median));
    return places;
  }

  /// Whether each count of failures, in all panels, fits before its first cross or after its last.
  bool failures_fit() const {
    return std::ranges::all_of(whole.series, [&](const trace::StudySeries& series) {
      const std::vector<float> failures = failures_of(series);
      if (failures.empty()) return true;
      const auto [first, last] = std::ranges::minmax(failures);
      const float width = width_of(count_of(series)) + px(2 * kCross);
      return first - width >= left + px(2) || last + width <= right;
    });
  }

  // One row for each method with failures; two share a row if they do not overlap.
  void place_failures(const trace::StudySeries& series, Course& course) {
    course.failure_text = count_of(series);
    const float width = width_of(course.failure_text);
    const auto [first, last] = std::ranges::minmax(course.failures);
    float begin = first - px(2 * kCross);
    float end = last + px(2 * kCross);
    const bool fits_right = end + width <= right;
    const float text_left = fits_right ? end : std::max(left + px(2), begin - width);
    begin = std::min(begin, text_left);
    end = std::max(end, text_left + width) + px(kPlotMargin);
    auto row = std::ranges::find_if(rows, [&](const std::vector<Stretch>& taken) {
      return std::ranges::none_of(
          taken, [&](const Stretch& other) { return begin < other[1] && other[0] < end; });
    });
    if (row == rows.end()) row = rows.emplace(row);
    row->push_back({begin, end});
    const auto number = static_cast<float>(row - rows.begin());
    course.failure_row = top + px(kFailureRow) * (number + 0.6f);
    course.failure_text_at = {text_left, course.failure_row + 0.34f * px(kPlotText)};
  }
};

}  // namespace

PlotGeometry plot_geometry(const trace::Study& study, ErrorKind kind, const Rect& area, float scale,
                           const trace::Study& whole) {
  return Mapping{study, kind, area, scale, whole}.run();
}

}  // namespace contactscope::draw
