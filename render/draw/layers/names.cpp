#include "draw/layers/layer.h"
#include "draw/scene/pairs.h"
#include "draw/scene/points.h"
#include "draw/scene/solid.h"

/// Names at the middle of each shape, because the legend has no room for them in a heap.
namespace contactscope::draw {
namespace {

constexpr float kSmallName = 13, kLargeName = 20;  // pixels, with many shapes
constexpr double kFromBar = 8;                     // pixels

// Shapes larger than the picture, such as the ground, are named at their nearest corner.
Vec3d nearest_corner(const Camera& camera, const std::vector<Vec3d>& corners) {
  Vec3d nearest = corners.front();
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3d& corner : corners) {
    const double distance = (corner - camera.eye()).norm();
    if (distance >= least || !camera.sees(corner)) continue;
    least = distance;
    nearest = corner;
  }
  return nearest;
}

Vec3d place_of(const Camera& camera, const PlacedShape& shape) {
  if (shape.mesh->patch)
    return nearest_corner(camera, patch_corners(*shape.mesh->patch, shape.pose));
  if (shape.is_mesh()) return nearest_corner(camera, shape.vertices);
  return box_around(shape.vertices).center();
}

// A bar is named on its far side, as a column or row of a table; other shapes in their middle.
std::optional<Vec3d> next_to_bar(const PlacedShape& shape, const Vec3d& center) {
  constexpr double kThin = 0.1;  // share of the length
  const Eigen::AlignedBox3d box = box_around(shape.vertices);
  Eigen::Index along = 0;
  const double length = box.sizes().maxCoeff(&along);
  const Vec3d across = box.sizes() - length * Vec3d::Unit(along);
  if (shape.is_mesh() || across.maxCoeff() > kThin * length) return std::nullopt;
  Vec3d out = box.center() - center;
  out[along] = 0;
  return out;
}

// Among many shapes only those in contact are named, which titles and panels mention, and larger
// those that no pair has, such as the heads of a table. In a heap only the pair that stands out has
// names; see draw_crowd().
void draw_names(const Scene& scene, Sketch& sketch) {
  constexpr std::size_t kMaxNames = 12;
  if (scene.scales.heap) return;
  const bool many = scene.shapes.size() > kMaxNames;
  const std::vector<bool> touches = shapes_in_contact(scene.meshes, scene.frame);
  for (const PlacedShape& shape : scene.shapes) {
    const std::string& name = shape.traced().name;
    const auto has = [&](const trace::Pair& pair) { return pair.a == name || pair.b == name; };
    const bool is_alone =
        many && !scene.frame.broad_phase && std::ranges::none_of(scene.frame.pairs, has);
    if (!in_view(scene.camera, shape) || (many && !touches[shape.place] && !is_alone)) continue;
    const float size = is_alone ? kLargeName : scene.shapes.size() > 8 ? kSmallName : 16;
    std::optional<Vec3d> out = is_alone ? next_to_bar(shape, sketch.center) : std::nullopt;
    const double gap = out ? kFromBar : 0;
    if (is_alone && !out) out = scene.camera.up();  // centred
    sketch.label(place_of(scene.camera, shape), name, kText, size, gap, out);
  }
}

// More names would not be readable.
constexpr std::size_t kMaxEdgeNames = 12;

/// "A5 × B9" for the edges "a:e5 b:e9", "corner B4" for "b:v4"; other names are not changed.
std::string features_of(std::string_view id) {
  std::string text;
  int edges = 0;
  while (!id.empty()) {
    const std::string_view word = id.substr(0, id.find(' '));
    id.remove_prefix(std::min(word.size() + 1, id.size()));
    const bool known = word.size() > 3 && word[1] == ':' && (word[0] == 'a' || word[0] == 'b') &&
                       (word[2] == 'e' || word[2] == 'v' || word[2] == 'f');
    if (!text.empty()) text += edges > 0 && known && word[2] == 'e' ? " × " : " ";
    if (!known) {
      text += word;
      continue;
    }
    edges += word[2] == 'e';
    text += word[2] == 'v' ? "corner " : word[2] == 'f' ? "face " : "";
    text += word[0] == 'a' ? 'A' : 'B';
    text += word.substr(3);
  }
  return text;
}

/// Mean of the points on an edge; nothing for fewer than two.
std::optional<Vec3d> middle_of(const trace::Pair& pair, const PairFeature& edge) {
  std::vector<Vec3d> on_edge;
  for (const PairPoint& any : all_points(pair)) {
    const std::vector<PairFeature> edges = edges_in(any.point->id);
    if (std::ranges::find(edges, edge) != edges.end()) on_edge.push_back(any.point->position);
  }
  if (on_edge.size() < 2) return std::nullopt;
  return mean_of(on_edge);
}

// Catto 2007, "Feature-Based Contact Points": the ids, and a name on each edge in them, except
// edges of a mesh, which count within a triangle, and of round shapes, which have no visible ones.
void draw_ids(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  for (const PairPoint& kept : kept_points(pair))
    sketch.label(kept.point->position, features_of(kept.point->id), kText, 18, 12);
  std::vector<PairFeature> edges;
  for (const PairPoint& any : all_points(pair)) {
    for (const PairFeature& edge : edges_in(any.point->id))
      if (std::ranges::find(edges, edge) == edges.end()) edges.push_back(edge);
  }
  if (edges.size() > kMaxEdgeNames) return;
  for (const PairFeature& edge : edges) {
    const auto& [of_a, index, kind] = edge;
    const PlacedShape* shape = scene.find(of_a ? pair.a : pair.b);
    if (shape == nullptr || shape->is_mesh()) continue;
    const auto ends = shape->edge(index);
    if (!ends || shape->traced().radius > 0) continue;
    sketch.label(middle_of(pair, edge).value_or(0.5 * ((*ends)[0] + (*ends)[1])),
                 (of_a ? "edge A" : "edge B") + std::to_string(index), of_a ? kArcOfA : kArcOfB, 16,
                 5);
  }
}

}  // namespace

const LayerDrawing kNamesLayer{.above = draw_names};

const LayerDrawing kIdsLayer{.needs = {&Stages::reduction}, .result = draw_ids};

}  // namespace contactscope::draw
