#pragma once

#include <optional>
#include <vector>

#include "draw/scene/drawing.h"

namespace contactscope::draw {

/// Finds places for labels: never over a mark, another label or the border of the view.
///
/// Places are tried on rings around the anchor, nearest ring first and on each ring from the wanted
/// direction outwards; the first one is taken that is free and that no line crosses. Where there is
/// none nearby, lines may cross it. A leader runs neither through another label nor along a line that
/// labels keep off, unless there is no other place. A label that found no free place on any ring is
/// left out rather than drawn over something.
class LabelPlacer {
 public:
  explicit LabelPlacer(const Rect& view) : view_(view) {}

  /// Keeps labels off a disc, or off a line of some width; pixels.
  void block(const Point2& center, float radius);
  /// No leader runs on along such a line either: it would look like more of it.
  void block(const Point2& from, const Point2& to, float width);
  /// Keeps labels off a line where they can.
  void avoid(const Segment2& line) { lines_.push_back(line); }

  struct Place {
    Point2 left_baseline;  // where the text begins
    bool needs_leader = false;
    Point2 leader_end;  // point of the label's box nearest to the anchor
  };

  struct Wish {
    float clearance = 0;      // between the anchor and the text, pixels
    Point2 direction;         // from the anchor; unit, y down
    bool outwards = false;    // rather on a line than on the other side of the anchor
    bool has_leader = false;  // also from near by
  };

  /// `ascent`, `descent`, `width`: size of the text.
  std::optional<Place> place(const Point2& anchor, float width, float ascent, float descent,
                             const Wish& wish);

 private:
  bool misleads(const Point2& anchor, const Point2& end) const;

  Rect view_;
  std::vector<Rect> taken_;
  std::vector<Rect> texts_;      // labels, which no leader crosses
  std::vector<Segment2> lines_;  // that labels avoid
  std::vector<Segment2> blocked_;
};

/// A label that belongs to an end of a line.
struct LineLabel {
  float width = 0;              // of the text, pixels
  std::vector<Point2> anchors;  // ends of the line, the preferred one first; not empty
  float clearance = 0;          // pixels more between an anchor and the text
  float height = 0;             // of the text; 0: that of all
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
