#include "draw/viewports.h"

#include "draw/scene/pairs.h"
#include "draw/scene/points.h"

namespace contactscope::draw {
namespace {

// Pixels at 720 lines.
constexpr double kViewportHeading = 17, kViewportHeadingRow = 28, kViewportGap = 12;
constexpr double kWantedAspect = 1.25;

// Pixels at 720 lines.
constexpr double kLargeEnough = 20;  // larger subjects need no magnifier
constexpr double kMinSubject = 0.002;
constexpr double kMagnified = 105;         // of the subject, in the smallest magnifier
constexpr double kMagnifierHeight = 0.3;   // share of the view's height, for the smallest magnifier
constexpr double kMagnifierAspect = 1.25;  // width to height
// Magnifiers are larger by these factors if a corner of the view has free space.
constexpr std::array<double, 4> kLarger = {1.7, 1.5, 1.3, 1.0};
constexpr double kMagnifierText = 15;

// The subject of the picture: contact points of a pair, or the two ends of a distance.
std::vector<Vec3d> subject_of(const View& view, const trace::Frame& frame) {
  std::vector<Vec3d> points;
  for (const trace::Pair& pair : frame.pairs) {
    if (pair.manifolds.size() > 1) return {};
    if (const std::vector<Vec3d> own = positions_of(pair); own.size() > 1) append(points, own);
    if (pair.sat && pair.sat->edge && pair.sat->chosen == "edge_edge" &&
        (view.shows(Layer::ContactAxis) || view.shows(Layer::SatAxes)))
      append(points, std::array{pair.sat->edge->point_a, pair.sat->edge->point_b});
    if (pair.query && pair.query->point_a && pair.query->point_b && view.shows(Layer::Answer))
      append(points, std::array{*pair.query->point_a, *pair.query->point_b});
  }
  return points;
}

/// Largest distance between two points on the screen, canvas pixels.
double seen_size(const std::vector<Vec3d>& points, const Camera& camera) {
  double largest = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      const auto seen = seen_distance(camera, points[i], points[j]);
      largest = std::max<double>(largest, seen.value_or(0));
    }
  }
  return largest;
}

/// If the magnifier has room, two arrows that measure from outside become one between their tips.
void measure_within(const Camera& near, Sketch& sketch) {
  const auto comes_in = [&](const Arrow& arrow) {
    return arrow.to && !arrow.bars && !arrow.may_leave && near.sees(*arrow.to) &&
           !near.sees(arrow.from);
  };
  std::vector<Arrow*> narrow;
  for (Arrow& arrow : sketch.arrows)
    if (comes_in(arrow)) narrow.push_back(&arrow);
  if (narrow.size() != 2) return;
  Arrow &one = *narrow[0], &other = *narrow[1];
  one.from = *one.to;
  one.to = *other.to;
  one.double_headed = true;
  other.to = other.from;  // zero length: not drawn
}

/// A part of the view for each of several viewports, in rows.
Rect cell_of(std::size_t i, std::size_t count, const Layout& layout) {
  const double gap = layout.px(kViewportGap);
  std::size_t columns = count;
  double best = 1e300;
  for (std::size_t wide = 1; wide <= count; ++wide) {
    const std::size_t high = (count + wide - 1) / wide;
    const double width = layout.view.width / static_cast<double>(wide);
    const double height = layout.view.height / static_cast<double>(high);
    const double off = std::abs(std::log(width / height / kWantedAspect)) +
                       0.3 * static_cast<double>(wide * high - count);
    if (off >= best) continue;
    best = off;
    columns = wide;
  }
  const std::size_t rows = (count + columns - 1) / columns;
  return layout.view.cell(i, columns, rows, gap, gap);
}

std::string label_with_steps(const trace::Pair& pair) {
  return pair.label + ": " + counted(static_cast<std::size_t>(pair.gjk->iterations), "step");
}

/// The name of a stage, and its result in this frame.
std::string stage_heading(Layer layer, const trace::Frame& frame) {
  std::size_t touching = 0, points = 0;
  std::vector<std::string> steps;  // of GJK
  for (const trace::Pair& pair : frame.pairs) {
    if (pair.gjk && !pair.label.empty()) steps.push_back(label_with_steps(pair));
    touching += !pair.manifolds.empty();
    points += all_points(pair).size();
  }
  const std::size_t shapes = frame.poses.size();
  if (layer == Layer::Bounds) return "bounds: a box around each shape";
  if (layer == Layer::CandidatePairs)
    return "broad phase: candidates, the boxes of " + std::to_string(frame.pairs.size()) + " of " +
           std::to_string(shapes * (shapes - 1) / 2) + " pairs overlap";
  if (layer == Layer::Contacts)
    return "narrow phase: contacts, " + counted(touching, "pair touches", "pairs touch") + " at " +
           counted(points, "point", "points");
  if (layer == Layer::Impulses) return "solver: an impulse at each point";
  if (layer == Layer::Simplex) return "simplex: " + separated(steps, "; ");
  return in_words(name_of(layer));
}

}  // namespace

