#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "draw/scene/drawing.h"
#include "trace/study.h"

namespace contactscope::draw {

enum class Marker {
  Circle,
  Square,
  Diamond,
  TriangleUp,
  Plus,
  TriangleDown,
  Ring,
  HollowSquare,
  HollowDiamond,
};

/// How a method looks in every plot of a study: no two of up to 63 look the same, and each
/// of colour, marker and dash alone already sets neighbours apart.
struct MethodStyle {
  Color color;  // Okabe-Ito
  Color text;   // the same hue, dark enough for letters on white
  Marker marker = Marker::Circle;
  float dash = 0, gap = 0;  // pixels at 720 lines; solid when gap is 0
};

MethodStyle method_style(std::size_t index);

/// Paints a marker about `center`; `radius` in pixels is that of the circle. All shapes weigh about
/// the same.
void draw_marker(Marker marker, const Point2& center, float radius, const Color& color,
                 Drawing& drawing);

/// Which error of a study's points.
enum class ErrorKind { Mean, Worst };
const std::optional<double>& error_of(const trace::StudyPoint& point, ErrorKind kind);

/// For each series whether at least half of its points are beaten by no other point at the same
/// parameter: none is as fast and as close, and better in one of them. Where the study has panels,
/// whose parameter is how hard a method tries at the same cases, by no other point at all. By
/// median time. A point without an error is beaten.
std::vector<bool> on_front(const trace::Study& study, ErrorKind kind);

}  // namespace contactscope::draw
