#pragma once

#include <vector>

#include "core/convex_polygon.h"
#include "draw/scene/drawing.h"
#include "draw/scene/layout.h"
#include "trace/trace.h"

namespace contactscope::draw {

/// The marks of the contact plane, in pixels: the same in every picture of it, but for their size
/// where points stand close; 1 is that of a single patch.
void draw_kept_point(const Point2& at, const Layout& layout, double size, Drawing& drawing);
void draw_plain_point(const Point2& at, const Layout& layout, Drawing& drawing);
void draw_dropped_point(const Point2& at, const Layout& layout, double size, Drawing& drawing);
/// A square about the point, whatever became of it.
void draw_deepest_mark(const Point2& at, const Layout& layout, double size, const Color& color,
                       Drawing& drawing);
/// Half the width of a kept point, at 720 lines.
inline constexpr double kKeptReach = 8.2;

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
