#include <future>

#include "draw/scene/labels.h"
#include "draw/scene/outlines.h"

namespace contactscope::draw {
namespace {

constexpr float kJoin = 0.25f;            // pixels
constexpr float kAvoided = 1.5f;          // pixels: labels avoid lines of at least this width
constexpr double kLabelHeadingSize = 21;  // pixels at 720 lines
constexpr double kMinHeading = 0.65;      // smallest factor of it, in a narrow view
constexpr double kWholeView = 0.9;        // share of the view's width
constexpr float kMinPiece = 4;  // pixels of a curve: shorter pieces would be mostly line ends

// Marks on the ground behind a body.
constexpr float kFaintGround = 0.2f;  // factor of the opacity
constexpr double kMinSeen = 0.2;      // share of the area; with less visible, it shows through

struct Composer {
  const Sketch& sketch;
  const Camera& camera;
  const Layout& layout;
  Drawing& drawing;
  const HiddenLines& hidden_lines;
  Pen pen{drawing, layout.scale, 0};
  LabelPlacer placer{layout.view};
  std::vector<std::vector<Span>> line_spans{};  // of each line; none if it is not in the view
  std::size_t current = 0;                      // index of the sketch part that is being drawn
  // Ranges of x where the upper and the lower border of the view cut off bodies.
  std::array<std::optional<std::pair<float, float>>, 2> cuts{};

  void run() {
    // Insets are drawn over the view later, so labels keep off them.
    for (const Rect& inset : layout.insets) {
      const double half = 0.5 * inset.height, middle = inset.y + half;
      placer.block(pixel(inset.x + half, middle), pixel(inset.right() - half, middle),
                   static_cast<float>(inset.height));
    }
    std::future<std::vector<Surface>> ordered = order_surfaces();
    for (const Line& line : sketch.lines)
      line_spans.push_back(project_segment(camera, line.from, line.to)
                               ? spans_of(line.from, line.to, line.style)
                               : std::vector<Span>{});
    draw_surfaces(ordered.get());
    each_of(&Sketch::curves, &SketchPart::curves, "line", &Composer::draw_curve);
    each_of(&Sketch::lines, &SketchPart::lines, "line", &Composer::draw_line);
    draw_breaks();
    each_of(&Sketch::marks, &SketchPart::marks, "mark", &Composer::draw_mark_inside);
    each_of(&Sketch::arrows, &SketchPart::arrows, "arrow", &Composer::draw_arrow);
    each_of(&Sketch::marks, &SketchPart::marks, "mark", &Composer::draw_mark_outside);
    draw_heading();
    each_of(&Sketch::labels, &SketchPart::labels, "label", &Composer::draw_label);
  }

  // Assigns the following primitives to a part of the sketch, if it exists.
  void begin(std::size_t part, std::string_view role) {
    if (part < sketch.parts.size())
      drawing.begin(sketch.parts[part].layer, sketch.parts[part].pair, role);
  }

  /// Draws all elements of one kind, each within its part.
  template <class Kind>
  void each_of(std::vector<Kind> Sketch::*kind, std::size_t SketchPart::*begins,
               std::string_view role, void (Composer::*draw)(const Kind&)) {
    const std::vector<Kind>& all = sketch.*kind;
    std::size_t next = 0;  // part
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (i == 0 || (next < sketch.parts.size() && sketch.parts[next].*begins <= i)) {
        while (next < sketch.parts.size() && sketch.parts[next].*begins <= i) ++next;
        current = next - 1;  // none before the first
        begin(current, role);
      }
      (this->*draw)(all[i]);
    }
  }

  // Sorting cuts and reorders surfaces, so each carries the number of its part. Many are sorted on
  // another thread.
  std::future<std::vector<Surface>> order_surfaces() const {
    constexpr std::size_t kMany = 500;
    std::vector<Surface> surfaces;
    std::size_t next = 0;
    for (std::size_t i = 0; i < sketch.surfaces.size(); ++i) {
      if (hidden_lines.hides(sketch.surfaces[i])) continue;
      while (next < sketch.parts.size() && sketch.parts[next].surfaces <= i) ++next;
      surfaces.push_back(sketch.surfaces[i]);
      surfaces.back().part = next - 1;
    }
    const auto policy = surfaces.size() < kMany ? std::launch::deferred : std::launch::async;
    return std::async(policy, [this, all = std::move(surfaces)]() mutable {
      return depth_ordered(std::move(all), camera, sketch.bodies);
    });
  }

