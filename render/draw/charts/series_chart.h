#pragma once

#include "draw/scene/pen.h"
#include "trace/trace.h"

/// Charts over the time of a sequence, and their series.
namespace contactscope::draw {

/// Style of one of a few curves of a chart.
struct SeriesStyle {
  Color color;
  float dash = 0;  // pixels at 720 lines; solid when 0
};
SeriesStyle series_style(std::size_t index);

/// A small chart of values over frames. Its name and newest value are above; to the left are ticks
/// at zero and at a round value on each side of zero that it reaches.
struct SeriesChart {
  /// A category that differs from the previous frame's.
  struct Change {
    std::size_t frame = 0;
    std::string before, after;  // old and new state
  };

  std::string name;
  std::string unit;                           // "m", with a suitable prefix; empty: a plain number
  std::vector<std::vector<double>> curves{};  // one value per frame of the sequence, NaN: none
  bool steps = false;                         // integers: drawn as stairs
  bool ahead = false;                         // what follows the drawn frame is drawn, pale
  bool baseline = false;                      // values may be negative: strong zero line
  std::vector<Change> changes{};
  bool total = false;  // a single total, in the text colour, next to charts with several curves
  std::vector<std::string> subjects{};  // for a single curve: the owner of each frame's value

  /// Bounds of all values and zero; zero and one if nothing happens. Set by fit() after the curves.
  double low = 0, high = 1;
  void fit();
};

/// Pixels at 720 lines: text size, and width of the ticks to the left of a chart.
inline constexpr double kChartText = 15;
inline constexpr double kChartGutter = 46;

/// Area for the curves in `rect`, without the ticks and `heading` pixels at 720 lines.
Rect chart_area(const Rect& rect, double heading, const Pen& pen);

/// Draws frames 0 to `moment`, or all, on an axis for all frames. `rect` includes gutter and heading.
void draw_series_chart(const SeriesChart& chart, std::size_t moment, const Rect& rect,
                       const Pen& pen);

/// Sample of the curve with this index, `length` pixels at 720 lines.
void draw_series_swatch(std::size_t index, const Point2& left, double length, const Pen& pen);

/// Vertical line at a frame, slightly higher than the chart.
void draw_moment(const Rect& chart, std::size_t frames, std::size_t moment, const Pen& pen);

/// Below charts of a whole sequence: the times of its first and last frame, and "time"; or their
/// numbers, if a time does not increase.
void draw_time_axis(const std::vector<trace::Frame>& frames, double left, double width,
                    double baseline, const Pen& pen);

/// State of a contact id in one frame.
enum class IdState : std::uint8_t { Absent, Dropped, Kept };

/// Contact ids over a sequence: one row per id, grey while the point exists, vermilion while it is
/// kept. Made once per sequence; the cost of a picture depends only on what it shows.
class IdHistory {
 public:
  /// `rows`: a state for every frame; `pairs`: pair of each row. Rows of a pair need not be
  /// adjacent.
  IdHistory(const std::vector<std::vector<IdState>>& rows, const std::vector<std::size_t>& pairs);

  std::size_t row_count() const { return rows_.size(); }
  std::size_t pair_count() const { return bands_.size(); }
  /// Whether each id is kept in every frame.
  bool is_constant() const;

  /// Draws frames before `until`; a line marks frame `moment`.
  void draw_rows(const Rect& strip, std::size_t moment, std::size_t until, const Pen& pen) const;

  /// For too many rows: one band for each of the first `count` pairs, up to frame `moment`. Its
  /// height is the number of kept points relative to the pair's maximum. Cuts mark replaced kept
  /// points.
  void draw_bands(const Rect& strip, std::size_t moment, std::size_t count, const Pen& pen) const;

 private:
  /// A run of frames without changes.
  struct Run {
    std::size_t from = 0, length = 0;
    IdState state = IdState::Absent;  // for a row
    std::size_t kept = 0;             // number of points, for a band
  };
  /// Rectangle of the frames before `until` on the strip.
  Rect place_of(const Run& run, const Rect& strip, std::size_t until) const;

  std::size_t frames_ = 0;
  std::vector<std::vector<Run>> rows_;   // in order of the pairs
  std::vector<std::vector<Run>> bands_;  // one per pair
};

/// Values of one pair over a sequence; one entry per frame, NaN in frames without a contact.
struct PairSeries {
  std::string name;                 // "floor–crate"
  std::vector<double> penetration;  // metres, at the deepest point
  std::vector<double> impulse;      // newton seconds; empty if no frame has a solver
};

/// Values of a group of bodies, named by the label of its pairs, empty without labels. Penetration
/// is 0 without an overlap; impulses are the sum of the step's normal impulses.
struct TimeSeries : PairSeries {
  std::vector<double> points;
  std::vector<double>
      energy;  // joules, kinetic, of these pairs' bodies; empty like `impulse`, and if not recorded
  /// For incremental manifolds: changes of the query that measured the cores.
  std::vector<SeriesChart::Change> queries;
  std::vector<std::vector<IdState>> ids;  // one row per id, in order of appearance
  std::vector<std::size_t> id_pairs;      // pair of each row, numbered in order of appearance
  /// For two or more touching pairs, as long as a chart can distinguish them; otherwise empty.
  std::vector<PairSeries> pairs;
  /// For more pairs: the pair with the deepest point, empty in frames without a contact.
  std::vector<std::string> deepest;
};

/// One series per label, or a single one without labels. Bodies without contacts count in all
/// series. Without ids, which take most of the time if there are many pairs, `ids` and `id_pairs` are
/// empty.
std::vector<TimeSeries> time_series(const std::vector<trace::Frame>& frames, bool with_ids = true);

}  // namespace contactscope::draw
