#include "draw/layout.h"

#include <algorithm>
#include <cmath>

#include "draw/hatch.h"
#include "draw/palette.h"
#include "image/font.h"

namespace contactscope::draw {
namespace {

constexpr double kMargin = 24;
constexpr double kTitleSize = 28;
constexpr double kSourceSize = 14;
constexpr double kLegendSize = 15;
constexpr double kLegendRow = 24;
constexpr double kSwatch = 26;
constexpr double kEntryGap = 22;
constexpr double kPanelColumn = 356;
constexpr double kGutter = 16;
// Letters of 14 px at 720 lines are still 10 px high on the smallest pictures.
constexpr float kLeastScale = 0.72f;

int rows_of(const std::vector<float>& widths, double available) {
  int rows = widths.empty() ? 0 : 1;
  double used = 0;
  for (const float width : widths) {
    if (used > 0 && used + width > available) {
      ++rows;
      used = 0;
    }
    used += width;
  }
  return rows;
}

class Swatch {
 public:
  Swatch(const Layout& layout, double x, double middle, Drawing& drawing)
      : layout_(layout), x_(static_cast<float>(x)), y_(static_cast<float>(middle)), out_(drawing) {}

  void face(const Color& fill, const Color& outline, double width, bool dashed) {
    const float h = layout_.px(7);
    const float w = layout_.px(kSwatch - 4);
    const Point2 corners[4] = {{x_, y_ - h}, {x_ + w, y_ - h}, {x_ + w, y_ + h}, {x_, y_ + h}};
    out_.primitives.push_back(Fill{{corners, corners + 4}, fill});
    for (int i = 0; i < 4; ++i) {
      Stroke stroke{corners[i], corners[(i + 1) % 4], layout_.px(width), outline, Cap::Round};
      if (dashed) {
        stroke.cap = Cap::Butt;
        stroke.dash = layout_.px(5);
        stroke.gap = layout_.px(3.5);
      }
      out_.primitives.push_back(stroke);
    }
  }
  void dot(double inner, double outer, const Color& color) {
    out_.primitives.push_back(Disc{middle(), layout_.px(inner), layout_.px(outer), color});
  }
  void cross(const Color& color) {
    const float r = layout_.px(4.5);
    const Point2 m = middle();
    out_.primitives.push_back(
        Stroke{{m.x - r, m.y - r}, {m.x + r, m.y + r}, layout_.px(2), color, Cap::Round});
    out_.primitives.push_back(
        Stroke{{m.x - r, m.y + r}, {m.x + r, m.y - r}, layout_.px(2), color, Cap::Round});
  }
  void line(double from, double to, double width, const Color& color) {
    out_.primitives.push_back(
        Stroke{{x_ + layout_.px(from), y_}, {x_ + layout_.px(to), y_}, layout_.px(width), color});
  }
  void head(double tip, double size, const Color& color) {
    const float x = x_ + layout_.px(tip);
    const float s = layout_.px(size);
    const float back = size < 0 ? -1.0f : 1.0f;
    out_.primitives.push_back(
        Fill{{{x, y_}, {x - s, y_ - back * s * 0.5f}, {x - s, y_ + back * s * 0.5f}}, color});
  }
  void hatched(const Color& color) {
    const double h = layout_.px(7);
    const double w = layout_.px(kSwatch - 4);
    const std::vector<Vec2d> box = {{x_, y_ - h}, {x_ + w, y_ - h}, {x_ + w, y_ + h}, {x_, y_ + h}};
    hatch(box, {}, layout_.px(5), layout_.px(1.1), color, out_);
  }
  // Two rows of a strip: one kept to the end, one given up for the other.
  void bars(const Color& strong, const Color& faint) {
    const auto bar = [&](double from, double to, double top, const Color& color) {
      const float x0 = x_ + layout_.px(from), x1 = x_ + layout_.px(to);
      const float y0 = y_ + layout_.px(top), y1 = y0 + layout_.px(5);
      out_.primitives.push_back(Fill{{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, color});
    };
    bar(0, 12, -6, strong);
    bar(12, 22, -6, faint);
    bar(0, 12, 1, faint);
    bar(12, 22, 1, strong);
  }
  void upright(double width, const Color& color) {
    const Point2 m = middle();
    out_.primitives.push_back(
        Stroke{{m.x, m.y}, {m.x, m.y + layout_.px(9)}, layout_.px(width), color});
  }

 private:
  Point2 middle() const { return {x_ + layout_.px(kSwatch / 2 - 2), y_}; }

  const Layout& layout_;
  float x_, y_;
  Drawing& out_;
};

void draw_swatch(LegendKind kind, Swatch swatch) {
  switch (kind) {
    case LegendKind::ShapeA:
      swatch.face(kShapeA, kShapeEdge, 1.5, false);
      break;
    case LegendKind::ShapeB:
      swatch.face(kShapeB, kShapeEdge, 1.5, false);
      break;
    case LegendKind::ReferenceFace:
      swatch.face(with_alpha(kReferenceFace, 0.35f), kReferenceFace, 2.5, false);
      break;
    case LegendKind::SidePlane:
      swatch.face(with_alpha(kSidePlane, 0.2f), kSidePlane, 1.2, false);
      break;
    case LegendKind::IncidentFace:
      swatch.face(with_alpha(kIncidentFace, 0.35f), kIncidentFace, 2.5, true);
      break;
    case LegendKind::ClipPolygon:
      swatch.face(with_alpha(kClipPolygon, 0.2f), kClipPolygon, 2.5, false);
      break;
    case LegendKind::Dropped:
    case LegendKind::Reduced:
      swatch.cross(kDropped);
      break;
    case LegendKind::BeforeMove:
      swatch.dot(2.6, 4.8, kContact);
      break;
    case LegendKind::Contact:
      swatch.upright(2.5, kContact);
      swatch.dot(0, 4.8, kContact);
      break;
    case LegendKind::PlainPoint:
      swatch.dot(0, 4.8, kContact);
      break;
    case LegendKind::Kept:
      swatch.dot(0, 3.6, kContact);
      swatch.dot(6.2, 8.2, kContact);
      break;
    case LegendKind::LostArea:
      swatch.hatched(kDropped);
      break;
    case LegendKind::BestPolygon:
      swatch.face(with_alpha(kNormal, 0), kNormal, 1.6, true);
      break;
    case LegendKind::KeptIds:
      swatch.bars(kContact, rgb(0xD5D8DC));
      break;
    case LegendKind::Normal:
      swatch.line(0, 14, 3, kNormal);
      swatch.head(22, 10, kNormal);
      break;
    case LegendKind::Axis:
      swatch.line(6, 16, 3, kAxis);
      swatch.head(22, 8, kAxis);
      swatch.head(0, -8, kAxis);
      break;
    case LegendKind::TreeQuery:
      swatch.face(with_alpha(kNormal, 0), kNormal, 2, false);
      break;
    case LegendKind::TreeBox:
      swatch.face(with_alpha(kSidePlane, 0), kSidePlane, 2.5, false);
      break;
    case LegendKind::TreeMiss:
      swatch.face(with_alpha(kDropped, 0), kDropped, 1.5, true);
      break;
  }
}

}  // namespace

float interface_scale(int width, int height) {
  const double fit = std::min(width / 1280.0, height / 720.0);
  return std::max(kLeastScale, static_cast<float>(fit));
}

float legend_entry_width(const LegendEntry& entry, float scale) {
  return scale * static_cast<float>(kSwatch + 6 + kEntryGap) +
         text_width(entry.text, scale * static_cast<float>(kLegendSize), FontWeight::Regular);
}

std::string fitted(const std::string& text, float size, FontWeight weight, float available) {
  if (text_width(text, size, weight) <= available) return text;
  std::string shortened = text;
  while (!shortened.empty()) {
    // Whole UTF-8 characters only.
    do {
      shortened.pop_back();
    } while (!shortened.empty() && (static_cast<unsigned char>(shortened.back()) & 0xC0) == 0x80);
    if (!shortened.empty() && (static_cast<unsigned char>(shortened.back()) & 0xC0) == 0xC0) {
      shortened.pop_back();
    }
    if (text_width(shortened + "…", size, weight) <= available) return shortened + "…";
  }
  return shortened;
}

Layout make_layout(int width, int height, bool has_panels,
                   const std::vector<std::vector<float>>& legend_widths) {
  Layout layout;
  layout.width = width;
  layout.height = height;
  layout.scale = interface_scale(width, height);
  const double margin = layout.px(kMargin * (layout.scale < 1 ? 0.7 : 1.0));
  const double inner = width - 2 * margin;
  int rows = 0;
  for (const std::vector<float>& widths : legend_widths) {
    rows = std::max(rows, rows_of(widths, inner));
  }
  const double top = margin + layout.px(kTitleSize + 14);
  const double source_top = height - margin - layout.px(kSourceSize);
  const double legend_height = rows * layout.px(kLegendRow);
  const double legend_top = source_top - layout.px(8) - legend_height;
  const double column = has_panels ? layout.px(kPanelColumn) : 0;
  const double gutter = has_panels ? layout.px(kGutter) : 0;
  const double view_height = legend_top - layout.px(10) - top;
  layout.view = {margin, top, inner - column - gutter, view_height};
  layout.panels = {width - margin - column, top, column, view_height};
  layout.legend = {margin, legend_top, inner, legend_height};
  return layout;
}

void draw_legend(const std::vector<LegendEntry>& entries, const Layout& layout, Drawing& drawing) {
  double x = layout.legend.x;
  double middle = layout.legend.y + layout.px(kLegendRow / 2);
  for (const LegendEntry& entry : entries) {
    const double width = legend_entry_width(entry, layout.scale);
    if (x > layout.legend.x && x + width > layout.legend.x + layout.legend.width) {
      x = layout.legend.x;
      middle += layout.px(kLegendRow);
    }
    draw_swatch(entry.kind, Swatch(layout, x, middle, drawing));
    Text text;
    text.text = entry.text;
    text.size = layout.px(kLegendSize);
    text.at = {static_cast<float>(x) + layout.px(kSwatch + 6),
               static_cast<float>(middle) + 0.36f * text.size};
    text.color = kText;
    drawing.primitives.push_back(text);
    x += width;
  }
}

void draw_captions(const std::string& title, const std::string& source, const std::string& moment,
                   const Layout& layout, Drawing& drawing) {
  const float left = static_cast<float>(layout.legend.x);
  const float right = static_cast<float>(layout.legend.x + layout.legend.width);
  const float bottom = static_cast<float>(layout.height) - left;  // margins are equal
  const auto add = [&](const std::string& text, Point2 at, double size, FontWeight weight,
                       Align align, const Color& color, float available) {
    Text caption;
    caption.size = layout.px(size);
    caption.text = fitted(text, caption.size, weight, available);
    caption.at = at;
    caption.weight = weight == FontWeight::Bold ? Weight::Bold : Weight::Regular;
    caption.align = align;
    caption.color = color;
    drawing.primitives.push_back(caption);
  };
  add(title, {left, left + 0.8f * layout.px(kTitleSize)}, kTitleSize, FontWeight::Bold, Align::Left,
      kText, right - left);
  const float moment_width = text_width(moment, layout.px(kSourceSize), FontWeight::Regular);
  add(source, {left, bottom}, kSourceSize, FontWeight::Regular, Align::Left, kQuietText,
      right - left - moment_width - layout.px(kEntryGap));
  add(moment, {right, bottom}, kSourceSize, FontWeight::Regular, Align::Right, kQuietText,
      right - left);
}

}  // namespace contactscope::draw
