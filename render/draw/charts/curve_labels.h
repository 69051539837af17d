#pragma once

#include <string>
#include <vector>

#include "draw/scene/labels.h"
#include "draw/scene/pen.h"

namespace contactscope::draw {

/// A point that a picture's title speaks of, and what stands beside it.
struct MarkedPoint {
  Point2 at;
  std::string words;
};

/// Size of what stands there, pixels at 720 lines: larger than names.
inline constexpr float kMarkLetters = 16;

/// A ring about such a point, and what no label may cover of it.
void draw_mark(const Point2& at, const Pen& pen);
Rect mark_box(const Point2& at, const Pen& pen);
/// What is to be placed for its words, and they in the place that was found.
LineLabel mark_label(const MarkedPoint& mark, const Pen& pen);
void write_mark(const MarkedPoint& mark, const PlacedLabel& place, const Color& color,
                const Pen& pen);

/// A line of a chart, as pixels, and how it is called.
struct NamedLine {
  std::string name;
  Color color;  // of the letters
  bool quiet = false;
  std::vector<Point2> points;  // from left to right
  std::vector<MarkedPoint> marks{};
};

/// Pixels to the right of a chart that the names of its lines need; long ones take several rows.
float room_beside(const std::vector<NamedLine>& lines, const Pen& pen);

/// Names lines to the right of the area, from the top in the order of their ends, each with a leader;
/// and those that end before they get there at their end.
void name_beside(const std::vector<NamedLine>& lines, const Rect& area, const Pen& pen);

/// Names some of the lines of a chart inside of the area, each near one of its anchors; and rings what is marked of
/// any of its lines, with its words, which choose their places first.
void name_near(const std::vector<const NamedLine*>& named,
               const std::vector<std::vector<Point2>>& anchors, const std::vector<NamedLine>& lines,
               const Rect& area, const Pen& pen);

/// Names lines inside of the area, where they can be told apart.
void name_inside(const std::vector<NamedLine>& lines, const Rect& area, const Pen& pen);

}  // namespace contactscope::draw
