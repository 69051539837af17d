#include "draw/scene/points.h"
#include "draw/scene/solid.h"

namespace contactscope::draw {
namespace {

// Edge lengths on the screen, pixels, between which the lines inside a surface fade.
constexpr double kFaded = 5, kFull = 60;
constexpr float kThinAlpha = 0.45f;
// A mesh with up to this many triangles is drawn like a hull: exact depth order, strong creases.
constexpr std::size_t kFewTriangles = 120;
constexpr std::size_t kSampled = 400;  // number of edges that suffices to estimate their length

// Grows linearly from 0 at `none` to 1 at `whole`.
float share_between(double none, double whole, double value) {
  return static_cast<float>(std::clamp((value - none) / (whole - none), 0.0, 1.0));
}

// Opacity of the lines between triangles.
float thin_alpha(const Scene& scene, const PlacedShape& shape) {
  const std::vector<ShapeMesh::Edge>& edges = shape.mesh->edges;
  const std::size_t step = std::max<std::size_t>(1, edges.size() / kSampled);
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < edges.size(); i += step) {
    const Vec3d& from = shape.vertex(edges[i].from);
    const Vec3d& to = shape.vertex(edges[i].to);
    const Vec3d middle = 0.5 * (from + to);
    if (!scene.camera.project(middle)) continue;
    sum += (to - from).norm() * scene.camera.pixels_per_metre(middle);
    ++count;
  }
  return count == 0 ? 0 : kThinAlpha * share_between(kFaded, kFull, sum / count);
}

// Distances between lines on the screen, pixels, over which they fade, to avoid a moiré.
constexpr double kTooClose = 3, kFarAway = 11;

// Remaining opacity of a line between triangles, which get narrower on the screen towards the
// horizon. `seen`: each vertex on the screen.
float distance_fade(const Scene& scene, const PlacedShape& shape, const ShapeMesh::Edge& edge,
                    const std::vector<std::optional<Point2>>& seen) {
  const std::optional<Point2>& from = at(seen, edge.from);
  const std::optional<Point2>& to = at(seen, edge.to);
  if (!from || !to) return 1;
  const Vec2d along(to->x - from->x, to->y - from->y);
  const double length = along.norm();
  if (length <= 0) return 0;
  double spacing = std::numeric_limits<double>::infinity();
  for (const int face : {edge.left, edge.right}) {
    if (face < 0) continue;
    for (const int v : at(shape.traced().faces, face)) {
      if (v == edge.from || v == edge.to) continue;
      const std::optional<Point2>& apex = at(seen, v);
      if (!apex) continue;
      const Vec2d offset(apex->x - from->x, apex->y - from->y);
      spacing = std::min(spacing, std::abs(cross(along, offset)) / length);
    }
  }
  return share_between(kTooClose, kFarAway, spacing / scene.scales.pixel);
}

// A triangle of a mesh with the strongest role that a manifold assigns to it.
struct Touched {
  const PlacedShape* mesh;
  int triangle;
  bool incident;
};

/// The triangles of a mesh that made a manifold of the pair.
std::vector<int> triangles_of(const trace::Pair& pair, std::size_t manifold) {
  if (const auto& one = pair.manifolds[manifold].triangle) return {*one};
  if (!pair.merge || manifold >= pair.merge->manifolds.size()) return {};
  return pair.merge->manifolds[manifold].triangles;
}

std::vector<Touched> touched_triangles(const Scene& scene) {
  std::vector<Touched> touched;
  for (const trace::Pair& pair : scene.frame.pairs) {
    for (const bool of_a : {true, false}) {
      const PlacedShape* mesh = scene.find(of_a ? pair.a : pair.b);
      if (mesh == nullptr || !mesh->is_mesh()) continue;
      for (std::size_t m = 0; m < pair.manifolds.size(); ++m) {
        const bool incident = pair.manifolds[m].axis == (of_a ? "face_b" : "face_a");
        for (const int triangle : triangles_of(pair, m)) {
          if (triangle < 0 || triangle >= count_of(mesh->traced().faces)) continue;
          auto known = std::ranges::find_if(touched, [&](const Touched& other) {
            return other.mesh == mesh && other.triangle == triangle;
          });
          if (known == touched.end()) known = touched.insert(known, Touched{mesh, triangle, true});
          known->incident &= incident;
        }
      }
    }
  }
  return touched;
}

}  // namespace

