#include "draw/charts/curve_labels.h"
#include "draw/charts/plot.h"
#include "draw/scene/palette.h"
#include "draw/scene/quantity.h"

namespace contactscope::draw {
namespace {

// Pixels at 720 lines.
constexpr float kHeading = 16, kTickColumn = 54, kStrongMarker = 5.0f, kMutedMarker = 3.3f;
constexpr float kCross = 4;
constexpr float kMinDecade = 70;  // shorter ones would be crowded with minor lines

constexpr Color kMinorGrid = rgb(0xEEF0F2);

// Opaque, so that a marker hides the line below it.
Color muted(const Color& color) {
  const auto mix = [](float channel) { return 0.68f * channel + 0.32f; };
  return {mix(color.r), mix(color.g), mix(color.b), color.a};
}

Rect area_in(const Rect& rect, float scale) {
  const double left = rect.x + scale * kTickColumn;
  const double top = rect.y + scale * (kHeading + 10);
  const double bottom = rect.bottom() - scale * (2 * kPlotText + 8);
  return {left, top, rect.right() - left, bottom - top};
}

struct Diagram : Pen {
  const trace::Study& study;
  const trace::Study& whole;  // contains `study`
  ErrorKind kind;
  const Rect& rect;

  PlotGeometry plot = plot_geometry(study, kind, area_in(rect, scale()), scale(), whole);
  float left = static_cast<float>(plot.area.x), right = static_cast<float>(plot.area.right());
  float top = static_cast<float>(plot.area.y), bottom = static_cast<float>(plot.area.bottom());

  void run() {
    draw_grid();
    draw_headings();
    for (const Course& course : plot.courses)
      if (course.strong) draw_spread(course);
    for (const bool strong : {false, true}) {
      for (const auto part : {&Diagram::draw_line, &Diagram::draw_markers}) {
        for (const Course& course : plot.courses)
          if (course.strong == strong) (this->*part)(course);
      }
    }
    draw_failures();
    draw_border();
    draw_labels(draw_arrow());
  }

  void draw_grid() {
    for (const bool decades : {false, true}) {
      const Color& color = decades ? kChartGrid : kMinorGrid;
      for (const Axis::Tick& tick : plot.x.ticks(px(kMinDecade)))
        if (tick.decade == decades) line({tick.at, top}, {tick.at, bottom}, 1, color);
      for (const Axis::Tick& tick : plot.y.ticks(px(kMinDecade)))
        if (tick.decade == decades) line({left, tick.at}, {right, tick.at}, 1, color);
    }
    draw_time_ticks();
    draw_error_ticks();
  }

  /// Decades first: other ticks are labelled if there is room next to them.
  std::vector<Axis::Tick> labelled_ticks(const Axis& axis) const {
    std::vector<Axis::Tick> ticks = axis.ticks(px(kMinDecade));
    std::erase_if(ticks, [](const Axis::Tick& tick) { return !tick.labelled; });
    std::stable_partition(ticks.begin(), ticks.end(), std::mem_fn(&Axis::Tick::decade));
    return ticks;
  }

  void draw_time_ticks() {
    std::vector<std::array<float, 2>> taken;
    for (const Axis::Tick& tick : labelled_ticks(plot.x)) {
      const std::string label = spell_tick_time(tick.value);
      const float half = 0.5f * width_of(label);
      const float center = std::clamp(tick.at, left + half - px(kTickColumn), right - half);
      const float begin = center - half - px(5), end = center + half + px(5);
      if (std::ranges::any_of(taken, [&](const auto& t) { return begin < t[1] && t[0] < end; }))
        continue;
      taken.push_back({begin, end});
      line({tick.at, bottom}, {tick.at, bottom + px(4)}, 1, kChartBorder);
      text(label, {center, bottom + px(kPlotText + 2)}, Align::Center, kText);
    }
  }

  void draw_error_ticks() {
    std::vector<float> taken;
    const auto label = [&](const std::string& what, float y) {
      const float clear = px(kPlotText);
      if (std::ranges::any_of(taken, [&](float t) { return std::abs(t - y) < clear; })) return;
      taken.push_back(y);
      text(what, {left - px(8), y + 0.34f * px(kPlotText)}, Align::Right, kText);
    };
    if (plot.zeros_begin < bottom) label(plot.zeros_label, 0.5f * (plot.zeros_begin + bottom));
    const std::string failed = study.failed.empty() ? "failed" : study.failed;
    if (plot.failures_end > top) label(failed, 0.5f * (top + plot.failures_end));
    for (const Axis::Tick& tick : labelled_ticks(plot.y))
      label(spell_tick_error(tick.value, study.unit), tick.at);
  }

