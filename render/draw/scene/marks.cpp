#include "draw/scene/scene.h"

namespace contactscope::draw {
namespace {

constexpr int kSteps = 12;  // for a quarter of a circle

// Pixels at 720 lines.
constexpr double kDotRadius = 5.5, kDotHalo = 1.8, kSpeckRadius = 2.4, kDotBorder = 2.2;
constexpr double kHaloed = kDotRadius + kDotHalo, kSeparatedBorder = 1.2, kCenterRadius = 9.5;
constexpr double kFootRadius = 6.5, kCoreRadius = 2.4, kOriginRadius = 7.0;
constexpr double kOriginHaloed = kOriginRadius + kDotHalo, kNodeRadius = 4.0, kSquare = 5.0;
constexpr double kRingInner = 9.0, kRingOuter = 11.2, kCrossReach = 4.5;

/// Sector of a disc; angles in quarters of a turn, clockwise on the screen from the right.
Fill sector(const Point2& center, float radius, int from, int to, const Color& color) {
  Fill fill{{}, color};
  if (to - from < 2) fill.polygon.push_back(center);
  for (int i = from * kSteps; i <= to * kSteps; ++i) {
    const float angle = 0.5f * std::numbers::pi_v<float> * static_cast<float>(i) / kSteps;
    fill.polygon.push_back(
        {center.x + radius * std::cos(angle), center.y + radius * std::sin(angle)});
  }
  return fill;
}

/// A ring whose left half is filled; sizes in pixels.
void draw_half_dot(const Point2& center, float radius, float border, const Color& color,
                   Drawing& drawing) {
  drawing.primitives.push_back(sector(center, radius - 0.5f * border, 1, 3, color));
  drawing.primitives.push_back(Disc{center, radius - border, radius, color});
}

constexpr double kMinMeasure = 26;  // pixels: two heads and a bit of line between them
constexpr double kOuterArrow = 24;  // pixels

}  // namespace

PointState point_state(const std::string& state) {
  if (state == "new") return PointState::New;
  return state == "broken" ? PointState::Broken : PointState::Persisted;
}

float draw_mark(MarkKind kind, const Point2& at, const Color& color, const Pen& pen, float size) {
  struct Ring {
    double inner, outer;
    Color color;
  };
  const auto rings = [&](double clear, std::initializer_list<Ring> in_order) {
    for (const Ring& ring : in_order) pen.ring(at, ring.inner, ring.outer, ring.color);
    return pen.px(clear);
  };
  switch (kind) {
    case MarkKind::Dot:
      return rings(kHaloed, {{0, kHaloed, kWhite}, {0, kDotRadius, color}});
    case MarkKind::Half:
      pen.disc(at, kHaloed, kWhite);
      draw_half_dot(at, pen.px(kDotRadius), pen.px(kDotBorder), color, pen.drawing());
      return pen.px(kHaloed);
    case MarkKind::Hollow:
      return rings(kHaloed, {{0, kHaloed, kWhite}, {kDotRadius - kDotBorder, kDotRadius, color}});
    case MarkKind::Ring:
    case MarkKind::WideRing:
      return rings(kRingOuter,
                   {{kRingInner - 1.5, kRingOuter + 1.5, with_alpha(kWhite, 0.85f)},
                    {kRingInner,
                     kind == MarkKind::Ring ? kRingOuter : kRingInner + 0.7 * kDotBorder, color}});
    case MarkKind::Separation:
      return rings(kHaloed, {{0, kHaloed, kWhite},
                             {0, kDotRadius, with_alpha(color, 0.3f)},
                             {kDotRadius - kSeparatedBorder, kDotRadius, color}});
    case MarkKind::Cross:
    case MarkKind::SmallCross: {
      const bool small = kind == MarkKind::SmallCross;
      const double reach = small ? 0.5 * kCrossReach : kCrossReach, width = small ? 0.6f : 1;
      pen.cross(at, reach, 5.0 * width, with_alpha(kWhite, 0.9f), Cap::Round);
      pen.cross(at, reach, 2.2 * width, color, Cap::Round);
      return pen.px(reach) + pen.px(2);
    }
    case MarkKind::Core:
      return rings(0, {{0, size * kCoreRadius, color}});
    case MarkKind::Quartered:
    case MarkKind::SmallQuartered: {
      const float radius = pen.px(kind == MarkKind::Quartered ? kCenterRadius : kFootRadius);
      draw_quartered_disc(at, radius, pen.px(1.6), pen.drawing());
      return radius + pen.px(2);
    }
    case MarkKind::Origin:
      return rings(kOriginHaloed,
                   {{0, kOriginHaloed, kWhite}, {kOriginRadius - kDotHalo, kOriginRadius, color}});
    case MarkKind::HeldOrigin:
      return rings(kOriginHaloed,
                   {{0, 0.7 * kOriginRadius + kDotHalo, kWhite}, {0, 0.7 * kOriginRadius, color}});
    case MarkKind::Square:
      draw_square(at, pen.px(kSquare), color, pen.drawing());
      return pen.px(kSquare + kDotHalo);
    case MarkKind::Speck:
      return rings(
          0, {{0, size * kSpeckRadius + 0.5 * kDotHalo, kWhite}, {0, size * kSpeckRadius, color}});
    case MarkKind::Node:
      return rings(0, {{0, kNodeRadius + 0.5 * kDotHalo, kWhite}, {0, kNodeRadius, color}});
  }
  return 0;
}

void draw_quartered_disc(const Point2& center, float radius, float border, Drawing& drawing) {
  drawing.primitives.push_back(Disc{center, 0, radius + border, kWhite});
  for (const int quarter : {0, 2})
    drawing.primitives.push_back(
        sector(center, radius - 0.5f * border, quarter, quarter + 1, kNormal));
  drawing.primitives.push_back(Disc{center, radius - border, radius, kNormal});
}

void draw_badge(Badge badge, const Point2& middle, float width, float height, const Color& color,
                const Pen& pen) {
  if (badge == Badge::None) return;
  const double border = 1.6;  // pixels
  const float room = kBadgeRoom * height;
  const float x = std::max(0.5f * width, 0.35f * height) + room, y = 0.5f * height + room;
  if (badge == Badge::Choice && width <= height) {
    const double radius = std::hypot(0.5f * width, 0.5f * height) + 0.5f * room;
    pen.disc(middle, radius / pen.scale(), kWhite);
    pen.ring(middle, radius / pen.scale() - border, radius / pen.scale(), color);
    return;
  }
  std::vector<Point2> outline;
  if (badge == Badge::Support) {
    // The corners extend as far as those of the number require.
    const float reach = std::max(x + 0.6f * y, 0.85f * width + room);
    outline = {{middle.x - reach, middle.y},
               {middle.x, middle.y - 1.5f * y},
               {middle.x + reach, middle.y},
               {middle.x, middle.y + 1.5f * y}};
  } else if (badge == Badge::Choice) {  // two digits: an elongated circle
    constexpr int kHalf = 8;
    for (int i = 0; i <= 2 * kHalf + 1; ++i) {
      const bool right = i <= kHalf;
      const float turn =
          std::numbers::pi_v<float> * (static_cast<float>(right ? i : i - 1) / kHalf - 0.5f);
      outline.push_back({middle.x + (right ? 0.5f : -0.5f) * width + y * std::cos(turn),
                         middle.y + y * std::sin(turn)});
    }
  } else {
    outline = {{middle.x - x, middle.y - y},
               {middle.x + x, middle.y - y},
               {middle.x + x, middle.y + y},
               {middle.x - x, middle.y + y}};
  }
  pen.fill(outline, kWhite);
  pen.outline(outline, border, color);
}

void draw_square(const Point2& center, float half, const Color& color, Drawing& drawing) {
  for (const bool halo : {true, false}) {
    const float h = halo ? 1.4f * half : half;
    const Point2 across{h, h}, down{-h, h};
    drawing.primitives.push_back(Fill{
        {center - across, center - down, center + across, center + down}, halo ? kWhite : color});
  }
}

void draw_state_dot(PointState state, const Point2& center, float radius, const Color& color,
                    Drawing& drawing) {
  drawing.primitives.push_back(Disc{center, 0, 1.33f * radius, kWhite});
  if (state == PointState::Persisted) {
    draw_half_dot(center, radius, 0.4f * radius, color, drawing);
  } else {
    const float inner = state == PointState::Broken ? 0.6f * radius : 0.0f;
    drawing.primitives.push_back(Disc{center, inner, radius, color});
  }
}

void draw_measure(const Scene& scene, Measured what, const Vec3d& from, const Vec3d& to,
                  float width, const std::string& text, Sketch& sketch) {
  const std::optional<float> pixels = seen_distance(scene.camera, from, to);
  if (!pixels) return;
  const Vec3d middle = 0.5 * (from + to);
  const auto explain = [&](const Swatch& swatch) {
    if (!text.empty()) sketch.explain(swatch, text, middle);
  };
  Arrow arrow{.from = from, .to = to, .width = width, .head = 10, .color = kAxis};
  if (what == Measured::Overlap) {
    arrow.bars = true;
    sketch.arrows.push_back(arrow);
    return explain(kOverlapSwatch);
  }
  // A length seen end-on, which is a point on the screen, counts as long enough.
  if (*pixels >= kMinMeasure * scene.scales.pixel || *pixels <= 0) {
    arrow.double_headed = true;
    sketch.arrows.push_back(arrow);
    return explain(kAxisSwatch);
  }
  // Narrow: arrows from outside, as in technical drawings. Their length on the screen is fixed.
  const Vec3d outward = (from - to) * (kOuterArrow * scene.scales.pixel / *pixels);
  for (const auto& [tip, offset] : {std::pair{from, outward}, {to, Vec3d(-outward)}}) {
    arrow.from = tip + offset;
    arrow.to = tip;
    sketch.arrows.push_back(arrow);
  }
  explain(kNarrowAxisSwatch);
}

void draw_gap(const Scene& scene, const Vec3d& from, const Vec3d& to, double metres, double noise,
              double clearance, const Vec3d& aside, Sketch& sketch) {
  draw_measure(scene, Measured::Gap, from, to, 3, "", sketch);
  sketch.label(0.5 * (from + to), "gap " + spell_length(metres, noise, scene.scales.length),
               kAxisText, 17, clearance, aside);
}

void draw_curved_arrow(const Camera& camera, const Vec3d& center, const Vec3d& axis, double radius,
                       double angle, float width, const Color& color, Sketch& sketch) {
  constexpr double kStep = 0.08;  // radians
  constexpr double kHead = 12;    // pixels
  const Vec3d to_eye = camera.to_eye(center);
  Vec3d front = to_eye - to_eye.dot(axis) * axis;
  front = front.norm() > 0.1 ? Vec3d(front.normalized())
                             : Vec3d(camera.right() - camera.right().dot(axis) * axis).normalized();
  const Vec3d side = axis.cross(front);
  const auto at = [&](double turn) -> Vec3d {
    const double a = turn - 0.5 * angle;
    return center + radius * (std::cos(a) * front + std::sin(a) * side);
  };
  // The head is straight, so the arc ends at its base.
  const double head =
      std::min(0.6 * angle, kHead / std::max(1e-9, radius * camera.pixels_per_metre(center)));
  const int steps = std::max(2, static_cast<int>(std::ceil((angle - head) / kStep)));
  std::vector<Vec3d> arc;
  for (int i = 0; i <= steps; ++i) arc.push_back(at((angle - head) * i / steps));
  sketch.curves.push_back({arc, {width + 3.5f, with_alpha(kWhite, 0.85f)}});
  sketch.curves.push_back({arc, {width, color}});
  sketch.arrow_head(at(angle - head), at(angle), width, kHead, color);
}

}  // namespace contactscope::draw
