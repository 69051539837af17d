#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "draw/charts/series_chart.h"
#include "draw/insets/contact_plane.h"
#include "draw/scene/camera.h"
#include "draw/scene/pen.h"
#include "trace/trace.h"

namespace contactscope::draw {

/// The content of panel "stability": for each pair whose stability was recorded (the first three)
/// the contact plane seen along the normal, right as in the camera's picture, with the points, the
/// hull of them that a body can rest on, its projected centre of mass and how far that is from the
/// border; what that means in words; then the margin over the time up to a moment, and in which row,
/// one a verdict, each pair is. One scale in all frames and pairs. Without room for both, the map
/// goes first. Made once a sequence, whose frames outlive it.
class StabilityPlot {
 public:
  explicit StabilityPlot(const std::vector<trace::Frame>& frames);

  void draw(std::size_t moment, const Camera& camera, const Rect& rect, const Pen& pen) const;

 private:
  /// One pair through the sequence.
  struct History {
    std::string name;
    std::vector<const trace::Pair*> pairs;  // in every frame; null where they do not touch
    std::vector<Vec3d> points;              // what must be in sight in any of them
  };

  void draw_maps(std::size_t moment, const Camera& camera, const Rect& rect, double height,
                 const Pen& pen) const;
  void draw_map(const trace::Pair& pair, const ContactPlane& plane) const;
  void draw_words(const trace::Pair* pair, const Rect& rect, const Pen& pen) const;
  void draw_verdicts(std::size_t moment, const Rect& rect, const Pen& pen) const;

  std::vector<History> histories_;
  SeriesChart margins_{"margin", "m"};
  double duration_ = 0;    // seconds
  bool has_ages_ = false;  // beside points that have an age, those without are drawn as such
};

}  // namespace contactscope::draw
