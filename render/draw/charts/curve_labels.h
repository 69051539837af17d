#pragma once

#include "draw/scene/labels.h"
#include "draw/scene/pen.h"

namespace contactscope::draw {

/// A point that a picture's title mentions, and its text.
struct MarkedPoint {
  Point2 at;
  std::string words;
};

/// Size of that text, pixels at 720 lines: larger than names.
inline constexpr float kMarkLetters = 16;

/// Places labels around marked points, whose texts in these colours are placed first. Draws the
/// marks: a ring around each point and its text. Returns the places of the labels.
std::vector<PlacedLabel> place_with_marks(const std::vector<std::pair<MarkedPoint, Color>>& marks,
                                          const std::vector<LineLabel>& labels,
                                          LabelObstacles obstacles, const Rect& room, float height,
                                          const Pen& pen);

/// A line of a chart in pixels, and its name.
struct NamedLine {
  std::string name;
  Color color;  // of the name
  bool quiet = false;
  std::vector<Point2> points;  // from left to right
  std::vector<MarkedPoint> marks{};
};

/// Width to the right of a chart for the names of its lines, pixels; long names take several rows.
float side_room(const std::vector<NamedLine>& lines, const Pen& pen);

/// Names lines to the right of the area, ordered by their ends, with leaders. Lines that end before
/// the right border are named at their end.
void name_at_side(const std::vector<NamedLine>& lines, const Rect& area, const Pen& pen);

/// Names some lines inside the area, each near one of its anchors. Also draws rings and texts for
/// the marked points of all lines; these are placed first.
void name_near(const std::vector<const NamedLine*>& named,
               const std::vector<std::vector<Point2>>& anchors, const std::vector<NamedLine>& lines,
               const Rect& area, const Pen& pen);

/// Names lines inside the area, where they are well separated.
void name_inside(const std::vector<NamedLine>& lines, const Rect& area, const Pen& pen);

}  // namespace contactscope::draw
