#pragma once

#include <Eigen/Core>

#include "draw/scene/drawing.h"

namespace contactscope::draw {

/// Finds places for labels: never over a mark, another label or the border of the view.
///
/// Places are tried on rings around the anchor, nearest ring first, and on each ring from the
/// wanted direction outwards. The first place wins that is free and that no line crosses. If there
/// is none nearby, lines may cross the label. A leader neither crosses another label nor runs along
/// a blocked line, unless there is no other place. A label without a free place on any ring is left
/// out.
class LabelPlacer {
 public:
  explicit LabelPlacer(const Rect& view) : view_(view) {}

  /// Keeps labels off a disc; pixels.
  void block(const Point2& center, float radius);
  /// Keeps labels off a line of some width, and leaders from running along it.
  void block(const Point2& from, const Point2& to, float width);
  /// Keeps labels off a line if possible.
  void avoid(const Segment2& line) { lines_.push_back(line); }

  struct Place {
    Point2 left_baseline;  // where the text begins
    bool needs_leader = false;
    Point2 leader_end;  // point of the label's box that is nearest to the anchor
  };

  struct Wish {
    float clearance = 0;      // between the anchor and the text, pixels
    Point2 direction;         // from the anchor; unit, y down
    bool outwards = false;    // rather across a line than opposite to `direction`
    bool has_leader = false;  // draws a leader even if near
  };

  /// Middle of a text's box whose side or corner that faces the anchor is on a ring around it.
  /// `direction`: unit, y down.
  static Eigen::Vector2d middle_of(const Point2& anchor, const Eigen::Vector2d& direction,
                                   double width, double height, double ring);

  /// `ascent`, `descent`, `width`: size of the text.
  std::optional<Place> place(const Point2& anchor, float width, float ascent, float descent,
                             const Wish& wish);

 private:
  bool misleads(const Point2& anchor, const Point2& end) const;

  Rect view_;
  std::vector<Rect> taken_;
  std::vector<Rect> texts_;      // placed labels; no leader crosses them
  std::vector<Segment2> lines_;  // lines that labels avoid
  std::vector<Segment2> blocked_;
};

/// A label for an end of a line.
struct LineLabel {
  float width = 0;              // of the text, pixels
  std::vector<Point2> anchors;  // ends of the line, the preferred one first; not empty
  float clearance = 0;          // extra distance of the text from an anchor, pixels
  float height = 0;             // of the text; 0: the common height
};

struct LabelObstacles {
  struct Line {
    Point2 from, to;
    float weight = 1;  // factor of the cost of covering it
  };
  std::vector<Line> lines;
  std::vector<Point2> markers;
  std::vector<Rect> boxes;  // no label may cover these
};

struct PlacedLabel {
  Rect box;
  Point2 anchor;      // one of the request's anchors
  Point2 leader_end;  // where a leader from the anchor meets the box
  bool needs_leader = false;
};

/// Places all labels; earlier ones have priority. Labels do not overlap and are inside `frame`, if
/// it has enough room. Otherwise later labels move onto lines and farther from their ends rather
/// than onto each other.
///
/// Steps: candidates are on rings about each anchor and on a grid over the frame. The cost of a
/// candidate counts what it covers, its distance, and what its leader crosses. The cheapest wins,
/// label by label. In further rounds each label chooses again with all others in place.
std::vector<PlacedLabel> place_line_labels(const std::vector<LineLabel>& labels,
                                           const LabelObstacles& obstacles, const Rect& frame,
                                           float height, float scale);

}  // namespace contactscope::draw
