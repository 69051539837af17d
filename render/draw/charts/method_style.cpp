#include "draw/charts/method_style.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "draw/scene/palette.h"

namespace contactscope::draw {
namespace {

// Okabe-Ito without yellow, which is lost on white.
constexpr std::array<Color, 7> kColors = {rgb(0x0072B2), rgb(0xD55E00), rgb(0x009E73),
                                          rgb(0xCC79A7), rgb(0xE69F00), rgb(0x56B4E9),
                                          rgb(0x000000)};
constexpr std::size_t kMarkers = 9;

// Web Content Accessibility Guidelines 2.1, "relative luminance".
double luminance(const Color& color) {
  const auto linear = [](double c) {
    return c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(color.r) + 0.7152 * linear(color.g) + 0.0722 * linear(color.b);
}

// Darkened until its contrast with white reaches 4.5, what the same guidelines ask of text.
Color legible(Color color) {
  while (1.05 / (luminance(color) + 0.05) < 4.5) {
    color.r *= 0.97f;
    color.g *= 0.97f;
    color.b *= 0.97f;
  }
  return color;
}

std::vector<Point2> corners_of(Marker marker, const Point2& c, float r) {
  switch (marker) {
    case Marker::Square:
    case Marker::HollowSquare: {
      const float s = 0.88f * r;
      return {{c.x - s, c.y - s}, {c.x + s, c.y - s}, {c.x + s, c.y + s}, {c.x - s, c.y + s}};
    }
    case Marker::Diamond:
    case Marker::HollowDiamond: {
      const float s = 1.25f * r;
      return {{c.x, c.y - s}, {c.x + s, c.y}, {c.x, c.y + s}, {c.x - s, c.y}};
    }
    case Marker::TriangleUp:
      return {{c.x, c.y - 1.25f * r},
              {c.x + 1.15f * r, c.y + 0.8f * r},
              {c.x - 1.15f * r, c.y + 0.8f * r}};
    case Marker::TriangleDown:
      return {{c.x, c.y + 1.25f * r},
              {c.x - 1.15f * r, c.y - 0.8f * r},
              {c.x + 1.15f * r, c.y - 0.8f * r}};
    case Marker::Circle:
    case Marker::Ring:
    case Marker::Plus:
      break;
  }
  return {};
}

void draw_outline(const std::vector<Point2>& corners, float width, const Color& color,
                  Drawing& drawing) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    drawing.primitives.push_back(
        Stroke{corners[i], corners[(i + 1) % corners.size()], width, color, Cap::Round});
  }
}

}  // namespace

// The strides are prime to the counts, so that colour, marker and dash change at different beats.
MethodStyle method_style(std::size_t index) {
  constexpr std::array<std::array<float, 2>, 3> kDashes = {{{0, 0}, {8, 4}, {2.5f, 3.5f}}};
  MethodStyle style;
  style.color = kColors[index % kColors.size()];
  style.text = legible(style.color);
  style.marker = static_cast<Marker>(index % kMarkers);
  const std::array<float, 2>& dash = kDashes[(index / kColors.size()) % kDashes.size()];
  style.dash = dash[0];
  style.gap = dash[1];
  return style;
}

void draw_marker(Marker marker, const Point2& center, float radius, const Color& color,
                 Drawing& drawing) {
  const float line = 0.42f * radius;
  switch (marker) {
    case Marker::Circle:
      drawing.primitives.push_back(Disc{center, 0, radius, color});
      return;
    case Marker::Ring:
      drawing.primitives.push_back(Disc{center, 0, radius, kWhite});
      drawing.primitives.push_back(Disc{center, radius - line, radius + 0.2f * line, color});
      return;
    case Marker::Plus: {
      const float s = 1.15f * radius;
      const float width = 0.75f * radius;
      drawing.primitives.push_back(
          Stroke{{center.x - s, center.y}, {center.x + s, center.y}, width, color});
      drawing.primitives.push_back(
          Stroke{{center.x, center.y - s}, {center.x, center.y + s}, width, color});
      return;
    }
    case Marker::HollowSquare:
    case Marker::HollowDiamond: {
      const std::vector<Point2> corners = corners_of(marker, center, radius);
      drawing.primitives.push_back(Fill{corners, kWhite});
      draw_outline(corners, line, color, drawing);
      return;
    }
    case Marker::Square:
    case Marker::Diamond:
    case Marker::TriangleUp:
    case Marker::TriangleDown: {
      const std::vector<Point2> corners = corners_of(marker, center, radius);
      drawing.primitives.push_back(Fill{corners, color});
      draw_outline(corners, 1, color, drawing);  // fills have no soft border of their own
      return;
    }
  }
}

const std::optional<double>& error_of(const trace::StudyPoint& point, ErrorKind kind) {
  return kind == ErrorKind::Mean ? point.error : point.error_worst;
}

std::vector<bool> on_front(const trace::Study& study, ErrorKind kind) {
  const bool same_cases = trace::has_panels(study);
  const auto beats = [&](const trace::StudyPoint& one, const trace::StudyPoint& other) {
    const std::optional<double>& error = error_of(one, kind);
    const double least = *error_of(other, kind);
    const double time = one.nanoseconds.median;
    const double other_time = other.nanoseconds.median;
    const bool comparable = same_cases || one.parameter == other.parameter;
    return error && comparable && *error <= least && time <= other_time &&
           (*error < least || time < other_time);
  };
  const auto unbeaten = [&](const trace::StudyPoint& point) {
    if (!error_of(point, kind)) return false;
    return std::ranges::none_of(study.series, [&](const trace::StudySeries& other) {
      return std::ranges::any_of(
          other.points, [&](const trace::StudyPoint& rival) { return beats(rival, point); });
    });
  };
  std::vector<bool> front;
  for (const trace::StudySeries& series : study.series) {
    const auto count = static_cast<std::size_t>(std::ranges::count_if(series.points, unbeaten));
    front.push_back(count > 0 && 2 * count >= series.points.size());
  }
  return front;
}

}  // namespace contactscope::draw