bool shows_pair(const PairViewport& viewport, const trace::Pair& pair) {
  return pair.a == viewport.a && pair.b == viewport.b && pair.label == viewport.label;
}

std::vector<PairViewport> split_view(const std::vector<trace::Frame>& frames,
                                     const Layout& layout) {
  std::vector<const trace::Pair*> pairs =
      distinct_pairs(frames, [](const trace::Pair&) { return true; });
  // An unlabelled pair next to labelled ones is not part of the comparison.
  const auto has_no_label = [](const trace::Pair* pair) { return pair->label.empty(); };
  if (!std::ranges::all_of(pairs, has_no_label)) std::erase_if(pairs, has_no_label);
  const std::size_t count = pairs.size();
  if (count < 2 || count > kMaxViewports) return {};
  std::vector<PairViewport> viewports;
  for (std::size_t i = 0; i < count; ++i)
    viewports.push_back({pairs[i]->a, pairs[i]->b, pairs[i]->label, cell_of(i, count, layout),
                         pair_name(*pairs[i])});
  return viewports;
}

std::vector<PairViewport> split_stages(const View& view, const Layout& layout) {
  std::vector<Layer> stages = view.layers;  // in the view's order
  std::erase(stages, Layer::Shapes);
  if (stages.size() < 2 || stages.size() > kMaxViewports) return {};
  std::vector<PairViewport> viewports;
  for (const Layer layer : stages) {
    View own = view;
    own.layers = {layer};
    if (view.shows(Layer::Shapes)) own.layers.insert(own.layers.begin(), Layer::Shapes);
    PairViewport& viewport = viewports.emplace_back();
    viewport.frame = cell_of(viewports.size() - 1, stages.size(), layout);
    viewport.heading = std::to_string(viewports.size()) + "  ";
    viewport.view = std::move(own);
  }
  return viewports;
}

Rect inside_of(const PairViewport& viewport, const Layout& layout) {
  const double row = layout.px(kViewportHeadingRow);
  const Rect& frame = viewport.frame;
  return {frame.x + 1, frame.y + row, frame.width - 2, frame.height - row - 1};
}

trace::Frame part_of(const trace::Frame& frame, const PairViewport& viewport) {
  const auto has = [&](const std::string& name) {
    return name == viewport.a || name == viewport.b;
  };
  if (viewport.view) return frame;
  trace::Frame part;
  part.frame = frame.frame;
  part.time = frame.time;
  for (const trace::Placement& pose : frame.poses)
    if (has(pose.first)) part.poses.push_back(pose);
  for (const trace::Pair& pair : frame.pairs) {
    if (!shows_pair(viewport, pair)) continue;
    part.pairs.push_back(pair);
    part.pairs.back().label.clear();  // the viewport's heading contains it
  }
  for (const trace::Deformed& deformed : frame.deformed)
    if (has(deformed.name)) part.deformed.push_back(deformed);
  for (const trace::FieldSlice& slice : frame.field_slices)
    if (has(slice.name)) part.field_slices.push_back(slice);
  if (frame.solver) {
    part.solver = frame.solver;
    std::erase_if(part.solver->bodies, [&](const trace::Body& body) { return !has(body.name); });
  }
  return part;
}

void draw_viewport_frame(const PairViewport& viewport, const View& view, const trace::Frame& frame,
                         const Layout& layout, Drawing& drawing) {
  const auto pair = std::ranges::find_if(frame.pairs, [&](const trace::Pair& each) {
    return shows_pair(viewport, each) && !each.label.empty();
  });
  const bool found = pair != frame.pairs.end();
  const bool answers = found && pair->query && !pair->query->bounds.empty();
  const bool steps = found && pair->gjk && view.shows(Layer::Simplex);
  const Pen pen(drawing, layout.scale, kViewportHeading);
  pen.frame(viewport.frame, 1, with_alpha(kQuietText, 0.5f));
  const float padding = pen.px(8), size = pen.px(kViewportHeading);
  const std::string number = viewport.view ? viewport.heading : "";
  Said heading = pen.fitted(answers         ? label_with_answer(*pair)
                            : viewport.view ? stage_heading(viewport.view->layers.back(), frame)
                            : steps         ? label_with_steps(*pair)
                                            : viewport.heading,
                            Weight::Bold,
                            static_cast<float>(viewport.frame.width) - 2 * padding -
                                text_width(number, size, Weight::Bold),
                            kViewportHeading);
  heading.text = number + heading.text;
  pen.text(heading,
           pixel(viewport.frame.x + padding, viewport.frame.y + 0.5 * padding + 0.9 * size),
           Align::Left, kText, Weight::Bold);
}

std::optional<Vec3d> magnified_middle(const View& view, const trace::Frame& frame) {
  const std::vector<Vec3d> points = subject_of(view, frame);
  return points.empty() ? std::nullopt : std::optional(center_of(points));
}

