#include "draw/panels/panel.h"
#include "draw/scene/pairs.h"

namespace contactscope::draw {
namespace {

// Pixels at 720 lines.
constexpr double kMinPlot = 46, kMaxPlot = 220, kBelowCharts = 14, kTimeAxis = 20, kNamesRow = 20;
constexpr double kCurveSwatch = 22, kStripHeading = 19, kMaxIdStrip = 72;
constexpr double kStripShare = 0.16;  // share of the height of all charts
constexpr double kIdRow = 9, kMinIdRow = 2.6;
constexpr double kLegibleIdRow = 3.4;  // thinner rows look like a solid block

/// Results of the solver up to the current frame: stacked charts with one time axis below, and a
/// strip of contact ids. Two to four pairs have a line each. Points and ids that never change are a
/// line of text. If room is short, the strip and then the last charts are left out. The series are
/// gathered when a picture first needs them.
class PlotsPanel : public PanelContent {
 public:
  PlotsPanel(const Staging& staging, const Frames& frames) : PanelContent(staging, frames) {
    solved_ = std::ranges::any_of(
        frames, [](const trace::Frame& frame) { return frame.solver.has_value(); });
  }

  PanelNeed need(const PanelMoment&) const override {
    const Layout& layout = staging_.layout;
    const float least =
        Sheet::heading_height(layout.scale) + layout.px(kTimeAxis + kNamesRow + kMinPlot);
    int charts = 0;
    for (const Chart chart : {Chart::Overlap, Chart::Points, Chart::Energy, Chart::Impulse}) {
      const bool has = solved_ || chart == Chart::Overlap || chart == Chart::Points;
      charts += has && staging_.view.shows(chart);
    }
    charts = std::max(charts, 1);
    const float good = least + layout.px((charts - 1) * kMinPlot);
    // Without the strip, the panel ends with its charts.
    const bool has_strip = staging_.view.shows(Chart::Ids) || staging_.view.shows(Chart::Points);
    const float wanted = least + layout.px(charts * kMaxPlot - kMinPlot + kBelowCharts);
    return {least, good, has_strip || zoom_ > 1 ? 0 : std::max(good, wanted), 2};
  }

  std::string lay_out(const PanelMoment& moment, Sheet& sheet) override {
    if (!is_gathered_) gather();
    sheet.enlarge(zoom_);
    sheet.heading(subject_ + "over time");
    if (charts_.empty()) return {};
    const Pen pen(sheet.pen().drawing(), zoom_ * sheet.pen().scale(), kChartText);
    const Rect rect = sheet.rest();
    const double line = sheet.line_height();
    const double named = draw_names(rect, pen);
    double room = 0, strip = 0;
    std::size_t shown = 0;
    const double record = line * static_cast<double>(constants_.size());
    for (const double below : {0.0, line}) {  // if some are missing, a line reports it
      if (shown == charts_.size()) break;
      room = rect.height - below - pen.px(kTimeAxis) - named - record;
      strip = strip_height(room, pen);
      const double fitting = std::max(0.0, room - strip) / pen.px(kMinPlot);
      shown = std::clamp<std::size_t>(static_cast<std::size_t>(fitting), 1, charts_.size());
    }
    const double share = (room - strip) / static_cast<double>(shown);
    const double height = zoom_ > 1 ? share : std::min<double>(pen.px(kMaxPlot), share);
    double y = rect.y + named;
    for (std::size_t i = 0; i < shown; ++i, y += height)
      draw_series_chart(charts_[i], place_of(moment.frame), {rect.x, y, rect.width, height}, pen);
    if (strip > 0) draw_ids(moment.frame, {rect.x, y, rect.width, strip}, pen);
    const double gutter = pen.px(kChartGutter);
    draw_time_axis(frames_, rect.x + gutter, rect.width - gutter, y + strip + pen.px(kTimeAxis - 4),
                   pen);
    sheet.skip_to(y + strip + pen.px(kTimeAxis + 4));
    for (const std::string& constant : constants_) sheet.line(constant, kText);
    sheet.skip_to(rect.bottom() - line);
    return sheet.more(charts_.size() - shown, "chart", "charts");
  }

