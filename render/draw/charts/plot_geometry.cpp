#include "draw/charts/plot_geometry.h"

#include <algorithm>

#include "image/font.h"

namespace contactscope::draw {
namespace {

// Pixels at 720 lines.
constexpr float kZeroSlot = 12;
constexpr float kFailureRow = 18;
constexpr float kCross = 5;
constexpr float kMargin = 16;
constexpr float kMostLabelShare = 0.2f;  // of the width, kept free on the right
constexpr float kMostCountShare = 0.4f;  // likewise, where counts of failures have no place else

using Stretch = std::array<float, 2>;  // from, to

class Mapping {
 public:
  Mapping(const trace::Study& study, ErrorKind kind, const Rect& area, float scale,
          const trace::Study& whole)
      : study_(study),
        whole_(whole),
        kind_(kind),
        area_(area),
        scale_(scale),
        left_(static_cast<float>(area.x)),
        right_(static_cast<float>(area.right())),
        top_(static_cast<float>(area.y)) {}

  PlotGeometry run() {
    choose_time_axis();
    float failures_end = top_;
    for (const trace::StudySeries& series : study_.series) {
      Course& course = courses_.emplace_back();
      course.method = series.method;
      course.style = method_style(courses_.size() - 1);
      course.failures = failures_of(series);
      if (course.failures.empty()) continue;
      place_failures(series, course);
      failures_end = std::max(failures_end, course.failure_row);
    }
    if (failures_end > top_) failures_end += 0.5f * px(kFailureRow);

    const auto bottom = static_cast<float>(area_.bottom());
    std::vector<float> zero_slots;  // of each series; not looked at where it has no zero
    float slots = 0;
    bool rounded = false;
    for (const trace::StudySeries& series : study_.series) {
      zero_slots.push_back(slots);
      bool has_zero = false;
      for (const trace::StudyPoint& point : series.points) {
        const std::optional<double>& error = error_of(point, kind_);
        if (!error || !is_zero(*error)) continue;
        has_zero = true;
        rounded = rounded || *error > 0;
      }
      if (has_zero) ++slots;
    }
    const float zeros_begin = slots == 0 ? bottom : bottom - px(kZeroSlot) * (slots + 0.6f);
    const Axis y = error_axis(zeros_begin, failures_end);
    const std::vector<bool> front = on_front(study_, kind_);
    for (std::size_t i = 0; i < courses_.size(); ++i) {
      courses_[i].strong = front[i];
      add_points(study_.series[i], y, zeros_begin + px(kZeroSlot) * (zero_slots[i] + 0.8f),
                 courses_[i]);
    }
    const std::string label =
        rounded ? "≤ " + spell_tick_error(study_.resolution, study_.unit) : "0";
    return {area_, failures_end, zeros_begin, label, x_, y, std::move(courses_)};
  }

 private:
  float px(float at_720) const { return scale_ * at_720; }
  bool is_zero(double error) const { return error <= study_.resolution; }
  float width_of(const std::string& text, FontWeight weight = FontWeight::Regular) const {
    return text_width(text, px(kPlotText), weight);
  }

  void choose_time_axis() {
    PositiveRange times;
    float widest_name = 0, widest_count = 0;
    for (const trace::StudySeries& series : whole_.series) {
      widest_count = std::max(widest_count, width_of(count_of(series)));
      for (const trace::StudyPoint& point : series.points) {
        times.include(point.nanoseconds.min);
        times.include(point.nanoseconds.max);
      }
    }
    for (const trace::StudySeries& series : study_.series)
      widest_name = std::max(widest_name, width_of(series.method, FontWeight::Bold));
    times = times.or_else(1);
    const auto leave_room = [&](float widest, float share) {
      const float room = std::min(widest + px(kMargin), share * static_cast<float>(area_.width));
      x_ = Axis::logarithmic(times.low, times.high, left_, right_, px(kMargin), room);
    };
    leave_room(widest_name, kMostLabelShare);
    if (!failures_fit()) leave_room(widest_count, kMostCountShare);
  }

  Axis error_axis(float from, float to) const {
    PositiveRange errors;
    for (const trace::StudySeries& series : whole_.series) {
      for (const trace::StudyPoint& point : series.points) {
        const std::optional<double>& error = error_of(point, kind_);
        if (error && !is_zero(*error)) errors.include(*error);
      }
    }
    errors = errors.or_else(1);
    return Axis::logarithmic(errors.low, errors.high, from, to, px(kMargin), px(kMargin));
  }

  /// The text beside crosses.
  static std::string count_of(const trace::StudySeries& series) {
    return series.method + ": " + spell_failures(series);
  }

  std::vector<float> failures_of(const trace::StudySeries& series) const {
    std::vector<float> places;
    for (const trace::StudyPoint& point : series.points) {
      if (point.failed > 0) places.push_back(x_.at(point.nanoseconds.median));
    }
    return places;
  }

  /// Whether each count of failures, in all panels, has room before its first cross or after its
  /// last.
  bool failures_fit() const {
    return std::ranges::all_of(whole_.series, [&](const trace::StudySeries& series) {
      const std::vector<float> failures = failures_of(series);
      if (failures.empty()) return true;
      const auto [first, last] = std::ranges::minmax(failures);
      const float width = width_of(count_of(series)) + px(2 * kCross);
      return first - width >= left_ + px(2) || last + width <= right_;
    });
  }

  // A row for each method that failed; two share one where they do not meet.
  void place_failures(const trace::StudySeries& series, Course& course) {
    course.failure_text = count_of(series);
    const float width = width_of(course.failure_text);
    const auto [first, last] = std::ranges::minmax(course.failures);
    float begin = first - px(2 * kCross);
    float end = last + px(2 * kCross);
    const bool fits_right = end + width <= right_;
    const float text_left = fits_right ? end : std::max(left_ + px(2), begin - width);
    begin = std::min(begin, text_left);
    end = std::max(end, text_left + width) + px(kMargin);
    auto row = std::ranges::find_if(rows_, [&](const std::vector<Stretch>& taken) {
      return std::ranges::none_of(
          taken, [&](const Stretch& other) { return begin < other[1] && other[0] < end; });
    });
    if (row == rows_.end()) row = rows_.emplace(row);
    row->push_back({begin, end});
    const auto number = static_cast<float>(row - rows_.begin());
    course.failure_row = top_ + px(kFailureRow) * (number + 0.6f);
    course.failure_text_at = {text_left, course.failure_row + 0.34f * px(kPlotText)};
  }

  void add_points(const trace::StudySeries& series, const Axis& y, float zero_row,
                  Course& course) const {
    for (const trace::StudyPoint& point : series.points) {
      const std::optional<double>& error = error_of(point, kind_);
      if (!error) continue;
      const auto& [median, least, most] = point.nanoseconds;
      course.points.push_back({x_.at(median), is_zero(*error) ? zero_row : y.at(*error)});
      course.spread.push_back({x_.at(least), x_.at(most)});
    }
  }

  const trace::Study &study_, &whole_;
  ErrorKind kind_;
  Rect area_;
  float scale_, left_, right_, top_;
  Axis x_;
  std::vector<Course> courses_;
  std::vector<std::vector<Stretch>> rows_;  // of failures: what is taken of each
};

}  // namespace

PlotGeometry plot_geometry(const trace::Study& study, ErrorKind kind, const Rect& area, float scale,
                           const trace::Study& whole) {
  return Mapping(study, kind, area, scale, whole).run();
}

}  // namespace contactscope::draw