void draw_mesh(const Scene& scene, const PlacedShape& shape, const Color& fill, Sketch& sketch) {
  const std::vector<ShapeMesh::Edge>& edges = shape.mesh->edges;
  const bool open =
      std::ranges::any_of(edges, [](const ShapeMesh::Edge& edge) { return edge.right < 0; });
  const bool many = shape.traced().faces.size() > kFewTriangles;
  const std::size_t before = sketch.surfaces.size();
  const std::vector<bool> front = draw_faces(scene.camera, shape, fill, open, sketch);
  // Triangles in reach of other shapes need the exact depth order.
  Eigen::AlignedBox3d reach;
  for (const PlacedShape& other : scene.shapes)
    if (&other != &shape && !other.is_mesh()) reach.extend(box_around(extent_points(other)));
  for (Surface& surface : std::span(sketch.surfaces).subspan(before))
    if (many && !reach.intersects(box_around(surface.polygon))) surface.body = kSmallSurface;

  const auto hidden = many ? LineStyle::Hidden::Gone : LineStyle::Hidden::Faint;
  const LineStyle border{1.5f, with_alpha(kShapeEdge, 0.85f), false, LineStyle::Hidden::Faint};
  // Hills are not the outline of a landscape.
  const bool landscape = many && open;
  const LineStyle silhouette{landscape ? 1.3f : 2.0f,
                             with_alpha(kShapeEdge, landscape ? 0.6f : 1.0f), false, hidden};
  const LineStyle crease{1.5f, border.color, false, hidden};
  const LineStyle thin{1.0f, with_alpha(kShapeEdge, thin_alpha(scene, shape)), false,
                       LineStyle::Hidden::Gone};
  std::vector<std::optional<Point2>> seen;
  if (many && thin.color.a > 0)
    seen = mapped(shape.vertices, [&](const Vec3d& v) { return scene.camera.project(v); });
  for (const ShapeMesh::Edge& edge : edges) {
    const bool left = at(front, edge.left);
    const bool right = edge.right >= 0 && at(front, edge.right);
    LineStyle style = thin;
    if (edge.right < 0) {
      style = border;
    } else if (left != right) {
      style = silhouette;
    } else if (!edge.smooth && !many) {
      style = crease;
    } else {
      if (thin.color.a <= 0 || (!left && !open)) continue;
      if (many) style.color.a *= distance_fade(scene, shape, edge, seen);
      if (style.color.a < 0.01f) continue;
    }
    sketch.line(shape.vertex(edge.from), shape.vertex(edge.to), style);
  }
}

constexpr float kPale = 0.1f;
constexpr Swatch kTouchedSwatch{LegendGroup::Faces, 3,
                                [](auto& pen) { pen.area(kReferenceFace, kPale, 1.5); }};

void draw_touched_triangles(const Scene& scene, Sketch& sketch) {
  const std::vector<Touched> touched = touched_triangles(scene);
  const float width = touched.size() > 6 ? 1.5f : touched.size() > 2 ? 2.0f : 3.0f;
  // Where the clipping of one triangle is drawn, the others are pale.
  const bool has_clipping = scene.shows(Layer::IncidentFace);
  const auto is_clipped = [&](const std::string& mesh, int triangle) {
    return std::ranges::any_of(scene.frame.pairs, [&](const trace::Pair& pair) {
      return pair.clip && pair.triangle == triangle && (pair.a == mesh || pair.b == mesh);
    });
  };
  for (const auto& [mesh, triangle, incident] : touched) {
    const Color color = incident ? kIncidentFace : kReferenceFace;
    if (has_clipping) {
      if (is_clipped(mesh->traced().name, triangle)) continue;
      sketch.face(mesh->polygon(triangle), with_alpha(kReferenceFace, kPale),
                  {1.5f, kReferenceFace});
      sketch.explain(kTouchedSwatch, "another triangle touched",
                     near_corner(mesh->polygon(triangle)));
      continue;
    }
    // On a landscape, and in a heap, surfaces in front of a triangle hide it.
    const bool many = mesh->traced().faces.size() > kFewTriangles || scene.scales.heap;
    sketch.face(
        mesh->polygon(triangle), with_alpha(color, 0.35f),
        {width, color, incident, many ? LineStyle::Hidden::Faint : LineStyle::Hidden::Same});
    if (!incident) sketch.surfaces.back().kind = Surface::Kind::Ground;
    sketch.explain(incident ? kIncidentFaceSwatch : kReferenceFaceSwatch,
                   incident ? "incident triangle" : "triangle touched",
                   near_corner(mesh->polygon(triangle)));
  }
}

}  // namespace contactscope::draw
