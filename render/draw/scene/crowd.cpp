#include "draw/scene/labels.h"
#include "draw/scene/outlines.h"
#include "draw/scene/pairs.h"
#include "draw/scene/points.h"
#include "draw/scene/solid.h"

namespace contactscope::draw {
namespace {

constexpr std::size_t kNumbered = 5;                // as the panel `worst` lists
constexpr float kMinSize = 0.55f, kMaxSize = 2.0f;  // factors of a speck's radius
constexpr float kNormalLength = 46;                 // pixels
constexpr LineStyle kMarkedOutline{2.6f, kContact};

constexpr Swatch kSpeckSwatch{LegendGroup::Points, 3, [](auto& pen) { pen.dot(0, 2.4, kContact); }};
constexpr Swatch kSizedSwatch{LegendGroup::Points, 3, [](auto& pen) { pen.dot(0, 4, kContact); }};

/// Whether a picture is about some shapes, and this is none of them.
bool is_out_of_focus(const Scene& scene, const std::string& name) {
  const std::vector<std::string>& names = scene.view.focus_on;
  return !names.empty() && std::ranges::find(names, name) == names.end();
}

bool is_much_larger(const Scene& scene, const PlacedShape& shape) {
  constexpr double kMuchLarger = 4;
  return !(shape.mesh->radius < kMuchLarger * scene.meshes.smallest_radius());
}

/// Moves a label off all bodies, if it would cover some wherever it is next to its place: above them,
/// or to the nearest place in a diagonal direction if an edge of the ground is above them.
void put_off_bodies(const Scene& scene, Label& label) {
  constexpr double kGap = 12, kStep = 4;  // pixels
  const std::optional<Point2> from = scene.camera.project(label.at);
  if (!from) return;
  const double pixel = scene.scales.pixel;
  const Vec2d at(from->x, from->y);
  const Vec2d half(
      0.5 * text_width(label.text, static_cast<float>(pixel) * label.size, FontWeight::Bold),
      0.6 * pixel * label.size);
  const Rect& view = scene.camera.viewport();
  std::vector<Outline> outlines, large;
  double top = at.y();
  for (const PlacedShape& shape : scene.shapes) {
    if (shape.mesh->patch)
      large.push_back(outline_around(scene.camera, patch_corners(*shape.mesh->patch, shape.pose)));
    if (shape.traced().half_space || is_out_of_focus(scene, shape.traced().name)) continue;
    const Outline outline = outline_around(scene.camera, extent_points(shape));
    Eigen::AlignedBox2d box;
    for (const Vec2d& corner : outline) box.extend(corner);
    if (!box.isEmpty() && std::abs(box.center().x() - at.x()) < 0.5 * box.sizes().x() + half.x())
      top = std::min(top, box.min().y());
    if (!box.isEmpty()) (is_much_larger(scene, shape) ? large : outlines).push_back(outline);
  }
  const auto is_free = [&](const Vec2d& center, const Vec2d& gap) {
    const Eigen::AlignedBox2d box(center - half - gap, center + half + gap);
    const auto crosses = [&](const Outline& outline) {
      return overlap(outline, box) && !lies_on(outline, box);
    };
    return box.min().x() > view.x && box.max().x() < view.right() && box.min().y() > view.y &&
           box.max().y() < view.bottom() &&
           std::ranges::none_of(outlines, [&](auto& outline) { return overlap(outline, box); }) &&
           (gap.isZero() || std::ranges::none_of(large, crosses));
  };
  for (const Vec2d& out : {Vec2d(1, 0), Vec2d(-1, 0)})  // above is the arrow
    if (is_free(at + label.clearance * pixel * out + out.cwiseProduct(half), Vec2d::Zero())) return;
  const Vec2d gap = Vec2d::Constant(kGap * pixel), above(at.x(), top - gap.y() - half.y());
  if (!is_free(above, 0.9 * gap)) {
    for (double ring = label.clearance; ring * pixel < view.height; ring += kStep) {
      for (const Vec2d& diagonal : {Vec2d(-1, -1), Vec2d(1, -1), Vec2d(-1, 1), Vec2d(1, 1)}) {
        if (!is_free(LabelPlacer::middle_of(*from, diagonal.normalized(), 2 * half.x(),
                                            2 * half.y(), ring * pixel),
                     gap))
          continue;
        label.clearance = ring;
        label.direction = diagonal.x() * scene.camera.right() - diagonal.y() * scene.camera.up();
        return;
      }
    }
  }
  if (above.y() - half.y() > view.y) label.clearance = (at.y() - top) / pixel + kGap;
}

/// The point that lint's first finding is about, if it is one of this pair; else the deepest.
std::optional<PairPoint> subject_of(const Scene& scene, const trace::Pair& pair) {
  const Fault::Place* const fault = scene.view.first_fault();
  const std::vector<PairPoint> points = all_points(pair);
  if (fault == nullptr || !fault->at || fault->frame != scene.frame.frame || points.empty() ||
      std::minmax(fault->a, fault->b) != std::minmax(pair.a, pair.b))
    return deepest_contact(pair);
  return *std::ranges::min_element(points, {}, [&](const PairPoint& any) {
    return (any.point->position - *fault->at).squaredNorm();
  });
}

void mark_pair(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const std::optional<PairPoint> at = subject_of(scene, pair);
  if (!at) return;
  const Vec3d& place = at->point->position;
  for (const std::string* name : {&pair.a, &pair.b}) {
    const PlacedShape* shape = scene.find(*name);
    if (shape != nullptr && !shape->traced().half_space && !is_much_larger(scene, *shape))
      draw_ghost(scene.camera, *shape, kMarkedOutline, sketch);
  }
  sketch.mark(MarkKind::Speck, place, kContact, kMaxSize);
  sketch.mark(MarkKind::WideRing, place, kContact);
  if (scene.shows(Layer::Normals)) {
    sketch.arrow(place, at->manifold->normal, kNormalLength, 3, 12, kNormal);
    sketch.explain(kNormalSwatch, "normal, from A to B", place);
  }
  Label& label = sketch.label(
      place,
      spell_separation(at->point->separation, scene.noise(pair), scene.scales.length) +
          (at->point == deepest_contact(pair)->point ? ": " : " here: ") + pair_name(pair),
      kContact, 17, 34, Vec3d(scene.camera.up()));
  put_off_bodies(scene, label);
  label.leader = true;
}

/// Numbers of the pairs in the panel `worst`.
void number_pairs(const Scene& scene, const trace::Pair* marked, Sketch& sketch) {
  if (!scene.view.shows(Panel::Worst) || !scene.view.focus_on.empty()) return;
  const std::vector<RankedPair> ranked =
      ranked_pairs(scene.frame, Rank::Overlap, kNumbered, scene.meshes);
  for (std::size_t i = 0; i < ranked.size(); ++i) {
    if (ranked[i].pair == marked) continue;
    const std::optional<PairPoint> at = deepest_contact(*ranked[i].pair);
    sketch.begin(name_of(Layer::Contacts), ranked[i].pair->a + " " + ranked[i].pair->b);
    sketch.label(at->point->position, std::to_string(i + 1), kText, 16, 8);
  }
}

/// Whether a picture of a condition leaves this pair out.
bool is_left_out(const Scene& scene, const trace::Pair& pair) {
  const auto& faults = scene.view.faults;
  const auto condition = std::ranges::find_if(faults, &Fault::is_condition);
  return condition != faults.end() &&
         std::ranges::none_of(condition->places, [&](const Fault::Place& place) {
           return place.frame == scene.frame.frame && place.a == pair.a && place.b == pair.b;
         });
}

/// Whether lint names a shape next to the arrow of its step.
bool flies_off(const Scene& scene, const std::string& name) {
  return std::ranges::any_of(scene.view.faults, [&](const Fault& fault) {
    return std::ranges::any_of(fault.places, [&](const Fault::Place& place) {
      return place.path && place.a == name && place.frame == scene.frame.frame;
    });
  });
}

/// The pair that stands out in a frame; nullptr if none overlaps.
const trace::Pair* marked_pair(const Scene& scene) {
  const std::vector<std::string>& names = scene.view.focus_on;
  if (names.size() == 2) {
    for (const trace::Pair& pair : scene.frame.pairs)
      if ((pair.a == names[0] && pair.b == names[1]) || (pair.a == names[1] && pair.b == names[0]))
        return &pair;
    return nullptr;
  }
  const auto ranked =
      ranked_pairs(scene.frame, Rank::Overlap, scene.frame.pairs.size(), scene.meshes);
  const auto first = std::ranges::find_if(
      ranked, [&](const RankedPair& one) { return !is_left_out(scene, *one.pair); });
  return first == ranked.end() || first->value <= scene.scales.touching ? nullptr : first->pair;
}

}  // namespace

void draw_crowd(const Scene& scene, Sketch& sketch) {
  constexpr double kWithin = 6;    // pixels
  constexpr float kBehind = 0.4f;  // alpha
  const bool sized = scene.scales.heap;
  const trace::Pair* const marked = sized ? marked_pair(scene) : nullptr;
  double deepest = 0;  // metres
  for (const trace::Pair& pair : scene.frame.pairs) deepest = std::max(deepest, overlap_of(pair));
  const auto size_of = [&](const trace::Point& point) {
    if (!sized) return 1.0f;
    const double share = deepest > 0 ? std::max(0.0, -point.separation / deepest) : 0;
    return std::max(kMinSize, kMaxSize * static_cast<float>(std::sqrt(share)));
  };
  // Specks of points behind bodies would seem to be in front of them. A contact point is inside
  // both bodies, so a point just behind their surface counts as visible.
  const HiddenLines& bodies = hidden_lines_of(sketch, scene.camera);
  const auto is_behind = [&](const Vec3d& at) {
    const double metres = kWithin * scene.scales.pixel / scene.camera.pixels_per_metre(at);
    const Vec3d before = at + metres * scene.camera.to_eye(at).normalized();
    return bodies.split(before, before).front().hidden;
  };
  for (const trace::Pair& pair : scene.frame.pairs) {
    if (pair.manifolds.empty() || is_left_out(scene, pair)) continue;
    const bool is_other = is_out_of_focus(scene, pair.a) && is_out_of_focus(scene, pair.b);
    sketch.begin(name_of(Layer::Contacts), pair.a + " " + pair.b);
    for (const PairPoint& kept : kept_points(pair)) {
      const Vec3d& at = kept.point->position;
      const float size = size_of(*kept.point);
      const bool behind = is_behind(at) || is_other;
      if (behind)
        sketch.mark(MarkKind::Core, at, with_alpha(kContact, kBehind), size);
      else
        sketch.mark(MarkKind::Speck, at, kContact, size);
      if (sized)
        sketch.explain(kSizedSwatch, "contact point, area = overlap, pale behind a body");
      else
        sketch.explain(kSpeckSwatch,
                       behind ? "contact point, pale behind a body" : "contact point");
    }
  }
  // The label of the marked pair names it too, but not which of the two is A.
  for (const std::string& name : scene.view.focus_on) {
    const bool is_marked = marked != nullptr && (name == marked->a || name == marked->b);
    const PlacedShape* const shape = scene.find(name);
    if (shape == nullptr || shape->vertices.empty() || flies_off(scene, name)) continue;
    if (is_marked && (!scene.shows(Layer::Normals) || is_much_larger(scene, *shape))) continue;
    const std::string role = !is_marked ? "" : name == marked->a ? "A: " : "B: ";
    sketch.begin(name_of(Layer::Names), name);
    sketch.label(center_of(shape->vertices), role + name_in_words(name), kText, 16, 0);
  }
  if (!sized) return;
  number_pairs(scene, marked, sketch);
  if (marked == nullptr) return;
  sketch.begin(name_of(Layer::Contacts), marked->a + " " + marked->b);
  mark_pair(scene, *marked, sketch);
}

}  // namespace contactscope::draw
