#include "draw/scene/pen.h"

#include "draw/scene/layout.h"

namespace contactscope::draw {
namespace {

constexpr float kOnALine = 0.1f;  // pixels
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Index of the first point after `first` that no straight line reaches within tolerance of all
/// points between. Each point narrows the range of slopes, so a path of n points takes n steps.
/// Williams 1978, "An efficient algorithm for the piecewise linear approximation of planar curves".
std::size_t end_of_straight(const std::vector<Point2>& points, std::size_t first) {
  Point2 along;
  float reached = 0, least = -1, most = 1;
  std::size_t next = first + 1;
  for (; next < points.size(); ++next) {
    const Point2 displacement = points[next] - points[first];
    if (reached == 0) {
      const float direct = length(displacement);
      if (!(direct > 0)) continue;  // coincident points
      along = displacement / direct;
    }
    const float run = dot(along, displacement), aside = cross(along, displacement);
    const float slope = aside / run;
    if (run < reached || slope < least || slope > most) break;  // it turns back or leaves the line
    reached = run;
    least = std::max(least, (aside - kOnALine) / run);
    most = std::min(most, (aside + kOnALine) / run);
  }
  return next;
}

/// Removes points on straight stretches.
std::vector<Point2> straightened(const std::vector<Point2>& points) {
  std::vector<Point2> corners;
  for (std::size_t i = 0; i < points.size();) {
    corners.push_back(points[i]);
    const std::size_t next = end_of_straight(points, i);
    if (next == points.size()) {
      if (next > i + 1) corners.push_back(points.back());
      break;
    }
    i = std::max(i + 1, next - 1);
  }
  return corners;
}

/// Part of a line inside a convex polygon, as parameters (Cyrus and Beck 1978).
std::optional<std::pair<double, double>> inside(const std::vector<Vec2d>& polygon,
                                                const Vec2d& origin, const Vec2d& direction) {
  if (polygon.size() < 3) return std::nullopt;
  double first = -kInfinity, last = kInfinity;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2d edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    const double distance = cross(edge, Vec2d(origin - polygon[i]));  // positive inside
    const double speed = cross(edge, direction);
    if (speed == 0 && distance < 0) return std::nullopt;
    if (speed > 0) first = std::max(first, -distance / speed);
    if (speed < 0) last = std::min(last, -distance / speed);
  }
  return first < last ? std::optional(std::pair(first, last)) : std::nullopt;
}

}  // namespace

std::vector<Point2> corners_of(const Rect& rect) {
  const Point2 low = pixel(rect.x, rect.y), high = pixel(rect.right(), rect.bottom());
  return {low, {high.x, low.y}, high, {low.x, high.y}};
}

Said Pen::said(const std::string& what) const {
  return {out_.words == nullptr ? what : out_.words->of(what)};
}

Said Pen::fitted(const std::string& what, Weight weight, float available, double size) const {
  return {draw::fitted(said(what).text, px(size > 0 ? size : text_size_), weight, available)};
}

void Pen::text(const Said& what, const Point2& at, Align align, const Color& color, Weight weight,
               double size, double halo) const {
  out_.primitives.push_back(
      Text{what.text, at, px(size > 0 ? size : text_size_), weight, align, color, px(halo)});
}

float Pen::width_of(const Said& what, Weight weight) const {
  return text_width(what.text, px(text_size_), weight);
}

Stroke Pen::stroke(const Point2& from, const Point2& to, double width, const Color& color,
                   double dash, double gap) const {
  const float drawn = px(dash);
  return {from, to, px(width), color, Cap::Butt, drawn, gap > 0 ? px(gap) : 0.7f * drawn};
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

void Pen::fill(const Rect& rect, const Color& color) const { fill(corners_of(rect), color); }

void Pen::disc(const Point2& center, double radius, const Color& color) const {
  ring(center, 0, radius, color);
}

void Pen::ring(const Point2& center, double inner, double outer, const Color& color) const {
  out_.primitives.push_back(Disc{center, px(inner), px(outer), color});
}

void Pen::cross(const Point2& at, double radius, double width, const Color& color, Cap cap) const {
  const float r = px(radius);
  for (const float rise : {r, -r}) {
    out_.primitives.push_back(
        Stroke{{at.x - r, at.y - rise}, {at.x + r, at.y + rise}, px(width), color, cap});
  }
}

void Pen::hatch(const std::vector<Vec2d>& whole, const std::vector<Vec2d>& hole, double spacing,
                double width, const Color& color) const {
  if (whole.size() < 3) return;
  const Vec2d direction = Vec2d(1, -1) / std::sqrt(2.0), across = Vec2d(1, 1) / std::sqrt(2.0);
  double low = kInfinity, high = -kInfinity;
  for (const Vec2d& corner : whole) {
    low = std::min(low, across.dot(corner));
    high = std::max(high, across.dot(corner));
  }
  // Lines at multiples of the spacing, so that neighbouring regions continue each other.
  const double step = px(spacing);
  for (double offset = std::ceil(low / step) * step; offset < high; offset += step) {
    const Vec2d origin = offset * across;
    const auto seen = inside(whole, origin, direction), gone = inside(hole, origin, direction);
    if (!seen) continue;
    const auto draw = [&](double from, double to) {
      if (!(to > from)) return;
      const Vec2d a = origin + from * direction, b = origin + to * direction;
      line(pixel(a.x(), a.y()), pixel(b.x(), b.y()), width, color);
    };
    draw(seen->first, gone ? std::min(seen->second, gone->first) : seen->second);
    if (gone) draw(std::max(seen->first, gone->second), seen->second);
  }
}

}  // namespace contactscope::draw
