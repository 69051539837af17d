#pragma once

#include <vector>

#include "draw/scene/drawing.h"

namespace contactscope::draw {

/// A label that belongs to an end of a line.
struct LineLabel {
  float width = 0;              // of the text, pixels
  std::vector<Point2> anchors;  // ends of the line, the preferred one first; not empty
};

/// What labels keep off.
struct LabelObstacles {
  struct Line {
    Point2 from, to;
    float weight = 1;  // how much it matters that a label leaves it free
  };
  std::vector<Line> lines;
  std::vector<Point2> markers;
  std::vector<Rect> boxes;  // no label may cover these
};

struct PlacedLabel {
  Rect box;
  Point2 anchor;      // of the request's anchors
  Point2 leader_end;  // where a leader from the anchor meets the box
  bool needs_leader = false;
};

/// A place for each label, in the order given, earlier ones first served. No two overlap and all
/// are inside `frame`, as long as the frame has room for all side by side; then later ones move
/// onto lines and farther from their ends rather than onto each other.
///
/// Steps: candidates stand on rings about each anchor, and on a grid over the frame; each costs
/// what it covers, its distance, and what its leader crosses. The cheapest is taken, label by
/// label; some rounds more let each label choose again with all others in place.
std::vector<PlacedLabel> place_line_labels(const std::vector<LineLabel>& labels,
                                           const LabelObstacles& obstacles, const Rect& frame,
                                           float height, float scale);

}  // namespace contactscope::draw
