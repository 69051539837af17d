#include "draw/panels/panel.h"
#include "draw/scene/pairs.h"

/// First contact of two moving shapes: Catto 2013, "Continuous Collision"; Mirtich 1996, section
/// 2.3.
namespace contactscope::draw {
namespace {

constexpr double kMinApproach = 130, kGoodApproach = 220;  // pixels at 720 lines
constexpr double kTogether = 22;  // pixels: distance at which the numbers of dots would overlap
constexpr double kApproachGutter = 52, kApproachAbove = 18, kApproachBelow = 36, kApproachDot = 3.5;

bool is_query_of_time(const trace::Pair& pair) { return pair.impact.has_value(); }

/// Distance of two shapes over a step. From each measured point a straight lower bound leads to the
/// time before which they cannot meet: the next point.
class ApproachPanel : public PanelContent {
 public:
  using PanelContent::PanelContent;

  PanelNeed need(const PanelMoment&) const override {
    return need_of(kMinApproach, kGoodApproach, 1.4 * kGoodApproach,
                   kApproachAbove + kApproachBelow, 3);
  }

  std::string lay_out(const PanelMoment& moment, Sheet& sheet) override {
    sheet.heading("distance through the step");
    const std::vector<trace::Pair>& pairs = frames_[moment.frame].pairs;
    const auto pair = std::ranges::find_if(pairs, is_query_of_time);
    if (pair == pairs.end()) return sheet.inapplicable("no pair is asked when it meets");
    const trace::Impact& impact = *pair->impact;
    sheet.row("method", in_words(impact.method) + ", " +
                            counted(impact.steps.size(), "iteration", "iterations"));
    sheet.row("answer", in_words(impact.status) +
                            (impact.status == "hit"
                                 ? ", at " + printed("%.1f", 100 * impact.time) + " % of the step"
                                 : ""));
    if (!impact.steps.empty())
      sheet.line("pink: the distance falls no faster than this", kAxisText);
    if (!impact.distances.empty()) draw_chart(impact, sheet);
    const auto others =
        static_cast<std::size_t>(std::ranges::count_if(pairs, is_query_of_time) - 1);
    return others == 0 ? "" : counted(others, "pair", "pairs");
  }

 private:
  static void draw_chart(const trace::Impact& impact, const Sheet& sheet) {
    const Pen& pen = sheet.pen();
    const Rect rest = sheet.rest();
    const Rect chart{rest.x + pen.px(kApproachGutter), rest.y + pen.px(kApproachAbove),
                     rest.width - pen.px(kApproachGutter + 6),
                     rest.height - pen.px(kApproachAbove + kApproachBelow)};
    if (chart.height <= 0) return;
    const double most = std::max(
        std::ranges::max_element(impact.distances, {}, &trace::DistanceAt::distance)->distance,
        1e-300);
    const auto place = [&](double time, double distance) {
      const double up = std::clamp(distance / most, 0.0, 1.0);
      return pixel(chart.x + time * chart.width, chart.y + (1 - up) * chart.height);
    };
    pen.line(place(0, 0), place(1, 0), 1, kDropped);
    const double left = chart.x - pen.px(6), below = chart.y + chart.height + pen.px(20);
    pen.text(spell_length(most, 0, length_unit(most)), pixel(left, chart.y + pen.px(10)),
             Align::Right, kQuietText);
    pen.text("0", pixel(left, chart.y + chart.height + pen.px(4)), Align::Right, kQuietText);
    pen.text("0 %", pixel(chart.x, below), Align::Center, kQuietText);
    pen.text("share of the step", pixel(chart.x + 0.5 * chart.width, below), Align::Center,
             kQuietText);
    pen.text("100 %", pixel(chart.x + chart.width + pen.px(6), below), Align::Right, kQuietText);

    std::vector<Point2> curve;
    for (const trace::DistanceAt& at : impact.distances)
      curve.push_back(place(at.time, at.distance));
    pen.path(curve, 2, kShapeEdge);
    for (const trace::ImpactStep& step : impact.steps) {
      pen.line(place(step.time, step.distance), place(step.safe, 0), 1.5, kAxis);
      pen.line(place(step.safe, 0), place(step.safe, distance_at(impact, step.safe)), 1, kDropped,
               4);
    }
    number_steps(impact, place, pen);
    if (impact.status == "hit") pen.disc(place(impact.time, 0), 1.4 * kApproachDot, kContact);
  }

  /// Dots at the measured distances, with their numbers; dots close together share one.
  template <class Place>
  static void number_steps(const trace::Impact& impact, const Place& place, const Pen& pen) {
    const std::size_t count = impact.steps.size();
    for (std::size_t first = 0; first < count;) {
      const Point2 dot = place(impact.steps[first].time, impact.steps[first].distance);
      std::size_t end = first;
      for (; end < count; ++end) {
        const Point2 next = place(impact.steps[end].time, impact.steps[end].distance);
        if (std::hypot(next.x - dot.x, next.y - dot.y) > pen.px(kTogether)) break;
        pen.disc(next, kApproachDot, kAxis);
      }
      const std::string last = end == first + 1 ? "" : " to " + std::to_string(end);
      pen.text(std::to_string(first + 1) + last, pixel(dot.x + pen.px(8), dot.y - pen.px(4)),
               Align::Left, kAxisText);
      first = end;
    }
  }

  static double distance_at(const trace::Impact& impact, double time) {
    const double place = time * static_cast<double>(impact.distances.size() - 1);
    const auto before = std::min(static_cast<std::size_t>(place), impact.distances.size() - 2);
    const double part = place - static_cast<double>(before);
    return (1 - part) * impact.distances[before].distance +
           part * impact.distances[before + 1].distance;
  }
};

}  // namespace

const PanelDrawing kApproachPanel{.make = make_panel<ApproachPanel>};

}  // namespace contactscope::draw
