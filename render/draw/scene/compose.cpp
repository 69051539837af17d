#include "draw/scene/compose.h"

#include <cmath>

#include "draw/scene/labels.h"
#include "draw/scene/marks.h"
#include "draw/scene/palette.h"
#include "draw/scene/pen.h"
#include "image/font.h"

namespace contactscope::draw {
namespace {

constexpr float kJoin = 0.25f;    // pixels
constexpr float kAvoided = 1.5f;  // pixels: labels keep off lines of this width
constexpr float kLeastPiece = 4;  // pixels of a curve: shorter ones have more ends than line
constexpr double kDotRadius = 5.5;
constexpr double kDotHalo = 1.8;
constexpr double kDotBorder = 2.2;
constexpr double kApartBorder = 1.2;
constexpr float kApartFill = 0.3f;
constexpr double kCenterRadius = 9.5;
constexpr double kFootRadius = 6.5;
constexpr double kCoreRadius = 2.4;
constexpr double kOriginRadius = 7.0;
constexpr double kNodeRadius = 4.0;
constexpr double kSquare = 5.0;
constexpr double kRingInner = 9.0;
constexpr double kRingOuter = 11.2;
constexpr double kCrossReach = 4.5;

class Composer {
 public:
  Composer(const Sketch& sketch, const Camera& camera, const Layout& layout, Drawing& drawing)
      : sketch_(sketch),
        camera_(camera),
        layout_(layout),
        pen_(drawing, layout.scale, 0),
        placer_(layout.view),
        hidden_(camera, sketch.occluders, sketch.shadows) {}

  void run() {
    for (const Surface& surface : depth_ordered(sketch_.surfaces, camera_, sketch_.bodies)) {
      std::vector<Point2> polygon = project_polygon(camera_, surface.polygon);
      if (!polygon.empty()) pen_.fill(std::move(polygon), surface.color);
    }
    for (const Curve& curve : sketch_.curves) draw_curve(curve);
    for (const Line& line : sketch_.lines) draw_line(line);
    // What is inside of a shape stays under what is said about it.
    // So does an origin under the arrow that begins there, which may be no longer than it.
    const auto is_core = [](const Mark& mark) {
      return mark.kind == MarkKind::Core || mark.kind == MarkKind::Origin ||
             mark.kind == MarkKind::HeldOrigin;
    };
    for (const Mark& mark : sketch_.marks) {
      if (is_core(mark)) draw_mark(mark);
    }
    for (const Arrow& arrow : sketch_.arrows) draw_arrow(arrow);
    for (const Mark& mark : sketch_.marks) {
      if (!is_core(mark)) draw_mark(mark);
    }
    for (const Label& label : sketch_.labels) draw_label(label);
  }

 private:
  float px(double at_720) const { return layout_.px(at_720); }

  void stroke(const Vec3d& from, const Vec3d& to, float width, const Color& color, float dash,
              float gap, float phase, bool joined) {
    const std::optional<Segment2> seen = project_segment(camera_, from, to);
    if (!seen) return;
    Stroke result{seen->from, seen->to, px(width), color, Cap::Round};
    // Translucent strokes end flat, for round ends would add up where they meet.
    if (gap > 0 || color.a < 1) result.cap = Cap::Butt;
    const float length = distance(seen->from, seen->to);
    if (joined && result.cap == Cap::Round && length > 0) {
      // So do pieces of a curve: round ends would bead it. They overlap by what two flat ends lack.
      result.cap = Cap::Butt;
      const float dx = kJoin / length * (seen->to.x - seen->from.x);
      const float dy = kJoin / length * (seen->to.y - seen->from.y);
      result.from = {result.from.x - dx, result.from.y - dy};
      result.to = {result.to.x + dx, result.to.y + dy};
    }
    result.dash = px(dash);
    result.gap = px(gap);
    result.phase = phase;
    pen_.drawing().primitives.push_back(result);
  }