  void draw_headings() {
    // Studies of least times have no median.
    const auto is_one = [](const trace::StudyPoint& point) {
      return point.nanoseconds.min == point.nanoseconds.max;
    };
    const bool is_least = std::ranges::all_of(points_of(whole), is_one);
    const float x = static_cast<float>(rect.x);
    const float baseline = static_cast<float>(rect.y) + 0.8f * px(kHeading);
    const auto heading = [&](const std::string& what, float at, Weight weight) {
      text(what, {at, baseline}, Align::Left, kText, weight, kHeading);
    };
    text(is_least ? "least time of a call" : "time of a call, median",
         {right, bottom + px(2 * kPlotText + 5)}, Align::Right, kText);
    if (!study.series.empty() && !study.series.front().panel.empty())
      return heading(study.series.front().panel, x, Weight::Bold);
    heading(study.error + ",", x, Weight::Regular);
    const float used = text_width(study.error + ", ", px(kHeading), Weight::Regular);
    heading(kind == ErrorKind::Mean ? "mean" : "worst", x + used, Weight::Bold);
  }

  void draw_spread(const Course& course) {
    const Color color = with_alpha(course.style.color, 0.13f);
    for (std::size_t i = 1; i < course.points.size(); ++i) {
      const float before = course.points[i - 1].y, after = course.points[i].y;
      const auto& [low, high] = course.spread[i];
      const auto& [low_before, high_before] = course.spread[i - 1];
      fill({{low_before, before}, {high_before, before}, {high, after}, {low, after}}, color);
    }
  }

  static Color ink(const Course& course) {
    return course.strong || course.quiet ? course.style.color : muted(course.style.color);
  }

  void draw_line(const Course& course) {
    path(course.points, course.strong ? 3.0 : 1.2, ink(course), course.style.dash,
         course.style.gap);
  }

  void draw_markers(const Course& course) {
    const Marker marker = course.style.marker;
    const float radius = px(course.strong ? kStrongMarker : kMutedMarker);
    for (const Point2& point : course.points) {
      if (course.strong) draw_marker(marker, point, radius + px(1.6f), kWhite, drawing());
      draw_marker(marker, point, radius, ink(course), drawing());
    }
  }

  void draw_failures() {
    for (const Course& course : plot.courses) {
      if (course.failures.empty()) continue;
      for (const float x : course.failures)
        cross({x, course.failure_row}, kCross, 2, course.style.color);
      text(course.failure_text, course.failure_text_at, Align::Left, course.style.text);
    }
  }

  void draw_border() {
    frame(plot.area, 1.2, kChartBorder);
    for (const float y : {plot.failures_end, plot.zeros_begin})
      if (y > top && y < bottom) line({left, y}, {right, y}, 1.2, kChartBorder, 4, 4);
  }

  // Number of data points that a box would hide.
  int covered(const Rect& box) const {
    int count = 0;
    for (const Course& course : plot.courses) {
      for (std::size_t i = 0; i < course.points.size(); ++i) {
        // Points along the line to the next point, and the point itself.
        const Point2& at = course.points[i];
        const Point2& next = course.points[std::min(i + 1, course.points.size() - 1)];
        for (int step = 0; step < 10; ++step)
          count += box.contains(at + 0.1f * static_cast<float>(step) * (next - at));
      }
    }
    return count;
  }

  /// Arrow towards better values, near the lower left corner if there is room. Returns its box.
  Rect draw_arrow() {
    const float reach = px(30);
    const std::string word = "better";
    const double width = reach + width_of(word, Weight::Bold) + px(8), height = reach + px(6);
    const double floor = plot.zeros_begin - px(8) - height;
    const double rise = std::max(0.0, floor - plot.failures_end - px(8));
    const double run = std::max(0.0, right - px(8) - width - (left + px(8)));
    // Shares of the range to the right, and up.
    constexpr double kAlong[] = {0, 0, 0.15, 0, 0.3, 0, 0.5, 0, 0, 0.7, 1, 1};
    constexpr double kUp[] = {0, 0.15, 0, 0.3, 0, 0.5, 0, 0.7, 1, 0, 0, 1};
    std::vector<Rect> boxes;
    for (std::size_t i = 0; i < std::size(kUp); ++i)
      boxes.push_back({left + px(8) + kAlong[i] * run, floor - kUp[i] * rise, width, height});
    const Rect best = std::ranges::min(boxes, {}, [&](const Rect& box) { return covered(box); });
    const Point2 tip = pixel(best.x, best.bottom()) + Point2{px(3), -px(3)};
    const float head = px(11);
    line(tip + head * Point2{0.6f, -0.6f}, tip + Point2{reach, -reach}, 3, kText);
    fill({tip, tip + head * Point2{1.15f, -0.35f}, tip + head * Point2{0.35f, -1.15f}}, kText);
    text(word, {tip.x + reach + px(3), tip.y - reach + px(7)}, Align::Left, kText, Weight::Bold);
    return best;
  }

