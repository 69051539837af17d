#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "draw/scene/pen.h"
#include "trace/trace.h"

/// What is drawn over the time of a sequence, and the series that it shows.
namespace contactscope::draw {

/// How one of a few curves of a chart looks.
struct SeriesStyle {
  Color color;
  float dash = 0;  // pixels at 720 lines; solid when 0
};
SeriesStyle series_style(std::size_t index);

/// A small chart of values over frames: what it shows and its newest value above it; to its left
/// ticks at zero and at a round value on each side of zero that it reaches.
struct SeriesChart {
  /// Something is another in a frame than in the one before it.
  struct Change {
    std::size_t frame = 0;
    std::string before, after;  // what it was and what it is
  };

  std::string name;
  std::string unit;  // "m", with a prefix that suits; empty: a plain number
  std::vector<std::vector<double>> curves{};  // a value a frame of the whole sequence, NaN: none
  bool steps = false;                         // whole numbers: drawn as stairs
  bool baseline = false;                      // values go below zero: the zero line is drawn strong
  std::vector<Change> changes{};
  bool total = false;  // one curve of what other charts have several of: in the colour of text
  std::vector<std::string> subjects{};  // of one curve: whose its value is, a name a frame

  /// Bounds of all values and zero, of a sequence in which nothing happens zero and one. fit() sets
  /// them, once the curves are there.
  double low = 0, high = 1;
  void fit();
};

/// Sizes in pixels at 720 lines: of text, and of the room for ticks left of a chart.
inline constexpr double kChartText = 15;
inline constexpr double kChartGutter = 46;

/// What `rect` leaves for curves beside the ticks and under `heading` pixels at 720 lines.
Rect chart_area(const Rect& rect, double heading, const Pen& pen);

/// Draws frames 0 to `moment` on an axis that holds all frames. `rect` is all that the chart may
/// use, its gutter and heading included.
void draw_series_chart(const SeriesChart& chart, std::size_t moment, const Rect& rect,
                       const Pen& pen);

/// How the curve of this number looks, `length` pixels at 720 lines.
void draw_series_swatch(std::size_t index, const Point2& left, double length, const Pen& pen);

/// A line at a frame of so many, from a little above a chart to a little below it.
void draw_moment(const Rect& chart, std::size_t frames, std::size_t moment, const Pen& pen);

/// Under charts of the whole sequence: "0", "time", and how long it is in seconds.
void draw_time_axis(double duration, double left, double width, double baseline, const Pen& pen);

/// What became of a contact id in one frame.
enum class IdState : std::uint8_t { Absent, Dropped, Kept };

/// Ids over the time of a sequence: one row an id, grey while the point is there, vermilion while it
/// is kept. Made once a sequence; a picture costs what it shows of it.
class IdHistory {
 public:
  /// `rows`: a state for every frame; `pairs`: of each row its pair, those of one pair need not be
  /// next to each other.
  IdHistory(const std::vector<std::vector<IdState>>& rows, const std::vector<std::size_t>& pairs);

  std::size_t row_count() const { return rows_.size(); }
  std::size_t pair_count() const { return bands_.size(); }
  /// Each id is kept in every frame.
  bool is_constant() const;

  /// Frames before `until`; a line marks frame `moment`.
  void draw_rows(const Rect& strip, std::size_t moment, std::size_t until, const Pen& pen) const;

  /// The same where rows would be too many to tell apart: one band a pair, the first `count`, up to
  /// `moment`, as high as it has kept points of the most that it has had until then, and cut where
  /// one of them becomes another.
  void draw_bands(const Rect& strip, std::size_t moment, std::size_t count, const Pen& pen) const;

 private:
  /// Frames in which nothing changes.
  struct Run {
    std::size_t from = 0, length = 0;
    IdState state = IdState::Absent;  // of a row
    std::size_t kept = 0;             // points of a band
  };
  /// On the strip, as far as its frames are before `until`.
  Rect place_of(const Run& run, const Rect& strip, std::size_t until) const;

  std::size_t frames_ = 0;
  std::vector<std::vector<Run>> rows_;   // in the order of the pairs
  std::vector<std::vector<Run>> bands_;  // a pair each
};

/// What one pair did over a sequence; an entry a frame, NaN in frames without a contact.
struct PairSeries {
  std::string name;                 // "floor–crate"
  std::vector<double> penetration;  // metres, of the deepest point
  std::vector<double> impulse;      // newton seconds; empty where no frame has a solver
};

/// What one group of bodies did, named by the label of its pairs, empty where no pair has one. Without
/// an overlap the penetration is 0; impulses are the sum of all normal ones of the step.
struct TimeSeries : PairSeries {
  std::vector<double> points;
  std::vector<double>
      energy;  // joules, kinetic, of the bodies in these pairs; empty as `impulse`, and where nobody tells it
  /// Of incremental manifolds: where something else measured the cores than before.
  std::vector<SeriesChart::Change> queries;
  std::vector<std::vector<IdState>> ids;  // a row an id, in the order of appearance
  std::vector<std::size_t> id_pairs;      // of each row its pair, counted in the same order
  /// Of two pairs that ever touch, up to as many as a chart can tell apart; else empty.
  std::vector<PairSeries> pairs;
  /// Of more pairs than that: the one of the deepest point, empty in frames without a contact.
  std::vector<std::string> deepest;
};

/// From a whole sequence: one series a label, or one of all pairs where none has a label. Bodies
/// that touch nothing count in every series.
std::vector<TimeSeries> time_series(const std::vector<trace::Frame>& frames);

}  // namespace contactscope::draw
