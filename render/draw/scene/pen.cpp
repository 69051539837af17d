#include "draw/scene/pen.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace contactscope::draw {
namespace {

constexpr float kOnALine = 0.1f;  // pixels

/// How far a straight way from one point leads: slopes against its first direction that pass all
/// points so far. A corridor as wide as the tolerance narrows with every point, so that a path of n
/// points costs n steps. Williams 1978, "An efficient algorithm for the piecewise linear
/// approximation of planar curves".
class Corridor {
 public:
  explicit Corridor(const Point2& from) : from_(from) {}

  /// Whether the way may end at `point`, having passed all before; takes it in.
  bool reaches(const Point2& point) {
    const Point2 way = point - from_;
    if (length_ == 0) {
      const float first = length(way);
      if (!(first > 0)) return true;  // the same place
      along_ = way / first;
    }
    const float run = dot(along_, way), aside = cross(along_, way);
    if (run < length_) return false;  // it turns back
    length_ = run;
    const float slope = aside / run;
    if (slope < least_ || slope > most_) return false;
    least_ = std::max(least_, (aside - kOnALine) / run);
    most_ = std::min(most_, (aside + kOnALine) / run);
    return true;
  }

 private:
  Point2 from_, along_;
  float length_ = 0;
  float least_ = -1, most_ = 1;
};

/// Without the points between which the way is straight.
std::vector<Point2> straightened(const std::vector<Point2>& points) {
  std::vector<Point2> corners;
  for (std::size_t i = 0; i < points.size();) {
    corners.push_back(points[i]);
    Corridor corridor(points[i]);
    std::size_t next = i + 1;
    while (next < points.size() && corridor.reaches(points[next])) ++next;
    if (next == points.size()) {
      if (next > i + 1) corners.push_back(points.back());
      break;
    }
    i = std::max(i + 1, next - 1);
  }
  return corners;
}

}  // namespace

std::vector<Point2> corners_of(const Rect& rect) {
  const auto left = static_cast<float>(rect.x), top = static_cast<float>(rect.y);
  const auto right = static_cast<float>(rect.right()), bottom = static_cast<float>(rect.bottom());
  return {{left, top}, {right, top}, {right, bottom}, {left, bottom}};
}

void Pen::text(const std::string& what, const Point2& at, Align align, const Color& color,
               Weight weight, double size, double halo) const {
  Text text;
  text.text = what;
  text.at = at;
  text.size = px(size > 0 ? size : text_size_);
  text.weight = weight;
  text.align = align;
  text.color = color;
  text.halo = px(halo);
  out_.primitives.push_back(std::move(text));
}

float Pen::width_of(const std::string& what, Weight weight) const {
  return text_width(what, px(text_size_), weight);
}

Stroke Pen::stroke(const Point2& from, const Point2& to, double width, const Color& color,
                   double dash, double gap) const {
  Stroke stroke{from, to, px(width), color};
  stroke.dash = px(dash);
  stroke.gap = gap > 0 ? px(gap) : 0.7f * stroke.dash;
  return stroke;
}

void Pen::line(const Point2& from, const Point2& to, double width, const Color& color, double dash,
               double gap) const {
  out_.primitives.push_back(stroke(from, to, width, color, dash, gap));
}

void Pen::path(const std::vector<Point2>& points, double width, const Color& color, double dash,
               double gap) const {
  const std::vector<Point2> corners = straightened(points);
  float run = 0;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    Stroke piece = stroke(corners[i - 1], corners[i], width, color, dash, gap);
    piece.cap = dash > 0 ? Cap::Butt : Cap::Round;
    piece.phase = run;
    run += distance(corners[i - 1], corners[i]);
    out_.primitives.push_back(piece);
  }
}

void Pen::outline(const std::vector<Point2>& polygon, double width, const Color& color,
                  double dash) const {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    Stroke side = stroke(polygon[i], polygon[(i + 1) % polygon.size()], width, color, dash, 0);
    if (dash == 0) side.cap = Cap::Round;
    out_.primitives.push_back(side);
  }
}

void Pen::frame(const Rect& rect, double width, const Color& color) const {
  const std::vector<Point2> corners = corners_of(rect);
  for (std::size_t i = 0; i < corners.size(); ++i)
    line(corners[i], corners[(i + 1) % corners.size()], width, color);
}

void Pen::fill(std::vector<Point2> polygon, const Color& color) const {
  out_.primitives.push_back(Fill{std::move(polygon), color});
}

void Pen::fill(const Rect& rect, const Color& color) const {
  fill(corners_of(rect), color);
}

void Pen::disc(const Point2& center, double radius, const Color& color) const {
  ring(center, 0, radius, color);
}

void Pen::ring(const Point2& center, double inner, double outer, const Color& color) const {
  out_.primitives.push_back(Disc{center, px(inner), px(outer), color});
}

void Pen::cross(const Point2& at, double radius, double width, const Color& color, Cap cap) const {
  const float r = px(radius);
  for (const float rise : {r, -r}) {
    Stroke stroke{{at.x - r, at.y - rise}, {at.x + r, at.y + rise}, px(width), color, cap};
    out_.primitives.push_back(stroke);
  }
}

}  // namespace contactscope::draw
