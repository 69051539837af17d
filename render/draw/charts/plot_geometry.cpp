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

std::string counted(const trace::StudySeries& series, int failed, int of) {
  return series.method + ": " + std::to_string(failed) + " of " + std::to_string(of);
}

class Mapping {
 public:
  Mapping(const trace::Study& study, ErrorKind kind, const Rect& area, float scale,
          const trace::Study& whole)
      : study_(study), whole_(whole), kind_(kind), area_(area), scale_(scale) {
    for (const trace::StudySeries& series : study.series) {
      bool in_zero_row = false;
      widest_ = std::max(widest_, text_width(series.method, px(kPlotText), FontWeight::Bold));
      for (const trace::StudyPoint& point : series.points) {
        const std::optional<double>& error = error_of(point, kind);
        if (!error || !is_zero(*error)) continue;
        in_zero_row = true;
        rounded_ = rounded_ || *error > 0;
      }
      zero_slot_.push_back(in_zero_row ? zero_slots_++ : -1);
    }
    for (const trace::StudySeries& series : whole.series) {
      for (const trace::StudyPoint& point : series.points) {
        times_.include(point.nanoseconds.min);
        times_.include(point.nanoseconds.max);
        const std::optional<double>& error = error_of(point, kind);
        if (error && !is_zero(*error)) errors_.include(*error);
      }
    }
  }

  PlotGeometry run() const {
    const float left = static_cast<float>(area_.x);
    const float right = static_cast<float>(area_.x + area_.width);
    const float top = static_cast<float>(area_.y);
    const float bottom = static_cast<float>(area_.y + area_.height);
    const PositiveRange times = times_.or_else(1);
    const auto axis = [&](float widest, float share) {
      const float room = std::min(widest + px(kMargin), share * static_cast<float>(area_.width));
      return Axis::logarithmic(times.low, times.high, left, right, px(kMargin), room);
    };
    Axis x = axis(widest_, kMostLabelShare);
    if (!failures_fit(x, left, right)) x = axis(widest_count(), kMostCountShare);

    std::vector<Course> courses = failure_rows(x, left, right, top);
    float failures_end = top;
    for (const Course& course : courses) {
      if (course.failed > 0) failures_end = std::max(failures_end, course.failure_row);
    }
    if (failures_end > top) failures_end += 0.5f * px(kFailureRow);
    const float zeros_begin =
        zero_slots_ == 0 ? bottom
                         : bottom - px(kZeroSlot) * (static_cast<float>(zero_slots_) + 0.6f);
    const PositiveRange errors = errors_.or_else(1);
    const Axis y = Axis::logarithmic(errors.low, errors.high, zeros_begin, failures_end,
                                     px(kMargin), px(kMargin));
    add_points(x, y, zeros_begin, courses);

    const std::string label =
        rounded_ ? "≤ " + spell_tick_error(study_.resolution, study_.unit) : "0";
    return {area_, failures_end, zeros_begin, label, x, y, std::move(courses)};
  }

 private:
  float px(float at_720) const { return scale_ * at_720; }
  bool is_zero(double error) const { return error <= study_.resolution; }

  /// Of the longest text beside crosses.
  float widest_count() const {
    float widest = 0;
    for (const trace::StudySeries& series : whole_.series)
      widest = std::max(widest, count_width(series));
    return widest;
  }
  float count_width(const trace::StudySeries& series) const {
    int failed = 0, of = 0;
    for (const trace::StudyPoint& point : series.points) {
      failed += point.failed;
      of += point.of;
    }
    return text_width(counted(series, failed, of), px(kPlotText), FontWeight::Regular);
  }

  /// Whether each count of failures, in all panels, has room before its first cross or after its
  /// last.
  bool failures_fit(const Axis& x, float left, float right) const {
    for (const trace::StudySeries& series : whole_.series) {
      float first = right, last = left;
      for (const trace::StudyPoint& point : series.points) {
        if (point.failed == 0) continue;
        first = std::min(first, x.at(point.nanoseconds.median));
        last = std::max(last, x.at(point.nanoseconds.median));
      }
      const float width = count_width(series) + px(2 * kCross);
      if (first <= last && first - width < left + px(2) && last + width > right) return false;
    }
    return true;
  }

