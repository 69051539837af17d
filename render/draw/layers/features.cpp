#include "draw/layers/layer.h"
#include "draw/scene/pairs.h"
#include "draw/scene/points.h"

/// The touching features: a corner, edge or face of one shape on a face of the other, or two edges.
/// They name the contact and determine how many points it can have.
namespace contactscope::draw {
namespace {

constexpr Swatch kTouchingFeatureSwatch{LegendGroup::Faces, 6,
                                        [](auto& pen) { pen.level_line(0, 22, 5, kIncidentFace); }};

constexpr Swatch kVerticesSwatch{LegendGroup::Faces, 5,
                                 [](auto& pen) { pen.dot(0, 5, kIncidentFace); }};
constexpr Swatch kFacesSwatch{LegendGroup::Faces, 8,
                              [](auto& pen) { pen.area(kIncidentFace, 0.22f, 0); }};

/// The edge with both ends farthest along `direction`.
std::optional<std::array<Vec3d, 2>> farthest_edge(const PlacedShape& shape,
                                                  const Vec3d& direction) {
  const auto best = std::ranges::max_element(shape.mesh->edges, {}, [&](const auto& edge) {
    return direction.dot(shape.vertex(edge.from)) + direction.dot(shape.vertex(edge.to));
  });
  if (best == shape.mesh->edges.end()) return std::nullopt;
  return {{shape.vertex(best->from), shape.vertex(best->to)}};
}

/// A corner, edge or face of a hull that touches a face of the other shape.
struct TouchingFeature {
  const PlacedShape* shape = nullptr;
  std::string_view kind;  // "point", "edge" or "face"
  Vec3d direction;        // unit, towards the touched face
};

/// Nothing for crossed edges and round shapes.
std::optional<TouchingFeature> feature_on_face(const Scene& scene, const trace::Pair& pair,
                                               const trace::Manifold& manifold) {
  // Closest points of a capsule may belong to two edges as well.
  if (manifold.points.empty() || manifold.axis == "edge_edge" || manifold.type == "edge-edge")
    return std::nullopt;
  // The face is the reference. The type starts with the lesser feature, on the other shape.
  const bool of_b = manifold.axis != "face_b";
  const PlacedShape* shape = scene.find(of_b ? pair.b : pair.a);
  if (shape == nullptr || shape->vertices.empty() || shape->mesh->normals.empty())
    return std::nullopt;
  const std::string_view type = manifold.type;
  return TouchingFeature{shape, type.substr(0, type.find('-')),
                         of_b ? Vec3d(-manifold.normal) : manifold.normal};
}

/// "face that touches", or a list of kinds if the frame has several.
std::string words_of(const Scene& scene, std::string_view kind) {
  for (const trace::Pair& pair : scene.frame.pairs)
    for (const trace::Manifold& manifold : pair.manifolds) {
      const auto other = feature_on_face(scene, pair, manifold);
      if (other && other->kind != kind) return "corner, edge or face that touches";
    }
  return std::string(kind == "point" ? "corner" : kind) + " that touches";
}

// In the colour of the incident face, to which the features belong.
void draw_feature(const TouchingFeature& feature, const std::string& words, bool has_contact,
                  Sketch& sketch) {
  const auto& [placed, kind, direction] = feature;
  const PlacedShape& shape = *placed;
  if (kind == "point") {
    const auto corner = std::ranges::max_element(
        shape.vertices, {}, [&](const Vec3d& vertex) { return feature.direction.dot(vertex); });
    sketch.mark(MarkKind::WideRing, *corner, kIncidentFace);
    if (!has_contact) sketch.mark(MarkKind::Dot, *corner, kIncidentFace);
  } else if (kind == "edge") {
    const auto edge = farthest_edge(shape, direction);
    if (!edge) return;
    sketch.line((*edge)[0], (*edge)[1], {6.0f, kIncidentFace});
  } else if (kind == "face") {
    int best = 0;
    for (int face = 1; face < count_of(shape.mesh->normals); ++face)
      if (direction.dot(shape.normal(face)) > direction.dot(shape.normal(best))) best = face;
    sketch.face(shape.polygon(best), with_alpha(kIncidentFace, 0.35f), {5.0f, kIncidentFace});
  } else {
    return;
  }
  sketch.explain(kTouchingFeatureSwatch, words);
}

void draw_crossed_edges(const Scene& scene, const trace::Pair& pair,
                        const trace::Manifold& manifold, Sketch& sketch) {
  for (const PairFeature& edge : edges_in(manifold.points.front().id)) {
    const auto ends = scene.edge(edge.of_a ? pair.a : pair.b, edge.index);
    if (!ends) continue;
    sketch.line((*ends)[0], (*ends)[1], {6.0f, kAxis});
    sketch.explain(kDecidingEdgesSwatch, "edges that cross");
  }
}

/// One corner of a vertex, two of an edge, all of a face; none if the hull has no such feature.
std::vector<Vec3d> corners_of(const PlacedShape& shape, const PairFeature& feature) {
  if (feature.index < 0) return {};
  if (feature.kind == 'v' && feature.index < count_of(shape.vertices))
    return {shape.vertex(feature.index)};
  if (const auto ends = shape.edge(feature.index); feature.kind == 'e' && ends)
    return {ends->begin(), ends->end()};
  if (feature.kind == 'f' && feature.index < count_of(shape.mesh->normals))
    return shape.polygon(feature.index);
  return {};
}

constexpr Swatch kWalkSwatch{LegendGroup::Faces, 7, [](auto& pen) {
                               pen.level_line(0, 22, 3, kClipPolygon);
                               pen.dot(0, 3.5, kClipPolygon);
                             }};

constexpr Swatch kRegionSwatches[] = {
    {LegendGroup::Faces, 8, [](auto& pen) { pen.box(with_alpha(kArcOfA, 0.15f), kArcOfA, 1); }},
    {LegendGroup::Faces, 9, [](auto& pen) { pen.box(with_alpha(kArcOfB, 0.15f), kArcOfB, 1); }}};

/// The Voronoi region of a feature with these corners, between the normals of the faces that meet
/// there. Mirtich 1998, section 2.1.
void draw_region(const PlacedShape& shape, const std::vector<Vec3d>& corners, bool of_a,
                 Sketch& sketch) {
  const Color color = of_a ? kArcOfA : kArcOfB, fill = with_alpha(color, 0.15f);
  const LineStyle border{1.2f, color, true};
  std::vector<Vec3d> out;  // its edges, as long as the shape: it has no end
  for (int face = 0; face < count_of(shape.mesh->normals); ++face) {
    const std::vector<Vec3d> polygon = shape.polygon(face);
    const auto is_on = [&](const Vec3d& corner) { return std::ranges::count(polygon, corner) > 0; };
    if (std::ranges::all_of(corners, is_on))
      out.push_back(0.6 * shape.mesh->radius * shape.normal(face));
  }
  for (std::size_t k = 0; k < out.size(); ++k) {
    for (std::size_t i = 0; i < (corners.size() > 2 ? corners.size() : corners.size() - 1); ++i) {
      const Vec3d &from = corners[i], &to = corners[(i + 1) % corners.size()];
      sketch.face({from, to, to + out[k], from + out[k]}, fill, border);
    }
    for (std::size_t other = 0; other < k; ++other)  // at a corner of three faces all are adjacent
      for (const Vec3d& corner : corners)
        sketch.face({corner, corner + out[k], corner + out[other]}, fill, border);
  }
  sketch.explain(kRegionSwatches[of_a ? 0 : 1],
                 of_a ? "Voronoi region of A's feature: nearest to it" : "the same for B");
}

/// The features that V-Clip compares in this frame, and the path over the middles of those before.
void draw_walk(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const std::vector<trace::WalkStep>& walk = pair.query->walk;
  const int last = count_of(walk) - 1;
  const bool story = scene.view.story == Story::WalkSteps;
  const int shown = story ? std::clamp(scene.frame.frame, 0, last) : last;
  std::vector<Vec3d> ends;  // of the distance, if two corners are compared
  for (const bool of_a : {true, false}) {
    const PlacedShape* shape = scene.find(of_a ? pair.a : pair.b);
    if (shape == nullptr) continue;
    std::vector<Vec3d> corners;
    std::optional<Vec3d> before;
    for (int k = 0; k <= shown; ++k) {
      for (const PairFeature& feature : features_in(at(walk, k).features))
        if (feature.of_a == of_a) corners = corners_of(*shape, feature);
      if (corners.empty()) return;
      const Vec3d middle = mean_of(corners);
      if (before && middle == *before) continue;
      if (before) sketch.line(*before, middle, {3, kClipPolygon});
      if (!before && shown > 0 && shown < last) sketch.label(middle, "start", kText, 16, 8);
      if (k < shown) sketch.mark(MarkKind::Node, middle, kClipPolygon);
      if (shown == last) sketch.label(middle, std::to_string(k), kText, 15, 8);
      before = middle;
    }
    if (of_a || shown < last) draw_region(*shape, corners, of_a, sketch);
    if (shown > 0 && shown < last) sketch.label(mean_of(corners), "now", kText, 16, 8);
    if (corners.size() == 1) {
      sketch.mark(MarkKind::WideRing, corners[0], kIncidentFace);
      ends.push_back(corners[0]);
    }
    if (corners.size() == 2) sketch.line(corners[0], corners[1], {6, kIncidentFace});
    if (corners.size() > 2)
      sketch.face(corners, with_alpha(kIncidentFace, 0.35f), {5, kIncidentFace});
  }
  sketch.explain(kTouchingFeatureSwatch,
                 shown < last
                     ? "features that are compared, " +
                           spell_length(at(walk, shown).distance, 0, scene.scales.length) + " apart"
                     : "closest features");
  if (shown > 0)
    sketch.explain(kWalkSwatch, shown == last ? "middles of the features, by step"
                                              : "middles of the features before");
  const trace::Query& query = *pair.query;
  if (shown == last && query.point_a && query.point_b) ends = {*query.point_a, *query.point_b};
  if (ends.size() == 2)
    draw_gap(scene, ends[0], ends[1], (ends[1] - ends[0]).norm(), scene.noise(pair), 16,
             scene.camera.right(), sketch);
}

void draw_features(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (pair.query && !pair.query->walk.empty()) draw_walk(scene, pair, sketch);
  for (const trace::Manifold& manifold : pair.manifolds) {
    if (manifold.points.empty()) continue;
    if (manifold.axis == "edge_edge" || manifold.type == "edge-edge")
      draw_crossed_edges(scene, pair, manifold, sketch);
    else if (const auto feature = feature_on_face(scene, pair, manifold))
      draw_feature(*feature, words_of(scene, feature->kind), scene.shows(Layer::Contacts), sketch);
  }
}

// Gregorius 2015, "Collision Shapes: Convex Hull": what hulls in no pair store.
void draw_stored_features(const Scene& scene, Sketch& sketch) {
  for (const PlacedShape& shape : scene.shapes) {
    const std::string& name = shape.traced().name;
    const bool is_paired = std::ranges::any_of(scene.frame.pairs, [&](const trace::Pair& pair) {
      return pair.a == name || pair.b == name;
    });
    if (is_paired || shape.is_mesh() || shape.traced().faces.empty()) continue;
    const int faces = count_of(shape.traced().faces);
    for (int face = 0; face < faces; ++face)
      sketch.surfaces.push_back({shape.polygon(face), with_alpha(kIncidentFace, 0.22f)});
    for (const ShapeMesh::Edge& edge : shape.mesh->edges)
      sketch.line(shape.vertex(edge.from), shape.vertex(edge.to),
                  {5, kIncidentFace, false, LineStyle::Hidden::Faint});
    for (const Vec3d& vertex : shape.vertices) sketch.mark(MarkKind::Dot, vertex, kIncidentFace);
    sketch.explain(kVerticesSwatch, counted(shape.vertices.size(), "vertex", "vertices"));
    sketch.explain(kTouchingFeatureSwatch, counted(shape.mesh->edges.size(), "edge", "edges"));
    sketch.explain(kFacesSwatch, counted(std::size_t(faces), "face", "faces"));
  }
}

}  // namespace

const LayerDrawing kFeaturesLayer{.search = draw_features, .above = draw_stored_features};

}  // namespace contactscope::draw
