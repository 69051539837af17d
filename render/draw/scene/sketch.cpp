#include "draw/scene/sketch.h"

namespace contactscope::draw {

void Sketch::outline(const std::vector<Vec3d>& polygon, const LineStyle& style) {
  for (std::size_t i = 0; i < polygon.size(); ++i)
    line(polygon[i], polygon[(i + 1) % polygon.size()], style);
}

Label& Sketch::label(const Vec3d& at, const std::string& text, const Color& color, float size,
                     double clearance, const std::optional<Vec3d>& direction) {
  Label& label = labels.emplace_back();
  label.at = at;
  label.text = text;
  label.color = color;
  label.size = size;
  label.bold = true;
  label.clearance = clearance;
  label.direction = direction;
  return label;
}

}  // namespace contactscope::draw