  // A row for each method that failed; two share one where they do not meet.
  std::vector<Course> failure_rows(const Axis& x, float left, float right, float top) const {
    std::vector<Course> courses;
    std::vector<std::vector<std::array<float, 2>>> rows;
    for (const trace::StudySeries& series : study_.series) {
      Course course;
      course.method = series.method;
      course.style = method_style(courses.size());
      for (const trace::StudyPoint& point : series.points) {
        course.failed += point.failed;
        course.of += point.of;
        if (point.failed > 0) course.failures.push_back(x.at(point.nanoseconds.median));
      }
      if (course.failed > 0) stack(series, left, right, top, course, rows);
      courses.push_back(std::move(course));
    }
    return courses;
  }

  void stack(const trace::StudySeries& series, float left, float right, float top, Course& course,
             std::vector<std::vector<std::array<float, 2>>>& rows) const {
    course.failure_text = counted(series, course.failed, course.of);
    const float width = text_width(course.failure_text, px(kPlotText), FontWeight::Regular);
    const auto [first, last] = std::ranges::minmax(course.failures);
    float begin = first - px(2 * kCross);
    float end = last + px(2 * kCross);
    const bool fits_right = end + width <= right;
    const float text_left = fits_right ? end : std::max(left + px(2), begin - width);
    begin = std::min(begin, text_left);
    end = std::max(end, text_left + width) + px(kMargin);
    const auto is_free = [&](const std::vector<std::array<float, 2>>& row) {
      return std::ranges::none_of(row, [&](const std::array<float, 2>& other) {
        return begin < other[1] && other[0] < end;
      });
    };
    const auto row = std::ranges::find_if(rows, is_free);
    const auto number = static_cast<float>(row - rows.begin());
    if (row == rows.end()) {
      rows.push_back({{begin, end}});
    } else {
      row->push_back({begin, end});
    }
    course.failure_row = top + px(kFailureRow) * (number + 0.6f);
    course.failure_text_at = {text_left, course.failure_row + 0.34f * px(kPlotText)};
  }

  void add_points(const Axis& x, const Axis& y, float zeros_begin,
                  std::vector<Course>& courses) const {
    const std::vector<bool> front = on_front(study_, kind_);
    for (std::size_t i = 0; i < courses.size(); ++i) {
      Course& course = courses[i];
      course.strong = front[i];
      const float zero_row =
          zeros_begin + px(kZeroSlot) * (static_cast<float>(zero_slot_[i]) + 0.8f);
      for (const trace::StudyPoint& point : study_.series[i].points) {
        const std::optional<double>& error = error_of(point, kind_);
        if (!error) continue;
        const float height = is_zero(*error) ? zero_row : y.at(*error);
        course.points.push_back({x.at(point.nanoseconds.median), height});
        course.spread.push_back({x.at(point.nanoseconds.min), x.at(point.nanoseconds.max)});
      }
    }
  }

  const trace::Study& study_;
  const trace::Study& whole_;
  ErrorKind kind_;
  Rect area_;
  float scale_;
  float widest_ = 0;
  PositiveRange times_, errors_;
  bool rounded_ = false;
  int zero_slots_ = 0;
  std::vector<int> zero_slot_;  // of each series; -1 where it has no zero
};

}  // namespace

PlotGeometry plot_geometry(const trace::Study& study, ErrorKind kind, const Rect& area, float scale,
                           const trace::Study& whole) {
  return Mapping(study, kind, area, scale, whole).run();
}

PlotGeometry plot_geometry(const trace::Study& study, ErrorKind kind, const Rect& area,
                           float scale) {
  return plot_geometry(study, kind, area, scale, study);
}

}  // namespace contactscope::draw