 private:
  /// Charts of pair quantities have a line for each pair; other quantities belong to no pair.
  void gather() {
    is_gathered_ = true;
    if (staging_.scales.heap && staging_.view.focus_on.size() == 2) return gather_pair();
    const std::vector<TimeSeries> all = time_series(frames_, false);
    // If the view shows loads, impulses are divided by the time step and shown as forces.
    const double step = staging_.view.shows(Layer::Loads) ? staging_.scales.step : 0;
    SeriesChart penetration{"overlap", "m"}, energy{"kinetic energy", "J"},
        impulse{step > 0 ? "normal forces" : "normal impulses", step > 0 ? "N" : "N s"},
        points{"contact points", ""};
    points.steps = true;
    energy.total = points.total = all.size() == 1 && !all[0].pairs.empty();
    const auto add = [&](const PairSeries& one) {
      names_.push_back(one.name);
      penetration.curves.push_back(one.penetration);
      impulse.curves.push_back(one.impulse);
      for (double& value : impulse.curves.back()) value /= step > 0 ? step : 1;
    };
    for (const TimeSeries& one : all) {
      if (energy.total)
        std::ranges::for_each(one.pairs, add);
      else
        add(one);
      energy.curves.push_back(one.energy);
      points.curves.push_back(one.points);
    }
    if (all.size() == 1 && std::ranges::none_of(all[0].deepest, names_a_copy))
      penetration.subjects = all[0].deepest;
    if (!all.empty()) penetration.changes = all[0].queries;
    const bool same_points = std::ranges::all_of(points.curves, is_constant);
    const View& view = staging_.view;
    if (same_points && !points.curves.empty() && frames_.size() > 1 && view.shows(Chart::Points)) {
      const auto count = [](const auto& curve) { return spell_number(curve.front()); };
      const std::string counts = separated(points.curves, ", ", count);
      constants_.push_back("contact points: " + counts + " in every frame");
    }
    if (same_points && frames_.size() > 1 && view.shows(Chart::Ids) && ids().row_count() > 0 &&
        ids().is_constant())
      constants_.emplace_back("contact points: none changes");
    for (const auto& [chart, kind] : {std::pair{&penetration, Chart::Overlap},
                                      {&energy, Chart::Energy},
                                      {&impulse, Chart::Impulse},
                                      {&points, Chart::Points}}) {
      if (!view.shows(kind) || chart->curves.empty() || chart->curves[0].empty()) continue;
      if (chart == &points && same_points && frames_.size() > 1) continue;
      chart->fit();
      chart->ahead = staging_.scales.heap;
      charts_.push_back(std::move(*chart));
    }
  }

  /// The place of a frame in the charts.
  std::size_t place_of(std::size_t frame) const {
    const auto found = std::ranges::find(history_.frames, frames_[frame].frame);
    return found == history_.frames.end()
               ? frame
               : static_cast<std::size_t>(found - history_.frames.begin());
  }

  /// In a heap, of the two shapes in focus alone.
  void gather_pair() {
    const std::string &a = staging_.view.focus_on[0], &b = staging_.view.focus_on[1];
    subject_ = name_in_words(a) + " and " + name_in_words(b) + " ";
    SeriesChart overlap{"overlap", "m"}, points{"contact points", ""};
    overlap.curves.resize(1), points.curves.resize(1);
    points.steps = true;
    history_ = staging_.view.history;
    if (history_.frames.empty())
      for (const trace::Frame& frame : frames_) add_frame(frame, a, b, history_);
    overlap.curves[0] = history_.overlaps, points.curves[0] = history_.points;
    for (const auto& [chart, kind] :
         {std::pair{&overlap, Chart::Overlap}, {&points, Chart::Points}}) {
      if (!staging_.view.shows(kind)) continue;
      chart->fit();
      chart->ahead = true;
      charts_.push_back(std::move(*chart));
    }
  }

  /// Gathered when they are first needed: most of the work in a heap, which has no room for them.
  const IdHistory& ids() const {
    if (ids_) return *ids_;
    std::vector<std::vector<IdState>> ids;
    std::vector<std::size_t> pairs;  // pair of each row; each series continues the numbering
    for (const TimeSeries& one : time_series(frames_)) {
      ids.insert(ids.end(), one.ids.begin(), one.ids.end());
      const std::size_t before = pairs.empty() ? 0 : std::ranges::max(pairs) + 1;
      for (const std::size_t pair : one.id_pairs) pairs.push_back(before + pair);
    }
    return ids_.emplace(ids, pairs);
  }

