#pragma once

#include <vector>

#include "core/convex_polygon.h"
#include "draw/insets/contact_plane.h"
#include "draw/scene/drawing.h"
#include "draw/scene/layout.h"
#include "trace/trace.h"

namespace contactscope::draw {

/// One step of a reducer on the contact plane.
struct ChoiceStep {
  const std::vector<Point2>& places;  // of all points, pixels
  const std::vector<int>& kept;
  const std::vector<trace::Choice>& choices;
  int shown;        // the first so many choices; the last of them with its candidates
  Vec2d direction;  // of a support point, on the page, y down; zero: none
  double pixels_per_metre;
  const Rect& map;
  const Layout& layout;
};

/// Gregorius 2015, "Contact Point Reduction: 1st Point" to "4th Point (4)": what each candidate was
/// worth, and why the last shown one won.
void draw_choice(const ChoiceStep& step, Drawing& drawing);

}  // namespace contactscope::draw