  void draw_line(const Line& line) {
    const LineStyle& style = line.style;
    const std::optional<Segment2> seen = project_segment(camera_, line.from, line.to);
    if (!seen) return;
    if (line.keep_clear) placer_.block(seen->from, seen->to, px(style.width + 2));
    const Vec3d way = line.to - line.from;
    for (const Span& span : spans_of(line.from, line.to, style)) {
      draw_span(line.from + span.from * way, line.from + span.to * way, span.hidden, style, 0,
                false);
    }
  }

  // `run`: pixels of the line's dashes before `from`.
  void draw_span(const Vec3d& from, const Vec3d& to, bool hidden, const LineStyle& style, float run,
                 bool joined) {
    if (hidden) {
      if (style.hidden == LineStyle::Hidden::Gone) return;
      stroke(from, to, 1.0f, with_alpha(style.color, 0.38f * style.color.a), 5, 4, run, joined);
    } else {
      if (style.width >= kAvoided) {
        const std::optional<Segment2> seen = project_segment(camera_, from, to);
        if (seen) placer_.avoid(seen->from, seen->to);
      }
      const bool dashed = style.hidden == LineStyle::Hidden::Same && style.dashed;
      stroke(from, to, style.width, style.color, dashed ? 10.0f : 0.0f, dashed ? 6.0f : 0.0f, run,
             joined);
    }
  }

  std::vector<Span> spans_of(const Vec3d& from, const Vec3d& to, const LineStyle& style) const {
    if (style.hidden == LineStyle::Hidden::Same) return {{0, 1, false}};
    return hidden_.split(from, to);
  }

  // What is hidden is decided for each piece of the curve: a longer chord would lie inside the body
  // whose outline it is. Drawn are longer pieces, with fewer ends. The lengths already run are
  // measured on the screen, where dashes are.
  void draw_curve(const Curve& curve) {
    if (curve.points.empty()) return;
    float run = 0;
    Vec3d from = Vec3d::Zero(), to = Vec3d::Zero();
    bool hidden = false, any = false;
    const auto draw = [&] {
      if (any) draw_span(from, to, hidden, curve.style, run, true);
      if (any) run += on_screen(from, to);
      any = false;
    };
    const std::size_t pieces = curve.points.size() - (curve.closed ? 0 : 1);
    for (std::size_t i = 0; i < pieces; ++i) {
      const Vec3d& p = curve.points[i];
      const Vec3d& q = curve.points[(i + 1) % curve.points.size()];
      if (!project_segment(camera_, p, q)) {
        draw();
        continue;
      }
      for (const Span& span : spans_of(p, q, curve.style)) {
        if (any && (span.hidden != hidden || on_screen(from, to) >= kLeastPiece)) draw();
        if (!any) from = p + span.from * (q - p);
        to = p + span.to * (q - p);
        hidden = span.hidden;
        any = true;
      }
    }
    draw();
  }

  // Pixels; 0 behind the eye.
  float on_screen(const Vec3d& from, const Vec3d& to) const {
    const std::optional<Segment2> seen = project_segment(camera_, from, to);
    return seen ? distance(seen->from, seen->to) : 0;
  }

  // Of an arrow that comes from there.
  void head(const Point2& tip, const Point2& from, double size, const Color& color) {
    const float length = distance(from, tip);
    if (length <= 0) return;
    const float ux = (tip.x - from.x) / length;
    const float uy = (tip.y - from.y) / length;
    const float s = px(size);
    const float half = 0.42f * s;
    const Point2 base{tip.x - s * ux, tip.y - s * uy};
    const std::vector<Point2> corners = {
        tip, {base.x - half * uy, base.y + half * ux}, {base.x + half * uy, base.y - half * ux}};
    pen_.fill(corners, color);
    pen_.outline(corners, 1, color);
  }

