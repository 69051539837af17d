#pragma once

#include <string>
#include <vector>

#include "draw/charts/id_strip.h"
#include "draw/charts/series_chart.h"
#include "trace/trace.h"

namespace contactscope::draw {

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
  std::vector<double> energy;  // joules, kinetic, of the bodies in these pairs; empty as `impulse`
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
