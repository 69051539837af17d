#include "draw/charts/plot.h"
#include "draw/scene/layout.h"
#include "draw/scene/palette.h"

namespace contactscope::draw {
namespace {

// Okabe-Ito without yellow, which is hard to see on white.
constexpr std::array<Color, 7> kColors = {rgb(0x0072B2), rgb(0xD55E00), rgb(0x009E73),
                                          rgb(0xCC79A7), rgb(0xE69F00), rgb(0x56B4E9),
                                          rgb(0x000000)};
constexpr std::size_t kMarkers = 9;

// Darkened until its contrast with white is 4.5, which WCAG 2.1 requires for text.
Color legible(Color color) {
  while (contrast(color, kWhite) < 4.5)
    for (float* channel : {&color.r, &color.g, &color.b}) *channel *= 0.97f;
  return color;
}

/// Corners of a polygonal marker of radius 1.
std::vector<Point2> corners_of(Marker marker) {
  if (marker == Marker::Square || marker == Marker::HollowSquare)
    return {{-0.88f, -0.88f}, {0.88f, -0.88f}, {0.88f, 0.88f}, {-0.88f, 0.88f}};
  if (marker == Marker::Diamond || marker == Marker::HollowDiamond)
    return {{0, -1.25f}, {1.25f, 0}, {0, 1.25f}, {-1.25f, 0}};
  if (marker == Marker::TriangleUp) return {{0, -1.25f}, {1.15f, 0.8f}, {-1.15f, 0.8f}};
  if (marker == Marker::TriangleDown) return {{0, 1.25f}, {-1.15f, -0.8f}, {1.15f, -0.8f}};
  return {};
}

}  // namespace

// The periods are coprime, so that colour, marker and dash change at different indices.
MethodStyle method_style(std::size_t index) {
  constexpr std::array<std::array<float, 2>, 3> kDashes = {{{0, 0}, {8, 4}, {2.5f, 3.5f}}};
  const Color& color = kColors[index % kColors.size()];
  const auto& [dash, gap] = kDashes[(index / kColors.size()) % kDashes.size()];
  return {color, legible(color), static_cast<Marker>(index % kMarkers), dash, gap};
}

void draw_marker(Marker marker, const Point2& center, float radius, const Color& color,
                 Drawing& drawing) {
  const Pen pen(drawing, 1, 0);  // lengths are canvas pixels
  const float line = 0.42f * radius;
  if (marker == Marker::Circle) {
    pen.disc(center, radius, color);
  } else if (marker == Marker::Ring) {
    pen.disc(center, radius, kWhite);
    pen.ring(center, radius - line, radius + 0.2f * line, color);
  } else if (marker == Marker::Plus) {
    for (const Point2& half : {Point2{1.15f * radius, 0}, Point2{0, 1.15f * radius}})
      pen.line(center - half, center + half, 0.75f * radius, color);
  } else {
    std::vector<Point2> corners = corners_of(marker);
    for (Point2& corner : corners) corner = center + radius * corner;
    const bool hollow = marker == Marker::HollowSquare || marker == Marker::HollowDiamond;
    pen.fill(corners, hollow ? kWhite : color);
    // A thin line, because fills have no anti-aliased border.
    pen.outline(corners, hollow ? line : 1, color);
  }
}

const std::optional<double>& error_of(const trace::StudyPoint& point, ErrorKind kind) {
  return kind == ErrorKind::Mean ? point.error : point.error_worst;
}

std::vector<bool> on_front(const trace::Study& study, ErrorKind kind) {
  const bool same_cases = trace::has_panels(study) && !study.other_cases;
  const auto beats = [&](const trace::StudyPoint& one, const trace::StudyPoint& other) {
    const std::optional<double>& error = error_of(one, kind);
    const double least = *error_of(other, kind);
    const double time = one.nanoseconds.median, other_time = other.nanoseconds.median;
    const bool comparable = same_cases || one.parameter == other.parameter;
    return error && comparable && *error <= least && time <= other_time &&
           (*error < least || time < other_time);
  };
  const auto unbeaten = [&](const trace::StudyPoint& point) {
    return error_of(point, kind) &&
           std::ranges::none_of(points_of(study), [&](const trace::StudyPoint& rival) {
             return beats(rival, point);
           });
  };
  return mapped(study.series, [&](const trace::StudySeries& series) {
    const auto count = static_cast<std::size_t>(std::ranges::count_if(series.points, unbeaten));
    return count > 0 && 2 * count >= series.points.size();
  });
}

}  // namespace contactscope::draw
