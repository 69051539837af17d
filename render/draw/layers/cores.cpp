#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "draw/layers/layer.h"
#include "draw/scene/core_outline.h"
#include "draw/scene/quantity.h"
#include "draw/scene/swatches.h"

/// Gregorius 2015, "Building Incremental Manifolds (1)"; Catto 2007, "GJK Contact Margins": shapes
/// are cores inflated by margins. The cores stay apart while the margins overlap, so that closest
/// points are enough, and the depth is both margins less the distance of the cores.
namespace contactscope::draw {
namespace {

constexpr LineStyle kCoreFront{1.5f, with_alpha(kReferenceFace, 0.75f), true,
                               LineStyle::Hidden::Same};
constexpr LineStyle kCoreBack{1.0f, with_alpha(kReferenceFace, 0.35f), true,
                              LineStyle::Hidden::Same};
constexpr LineStyle kRoundedSurface{2.0f, kReferenceFace};
constexpr LineStyle kExtension{1.0f, with_alpha(kQuietText, 0.8f)};
constexpr Swatch kCoreSwatch{LegendGroup::Cores, 0, [](const SwatchPen& pen) {
                               pen.box(with_alpha(kReferenceFace, 0), kReferenceFace, 1.8, true);
                             }};
constexpr Swatch kRoundedSwatch{LegendGroup::Cores, 1, [](const SwatchPen& pen) {
                                  pen.box(with_alpha(kReferenceFace, 0), kReferenceFace, 2);
                                }};
// A length between two ticks.
constexpr Swatch kMarginsSwatch{LegendGroup::Cores, 2, [](const SwatchPen& pen) {
                                  pen.level_line(2, 20, 1.8, kReferenceFace);
                                  for (const double at : {2.0, 20.0})
                                    pen.line(pen.at(at, -4), pen.at(at, 4), 1.8, kReferenceFace);
                                }};

constexpr double kColumn = 30;  // pixels between the lines of one sum
constexpr double kBeyondColumn = 7;
constexpr double kLeastOfSum = 6;

void draw_hull_core(const Scene& scene, const PlacedShape& shape, double margin, Sketch& sketch) {
  const CoreSolid core = core_solid(shape, margin);
  const auto front = [&](std::size_t face) {
    const int index = static_cast<int>(face);
    return scene.camera.faces(shape.polygon(index)[0], shape.normal(index));
  };
  for (const CoreSolid::Edge& edge : core.edges) {
    const bool seen = front(edge.left) || front(edge.right);
    sketch.line(edge.from, edge.to, seen ? kCoreFront : kCoreBack);
  }
  sketch.curves.push_back(
      {rounded_outline(core.corners, margin, scene.camera), kRoundedSurface, true});
}

/// Where the cores are nearest to each other, or deepest in each other.
struct CorePair {
  Vec3d on_a, on_b;
  Vec3d normal;         // unit, from A to B
  double distance = 0;  // metres, negative in overlap
};

std::optional<CorePair> core_pair(const trace::Pair& pair) {
  if (pair.incremental->query == "gjk") {
    if (!pair.gjk || pair.gjk->distance <= 0) return std::nullopt;
    const trace::Gjk& gjk = *pair.gjk;
    return CorePair{gjk.point_a, gjk.point_b, (gjk.point_b - gjk.point_a).normalized(),
                    gjk.distance};
  }
  const std::string& method = pair.incremental->query;
  if (method.empty() || method == "plane" || pair.manifolds.empty()) return std::nullopt;
  const Vec3d& normal = pair.manifolds.front().normal;
  if (pair.penetration)
    return CorePair{pair.penetration->point_a, pair.penetration->point_b, normal,
                    -pair.penetration->depth};
  // The separating axis test leaves no points of the cores: they lie by the margins within the
  // places on the surfaces.
  const trace::PersistentPoint* deepest = nullptr;
  for (const trace::PersistentPoint& point : pair.incremental->points) {
    if (point.state == "broken") continue;
    if (deepest == nullptr || point.point.separation < deepest->point.separation) deepest = &point;
  }
  if (deepest == nullptr) return std::nullopt;
  const double margins = pair.incremental->margin_a + pair.incremental->margin_b;
  return CorePair{deepest->on_a - pair.incremental->margin_a * normal,
                  deepest->on_b + pair.incremental->margin_b * normal, normal,
                  deepest->point.separation + margins};
}

/// The lines of the sum stand side by side, each as long as what it tells.
class SumOfMargins {
 public:
  SumOfMargins(const Scene& scene, const CorePair& cores, Sketch& sketch)
      : cores_(cores), sketch_(sketch) {
    side_ = scene.camera.right() - scene.camera.right().dot(cores.normal) * cores.normal;
    side_ = side_.norm() > 1e-3 ? Vec3d(side_.normalized()) : any_perpendicular(cores.normal);
    pixel_ = 1 / scene.camera.pixels_per_metre(cores.on_a);
  }

