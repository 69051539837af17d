#include <algorithm>

#include "draw/layers/layer.h"
#include "draw/scene/box_outline.h"
#include "draw/scene/points.h"
#include "draw/scene/quantity.h"

/// Collection of a mesh's candidate triangles: Gregorius 2015, "Mesh Contacts".
namespace contactscope::draw {
namespace {

constexpr float kLeftOut = 0.22f;  // opacity of skipped boxes

constexpr Swatch kQuerySwatch{LegendGroup::Trees, 0, [](auto& pen) { pen.area(kNormal, 0, 2); }};
constexpr Swatch kBoxSwatch{LegendGroup::Trees, 1, [](auto& pen) { pen.area(kBox, 0, 2.5); }};
constexpr Swatch kMissSwatch{LegendGroup::Trees, 2,
                             [](auto& pen) { pen.area(kDropped, kLeftOut, 1.5); }};

constexpr double kSeam = 3;  // pixels between a box's side and its drawing

/// Boxes of a tree share sides. Each is drawn slightly smaller, so that sides can be distinguished.
trace::Box drawn_box(const Scene& scene, const trace::Box& box, const PlacedShape& mesh) {
  const Vec3d middle = mesh.pose.transform(0.5 * (box.lower + box.upper));
  const double seam = kSeam * scene.scales.pixel / scene.camera.pixels_per_metre(middle);
  trace::Box drawn = box;
  for (int k = 0; k < 3; ++k) {
    if (drawn.upper[k] - drawn.lower[k] < 4 * seam) continue;
    drawn.lower[k] += seam;
    drawn.upper[k] -= seam;
  }
  return drawn;
}

// Section through the middle of a box across its shortest side: the whole box on a flat mesh.
std::vector<Vec3d> widest_cut(const trace::Box& box, const PlacedShape& mesh) {
  int shortest = 0;
  const Vec3d sizes = box.upper - box.lower;
  sizes.minCoeff(&shortest);
  std::vector<Vec3d> corners = sides_of(solid_box(box))[2 * static_cast<std::size_t>(shortest)];
  for (Vec3d& corner : corners) {
    corner[shortest] = 0.5 * (box.lower[shortest] + box.upper[shortest]);
    corner = mesh.pose.transform(corner);
  }
  return corners;
}

const PlacedShape* mesh_of(const Scene& scene, const trace::Pair& pair) {
  return pair.tree ? scene.find(pair.tree->shape) : nullptr;
}

/// Triangles that a query found. Each is then tested for contacts.
void draw_candidates(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const PlacedShape* mesh = mesh_of(scene, pair);
  if (mesh == nullptr) return;
  for (const int candidate : pair.tree->candidates) {
    if (candidate < 0 || candidate >= count_of(mesh->traced().faces)) continue;
    // Inside boxes of the tree, their sides are weaker.
    const bool boxed = scene.shows(Layer::Tree);
    sketch.face(mesh->polygon(candidate), with_alpha(kClipPolygon, boxed ? 0.3f : 0.22f),
                {boxed ? 1.0f : 1.5f, with_alpha(kClipPolygon, boxed ? 0.5f : 1), false,
                 LineStyle::Hidden::Faint});
    sketch.explain(kClipPolygonSwatch, "candidate triangle", mean_of(mesh->polygon(candidate)));
  }
}

/// The query box, which overlaps the boxes of the found triangles.
void draw_query(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const PlacedShape* mesh = mesh_of(scene, pair);
  if (mesh == nullptr) return;
  outline(pair.tree->box, mesh->pose, {2.0f, kNormal, false, LineStyle::Hidden::Faint}, sketch);
  sketch.explain(kQuerySwatch, "box of the shape that asks",
                 mesh->pose.transform(pair.tree->box.upper));
}

void draw_tree(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const PlacedShape* mesh = mesh_of(scene, pair);
  if (mesh == nullptr) return;
  if (!scene.shows(Layer::Candidates)) draw_candidates(scene, pair, sketch);
  // Skipped boxes below found ones. An entered inner node is visible through its children.
  for (const bool found : {false, true}) {
    for (const trace::TreeVisit& visit : pair.tree->visits) {
      if (visit.overlaps != found || (found && !visit.leaf)) continue;
      const trace::Box box = drawn_box(scene, visit.box, *mesh);
      if (!found)
        sketch.surfaces.push_back({widest_cut(box, *mesh), with_alpha(kDropped, kLeftOut)});
      outline(box, mesh->pose,
              found ? LineStyle{3.0f, kBox} : LineStyle{1.5f, with_alpha(kDropped, 0.7f)}, sketch);
      sketch.explain(found ? kBoxSwatch : kMissSwatch,
                     found ? "box of triangles that are tested" : "box left out, with all below",
                     mesh->pose.transform(visit.box.upper));
    }
  }
  if (!scene.shows(Layer::Candidates)) draw_query(scene, pair, sketch);
}

constexpr Swatch kDeformedSwatch{LegendGroup::Trees, 5, [](auto& pen) { pen.area(kBox, 0, 1.5); }};

// Boxes share faces, and coincident lines add up, so they are lighter instead of translucent.
constexpr Color kLightBox = {0.3f + 0.7f * kBox.r, 0.3f + 0.7f * kBox.g, 0.3f + 0.7f * kBox.b, 1};

constexpr Swatch kLargestSwatch{LegendGroup::Trees, 6, [](auto& pen) { pen.area(kBox, 0.16f, 3); }};

/// Highlights one of many overlapping boxes, to show how much they have grown.
void draw_largest(const std::vector<trace::Box>& boxes, const PlacedShape& mesh, Sketch& sketch) {
  const auto volume = [](const trace::Box& box) { return (box.upper - box.lower).prod(); };
  const trace::Box& largest = *std::ranges::max_element(boxes, {}, volume);
  for (std::vector<Vec3d>& side : sides_of(solid_box(largest))) {
    for (Vec3d& corner : side) corner = mesh.pose.transform(corner);
    sketch.surfaces.push_back({side, with_alpha(kBox, 0.16f)});
  }
  outline(largest, mesh.pose, {3.0f, kBox}, sketch);
  sketch.explain(kLargestSwatch, "largest of them");
  sketch.label(mesh.pose.transform(0.5 * (largest.lower + largest.upper)),
               spell_number(volume(largest), 3) + " m³", kBox, 17, 10);
}

/// The boxes in the tree of a deforming mesh.
void draw_deformed_trees(const Scene& scene, Sketch& sketch) {
  for (const trace::Deformed& deformed : scene.frame.deformed) {
    const PlacedShape* mesh = scene.find(deformed.name);
    if (mesh == nullptr) continue;
    for (const trace::Box& box : deformed.boxes)
      outline(box, mesh->pose, {1.2f, kLightBox}, sketch);
    sketch.explain(kDeformedSwatch, "boxes of the tree, four levels down");
    if (deformed.boxes.size() > 1) draw_largest(deformed.boxes, *mesh, sketch);
  }
}

}  // namespace

const LayerDrawing kCandidatesLayer{
    .needs = {&Stages::tree},
    .beneath =
        [](const Scene& scene, Sketch& sketch) {
          for (const trace::Pair& pair : scene.frame.pairs) draw_candidates(scene, pair, sketch);
        },
    .search =
        [](const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
          if (!scene.shows(Layer::Bounds)) draw_query(scene, pair, sketch);
        },
};
const LayerDrawing kTreeLayer{
    .needs = {&Stages::tree}, .beneath = draw_deformed_trees, .search = draw_tree};

}  // namespace contactscope::draw
