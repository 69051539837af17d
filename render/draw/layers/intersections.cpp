#include "draw/layers/layer.h"
#include "draw/scene/points.h"

/// Intersection of two meshes: the triangles that share a point, and the shared points.
namespace contactscope::draw {
namespace {

constexpr Swatch kDegenerateSwatch{LegendGroup::Points, 24,
                                   [](auto& pen) { pen.level_line(0, 23, 4, kAxisText); }};
constexpr Swatch kMeetingCurveSwatch{LegendGroup::Points, 20,
                                     [](auto& pen) { pen.level_line(0, 23, 3.5, kContact); }};
constexpr Swatch kCrossingTriangleSwatch{LegendGroup::Points, 21,
                                         [](auto& pen) { pen.area(kContact, 0.22f, 1); }};
constexpr Swatch kTouchSwatch{LegendGroup::Points, 22,
                              [](auto& pen) { pen.dot(0, 4.8, kContact); }};
// Not fainter if hidden, because faint hidden lines are dashed as well.
constexpr LineStyle kUncounted{3.5f, kContact, true};
constexpr Swatch kUncountedSwatch{LegendGroup::Points, 25,
                                  [](auto& pen) { pen.dashes(kUncounted.width, kContact); }};
constexpr Swatch kCoplanarSwatch{LegendGroup::Points, 23,
                                 [](auto& pen) { pen.area(kAxis, 0.45f, 1.5); }};
constexpr LineStyle kOpenEdge{4.0f, kAxisText, false, LineStyle::Hidden::Faint};
constexpr Swatch kOpenEdgeSwatch{LegendGroup::Points, 26, [](auto& pen) {
                                   pen.level_line(0, 23, kOpenEdge.width, kOpenEdge.color);
                                 }};

/// If more than this share of a mesh crosses, no triangle is highlighted.
constexpr double kMaxOfMesh = 0.5;

/// Returns whether any is drawn.
bool draw_triangles(const PlacedShape* mesh, const std::set<int>& triangles, const Color& color,
                    float fill, Sketch& sketch) {
  if (mesh == nullptr || triangles.empty()) return false;
  if (static_cast<double>(triangles.size()) >
      kMaxOfMesh * static_cast<double>(mesh->traced().faces.size()))
    return false;
  for (const int triangle : triangles) {
    if (triangle < 0 || triangle >= count_of(mesh->traced().faces)) continue;
    sketch.face(mesh->polygon(triangle), with_alpha(color, fill),
                {1.0f, with_alpha(color, 0.6f), false, LineStyle::Hidden::Gone});
  }
  return true;
}

/// A triangle without area is drawn as a line.
void draw_degenerate(const PlacedShape* mesh, int triangle, Sketch& sketch) {
  if (mesh == nullptr || triangle < 0 || triangle >= count_of(mesh->traced().faces)) return;
  sketch.outline(mesh->polygon(triangle),
                 {4.0f, with_alpha(kAxisText, 0.8f), false, LineStyle::Hidden::Faint});
  for (const Vec3d& corner : mesh->polygon(triangle)) sketch.mark(MarkKind::Dot, corner, kAxisText);
  sketch.explain(kDegenerateSwatch, "triangle without an area", mesh->polygon(triangle)[0]);
}

/// Shared segments, and isolated points that end no segment. Different style if the answer is no
/// nevertheless, as for an exclusive comparison.
void draw_segments(const trace::Pair& pair, Sketch& sketch) {
  const bool counts = pair.overlap.value_or(true);
  const auto before = [](const Vec3d& p, const Vec3d& q) {
    return std::ranges::lexicographical_compare(p, q);
  };
  std::vector<Vec3d> ends, points;
  std::set<std::array<double, 6>> dashed;  // each once: repeated dashes would fill the gaps
  for (const trace::Intersection& meeting : pair.intersections) {
    if (!meeting.segment) continue;
    auto [from, to] = *meeting.segment;
    if (from == to) {
      points.push_back(from);
      continue;
    }
    if (before(to, from)) std::swap(from, to);
    if (!counts && !dashed.insert({from.x(), from.y(), from.z(), to.x(), to.y(), to.z()}).second)
      continue;
    // White between the dashes, because an edge of a mesh is there as well.
    if (!counts) sketch.line(from, to, {kUncounted.width + 2, kWhite});
    sketch.line(from, to,
                counts ? LineStyle{3.5f, kContact, false, LineStyle::Hidden::Faint} : kUncounted);
    if (counts)
      sketch.explain(kMeetingCurveSwatch, "where the surfaces meet");
    else
      sketch.explain(kUncountedSwatch, "where they touch, which does not count");
    ends.insert(ends.end(), {from, to});
  }
  std::ranges::sort(ends, before);
  for (const Vec3d& point : points) {
    if (std::ranges::binary_search(ends, point, before)) continue;
    sketch.mark(counts ? MarkKind::Dot : MarkKind::Hollow, point, kContact);
    if (counts)
      sketch.explain(kTouchSwatch, "a point where they touch", point);
    else
      sketch.explain(kUncountedSwatch, "where they touch, which does not count", point);
  }
}

/// Open edges of a mesh that has no inside.
void draw_open_edges(const PlacedShape* mesh, const std::string& containment, Sketch& sketch) {
  if (mesh == nullptr || containment != "open") return;
  for (const ShapeMesh::Edge& edge : mesh->mesh->edges) {
    if (edge.left >= 0 && edge.right >= 0) continue;
    sketch.line(mesh->vertex(edge.from), mesh->vertex(edge.to), kOpenEdge);
    sketch.explain(kOpenEdgeSwatch, "edge at which the surface ends");
  }
}

// Not faint, because the picture is about this mesh.
constexpr LineStyle kInsideEdge{1.8f, kShapeEdge, true};
constexpr Swatch kInsideSwatch{LegendGroup::Points, 27,
                               [](auto& pen) { pen.dashes(kInsideEdge.width, kShapeEdge); }};

/// Edges of a mesh that is inside another one: those that would be visible without it.
void draw_inside(const Scene& scene, const PlacedShape* mesh, const std::string& containment,
                 Sketch& sketch) {
  if (mesh == nullptr || containment != "inside") return;
  const auto seen = [&](int face) {
    return face >= 0 && scene.camera.faces(mean_of(mesh->polygon(face)), mesh->normal(face));
  };
  for (const ShapeMesh::Edge& edge : mesh->mesh->edges) {
    if (edge.smooth || (!seen(edge.left) && !seen(edge.right))) continue;
    sketch.line(mesh->vertex(edge.from), mesh->vertex(edge.to), kInsideEdge);
    sketch.explain(kInsideSwatch, "inside the other");
  }
}

void draw_intersections(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const PlacedShape *a = scene.find(pair.a), *b = scene.find(pair.b);
  std::array<std::set<int>, 2> crossing, coplanar;  // triangles of A, and of B
  for (const trace::Intersection& meeting : pair.intersections) {
    if (meeting.kind == "touching") continue;
    auto& [of_a, of_b] = meeting.kind == "coplanar" ? coplanar : crossing;
    of_a.insert(meeting.a);
    of_b.insert(meeting.b);
  }
  const auto draw_both = [&](const auto& triangles, const Color& color, float fill) {
    const bool any_of_a = draw_triangles(a, triangles[0], color, fill, sketch);
    return draw_triangles(b, triangles[1], color, fill, sketch) || any_of_a;
  };
  // Next to the boxes of trees the line of intersection is enough.
  if (!scene.shows(Layer::Tree) && draw_both(crossing, kContact, 0.22f))
    sketch.explain(kCrossingTriangleSwatch, "triangle that crosses the other mesh");
  if (draw_both(coplanar, kAxis, 0.35f))
    sketch.explain(kCoplanarSwatch, "triangles that overlap in one plane");
  for (const trace::Intersection& meeting : pair.intersections) {
    if (meeting.a_degenerate) draw_degenerate(a, meeting.a, sketch);
    if (meeting.b_degenerate) draw_degenerate(b, meeting.b, sketch);
  }
  draw_segments(pair, sketch);
  if (!pair.query || !pair.query->containment) return;
  draw_open_edges(a, pair.query->containment->a, sketch);
  draw_open_edges(b, pair.query->containment->b, sketch);
  draw_inside(scene, a, pair.query->containment->a, sketch);
  draw_inside(scene, b, pair.query->containment->b, sketch);
}

}  // namespace

const LayerDrawing kIntersectionsLayer{.needs = {&Stages::query}, .result = draw_intersections};

}  // namespace contactscope::draw