std::optional<Magnifier> stage_magnifier(const View& view, const Camera& camera,
                                         const Layout& layout,
                                         const std::vector<trace::Frame>& frames,
                                         const std::vector<Vec3d>& shapes) {
  if (!view.inset || frames.empty()) return std::nullopt;
  double largest = 0;
  std::vector<Vec3d> middles;
  for (const trace::Frame& frame : frames) {
    const std::vector<Vec3d> points = subject_of(view, frame);
    if (points.empty()) continue;
    if (points.size() > 64) return std::nullopt;  // too many for one subject
    largest = std::max(largest, seen_size(points, camera));
    if (largest >= kLargeEnough * layout.scale) return std::nullopt;
    middles.push_back(center_of(points));
  }
  if (middles.empty() || largest < kMinSubject * layout.scale) return std::nullopt;
  const Rect& view_rect = layout.view;
  const std::optional<Point2> subject = camera.project(mean_of(middles));
  if (!subject || !view_rect.contains(*subject)) return std::nullopt;
  std::vector<Point2> seen;
  for (const Vec3d& p : shapes)
    if (const std::optional<Point2> at = camera.project(p)) seen.push_back(*at);
  Eigen::AlignedBox2d around;
  for (const Point2& p : seen) around.extend(Vec2d(p.x, p.y));
  const Rect taken{around.min().x(), around.min().y(), around.sizes().x(), around.sizes().y()};
  for (const double larger : kLarger) {
    const double height = larger * kMagnifierHeight * view_rect.height;
    const double width = kMagnifierAspect * height;
    // The corner that covers the fewest shape points and is farthest from the subject, right if
    // equal.
    Magnifier magnifier{{}, round_down(larger * kMagnified * layout.scale / largest)};
    double farthest = -1;
    for (const bool right : {true, false}) {
      for (const bool low : {true, false}) {
        const Rect frame{right ? view_rect.right() - width - 2 : view_rect.x + 2,
                         low ? view_rect.bottom() - height - 2 : view_rect.y + 2, width, height};
        const Point2 center = pixel(frame.x + 0.5 * width, frame.y + 0.5 * height);
        if (frame.contains(*subject) || (larger > 1 && frame.overlaps(taken))) continue;
        const auto covers = [&](const Point2& p) { return frame.contains(p); };
        const double covered = static_cast<double>(std::ranges::count_if(seen, covers)) /
                               std::max(1.0, static_cast<double>(seen.size()));
        const double away = distance(center, *subject) * (1 - std::min(0.9, 4 * covered));
        if (away <= farthest + 1) continue;
        farthest = away;
        magnifier.frame = frame;
      }
    }
    if (farthest >= 0 && magnifier.factor >= 2) return magnifier;
  }
  return std::nullopt;
}

SequenceScales scales_within(const Magnifier& magnifier, const SequenceScales& scales) {
  SequenceScales within = scales;
  for (double* factor : {&within.overlap, &within.gap})
    *factor = std::max(std::min(1.0, *factor), round_down(*factor / magnifier.factor));
  return within;
}

void draw_magnified(const Magnifier& magnifier, const Vec3d& middle, Sketch sketch,
                    const std::string& note, const Camera& camera, const Layout& layout,
                    Drawing& drawing) {
  const std::optional<Point2> at = camera.project(middle);
  if (!at) return;
  const Rect& frame = magnifier.frame;
  const Pen pen(drawing, layout.scale, kMagnifierText);
  // Frame of the source: the size of the magnified area, but large enough to be visible.
  const double half = std::max<double>(0.5 * frame.height / magnifier.factor, pen.px(7));
  const Rect source{at->x - kMagnifierAspect * half, at->y - half, 2 * kMagnifierAspect * half,
                    2 * half};
  const Color border = with_alpha(kText, 0.75f);
  const Point2 end = frame.nearest(*at), begin = source.nearest(end);
  pen.line(begin, end, 1.2, border);
  pen.frame(source, 1.5, border);
  pen.fill(frame, kWhite);
  Layout inner = layout;
  inner.view = frame;
  inner.framed = true;
  const double pixels = camera.pixels_per_metre(middle) * magnifier.factor;
  const Vec3d back = camera.to_eye(middle);
  const double away = (camera.eye() - middle).norm();
  const Camera near =
      Camera::orthographic(middle + away * back, middle, camera.up(), frame.height / pixels, frame);
  measure_within(near, sketch);
  compose(sketch, near, inner, drawing);
  pen.frame(frame, 1.5, border);
  // Large factors are round, so print their zeros rather than a power of ten.
  const std::string factor = magnifier.factor < 1e4
                                 ? spell_number(magnifier.factor)
                                 : std::to_string(std::llround(magnifier.factor));
  const std::string words = "×" + factor + note;
  pen.text(words, pixel(frame.x, frame.bottom()) + Point2{pen.px(7), -pen.px(7)}, Align::Left,
           kText, Weight::Bold, 0, 3);
}

}  // namespace contactscope::draw
