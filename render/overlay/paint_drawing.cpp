#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include "image/font.h"
#include "overlay/paint.h"

namespace contactscope::overlay {
namespace {

class DrawingPainter {
 public:
  explicit DrawingPainter(ImDrawList* list) : list_(list) {}

  void operator()(const draw::Fill& fill) const {
    std::vector<ImVec2> points;
    float twice_area = 0;
    for (std::size_t i = 0; i < fill.polygon.size(); ++i) {
      const draw::Point2& a = fill.polygon[i];
      const draw::Point2& b = fill.polygon[(i + 1) % fill.polygon.size()];
      twice_area += a.x * b.y - b.x * a.y;
      points.push_back({a.x, a.y});
    }
    // Dear ImGui fills clockwise on the screen; the other winding would lose its smooth border.
    if (twice_area < 0) std::ranges::reverse(points);
    list_->AddConvexPolyFilled(points.data(), static_cast<int>(points.size()), packed(fill.color));
  }

  void operator()(const draw::Stroke& stroke) const {
    const float dx = stroke.to.x - stroke.from.x, dy = stroke.to.y - stroke.from.y;
    const float length = std::hypot(dx, dy);
    if (!(length > 0)) return;
    const auto at = [&](float run) {
      return ImVec2{stroke.from.x + run / length * dx, stroke.from.y + run / length * dy};
    };
    const auto piece = [&](float from, float to) {
      list_->AddLine(at(from), at(to), packed(stroke.color), stroke.width);
    };
    if (stroke.gap <= 0) {
      piece(0, length);
      return;
    }
    const float period = stroke.dash + stroke.gap;
    for (float run = -std::fmod(stroke.phase, period); run < length; run += period) {
      const float from = std::max(0.0f, run), to = std::min(length, run + stroke.dash);
      if (to > from) piece(from, to);
    }
  }

  void operator()(const draw::Disc& disc) const {
    constexpr int kSegments = 32;
    const ImVec2 center{disc.center.x, disc.center.y};
    if (disc.inner <= 0) {
      list_->AddCircleFilled(center, disc.outer, packed(disc.color), kSegments);
    } else {
      list_->AddCircle(center, 0.5f * (disc.inner + disc.outer), packed(disc.color), kSegments,
                       disc.outer - disc.inner);
    }
  }

  void operator()(const draw::Text& text) const {
    const ImVector<ImFont*>& fonts = ImGui::GetIO().Fonts->Fonts;
    const bool bold = text.weight == draw::Weight::Bold;
    ImFont* font = bold ? fonts.back() : fonts.front();
    const float width = font->CalcTextSizeA(text.size, 1e9f, 0, text.text.c_str()).x;
    const float rise = ascent(text.size, bold ? FontWeight::Bold : FontWeight::Regular);
    const float shift = text.align == draw::Align::Left     ? 0.0f
                        : text.align == draw::Align::Center ? 0.5f * width
                                                            : width;
    const ImVec2 at{text.at.x - shift, text.at.y - rise};
    if (text.halo > 0) {
      constexpr int kSides = 8;
      for (int i = 0; i < kSides; ++i) {
        const float angle = 6.2831853f * static_cast<float>(i) / kSides;
        list_->AddText(font, text.size,
                       {at.x + text.halo * std::cos(angle), at.y + text.halo * std::sin(angle)},
                       packed(text.halo_color), text.text.c_str());
      }
    }
    list_->AddText(font, text.size, at, packed(text.color), text.text.c_str());
  }

 private:
  ImDrawList* list_;
};

bool continues(const draw::Stroke& next, const draw::Stroke& first, const ImVec2& at) {
  return next.gap <= 0 && next.cap == draw::Cap::Round && next.width == first.width &&
         packed(next.color) == packed(first.color) && next.from.x == at.x && next.from.y == at.y;
}

}  // namespace

void paint(const draw::Drawing& drawing, ImDrawList* list) {
  const DrawingPainter painter(list);
  const std::vector<draw::Primitive>& all = drawing.primitives;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const draw::Stroke* first = std::get_if<draw::Stroke>(&all[i]);
    if (first == nullptr || first->gap > 0 || first->cap != draw::Cap::Round) {
      std::visit(painter, all[i]);
      continue;
    }
    // Strokes that go on from each other are one line: round ends of each would bead it.
    std::vector<ImVec2> points = {{first->from.x, first->from.y}, {first->to.x, first->to.y}};
    while (i + 1 < all.size()) {
      const draw::Stroke* next = std::get_if<draw::Stroke>(&all[i + 1]);
      if (next == nullptr || !continues(*next, *first, points.back())) break;
      points.push_back({next->to.x, next->to.y});
      ++i;
    }
    list->AddPolyline(points.data(), static_cast<int>(points.size()), packed(first->color),
                      ImDrawFlags_None, first->width);
  }
}

}  // namespace contactscope::overlay
