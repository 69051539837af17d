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
    draw_marks(true);
    for (const Arrow& arrow : sketch_.arrows) draw_arrow(arrow);
    draw_marks(false);
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
    const float run = distance(seen->from, seen->to);
    if (joined && result.cap == Cap::Round && run > 0) {
      // So do pieces of a curve: round ends would bead it. They overlap by what two flat ends lack.
      result.cap = Cap::Butt;
      const Point2 lap = kJoin / run * (seen->to - seen->from);
      result.from = seen->from - lap;
      result.to = seen->to + lap;
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
    const float run = distance(from, tip);
    if (run <= 0) return;
    const Point2 along = (tip - from) / run;
    const Point2 base = tip - px(size) * along;
    const Point2 aside = 0.42f * px(size) * perpendicular(along);
    const std::vector<Point2> corners = {tip, base + aside, base - aside};
    pen_.fill(corners, color);
    pen_.outline(corners, 1, color);
  }

  void open_head(const Point2& tip, const Point2& from, double size, float width,
                 const Color& color) {
    const float run = distance(from, tip);
    if (run <= 0) return;
    const Point2 back = px(size) / run * (from - tip);
    for (const float side : {-0.5f, 0.5f})
      pen_.path({tip, tip + back + side * perpendicular(back)}, width, color);
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
    const Point2 inset = (arrow.open ? 0 : px(0.9 * size)) * ((*b - *a) / length);
    const Point2 shaft_begin = arrow.double_headed ? *a + inset : *a;
    if (arrow.halo) pen_.path({*a, *b}, arrow.width + 4, with_alpha(kWhite, 0.85f));
    pen_.line(shaft_begin, *b - inset, arrow.width, arrow.color);
    if (arrow.open) {
      open_head(*b, *a, size, arrow.width, arrow.color);
    } else {
      head(*b, *a, size, arrow.color);
    }
    if (arrow.double_headed) head(*a, *b, size, arrow.color);
    placer_.block(*a, *b, px(arrow.width + 6));
  }

  // What is inside of a shape stays under what is said about it. So does an origin under the arrow
  // that begins there, which may be no longer than it.
  void draw_marks(bool inside) {
    for (const Mark& mark : sketch_.marks) {
      const bool is_inside = mark.kind == MarkKind::Core || mark.kind == MarkKind::Origin ||
                             mark.kind == MarkKind::HeldOrigin;
      const std::optional<Point2> at = camera_.project(mark.at);
      if (is_inside != inside || !at || !layout_.view.contains(*at)) continue;
      const float reach = draw_mark(mark.kind, *at, mark.color, pen_);
      if (reach > 0) placer_.block(*at, reach);
    }
  }

  Point2 wanted_direction(const Label& label, const Point2& at) const {
    Vec3d towards = sketch_.center;
    if (label.direction)
      towards = label.at + 20 / camera_.pixels_per_metre(label.at) * *label.direction;
    const std::optional<Point2> other = camera_.project(towards);
    if (!other) return {0, -1};
    const Point2 way = label.direction ? *other - at : at - *other;
    const float reach = length(way);
    return reach < 1 ? Point2{0, -1} : way / reach;
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