  /// The name of one of many scattered copies, such as crate 5, means nothing.
  static bool names_a_copy(const std::string& pair) {
    return pair.find_first_of("0123456789") != std::string::npos;
  }

  static bool is_constant(const std::vector<double>& curve) {
    return !curve.empty() &&
           std::ranges::adjacent_find(curve, std::not_equal_to<>()) == curve.end();
  }

  /// Draws the curves' names in as many rows as needed. Returns the height of the rows.
  double draw_names(const Rect& rect, const Pen& pen) const {
    if (names_.size() < 2) return 0;
    const float swatch = pen.px(kCurveSwatch + 6);
    double x = rect.x, y = rect.y;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const double width = swatch + pen.width_of(names_[i]);
      if (x > rect.x && x + width > rect.right()) {
        x = rect.x;
        y += pen.px(kNamesRow);
      }
      const Point2 left = pixel(x, y + 0.45 * pen.px(kNamesRow));
      draw_series_swatch(i, left, kCurveSwatch, pen);
      pen.text(names_[i], left + Point2{swatch, pen.px(5)}, Align::Left, kText);
      x += width + pen.px(16);
    }
    return y + pen.px(kNamesRow) - rect.y;
  }

  /// 0 if the charts need all the room.
  double strip_height(double room, const Pen& pen) const {
    if (!staging_.view.shows(Chart::Ids)) return 0;
    const double charts = pen.px(kMinPlot) * static_cast<double>(charts_.size());
    const double share = kStripShare * room;
    const double least = pen.px(kStripHeading) + std::min<double>(share, pen.px(kMinIdRow));
    if (room - least < charts) return 0;
    if (ids().row_count() == 0 || (ids().is_constant() && frames_.size() > 1)) return 0;
    const auto rows = static_cast<double>(ids().row_count());
    const double wanted = std::min<double>({pen.px(kMaxIdStrip), share, pen.px(kIdRow) * rows});
    const double strip =
        pen.px(kStripHeading) + std::max(wanted, std::min(share, pen.px(kMinIdRow) * rows));
    return room - strip < charts ? 0 : strip;
  }

  void draw_ids(std::size_t moment, const Rect& strip, const Pen& pen) const {
    const Rect inner = chart_area(strip, kStripHeading, pen);
    const auto rows = static_cast<double>(ids().row_count());
    const bool bands = inner.height < pen.px(kLegibleIdRow) * rows && ids().pair_count() > 1;
    const auto most = static_cast<std::size_t>(inner.height / pen.px(kMinIdRow));
    const std::string text = !bands ? "points over time, a row each"
                             : ids().pair_count() <= most
                                 ? "points by pair, cut where one changes"
                                 : "points of the first " + std::to_string(most) + " of " +
                                       std::to_string(ids().pair_count()) + " pairs";
    pen.text(text, pixel(strip.x, strip.y + pen.px(kStripHeading - 6)), Align::Left, kText);
    if (bands) {
      ids().draw_bands(inner, moment, most, pen);
    } else {
      ids().draw_rows(inner, moment, moment + 1, pen);
    }
  }

  bool solved_ = false;
  // Charts that have the whole picture, without a scene next to them, are legible on a slide.
  float zoom_ = staging_.layout.panels.width >= staging_.layout.page.width &&
                        staging_.layout.panels.y < staging_.layout.view.bottom()
                    ? 1.5f
                    : 1.0f;
  std::vector<SeriesChart> charts_;
  std::vector<std::string> names_;      // of the curves
  std::vector<std::string> constants_;  // texts for quantities that never change
  std::string subject_;                 // of all charts; empty: of the scene
  PairHistory history_;                 // of the subject
  bool is_gathered_ = false;
  mutable std::optional<IdHistory> ids_;
};

}  // namespace

const PanelDrawing kPlotsPanel{.make = make_panel<PlotsPanel>};

}  // namespace contactscope::draw
