#pragma once

#include "draw/charts/series_chart.h"
#include "draw/charts/time_series.h"

namespace contactscope::draw {

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
  double draw_names(const Rect& rect, const Pen& pen) const;
  double strip_height(double room, const Pen& pen) const;
  void draw_ids(std::size_t moment, const Rect& strip, const Pen& pen) const;

  std::vector<SeriesChart> charts_;
  std::vector<std::string> names_;  // of the curves
  IdHistory ids_;
  double duration_;
};

}  // namespace contactscope::draw