  void open_head(const Point2& tip, const Point2& from, double size, float width,
                 const Color& color) {
    const float length = distance(from, tip);
    if (length <= 0) return;
    const float s = px(size) / length;
    const Point2 back{s * (from.x - tip.x), s * (from.y - tip.y)};
    for (const float side : {-0.5f, 0.5f}) {
      const Point2 end{tip.x + back.x - side * back.y, tip.y + back.y + side * back.x};
      pen_.path({tip, end}, width, color);
    }
  }

  void draw_arrow(const Arrow& arrow) {
    Vec3d end = arrow.from;
    if (arrow.to) {
      end = *arrow.to;
    } else {
      end += arrow.pixels * layout_.scale / camera_.pixels_per_metre(arrow.from) * arrow.direction;
    }
    const std::optional<Point2> a = camera_.project(arrow.from);
    std::optional<Point2> b = camera_.project(end);
    if (!a || !b || !layout_.view.contains(*a)) return;
    if (!layout_.view.contains(*b)) {
      if (arrow.may_leave) stroke(arrow.from, end, arrow.width, arrow.color, 0, 0, 0, false);
      if (arrow.may_leave || arrow.to) return;
      const std::optional<Segment2> inside = clip_segment(layout_.view, *a, *b);
      if (!inside) return;
      b = inside->to;  // its length says nothing
    }
    const float length = distance(*a, *b);
    if (length < px(1)) return;
    // Short arrows keep their shape: the heads shrink before the shaft is lost.
    const double size = std::min<double>(arrow.head, arrow.head_share * length / layout_.scale);
    const float ux = (b->x - a->x) / length;
    const float uy = (b->y - a->y) / length;
    const float inset = arrow.open ? 0 : px(0.9 * size);
    const Point2 shaft_end{b->x - inset * ux, b->y - inset * uy};
    const Point2 shaft_begin =
        arrow.double_headed ? Point2{a->x + inset * ux, a->y + inset * uy} : *a;
    if (arrow.halo) pen_.path({*a, *b}, arrow.width + 4, with_alpha(kWhite, 0.85f));
    pen_.line(shaft_begin, shaft_end, arrow.width, arrow.color);
    if (arrow.open) {
      open_head(*b, *a, size, arrow.width, arrow.color);
    } else {
      head(*b, *a, size, arrow.color);
    }
    if (arrow.double_headed) head(*a, *b, size, arrow.color);
    placer_.block(*a, *b, px(arrow.width + 6));
  }