  void draw_labels(const Rect& arrow) {
    LabelObstacles obstacles;
    obstacles.boxes.push_back(arrow);
    std::vector<const Course*> order;  // strong ones choose first
    for (const Course& course : plot.courses) {
      if (!course.points.empty() && !course.method.empty()) order.push_back(&course);
      for (std::size_t i = 0; i < course.points.size(); ++i) {
        obstacles.markers.push_back(course.points[i]);
        if (i == 0) continue;
        obstacles.lines.push_back(
            {course.points[i - 1], course.points[i], course.strong ? 1.5f : 0.7f});
      }
    }
    std::stable_partition(order.begin(), order.end(), std::mem_fn(&Course::strong));
    const auto weight_of = [](const Course* course) {
      return course->strong ? Weight::Bold : Weight::Regular;
    };
    std::vector<LineLabel> labels = mapped(order, [&](const Course* course) {
      return LineLabel{width_of(course->method, weight_of(course)),
                       {course->points.back(), course->points.front()}};
    });
    const Course* const line_of_ends = marked(order);
    const std::vector<std::string> ends = parameters_at_ends(line_of_ends);
    for (std::size_t i = 0; i < ends.size(); ++i) {
      const std::vector<Point2>& points = line_of_ends->points;
      labels.push_back({width_of(ends[i]), {i == 0 ? points.front() : points.back()}});
    }
    std::vector<std::pair<MarkedPoint, Color>> marks;
    for (const Course& course : plot.courses)
      for (std::size_t i = 0; i < course.points.size(); ++i)
        if (!course.marks[i].empty())
          marks.emplace_back(MarkedPoint{course.points[i], course.marks[i]}, course.style.text);
    const float height = px(kPlotText);
    const double inset = px(3);
    const Rect room{left + inset, plot.failures_end + inset, right - left - 2 * inset,
                    bottom - plot.failures_end - 2 * inset};
    const std::vector<PlacedLabel> others =
        place_with_marks(marks, labels, obstacles, room, height, *this);
    for (std::size_t i = 0; i < order.size(); ++i) {
      if (others[i].needs_leader)
        line(others[i].anchor, others[i].leader_end, 1, muted(order[i]->style.text));
    }
    for (std::size_t i = 0; i < others.size(); ++i) {
      const Point2 at =
          pixel(others[i].box.x, others[i].box.y) + Point2{0, 0.5f * (height + 0.68f * height)};
      if (i < order.size())
        text(order[i]->method, at, Align::Left, order[i]->style.text, weight_of(order[i]), 0, 2);
      else
        text(ends[i - order.size()], at, Align::Left, kQuietText, Weight::Regular, 0, 2);
    }
  }

  /// The first strong line that does not end on the row of zeros; null if there is none.
  const Course* marked(const std::vector<const Course*>& order) const {
    for (const Course* course : order)
      if (course->strong && course->points.size() > 1 && course->points.back().y < plot.zeros_begin)
        return course;
    return nullptr;
  }

  /// "5" and "32 points": parameters at the start and end of that line.
  std::vector<std::string> parameters_at_ends(const Course* course) const {
    if (course == nullptr || study.other_cases) return {};
    const std::string& counted =
        study.series.front().parameter.empty() ? study.parameter : study.series.front().parameter;
    return {spell_number(course->parameters.front()),
            spell_number(course->parameters.back()) + " " + counted};
  }
};

}  // namespace

void draw_plot_panel(const trace::Study& study, ErrorKind kind, const Rect& rect, PlotPage& page,
                     const std::string& panel) {
  trace::Study part = study;
  std::erase_if(part.series, [&](const trace::StudySeries& one) { return one.panel != panel; });
  Diagram{Pen(page.drawing, page.scale, kPlotText), part, study, kind, rect}.run();
}

}  // namespace contactscope::draw
