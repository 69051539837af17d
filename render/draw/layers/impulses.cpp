#include "draw/layers/layer.h"
#include "draw/scene/pairs.h"

/// Gregorius 2015, "Recap: Solving Contact": impulses of the solver at each point in the step that
/// follows. Layers Loads and Friction modify how this layer draws them.
namespace contactscope::draw {
namespace {

constexpr double kMinImpulse = 3;           // pixels
constexpr double kMinFriction = 10;         // pixels: shorter open heads are not legible
constexpr double kMinOfFriction = 0.35;     // share of the largest, to show only relevant friction
constexpr std::size_t kLabelledPoints = 8;  // points: more numbers would crowd the picture

// The colour of friction is too light for text on white; the same hue, darkened.
constexpr Color kFrictionText = rgb(0x8F4B3E);

constexpr Swatch kPushedSwatch{LegendGroup::Points, 3,
                               [](auto& pen) { pen.dot(0, 4.0, kContact); }};
constexpr Swatch kNormalImpulseSwatch{LegendGroup::Forces, 1,
                                      [](auto& pen) { pen.arrow(3, 10, kImpulse); }};
// The warm start is a wide pale bar below the arrow; a frame would close up in small pictures.
constexpr Color kKept = rgb(0xEDB5BB);
constexpr float kKeptWidth = 14;  // pixels
constexpr Swatch kWarmStartSwatch{LegendGroup::Forces, 2,
                                  [](auto& pen) { pen.level_line(0, 22, 13, kKept); }};
constexpr Swatch kFrictionSwatch{LegendGroup::Forces, 3,
                                 [](auto& pen) { pen.open_arrow(2.5, kFriction); }};
// Two strokes across a line that continues.
constexpr Swatch kBreakSwatch{LegendGroup::Forces, 4, [](auto& pen) {
                                pen.level_line(0, 8.5, 3, kImpulse);
                                pen.level_line(14, 22, 3, kImpulse);
                                for (const double at : {9.0, 13.0}) {
                                  const Point2 middle = pen.at(at);
                                  const float rise = pen.px(6), lean = pen.px(2);
                                  pen.line({middle.x - lean, middle.y + rise},
                                           {middle.x + lean, middle.y - rise}, 1.8, kImpulse);
                                }
                              }};

// Two strokes across an arrow that continues.
void draw_break(const Scene& scene, const Vec3d& at, const Vec3d& along, const Color& color,
                Sketch& sketch) {
  const Vec3d across = along.cross(scene.camera.to_eye(at));
  if (!(across.norm() > 0)) return;
  const double pixel = 1 / scene.camera.pixels_per_metre(at);
  const Vec3d slanted = pixel * (6 * across.normalized() + 3 * along);
  for (const double shift : {-2.5, 2.5}) {
    const Vec3d middle = at + shift * pixel * along;
    sketch.line(middle - slanted, middle + slanted, {5.0f, kWhite});
    sketch.line(middle - slanted, middle + slanted, {2.0f, color});
  }
}

bool shows_loads(const Scene& scene) { return scene.shows(Layer::Loads) && scene.scales.step > 0; }

std::string spell_scale(const Scene& scene, double metres) {
  return shows_loads(scene) ? spell_impulse_scale(metres * scene.scales.step, "N")
                            : spell_impulse_scale(metres);
}

// Along the normal out of the other body: the part kept from the previous step, and the whole over
// it. Both are cut if they are too long.
void draw_normal_impulse(const Scene& scene, const trace::Point& point, const Vec3d& out,
                         Sketch& sketch) {
  const Vec3d& at = point.position;
  for (const bool warm : {true, false}) {
    const double whole =
        scene.scales.impulse * (warm ? point.impulse->warm_start : point.impulse->normal);
    const double shown = std::min(whole, scene.scales.longest_impulse);
    if (!(shown * scene.camera.pixels_per_metre(at) >= kMinImpulse)) continue;
    if (warm) {
      sketch.line(at, at + shown * out, {kKeptWidth, kKept});
      sketch.explain(kWarmStartSwatch, "kept from the step before");
    } else {
      sketch.arrow_to_scale(at, shown * out, 3, 12, kImpulse).halo = false;
      sketch.explain(kNormalImpulseSwatch,
                     (shows_loads(scene) ? "normal force, " : "normal impulse, ") +
                         spell_scale(scene, scene.scales.impulse));
    }
    if (whole <= shown) continue;
    draw_break(scene, at + 0.6 * shown * out, out, kImpulse, sketch);
    sketch.explain(kBreakSwatch, "longer than drawn", Vec3d(at + 0.6 * shown * out));
  }
}

/// Newton seconds, over all points of the frame.
double largest_friction(const Scene& scene) {
  double largest = 0;
  for (const trace::Pair& pair : scene.frame.pairs)
    for (const auto& [manifold, point] : all_points(pair))
      if (point->impulse) largest = std::max(largest, point->impulse->friction.norm());
  return largest;
}

/// Sum over each pair, maximum over the pairs.
double largest_friction_of_pairs(const Scene& scene) {
  double largest = 0;
  for (const trace::Pair& pair : scene.frame.pairs) {
    Vec3d sum = Vec3d::Zero();
    for (const auto& [manifold, point] : all_points(pair))
      if (point->impulse) sum += point->impulse->friction;
    largest = std::max(largest, sum.norm());
  }
  return largest;
}

/// Displacement of its arrow; nothing if it is too small or small compared with `largest`.
std::optional<Vec3d> draw_friction(const Scene& scene, const trace::Point& point, double side,
                                   double largest, Sketch& sketch) {
  const SequenceScales& scales = scene.scales;
  const Vec3d& at = point.position;
  const bool own_scale = scales.friction != scales.impulse;
  const double length = scales.impulse * point.impulse->normal;
  // Cut like the arrow of the normal impulse, to keep their angle.
  const double share =
      own_scale ? 1.0 : std::min(1.0, scales.longest_impulse / std::max(length, 1e-300));
  const Vec3d offset = side * share * scales.friction * point.impulse->friction;
  // Length on the screen, because an arrow towards the eye is not legible either.
  const auto seen = seen_distance(scene.camera, at, at + offset);
  if (!seen || !(*seen >= kMinFriction * scales.pixel)) return std::nullopt;
  if (point.impulse->friction.norm() < kMinOfFriction * largest) return std::nullopt;
  sketch.arrow_to_scale(at, offset, 2.5f, 10, kFriction).open = true;
  if (share < 1) draw_break(scene, at + 0.6 * offset, offset.normalized(), kFriction, sketch);
  sketch.explain(kFrictionSwatch, own_scale ? "friction, " + spell_scale(scene, scales.friction)
                                            : "friction, same scale");
  return offset;
}

std::string spell_load(const Scene& scene, double newton_seconds) {
  return spell_quantity(newton_seconds / scene.scales.step, "N", 3, scene.scales.load);
}

// Sums points that coincide on the screen, such as those of an edge seen end-on. Nothing if points
// are separate on the screen or their normals differ.
std::optional<PairPoint> seen_as_one(const Scene& scene, const trace::Pair& pair,
                                     trace::Point& sum) {
  constexpr float kOnePlace = 4;            // pixels
  constexpr double kSameDirection = 0.999;  // cosine
  std::optional<PairPoint> first;
  for (const PairPoint& one : all_points(pair)) {
    if (!one.point->impulse) continue;
    if (!first) {
      first = {one.manifold, &sum};
      sum = *one.point;
      sum.impulse->warm_start = 0;  // drawn for single points only
      continue;
    }
    const auto separated = seen_distance(scene.camera, sum.position, one.point->position);
    if (!separated || *separated > kOnePlace * scene.scales.pixel ||
        first->manifold->normal.dot(one.manifold->normal) < kSameDirection)
      return std::nullopt;
    sum.impulse->normal += one.point->impulse->normal;
    sum.impulse->friction += one.point->impulse->friction;
  }
  return first;
}

// Normal force and friction on one of the bodies, as two arrows with numbers.
void draw_load_of_one(const Scene& scene, const PairPoint& at, double side, Sketch& sketch) {
  const trace::Point& point = *at.point;
  const Vec3d out = side * at.manifold->normal;
  draw_normal_impulse(scene, point, out, sketch);
  const double shown =
      std::min(scene.scales.impulse * point.impulse->normal, scene.scales.longest_impulse);
  if (shown * scene.camera.pixels_per_metre(point.position) >= kMinImpulse)
    sketch.label(point.position + shown * out, spell_load(scene, point.impulse->normal), kImpulse,
                 17, 8, out);
  if (const auto offset =
          draw_friction(scene, point, side, largest_friction_of_pairs(scene), sketch))
    sketch.label(point.position + 0.5 * *offset, spell_load(scene, point.impulse->friction.norm()),
                 kFrictionText, 17, 8, scene.camera.up());
}

// Total load over the pair's points.
struct PairLoad {
  std::vector<Vec3d> at;                    // points with impulses
  const trace::Point* outermost = nullptr;  // farthest to the right
  Vec3d offset = Vec3d::Zero();             // normal of the last point, out of the other body
  double normal = 0;                        // newton seconds
  Vec3d friction = Vec3d::Zero();           // newton seconds
};

PairLoad load_of(const Scene& scene, const trace::Pair& pair, double side) {
  const Vec3d right = scene.camera.right();
  PairLoad load;
  for (const auto& [manifold, point] : all_points(pair)) {
    if (!point->impulse) continue;
    load.at.push_back(point->position);
    load.offset = side * manifold->normal;
    load.normal += point->impulse->normal;
    load.friction += side * point->impulse->friction;
    if (load.outermost == nullptr || right.dot(point->position - load.outermost->position) > 0)
      load.outermost = point;
  }
  return load;
}

// The sum belongs to no single arrow: a bracket spans its points, with the sum at the tip.
struct Bracket {
  std::array<Vec3d, 4> line;  // from the end of one arm to the end of the other
  Vec3d middle, tip;
  Vec3d out;  // unit, away from the points
};

// On the screen, in the plane of the first point: for two points parallel to their line, on the
// side without arrows; otherwise vertical, to the right of all. Nothing if one is behind the eye.
std::optional<Bracket> bracket_next_to(const Scene& scene, const PairLoad& load) {
  constexpr double kAway = 15, kArm = 7, kBeyond = 4, kMin = 12;  // pixels
  const Camera& camera = scene.camera;
  const double metres = 1 / camera.pixels_per_metre(load.at.front());
  const double pixel = scene.scales.pixel;
  const std::optional<Point2> origin = camera.project(load.at.front());
  if (!origin) return std::nullopt;
  std::vector<Vec2d> seen;  // pixels from the first, y up
  for (const Vec3d& at : load.at) {
    const std::optional<Point2> place = camera.project(at);
    if (!place) return std::nullopt;
    seen.emplace_back(place->x - origin->x, origin->y - place->y);
  }
  Vec2d along = Vec2d::UnitY(), out = Vec2d::UnitX();
  if (seen.size() == 2 && (seen[1] - seen[0]).norm() > 2 * kMin * pixel) {
    along = (seen[1] - seen[0]).normalized();
    out = {along.y(), -along.x()};
    const Vec2d arrows(load.offset.dot(camera.right()), load.offset.dot(camera.up()));
    const double facing = out.dot(arrows);
    if (facing > 0.1 || (std::abs(facing) <= 0.1 && out.x() < 0)) out = -out;
  }
  double low = 1e300, high = -1e300, reach = -1e300;
  for (const Vec2d& at : seen) {
    low = std::min(low, along.dot(at));
    high = std::max(high, along.dot(at));
    reach = std::max(reach, out.dot(at));
  }
  const double half = std::max(0.5 * (high - low) + kBeyond * pixel, 0.5 * kMin * pixel);
  const double middle = 0.5 * (low + high), away = reach + kAway * pixel;
  const auto place = [&](double at, double beyond) -> Vec3d {
    const Vec2d p = at * along + (away + beyond * pixel) * out;
    return load.at.front() + metres * (p.x() * camera.right() + p.y() * camera.up());
  };
  return Bracket{{place(middle - half, -kArm), place(middle - half, 0), place(middle + half, 0),
                  place(middle + half, -kArm)},
                 place(middle, 0),
                 place(middle, kArm),
                 out.x() * camera.right() + out.y() * camera.up()};
}

void draw_load(const Scene& scene, const trace::Pair& pair, double side, Sketch& sketch) {
  const PairLoad load = load_of(scene, pair, side);
  if (load.outermost == nullptr || !(load.normal > 0)) return;
  const std::string normal = spell_load(scene, load.normal);
  const bool rubs = scene.shows(Layer::Friction) && load.friction.norm() >= 1e-6 * load.normal;
  const std::string friction = spell_load(scene, load.friction.norm());
  const std::optional<Bracket> bracket = bracket_next_to(scene, load);
  if (!bracket) return;
  const LineStyle style{1.8f, kImpulse};
  for (std::size_t i = 1; i < bracket->line.size(); ++i)
    sketch.bordered_line(bracket->line[i - 1], bracket->line[i], style, 4.5f);
  sketch.bordered_line(bracket->middle, bracket->tip, style, 4.5f);
  sketch.label(bracket->tip, "Σ " + normal, kImpulse, 17, 5, bracket->out);
  if (rubs)
    sketch.label(bracket->tip, "friction Σ " + friction, kFrictionText, 17, 5, bracket->out);
}

void draw_impulses(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (scene.scales.impulse == 0) return;
  // Impulses are drawn on the body that they move: b, or a if only a moves.
  const bool moves_a = scene.frame.solver && scene.body(pair.a) != nullptr;
  const bool moves_b = !scene.frame.solver || scene.body(pair.b) != nullptr;
  const double side = moves_a && !moves_b ? -1 : 1;
  trace::Point sum;
  const std::optional<PairPoint> one =
      shows_loads(scene) ? seen_as_one(scene, pair, sum) : std::nullopt;
  const auto mark_point = [&](const Vec3d& at) {
    if (scene.shows(Layer::Contacts)) return;
    sketch.mark(MarkKind::Node, at, kContact);
    sketch.explain(kPushedSwatch, "contact point", at);
  };
  if (one && sum.impulse->normal > 0 && scene.camera.sees(sum.position)) {
    mark_point(sum.position);
    if (moves_a && moves_b) draw_load_of_one(scene, *one, -side, sketch);
    return draw_load_of_one(scene, *one, side, sketch);
  }
  if (shows_loads(scene)) draw_load(scene, pair, side, sketch);
  const std::size_t points = count_contacts(scene.frame).points;
  const double largest = largest_friction(scene);
  for (const auto& [manifold, point] : all_points(pair)) {
    const Vec3d& at = point->position;
    if (!point->impulse || !scene.camera.sees(at)) continue;
    // A separated point without an impulse has no arrow.
    if (stands_off(*point, scene.scales) && point->impulse->normal == 0) continue;
    const Vec3d out = side * manifold->normal;
    mark_point(at);
    draw_normal_impulse(scene, *point, out, sketch);
    const bool pushes_both = moves_a && moves_b && points == 1;
    if (pushes_both) draw_normal_impulse(scene, *point, -out, sketch);
    draw_friction(scene, *point, side, largest, sketch);
    const double length = scene.scales.impulse * point->impulse->normal;
    const double pixels = scene.camera.pixels_per_metre(at);
    if (shows_loads(scene) || points > kLabelledPoints || length * pixels < kMinImpulse) continue;
    const double shown = std::min(length, scene.scales.longest_impulse);
    const std::string spelled = spell_quantity(point->impulse->normal, "N s", 3, scene.scales.load);
    sketch.label(at + shown * out, spelled, kImpulse, 15, 8, out);
    if (pushes_both) sketch.label(at - shown * out, spelled, kImpulse, 15, 8, Vec3d(-out));
  }
}

}  // namespace

const LayerDrawing kImpulsesLayer{.result = draw_impulses};
const LayerDrawing kLoadsLayer{};
const LayerDrawing kFrictionLayer{};

}  // namespace contactscope::draw