  /// `from` and `to` along the normal from A's core, metres.
  void arrow(int column, double from, double to, const Color& color, float width) {
    if (std::abs(to - from) < kLeastOfSum * pixel_) return;
    sketch_.arrows.push_back({.from = place(column, from),
                              .to = place(column, to),
                              .double_headed = true,
                              .width = width,
                              .color = color});
  }
  void line(int column, double from, double to, const Color& color) {
    sketch_.bordered_line(place(column, from), place(column, to), {2.2f, color}, 5.0f);
    const Vec3d tick = 4 * pixel_ * side_;
    for (const double end : {from, to})
      sketch_.line(place(column, end) - tick, place(column, end) + tick, {2.2f, color});
  }
  void label(int column, double at, const std::string& text, const Color& color,
             const Vec3d& away) {
    sketch_.label(place(column, at), text, color, 16, 8, away);
  }
  /// A thin line from one column to another at a height.
  void extend(int from, int to, double at) {
    const Vec3d beyond = kBeyondColumn * pixel_ * side_;
    sketch_.line(place(from, at), place(to, at) + beyond, kExtension);
  }
  const Vec3d& side() const { return side_; }

 private:
  Vec3d place(int column, double along) const {
    return cores_.on_a + along * cores_.normal + column * kColumn * pixel_ * side_;
  }

  const CorePair& cores_;
  Sketch& sketch_;
  Vec3d side_;
  double pixel_;
};

void draw_sum(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const std::optional<CorePair> cores = core_pair(pair);
  if (!cores) return;
  const double distance = cores->distance;
  SumOfMargins sum(scene, *cores, sketch);
  sum.arrow(0, 0, distance, kAxis, 3);
  if (distance < 0) {
    sum.label(0, 0.5 * distance,
              "cores overlap " + spell_length(-distance) + ", by " + pair.incremental->query,
              kAxisText, -sum.side());
    return;
  }
  const double a = pair.incremental->margin_a, b = distance - pair.incremental->margin_b;
  sum.extend(0, 1, 0);
  sum.extend(0, 2, distance);
  sum.extend(1, 3, a);
  sum.extend(2, 3, b);
  sum.line(1, 0, a, kReferenceFace);
  sum.line(2, b, distance, kReferenceFace);
  sum.label(1, 0.3 * a, "A's margin " + spell_length(pair.incremental->margin_a), kReferenceFace,
            sum.side() - 2 * cores->normal);
  sum.label(2, distance - 0.3 * pair.incremental->margin_b,
            "B's margin " + spell_length(pair.incremental->margin_b), kReferenceFace,
            sum.side() + 2 * cores->normal);
  const bool apart = b >= a;
  sum.arrow(3, a, b, apart ? kAxis : kContact, 3);
  sum.label(3, 0.5 * (a + b), (apart ? "gap " : "overlap ") + spell_length(std::abs(b - a)),
            apart ? kAxisText : kContact, sum.side());
  sum.label(0, 0.5 * distance, "cores " + spell_length(distance) + " apart", kAxisText,
            -sum.side());
}

/// A shape of the pair, and the margin around its core.
struct Inflated {
  const PlacedShape* shape;
  double margin;
};

// Round shapes show their cores already.
std::vector<Inflated> inflated_hulls(const Scene& scene, const trace::Pair& pair) {
  std::vector<Inflated> hulls;
  if (!pair.incremental) return hulls;
  for (const bool of_a : {true, false}) {
    const double margin = of_a ? pair.incremental->margin_a : pair.incremental->margin_b;
    const PlacedShape* shape = scene.find(of_a ? pair.a : pair.b);
    if (shape == nullptr || margin <= 0 || shape->mesh->shape->radius > 0) continue;
    if (shape->mesh->shape->faces.empty() || shape->mesh->shape->type == "mesh") continue;
    hulls.push_back({shape, margin});
  }
  return hulls;
}

void draw_cores(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const std::vector<Inflated> hulls = inflated_hulls(scene, pair);
  for (const auto& [shape, margin] : hulls) draw_hull_core(scene, *shape, margin, sketch);
  if (!hulls.empty()) draw_sum(scene, pair, sketch);
}

void explain_cores(const Scene& scene, const trace::Pair& pair, Legend& legend) {
  if (inflated_hulls(scene, pair).empty()) return;
  const trace::Incremental& incremental = *pair.incremental;
  const double widest = std::max(incremental.margin_a, incremental.margin_b);
  legend.explain(kCoreSwatch, "core, " + spell_length(widest) + " within the faces");
  legend.explain(kRoundedSwatch, "core and margin: the surface that touches");
  const std::optional<CorePair> cores = core_pair(pair);
  if (!cores) return;
  if (cores->distance < 0) {
    legend.explain(kAxisSwatch, "overlap of the cores");
    return;
  }
  legend.explain(kMarginsSwatch, "margins");
  const bool apart = cores->distance - incremental.margin_b >= incremental.margin_a;
  legend.explain(kAxisSwatch, apart ? "distance of the cores, and the gap that the margins leave"
                                    : "distance of the cores");
}

}  // namespace

const LayerDrawing kCoreLayer{.needs = {&trace::Stages::gjk, &trace::Stages::penetration},
                              .search = draw_cores,
                              .explain = explain_cores};

}  // namespace contactscope::draw
