#include "draw/insets/inset.h"
#include "draw/scene/pairs.h"
#include "draw/scene/points.h"
#include "draw/scene/solid.h"

/// The Gauss maps of A and −B on one sphere: each face is a point, each edge an arc between its two
/// faces. Two edges make a face of the Minkowski difference if their arcs cross. Gregorius 2013,
/// "The Separating Axis Test". A capsule's edge is a full ring: Gregorius 2015, "Capsule vs Hull".
namespace contactscope::draw {
namespace {

constexpr Swatch kArcsOfASwatch{LegendGroup::Directions, 0,
                                [](auto& pen) { pen.level_line(0, 22, 2.5, kArcOfA); }};
constexpr Swatch kArcsOfBSwatch{LegendGroup::Directions, 1,
                                [](auto& pen) { pen.dashes(2.5, kArcOfB); }};
constexpr Swatch kCrossingSwatch{LegendGroup::Directions, 2,
                                 [](auto& pen) { pen.dot(0, 4.8, kAxis); }};
constexpr Swatch kBestAxisSwatch{LegendGroup::Directions, 3, [](auto& pen) {
                                   pen.dot(0, 3.6, kAxisText);
                                   pen.dot(6.2, 8.2, kAxisText);
                                 }};

constexpr Color kSphere = rgb(0xF3F4F6);
constexpr int kArcSteps = 48, kRingSteps = 96;
// Maximum angle between the best axis and the viewing direction.
constexpr double kInFront = 42 * std::numbers::pi / 180;

bool has_map(const trace::Pair& pair) {
  return pair.kind == "hull-hull" || pair.kind == "capsule-hull" || pair.kind == "hull-capsule";
}

double angle_between(const Vec3d& a, const Vec3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

std::vector<Vec3d> map_arc(const Vec3d& from, const Vec3d& to) {
  const double angle = angle_between(from, to);
  std::vector<Vec3d> points;
  for (int i = 0; i <= kArcSteps; ++i) {
    const double t = static_cast<double>(i) / kArcSteps;
    // Spherical linear interpolation; both ends of an arc of length zero are equal.
    Vec3d point = (1 - t) * from + t * to;
    if (angle > 1e-6)
      point = (std::sin((1 - t) * angle) * from + std::sin(t * angle) * to) / std::sin(angle);
    points.push_back(point.normalized());
  }
  return points;
}

std::vector<Vec3d> map_ring(const Vec3d& axis) {
  const Vec3d u = any_perpendicular(axis);
  const Vec3d v = axis.cross(u);
  return mapped(circle(kRingSteps, kRingSteps + 1),
                [&](const Vec2d& at) -> Vec3d { return at.x() * u + at.y() * v; });
}

/// Crossing of an arc of A with one of B: the normal is a direction that both shapes share.
using MapCrossing = trace::EdgePair;

/// One shape's Gauss map; B's is negated.
class ShapeMap {
 public:
  ShapeMap(const PlacedShape& shape, bool is_a) : shape_(shape), is_a_(is_a) {
    const trace::Shape& solid = *shape.mesh->shape;
    if (solid.faces.empty() && solid.vertices.size() == 2)
      ring_axis_ = (shape.vertices[1] - shape.vertices[0]).normalized();
    std::map<std::pair<int, int>, int> index;  // of the edges, numbered as in ids
    for (std::size_t i = 0; i < solid.edges.size(); ++i)
      index[std::minmax(solid.edges[i][0], solid.edges[i][1])] = static_cast<int>(i);
    for (const ShapeMesh::Edge& edge : shape.mesh->edges) {
      const auto known = index.find(std::minmax(edge.from, edge.to));
      if (edge.right < 0 || known == index.end()) continue;
      arcs_.push_back({known->second, direction(edge.left), direction(edge.right)});
    }
  }

  bool is_ring() const { return ring_axis_.has_value(); }

  /// Gregorius 2015, appendix: a hull's arc crosses a capsule's ring if the normals of its two
  /// faces are on different sides of the ring's plane.
  std::vector<MapCrossing> crossings(const ShapeMap& ring) const {
    std::vector<MapCrossing> found;
    for (const MapArc& arc : arcs_) {
      const double from = arc.from.dot(*ring.ring_axis_), to = arc.to.dot(*ring.ring_axis_);
      if (from * to >= 0) continue;
      const Vec3d at = (std::abs(to) * arc.from + std::abs(from) * arc.to).normalized();
      found.push_back({.a = is_a_ ? arc.edge : 0, .b = is_a_ ? 0 : arc.edge, .normal = at});
    }
    return found;
  }

  /// Draws arcs that cross arcs of the other shape strongly.
  void draw(const Camera& camera, const std::vector<MapCrossing>& crossings, Sketch& sketch) const {
    const std::string name = is_a_ ? "A" : "−B";
    if (is_ring()) {
      draw_curve(camera, map_ring(*ring_axis_), true, sketch);
      sketch.explain(swatch(), "ring of " + name + "'s segment");
      return;
    }
    std::set<int> lit;
    for (const MapCrossing& crossing : crossings) lit.insert(is_a_ ? crossing.a : crossing.b);
    for (const MapArc& arc : arcs_)
      draw_curve(camera, map_arc(arc.from, arc.to), lit.contains(arc.edge), sketch);
    for (int face = 0; face < static_cast<int>(shape_.mesh->normals.size()); ++face) {
      const Vec3d at = direction(face);
      if (camera.faces(at, at)) sketch.mark(MarkKind::Node, at, ink());
    }
    sketch.explain(swatch(), "faces and edges of " + name);
  }

 private:
  struct MapArc {
    int edge;
    Vec3d from, to;
  };

  Vec3d direction(int face) const { return (is_a_ ? 1.0 : -1.0) * shape_.normal(face); }
  Color ink() const { return is_a_ ? kArcOfA : kArcOfB; }
  const Swatch& swatch() const { return is_a_ ? kArcsOfASwatch : kArcsOfBSwatch; }

  // A point on a sphere is visible if its normal faces the eye. Dashes distinguish B's arcs from
  // A's without colours. Arcs without crossings are faint, and hidden ones fainter still.
  void draw_curve(const Camera& camera, const std::vector<Vec3d>& points, bool lit,
                  Sketch& sketch) const {
    const LineStyle front{lit ? 3.0f : 1.5f, with_alpha(ink(), lit ? 1.0f : 0.6f), !is_a_};
    // Half of a ring is always hidden, but is needed to recognise it.
    const LineStyle back{is_ring() ? 2.0f : 1.0f, with_alpha(ink(), is_ring() ? 0.5f : 0.28f),
                         is_ring()};
    bool seen = false;
    for (std::size_t i = 1; i < points.size(); ++i) {
      const bool faces = camera.faces(points[i], points[i]);
      if (i == 1 || faces != seen)
        sketch.curves.push_back({{points[i - 1]}, faces ? front : back, false});
      sketch.curves.back().points.push_back(points[i]);
      seen = faces;
    }
  }

  const PlacedShape& shape_;
  bool is_a_;
  std::optional<Vec3d> ring_axis_;
  std::vector<MapArc> arcs_;
};

void draw_best(const Vec3d& normal, const std::string& text, bool chosen, const Camera& camera,
               Sketch& sketch) {
  if (!camera.faces(normal, normal)) return;
  sketch.mark(MarkKind::Dot, normal, kAxisText);
  sketch.mark(MarkKind::Ring, normal, kAxisText);
  sketch.label(normal, text, kAxisText, chosen ? 18.0f : 15.0f, 15).bold = chosen;
}

void draw_best_axes(const trace::Sat& sat, double noise, const LengthUnit& unit,
                    const Camera& camera, Sketch& sketch) {
  const bool of_a = sat.chosen == "face_a";
  const auto& face = of_a ? sat.face_a : sat.face_b;
  if (face && (of_a || sat.chosen == "face_b"))
    draw_best(
        face->normal,
        (of_a ? "face of A: " : "face of B: ") + spell_separation(face->separation, noise, unit),
        true, camera, sketch);
  if (sat.edge)
    draw_best(sat.edge->normal,
              "edge of A × edge of B, " + spell_separation(sat.edge->separation, noise, unit),
              sat.chosen == "edge_edge", camera, sketch);
  sketch.explain(kBestAxisSwatch, "best axis of a query");
}

/// The direction that the picture is about; zero if there is none.
Vec3d best_direction(const trace::Pair& pair) {
  if (pair.sat && pair.sat->edge) return pair.sat->edge->normal;
  return pair.manifolds.empty() ? Vec3d(Vec3d::Zero()) : pair.manifolds.front().normal;
}

std::vector<MapCrossing> crossings_of(const trace::Pair& pair, const ShapeMap& a,
                                      const ShapeMap& b) {
  if (pair.sat && !pair.sat->edge_pairs.empty()) return pair.sat->edge_pairs;
  if (a.is_ring() == b.is_ring()) return {};
  return a.is_ring() ? b.crossings(a) : a.crossings(b);
}

}  // namespace

Vec3d gauss_map_direction(const std::vector<trace::Frame>& frames, const Vec3d& usual) {
  for (const trace::Frame& frame : frames) {
    const trace::Pair* pair = first_pair(frame, has_map);
    const Vec3d axis = pair == nullptr ? Vec3d(Vec3d::Zero()) : best_direction(*pair);
    if (axis.isZero()) continue;
    const Vec3d across = usual - usual.dot(axis) * axis;
    if (angle_between(axis, usual) <= kInFront || across.norm() < 1e-6) return usual;
    return std::cos(kInFront) * axis + std::sin(kInFront) * across.normalized();
  }
  return usual;
}

InsetPicture sketch_gauss_map(const Inset& inset, const Scene& scene) {
  InsetPicture picture;
  picture.heading = "Gauss map of A and −B";
  Sketch& sketch = picture.sketch;
  draw_body(inset.camera, {{Vec3d::Zero()}, 1}, kSphere, {1.5f, with_alpha(kShapeEdge, 0.6f)},
            sketch);
  const trace::Pair* pair = first_pair(scene.frame, has_map);
  if (pair == nullptr) {
    sketch.label(Vec3d::Zero(), "no two hulls, nor a hull and a capsule", kQuietText, 15, 0).bold =
        false;
    return picture;
  }
  const PlacedShape *placed_a = scene.find(pair->a), *placed_b = scene.find(pair->b);
  if (placed_a == nullptr || placed_b == nullptr) return picture;
  const ShapeMap a(*placed_a, true), b(*placed_b, false);
  const std::vector<MapCrossing> crossings = crossings_of(*pair, a, b);
  a.draw(inset.camera, crossings, sketch);
  b.draw(inset.camera, crossings, sketch);
  std::size_t in_front = 0;
  for (const MapCrossing& crossing : crossings) {
    if (!inset.camera.faces(crossing.normal, crossing.normal)) continue;
    ++in_front;
    sketch.mark(MarkKind::Dot, crossing.normal, kAxis);
    sketch.explain(kCrossingSwatch, "arcs that cross");
  }
  if (pair->sat) {
    draw_best_axes(*pair->sat, scene.noise(*pair), scene.scales.length, inset.camera, sketch);
  } else if (!pair->manifolds.empty()) {
    draw_best(
        pair->manifolds.front().normal,
        "normal, " + spell_separation(pair->separation, scene.noise(*pair), scene.scales.length),
        true, inset.camera, sketch);
    sketch.explain(kBestAxisSwatch, "normal of the contact");
  }
  const std::size_t count = crossings.size();
  if (count > 0) picture.note = counted(count, "pair of arcs crosses", "pairs of arcs cross");
  if (in_front < count) picture.note += ", " + std::to_string(in_front) + " in front";
  return picture;
}

}  // namespace contactscope::draw