  void draw_surfaces(const std::vector<Surface>& surfaces) {
    std::size_t last = sketch.parts.size();
    for (const Surface& surface : surfaces) {
      std::vector<Point2> polygon = project_polygon(camera, surface.polygon);
      if (polygon.empty()) continue;
      if (surface.kind == Surface::Kind::Body) note_cut(polygon);
      if (surface.part != last) begin(surface.part, "surface");
      last = surface.part;
      if (surface.kind == Surface::Kind::Ground)
        draw_ground(polygon, surface.color, {&surface + 1, surfaces.data() + surfaces.size()});
      else
        pen.fill(std::move(polygon), surface.color);
    }
  }

  float border(std::size_t side) const {
    return static_cast<float>(side == 0 ? layout.view.y : layout.view.bottom());
  }

  // Records where the upper or lower border of the view cuts off a body.
  void note_cut(const std::vector<Point2>& polygon) {
    constexpr float kAtBorder = 0.01f;  // pixels
    if (layout.framed) return;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Point2 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
      for (std::size_t side = 0; side < cuts.size(); ++side) {
        const float y = border(side);
        if (std::max(std::abs(p.y - y), std::abs(q.y - y)) > kAtBorder) continue;
        const auto [left, right] = std::minmax(p.x, q.x);
        auto& cut = cuts[side];
        if (!cut) cut.emplace(left, right);
        cut->first = std::min(cut->first, left);
        cut->second = std::max(cut->second, right);
      }
    }
  }

  // Marks cut-off bodies with long dashes, as technical drawings do, except view-filling floors.
  void draw_breaks() {
    constexpr double kMinCut = 12, kDash = 14, kGap = 5;  // pixels
    for (std::size_t side = 0; side < cuts.size(); ++side) {
      const auto& cut = cuts[side];
      if (!cut || cut->second - cut->first < px(kMinCut)) continue;
      if (cut->second - cut->first > kWholeView * layout.view.width) continue;
      drawing.begin(kBreakPart, {}, "line");
      pen.line({cut->first, border(side)}, {cut->second, border(side)}, 1.5,
               with_alpha(kShapeEdge, 0.8f), kDash, kGap);
    }
  }

  float px(double at_720) const { return layout.px(at_720); }

  // Marks on the ground are faint where later surfaces cover them, so that bodies keep their
  // colour. A mark that would be almost invisible shows through the bodies at full strength.
  void draw_ground(const std::vector<Point2>& polygon, const Color& color,
                   std::span<const Surface> later) {
    const std::vector<Outline> bodies = outlines_before(polygon, camera, later);
    const Outline whole = as_outline(polygon);
    std::vector<Outline> seen = {whole};
    for (const Outline& body : bodies) seen = without(seen, body);
    double area = 0;
    for (const Outline& part : seen) area += area_of(part);
    if (bodies.empty() || area < kMinSeen * area_of(whole)) return pen.fill(polygon, color);
    Color faint = color;
    faint.a *= kFaintGround;
    pen.fill(polygon, faint);
    Color rest = color;  // adds up to the full colour over the faint one
    rest.a = (color.a - faint.a) / (1 - faint.a);
    for (const Outline& part : with_shared_corners(seen))
      pen.fill(mapped(part, [](const Vec2d& p) { return pixel(p); }), rest);
  }

  void draw_line(const Line& line) {
    const auto number = static_cast<std::size_t>(&line - sketch.lines.data());
    const std::vector<Span>& spans = line_spans[number];
    if (!spans.empty() && line.keep_clear) {
      const std::optional<Segment2> seen = project_segment(camera, line.from, line.to);
      placer.block(seen->from, seen->to, px(line.style.width + 2));
    }
    const Vec3d offset = line.to - line.from;
    for (const Span& span : spans) {
      draw_span(line.from + span.from * offset, line.from + span.to * offset, span.hidden,
                line.style, 0, false);
    }
  }

