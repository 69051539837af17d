#include <algorithm>

#include "draw/scene/palette.h"
#include "draw/scene/scene.h"

/// How the triangles of a mesh were collected: Gregorius 2015, "Mesh Contacts".
namespace contactscope::draw {
namespace {

/// The corner of a box by bits: 1 the upper x, 2 the upper y, 4 the upper z.
Vec3d corner(const trace::Box& box, int bits) {
  return {(bits & 1) != 0 ? box.upper.x() : box.lower.x(),
          (bits & 2) != 0 ? box.upper.y() : box.lower.y(),
          (bits & 4) != 0 ? box.upper.z() : box.lower.z()};
}

/// The twelve edges; of a flat box each but once.
void outline(const trace::Box& box, const Pose<double>& pose, const LineStyle& style,
             Sketch& sketch) {
  for (int bits = 0; bits < 8; ++bits) {
    for (const int axis : {1, 2, 4}) {
      if ((bits & axis) != 0) continue;
      const Vec3d from = corner(box, bits);
      const Vec3d to = corner(box, bits | axis);
      if (from == to) continue;
      bool twice = false;
      for (const int other : {1, 2, 4}) {
        const bool flat = corner(box, other) == corner(box, 0);
        twice = twice || (flat && (bits & other) != 0);
      }
      if (!twice) sketch.lines.push_back({pose.transform(from), pose.transform(to), style, false});
    }
  }
}

}  // namespace

void draw_tree(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (!pair.tree) return;
  const trace::Tree& tree = *pair.tree;
  const PlacedShape* mesh = scene.find(tree.shape);
  if (mesh == nullptr) return;
  const int triangles = static_cast<int>(mesh->mesh->shape->faces.size());
  for (const int candidate : tree.candidates) {
    if (candidate < 0 || candidate >= triangles) continue;
    const std::vector<Vec3d> polygon = mesh->polygon(candidate);
    sketch.surfaces.push_back({polygon, with_alpha(kClipPolygon, 0.22f)});
    sketch.outline(polygon, {1.5f, kClipPolygon, false});
    sketch.explain(LegendKind::ClipPolygon, "candidate triangle");
  }
  // What was left out beneath what was entered, and the deepest last: it is what the query found.
  std::vector<trace::TreeVisit> visits = tree.visits;
  std::ranges::stable_sort(visits, [](const auto& a, const auto& b) {
    return a.overlaps != b.overlaps ? b.overlaps : a.depth < b.depth;
  });
  for (const trace::TreeVisit& visit : visits) {
    const bool inner = !visit.leaf;
    const LineStyle style =
        visit.overlaps ? LineStyle{inner ? 1.5f : 3.0f, with_alpha(kSidePlane, inner ? 0.8f : 1)}
                       : LineStyle{1.5f, kDropped, true};
    outline(visit.box, mesh->pose, style, sketch);
    sketch.explain(visit.overlaps ? LegendKind::TreeBox : LegendKind::TreeMiss,
                   visit.overlaps ? "box of the tree, entered" : "box left out, with all below");
  }
  outline(tree.box, mesh->pose, {2.0f, kNormal}, sketch);
  const std::string& other = tree.shape == pair.a ? pair.b : pair.a;
  sketch.explain(LegendKind::TreeQuery, "box of " + other);
}

}  // namespace contactscope::draw
