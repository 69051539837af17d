#include <array>
#include <cmath>
#include <numbers>

#include "draw/insets/choice_steps.h"
#include "draw/scene/hatch.h"
#include "draw/scene/layout.h"
#include "draw/scene/marks.h"
#include "draw/scene/palette.h"
#include "image/font.h"

namespace contactscope::draw {
namespace {

constexpr double kLegendSize = 15;
constexpr double kSwatch = 26;

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
  void state(const std::string& state) {
    draw_state_dot(state, middle(), layout_.px(4.8), kContact, out_);
  }
  void quartered() { draw_quartered_disc(middle(), layout_.px(7.5), layout_.px(1.4), out_); }
  void spot(double at, double radius, const Color& color) {
    out_.primitives.push_back(Disc{{x_ + layout_.px(at), y_}, 0, layout_.px(radius), color});
  }
  void dashes(double width, const Color& color) {
    Stroke stroke{{x_, y_}, {x_ + layout_.px(23), y_}, layout_.px(width), color};
    stroke.dash = layout_.px(6);
    stroke.gap = layout_.px(2.5);
    out_.primitives.push_back(stroke);
  }
  void open_head(double tip, double size, double width, const Color& color) {
    const Point2 at{x_ + layout_.px(tip), y_};
    for (const double side : {-0.5, 0.5}) {
      out_.primitives.push_back(Stroke{at,
                                       {at.x - layout_.px(size), at.y + layout_.px(side * size)},
                                       layout_.px(width),
                                       color,
                                       Cap::Round});
    }
  }
  // Three quarters of a turn.
  void turn(const Color& color) {
    constexpr int kSteps = 18;
    const Point2 m = middle();
    const float r = layout_.px(7);
    const auto at = [&](int i) {
      const float angle =
          std::numbers::pi_v<float> * (0.3f + 1.5f * static_cast<float>(i) / kSteps);
      return Point2{m.x + r * std::cos(angle), m.y - r * std::sin(angle)};
    };
    for (int i = 0; i + 1 < kSteps - 3; ++i) {
      out_.primitives.push_back(Stroke{at(i), at(i + 1), layout_.px(2.5), color, Cap::Round});
    }
    const Point2 tip = at(kSteps), back = at(kSteps - 4);
    const Point2 across{0.6f * (tip.y - back.y), -0.6f * (tip.x - back.x)};
    out_.primitives.push_back(
        Fill{{tip, {back.x + across.x, back.y + across.y}, {back.x - across.x, back.y - across.y}},
             color});
  }
  // A length between two ticks.
  void span(const Color& color) {
    line(2, 20, 1.8, color);
    for (const double at : {2.0, 20.0}) {
      const float x = x_ + layout_.px(at);
      out_.primitives.push_back(
          Stroke{{x, y_ - layout_.px(4)}, {x, y_ + layout_.px(4)}, layout_.px(1.8), color});
    }
  }
  void square(const Color& color) { draw_square(middle(), layout_.px(4.2), color, out_); }
  void open_square(const Color& color) { draw_deepest_mark(middle(), layout_, 0.72, color, out_); }
  // Two strokes across a line that goes on.
  void breaks(const Color& color) {
    line(0, 8.5, 3, color);
    line(14, 22, 3, color);
    for (const double at : {9.0, 13.0}) {
      const float x = x_ + layout_.px(at);
      out_.primitives.push_back(Stroke{{x - layout_.px(2), y_ + layout_.px(6)},
                                       {x + layout_.px(2), y_ - layout_.px(6)},
                                       layout_.px(1.8),
                                       color});
    }
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
    case LegendKind::Core:
      swatch.face(with_alpha(kReferenceFace, 0), kReferenceFace, 1.8, true);
      break;
    case LegendKind::Rounded:
      swatch.face(with_alpha(kReferenceFace, 0), kReferenceFace, 2, false);
      break;
    case LegendKind::Margins:
      swatch.span(kReferenceFace);
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
    case LegendKind::Support:
      swatch.face(with_alpha(kClipPolygon, 0.28f), kClipPolygon, 2.5, false);
      break;
    case LegendKind::NewPoint:
      swatch.state("new");
      break;
    case LegendKind::PersistedPoint:
      swatch.state("persisted");
      break;
    case LegendKind::BrokenPoint:
      swatch.state("broken");
      break;
    case LegendKind::Anchors:
      swatch.line(2, 20, 1.5, kContact);
      swatch.spot(2, 2.4, kContact);
      swatch.spot(20, 2.4, kContact);
      break;
    case LegendKind::NormalImpulse:
      swatch.line(0, 14, 3, kContact);
      swatch.head(22, 10, kContact);
      break;
    case LegendKind::WarmStart:
      swatch.line(0, 22, 9, kContact);
      swatch.line(1.5, 20.5, 6, kWhite);
      break;
    case LegendKind::FrictionImpulse:
      swatch.line(0, 21, 2.5, kIncidentFace);
      swatch.open_head(21, 9, 2.5, kIncidentFace);
      break;
    case LegendKind::BreakMark:
      swatch.breaks(kContact);
      break;
    case LegendKind::Velocity:
      swatch.line(0, 14, 3.5, kReferenceFace);
      swatch.head(22, 11, kReferenceFace);
      break;
    case LegendKind::RelativeVelocity:
      swatch.line(0, 21, 2, kClipPolygon);
      swatch.open_head(21, 9, 2, kClipPolygon);
      break;
    case LegendKind::NormalVelocity:
      swatch.line(0, 14, 4, kClipPolygon);
      swatch.head(22, 11, kClipPolygon);
      break;
    case LegendKind::Ahead:
      swatch.dashes(2, kDropped);
      break;
    case LegendKind::Spin:
      swatch.turn(kReferenceFace);
      break;
    case LegendKind::CenterOfMass:
      swatch.quartered();
      break;
    case LegendKind::FreeAxis:
      swatch.dashes(2.5, kNormal);
      break;
    case LegendKind::SupportMargin:
      swatch.line(0, 16, 2.2, kAxis);
      swatch.head(22, 8, kAxis);
      break;
    case LegendKind::DecidingEdges:
      swatch.line(0, 22, 4, kAxis);
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
    case LegendKind::OneShotPoint:
      swatch.upright(2.5, kContact);
      swatch.square(kContact);
      break;
    case LegendKind::ApartPoint:
      swatch.upright(1.5, kContact);
      swatch.dot(0, 4.8, kWhite);
      swatch.dot(0, 4.8, with_alpha(kContact, 0.3f));
      swatch.dot(3.7, 4.8, kContact);
      break;
    case LegendKind::PlainPoint:
      swatch.dot(0, 4.8, kContact);
      break;
    case LegendKind::Kept:
      swatch.dot(0, 3.6, kContact);
      swatch.dot(6.2, 8.2, kContact);
      break;
    case LegendKind::KeptPolygon:
      swatch.face(with_alpha(kContact, 0.16f), kContact, 2, false);
      break;
    case LegendKind::Deepest:
      swatch.open_square(kNormal);
      break;
    case LegendKind::AxesBox:
      swatch.face(with_alpha(kAxis, 0), kAxis, 2, true);
      break;
    case LegendKind::Candidate:
      swatch.line(0, 22, 1.5, with_alpha(kDropped, 0.7f));
      break;
    case LegendKind::OutsideTriangle:
      swatch.hatched(kContact);
      break;
    case LegendKind::InsideTriangle:
      swatch.face(with_alpha(kReferenceFace, 0.12f), with_alpha(kReferenceFace, 0.6f), 1.2, true);
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
    case LegendKind::NarrowAxis:
      swatch.line(0, 3, 3, kAxis);
      swatch.head(10, 8, kAxis);
      swatch.line(19, 22, 3, kAxis);
      swatch.head(12, -8, kAxis);
      break;
    case LegendKind::ClosestPoints:
      swatch.dot(0, 4.0, kAxisText);
      break;
    case LegendKind::LineOfCenters:
      swatch.dashes(1.2, kShapeEdge);
      break;
    case LegendKind::TreeQuery:
      swatch.face(with_alpha(kNormal, 0), kNormal, 2, false);
      break;
    case LegendKind::TreeBox:
      swatch.face(with_alpha(kSidePlane, 0), kSidePlane, 2.5, false);
      break;
    case LegendKind::Difference:
      swatch.face(rgb(0xE4E4E8), kShapeEdge, 1.5, false);
      break;
    case LegendKind::Simplex:
      swatch.face(with_alpha(kClipPolygon, 0.16f), kClipPolygon, 2, false);
      break;
    case LegendKind::Polytope:
      swatch.face(with_alpha(kReferenceFace, 0.06f), kReferenceFace, 1.2, false);
      break;
    case LegendKind::SimplexPoints:
      swatch.dot(0, 4.8, kClipPolygon);
      break;
    case LegendKind::FacePoints:
      swatch.dot(0, 4.8, kReferenceFace);
      break;
    case LegendKind::NextOfSimplex:
      swatch.dot(2.6, 4.8, kClipPolygon);
      break;
    case LegendKind::NextOfPolytope:
      swatch.dot(2.6, 4.8, kReferenceFace);
      break;
    case LegendKind::ArcsOfA:
      swatch.line(0, 22, 2.5, kArcOfA);
      break;
    case LegendKind::ArcsOfB:
      swatch.dashes(2.5, kArcOfB);
      break;
    case LegendKind::Crossing:
      swatch.dot(0, 4.8, kAxis);
      break;
    case LegendKind::BestAxis:
      swatch.dot(0, 3.6, kAxisText);
      swatch.dot(6.2, 8.2, kAxisText);
      break;
    case LegendKind::TreeMiss:
      swatch.face(with_alpha(kDropped, 0), kDropped, 1.5, true);
      break;
  }
}

}  // namespace

float legend_entry_width(const LegendEntry& entry, float scale) {
  return scale * static_cast<float>(kSwatch + 6 + kEntryGap) +
         text_width(entry.text, scale * static_cast<float>(kLegendSize), FontWeight::Regular);
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

}  // namespace contactscope::draw