  // `run`: pixels of the dash pattern already drawn; `joined`: the span is a piece of a curve.
  void draw_span(const Vec3d& from, const Vec3d& to, bool hidden, const LineStyle& style, float run,
                 bool joined) {
    const std::optional<Segment2> seen = project_segment(camera, from, to);
    if (!seen || (hidden && style.hidden == LineStyle::Hidden::Gone)) return;
    Stroke result{seen->from, seen->to, px(style.width), style.color, Cap::Round};
    result.phase = run;
    if (hidden) {
      result.width = px(1);
      result.color.a *= 0.38f;
      result.dash = px(5);
      result.gap = px(4);
    } else {
      if (style.width >= kAvoided) placer.avoid(*seen);
      if (style.dashed && style.hidden == LineStyle::Hidden::Same) {
        result.dash = px(10);
        result.gap = px(6);
      }
    }
    // Translucent strokes get flat ends, because overlapping round ends would add up.
    if (result.gap > 0 || result.color.a < 1) result.cap = Cap::Butt;
    const float length = distance(seen->from, seen->to);
    if (joined && result.cap == Cap::Round && length > 0) {
      // Pieces of a curve get flat ends too, against beads. They overlap to close the joints.
      result.cap = Cap::Butt;
      const Point2 lap = kJoin / length * (seen->to - seen->from);
      result.from = seen->from - lap;
      result.to = seen->to + lap;
    }
    drawing.primitives.push_back(result);
  }

  std::vector<Span> spans_of(const Vec3d& from, const Vec3d& to, const LineStyle& style) const {
    if (style.hidden == LineStyle::Hidden::Same) return {{0, 1, false}};
    std::vector<Span> spans = hidden_lines.split(from, to);
    // Hides specks where a hidden edge ends at a corner of the occluder.
    if (spans.size() > 1) {
      for (Span& span : spans) {
        const Vec3d offset = to - from;
        if (on_screen(from + span.from * offset, from + span.to * offset) < px(style.width + 1))
          span.hidden = true;
      }
    }
    return spans;
  }