  void draw_mark(const Mark& mark) {
    const std::optional<Point2> at = camera_.project(mark.at);
    if (!at || !layout_.view.contains(*at)) return;
    const auto keep_clear = [&](double radius) { placer_.block(*at, px(radius)); };
    const auto ring_on_white = [&](double inner, double outer) {
      pen_.disc(*at, outer + kDotHalo, kWhite);
      pen_.ring(*at, inner, outer, mark.color);
      keep_clear(outer + kDotHalo);
    };
    const auto ring_around = [&](double outer) {
      pen_.ring(*at, kRingInner - 1.5, kRingOuter + 1.5, with_alpha(kWhite, 0.85f));
      pen_.ring(*at, kRingInner, outer, mark.color);
      keep_clear(kRingOuter);
    };
    const auto quartered = [&](double radius) {
      draw_quartered_disc(*at, px(radius), px(1.6), pen_.drawing());
      placer_.block(*at, px(radius) + px(2));
    };
    const auto cross = [&](double reach, double width) {
      pen_.cross(*at, reach, 5.0 * width, with_alpha(kWhite, 0.9f), Cap::Round);
      pen_.cross(*at, reach, 2.2 * width, mark.color, Cap::Round);
      placer_.block(*at, px(reach) + px(2));
    };
    switch (mark.kind) {
      case MarkKind::Dot:
        ring_on_white(0, kDotRadius);
        break;
      case MarkKind::Hollow:
        ring_on_white(kDotRadius - kDotBorder, kDotRadius);
        break;
      case MarkKind::Half:
        pen_.disc(*at, kDotRadius + kDotHalo, kWhite);
        draw_half_dot(*at, px(kDotRadius), px(kDotBorder), mark.color, pen_.drawing());
        keep_clear(kDotRadius + kDotHalo);
        break;
      case MarkKind::Apart:
        pen_.disc(*at, kDotRadius + kDotHalo, kWhite);
        pen_.disc(*at, kDotRadius, with_alpha(mark.color, kApartFill));
        pen_.ring(*at, kDotRadius - kApartBorder, kDotRadius, mark.color);
        keep_clear(kDotRadius + kDotHalo);
        break;
      case MarkKind::Core:
        pen_.disc(*at, kCoreRadius, mark.color);
        break;
      case MarkKind::Node:
        pen_.disc(*at, kNodeRadius + 0.5 * kDotHalo, kWhite);
        pen_.disc(*at, kNodeRadius, mark.color);
        break;
      case MarkKind::Quartered:
        quartered(kCenterRadius);
        break;
      case MarkKind::SmallQuartered:
        quartered(kFootRadius);
        break;
      case MarkKind::Origin:
        ring_on_white(kOriginRadius - kDotHalo, kOriginRadius);
        break;
      case MarkKind::HeldOrigin:
        pen_.disc(*at, 0.7 * kOriginRadius + kDotHalo, kWhite);
        pen_.disc(*at, 0.7 * kOriginRadius, mark.color);
        keep_clear(kOriginRadius + kDotHalo);
        break;
      case MarkKind::Square:
        draw_square(*at, px(kSquare), mark.color, pen_.drawing());
        keep_clear(kSquare + kDotHalo);
        break;
      case MarkKind::WideRing:
        ring_around(kRingInner + 0.7 * kDotBorder);
        break;
      case MarkKind::Ring:
        ring_around(kRingOuter);
        break;
      case MarkKind::Cross:
        cross(kCrossReach, 1);
        break;
      case MarkKind::SmallCross:
        cross(0.5 * kCrossReach, 0.6f);
        break;
    }
  }

  Point2 wanted_direction(const Label& label, const Point2& at) const {
    std::optional<Point2> other;
    Point2 direction{0, -1};
    if (label.direction) {
      const double step = 20 / camera_.pixels_per_metre(label.at);
      other = camera_.project(label.at + step * *label.direction);
      if (other) direction = {other->x - at.x, other->y - at.y};
    } else {
      other = camera_.project(sketch_.center);
      if (other) direction = {at.x - other->x, at.y - other->y};
    }
    const float length = std::hypot(direction.x, direction.y);
    if (length < 1) return {0, -1};
    return {direction.x / length, direction.y / length};
  }

  void draw_label(const Label& label) {
    const std::optional<Point2> at = camera_.project(label.at);
    if (!at || !layout_.view.contains(*at)) return;
    const float size = px(label.size);
    const Weight weight = label.bold ? Weight::Bold : Weight::Regular;
    const float up = 0.76f * ascent(size, weight);  // capitals and digits, not accents
    const std::optional<LabelPlacer::Place> place = placer_.place(
        *at, text_width(label.text, size, weight), up, descent(size, weight), px(label.clearance),
        wanted_direction(label, *at), label.direction.has_value());
    if (!place) return;
    if (place->needs_leader || label.leader) {
      pen_.line(*at, place->leader_end, 3.5, with_alpha(kWhite, 0.8f));
      pen_.line(*at, place->leader_end, 1, label.color);
      placer_.block(*at, place->leader_end, px(2));
    }
    pen_.text(label.text, place->left_baseline, Align::Left, label.color, weight, label.size, 2.5);
  }

  const Sketch& sketch_;
  const Camera& camera_;
  const Layout& layout_;
  Pen pen_;
  LabelPlacer placer_;
  HiddenLines hidden_;
};

}  // namespace

void compose(const Sketch& sketch, const Camera& camera, const Layout& layout, Drawing& drawing) {
  Composer(sketch, camera, layout, drawing).run();
}

}  // namespace contactscope::draw
