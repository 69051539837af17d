#pragma once

#include <string>
#include <vector>

#include "draw/charts/id_strip.h"
#include "draw/charts/series_chart.h"
#include "trace/trace.h"

namespace contactscope::draw {

/// What one pair of a group did; an entry a frame, NaN in frames without a contact.
struct PairSeries {
  std::string name;                 // "floor–crate"
  std::vector<double> penetration;  // metres, of the deepest point
  std::vector<double> impulse;      // newton seconds; empty where no frame has a solver
};

/// What one group of bodies did over a sequence; an entry a frame.
struct TimeSeries {
  std::string name;                 // label of its pairs; empty where no pair has one
  std::vector<double> penetration;  // metres, of the deepest point, 0 without an overlap
  std::vector<double> points;
  // Empty where no frame has a solver.
  std::vector<double> energy;   // joules, kinetic, of the bodies in these pairs
  std::vector<double> impulse;  // newton seconds, sum of all normal impulses of the step
  /// Of incremental manifolds: what measured the cores, empty where there was none.
  std::vector<std::string> query;
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

/// The content of panel "plots": charts over each other, one time axis under them, and the strip of
/// contact ids. Of two to four pairs each has lines of its own. Made once a sequence.
class SeriesPlots {
 public:
  /// `duration`: seconds from the first frame to the last; `step`: seconds of a frame, where
  /// impulses are to be shown as the forces that they are over this time, else 0.
  SeriesPlots(const std::vector<TimeSeries>& series, double duration, double step = 0);

  /// Frames up to `moment`. Where there is little room, the strip, then the last charts are left
  /// out; returns how many.
  std::size_t draw(std::size_t moment, const Rect& rect, const Pen& pen) const;

 private:
  double strip_height(double room, const Pen& pen) const;
  void draw_ids(std::size_t moment, const Rect& strip, const Pen& pen) const;

  std::vector<SeriesChart> charts_;
  std::vector<std::string> names_;  // of the curves
  IdHistory ids_;
  double duration_;
};

}  // namespace contactscope::draw