  // Visibility is decided for each piece of the curve, because a longer chord would lie inside the
  // body whose outline it is. Drawn pieces are longer. Dashes are measured on the screen.
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
      if (!project_segment(camera, p, q)) {
        draw();
        continue;
      }
      for (const Span& span : spans_of(p, q, curve.style)) {
        if (any && (span.hidden != hidden || on_screen(from, to) >= kMinPiece)) draw();
        if (!any) from = p + span.from * (q - p);
        to = p + span.to * (q - p);
        hidden = span.hidden;
        any = true;
      }
    }
    draw();
  }

  // Length on the screen, pixels; 0 behind the eye.
  float on_screen(const Vec3d& from, const Vec3d& to) const {
    const std::optional<Segment2> seen = project_segment(camera, from, to);
    return seen ? distance(seen->from, seen->to) : 0;
  }

  // `along`: unit direction of the arrow.
  void head(const Point2& tip, const Point2& along, double size, const Color& color) {
    const Point2 base = tip - px(size) * along;
    const Point2 aside = 0.42f * px(size) * perpendicular(along);
    const std::vector<Point2> corners = {tip, base + aside, base - aside};
    pen.fill(corners, color);
    pen.outline(corners, 1, color);
  }

  // A line between two bars. It extends beyond them if they are close to each other.
  void draw_bars(const Point2& from, const Point2& to, const Arrow& arrow) {
    constexpr double kReach = 7, kTail = 13, kMinLine = 14;  // pixels
    const float length = distance(from, to);
    const Point2 along = (to - from) / length, aside = px(kReach) * perpendicular(along);
    const float tail = length < px(kMinLine) ? px(kTail) : 0;
    const Point2 begin = from - tail * along, end = to + tail * along;
    for (const bool halo : {true, false}) {
      if (halo && !arrow.halo) continue;
      const double width = arrow.width + (halo ? 4 : 0);
      const Color color = halo ? with_alpha(kWhite, 0.85f) : arrow.color;
      pen.line(begin, end, tail > 0 && !halo ? 0.7 * width : width, color);
      for (const Point2& bar : {from, to}) pen.line(bar - aside, bar + aside, width, color);
    }
    placer.block(begin, end, px(arrow.width + 6));
    for (const Point2& bar : {from, to}) placer.block(bar - aside, bar + aside, px(3));
  }

  void draw_arrow(const Arrow& arrow) {
    const Vec3d end =
        arrow.to.value_or(arrow.from + arrow.pixels * layout.scale /
                                           camera.pixels_per_metre(arrow.from) * arrow.direction);
    const std::optional<Point2> a = camera.project(arrow.from);
    std::optional<Point2> b = camera.project(end);
    if (!a || !b || !layout.view.contains(*a)) return;
    if (!layout.view.contains(*b)) {
      const std::optional<Segment2> inside = clip_segment(layout.view, *a, *b);
      if (!inside || (arrow.to && !arrow.may_leave)) return;
      if (arrow.may_leave) return pen.path({*a, inside->to}, arrow.width, arrow.color);
      b = inside->to;  // the length of such an arrow has no meaning
    }
    const float length = distance(*a, *b);
    if (length < px(1)) return;
    const Point2 along = (*b - *a) / length;
    if (arrow.bars) return draw_bars(*a, *b, arrow);
    // Short arrows keep their shape: the heads shrink before the shaft disappears.
    const double size = std::min<double>(arrow.head, arrow.head_share * length / layout.scale);
    const Point2 inset = (arrow.open ? 0 : px(0.9 * size)) * along;
    const Point2 shaft_begin = arrow.double_headed ? *a + inset : *a;
    if (arrow.halo) pen.path({*a, *b}, arrow.width + 4, with_alpha(kWhite, 0.85f));
    pen.line(shaft_begin, *b - inset, arrow.width, arrow.color);
    if (arrow.open) {
      const Point2 back = px(size) / length * (*a - *b);
      for (const float side : {-0.5f, 0.5f})
        pen.path({*b, *b + back + side * perpendicular(back)}, arrow.width, arrow.color);
    } else {
      head(*b, along, size, arrow.color);
    }
    if (arrow.double_headed) head(*a, -1.0f * along, size, arrow.color);
    placer.block(*a, *b, px(arrow.width + 6));
  }

  /// A node on top would hide a short arrow or the head of an arrow; a long arrow would hide it.
  bool is_under_arrow(const Point2& node) const {
    constexpr float kSame = 3, kShort = 24;  // pixels
    return std::ranges::any_of(sketch.arrows, [&](const Arrow& arrow) {
      const std::optional<Point2> from = camera.project(arrow.from);
      if (!from) return false;
      if (!arrow.to) return arrow.pixels < kShort && distance(*from, node) < px(kSame);
      const std::optional<Point2> to = camera.project(*arrow.to);
      return to && (arrow.double_headed || distance(*from, *to) < px(kShort)) &&
             std::min(distance(*from, node), distance(*to, node)) < px(kSame);
    });
  }

  // Below arrows: marks inside a shape, origins, and nodes under short arrows or arrow heads.
  void draw_mark_inside(const Mark& mark) { draw_mark_if(true, mark); }
  void draw_mark_outside(const Mark& mark) { draw_mark_if(false, mark); }
  void draw_mark_if(bool inside, const Mark& mark) {
    const std::optional<Point2> at = camera.project(mark.at);
    if (!at || !layout.view.contains(*at)) return;
    const bool is_inside = mark.kind == MarkKind::Core || mark.kind == MarkKind::Origin ||
                           mark.kind == MarkKind::HeldOrigin ||
                           (mark.kind == MarkKind::Node && is_under_arrow(*at));
    if (is_inside != inside) return;
    const float reach = draw_mark(mark.kind, *at, mark.color, pen, mark.size);
    if (reach > 0) placer.block(*at, reach);
  }

  // The heading has a fixed place, so that readers can page through the steps.
  void draw_heading() {
    if (sketch.heading.empty()) return;
    drawing.begin("heading", {}, "label");
    const float width = static_cast<float>(layout.view.width);
    // In a narrow view the heading shrinks before it is shortened.
    const float natural =
        text_width(pen.said(sketch.heading).text, px(kLabelHeadingSize), Weight::Bold);
    const double shrunk = kLabelHeadingSize * std::clamp<double>(width / natural, kMinHeading, 1);
    const float size = px(shrunk);
    const Said text = pen.fitted(sketch.heading, Weight::Bold, width, shrunk);
    const Point2 at = pixel(layout.view.x, layout.view.y + 0.8 * size);
    pen.text(text, at, Align::Left, kText, Weight::Bold, shrunk, 3);
    const Point2 middle{at.x, at.y - 0.3f * size};
    placer.block(middle, {middle.x + text_width(text.text, size, Weight::Bold), middle.y}, size);
  }

  Point2 wanted_direction(const Label& label, const Point2& at) const {
    Vec3d towards = sketch.center;
    if (label.direction)
      towards = label.at + 20 / camera.pixels_per_metre(label.at) * *label.direction;
    const std::optional<Point2> other = camera.project(towards);
    if (!other) return {0, -1};
    const Point2 offset = label.direction ? *other - at : at - *other;
    const float reach = length(offset);
    return reach < 1 ? Point2{0, -1} : offset / reach;
  }

  // Thin and grey, so that a leader is not mistaken for part of the scene.
  void draw_leader(const Point2& at, const Point2& end, bool foot) {
    constexpr double kClear = 4, kFoot = 2.4;  // pixels
    const float length = distance(at, end);
    if (length <= px(2 * kClear)) return;
    const Point2 begin = foot ? at : at + px(kClear) / length * (end - at);
    pen.line(begin, end, 3.5, with_alpha(kWhite, 0.8f));
    pen.line(begin, end, 1, kQuietText);
    if (foot) pen.disc(at, kFoot, kQuietText);
    placer.block(begin, end, px(2));
  }

  void draw_label(const Label& label) {
    const std::optional<Point2> at = camera.project(label.at);
    if (!at || !layout.view.contains(*at)) return;
    const float size = px(label.size);
    const Weight weight = label.bold ? Weight::Bold : Weight::Regular;
    const float up = 0.76f * ascent(size, weight);  // height of capitals and digits
    const Said text = pen.said(label.text);
    if (text.text.empty()) return;
    const bool has_badge = label.badge != Badge::None;
    const float width = text_width(text.text, size, weight);
    const bool diamond = label.badge == Badge::Support;
    const float room = !has_badge ? 0
                       : diamond  ? std::max(2 * kBadgeRoom * up, 0.35f * width + kBadgeRoom * up)
                                  : kBadgeRoom * up;
    std::optional<LabelPlacer::Place> place =
        placer.place(*at, width + 2 * room, up + room, has_badge ? room : descent(size, weight),
                     {px(label.clearance), wanted_direction(label, *at),
                      label.direction.has_value(), label.leader});
    if (!place) return;
    place->left_baseline.x += room;
    const Vec2d corner = flat(place->left_baseline);
    const Eigen::AlignedBox2d box(corner - Vec2d(0, up), corner + Vec2d(width, 0));
    if ((place->needs_leader || label.leader) && !lies_on(label.ground, box))
      draw_leader(*at, place->leader_end, label.foot);
    draw_badge(label.badge, place->left_baseline + Point2{0.5f * width, -0.5f * up}, width, up,
               label.color, pen);
    Callout callout{drawing.primitives.size(), *at};
    if (current < sketch.parts.size()) {
      callout.layer = sketch.parts[current].layer;
      callout.pair = sketch.parts[current].pair;
    }
    drawing.callouts.push_back(std::move(callout));
    pen.text(text, place->left_baseline, Align::Left, label.color, weight, label.size,
             has_badge ? 0 : 2.5);
  }
};

}  // namespace

const HiddenLines& hidden_lines_of(const Sketch& sketch, const Camera& camera) {
  if (!sketch.hidden_lines ||
      !sketch.hidden_lines->is_for(camera, {sketch.occluders.size(), sketch.shadows.size()}))
    sketch.hidden_lines = std::make_shared<HiddenLines>(camera, sketch.occluders, sketch.shadows);
  return *sketch.hidden_lines;
}

void compose(const Sketch& sketch, const Camera& camera, const Layout& layout, Drawing& drawing) {
  Composer{sketch, camera, layout, drawing, hidden_lines_of(sketch, camera)}.run();
}

}  // namespace contactscope::draw
