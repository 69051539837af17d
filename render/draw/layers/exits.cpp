#include "draw/layers/layer.h"
#include "draw/scene/solid.h"

/// Catto 2007, "Extreme Fuzziness": deeply overlapping hulls have several ways out. The shortest is
/// the contact's normal. Each is drawn from the centre of B, in the length of the overlap along it.
/// At the end of the chosen one, B would just touch A.
namespace contactscope::draw {
namespace {

constexpr std::size_t kMaxExits = 3;
constexpr double kSameDirection = 0.951;  // cosine of 18 degrees: closer directions look like one
constexpr double kTaken = 0.9999;         // cosine to the contact's normal

constexpr Swatch kTakenExitSwatch{LegendGroup::Axes, 5,
                                  [](auto& pen) { pen.arrow(4, 11, kAxisText); }};
constexpr Swatch kOtherExitSwatch{LegendGroup::Axes, 6, [](auto& pen) { pen.arrow(2, 9, kAxis); }};

constexpr LineStyle kMovedOut{1.5f, kDropped, true};
constexpr Swatch kMovedOutSwatch{LegendGroup::Axes, 7,
                                 [](auto& pen) { pen.dashes(1.5, kDropped); }};

struct Exit {
  Vec3d direction;     // unit: B moves along it
  double overlap = 0;  // metres
  bool of_edges = false;
};

double reach_along(const PlacedShape& shape, const Vec3d& direction) {
  double reach = -1e300;
  for (const Vec3d& vertex : shape.vertices) reach = std::max(reach, direction.dot(vertex));
  return reach;
}

// Along the normals of all faces, and along the best recorded cross product of two edges.
std::vector<Exit> exits(const trace::Pair& pair, const PlacedShape& a, const PlacedShape& b) {
  std::vector<Exit> candidates;
  const auto add = [&](const Vec3d& direction, bool of_edges) {
    candidates.push_back(
        {direction, reach_along(a, direction) + reach_along(b, Vec3d(-direction)), of_edges});
  };
  for (int face = 0; face < count_of(a.mesh->normals); ++face) add(a.normal(face), false);
  for (int face = 0; face < count_of(b.mesh->normals); ++face) add(-b.normal(face), false);
  if (pair.sat && pair.sat->edge) add(pair.sat->edge->normal, true);
  std::ranges::stable_sort(candidates, {}, &Exit::overlap);
  std::vector<Exit> distinct;
  for (const Exit& exit : candidates) {
    const auto same = [&](const Exit& other) {
      return other.direction.dot(exit.direction) > kSameDirection;
    };
    if (distinct.size() < kMaxExits && std::ranges::none_of(distinct, same))
      distinct.push_back(exit);
  }
  return distinct;
}

void draw_exits(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const PlacedShape *a = scene.find(pair.a), *b = scene.find(pair.b);
  if (pair.manifolds.empty() || a == nullptr || b == nullptr) return;
  if (a->mesh->normals.empty() || b->mesh->normals.empty() || a->is_mesh() || b->is_mesh()) return;
  const Vec3d& normal = pair.manifolds.front().normal;
  const Vec3d center = b->pose.transform(b->traced().center_of_mass);
  const std::vector<Exit> candidates = exits(pair, *a, *b);
  const bool any_of_edges = std::ranges::any_of(candidates, &Exit::of_edges);
  for (const Exit& exit : candidates) {
    if (exit.overlap <= 0) return;  // separated: nothing to resolve
    const bool taken = normal.dot(exit.direction) > kTaken;
    const Vec3d end = center + exit.overlap * exit.direction;
    const Color color = taken ? kAxisText : kAxis;
    sketch.arrow_to_scale(center, end - center, taken ? 5.0f : 2.5f, taken ? 16.0f : 12.0f, color);
    // The kind of feature is written if both kinds occur.
    const std::string name = exit.of_edges ? "edges: " : any_of_edges ? "face: " : "";
    sketch
        .label(end, name + spell_length(exit.overlap, 0, scene.scales.length), kAxisText,
               taken ? 20.0f : 17.0f, 10, exit.direction)
        .bold = taken;
    if (!taken) {
      sketch.explain(kOtherExitSwatch, "other ways out");
      continue;
    }
    sketch.explain(kTakenExitSwatch, "way out that is taken, as long as the overlap");
    draw_ghost(scene.camera, moved(*b, center, end - center, Vec3d::Zero()), kMovedOut, sketch);
    sketch.explain(kMovedOutSwatch, "B moved out of A");
  }
}

}  // namespace

const LayerDrawing kExitsLayer{.needs = {&Stages::sat}, .result = draw_exits};

}  // namespace contactscope::draw
