#include "draw/layers/layer.h"
#include "draw/scene/pairs.h"
#include "draw/scene/solid.h"

namespace contactscope::draw {
namespace {

// A margin narrower than this share of the shape is not visible, and its core would hide marks.
constexpr double kSeenMargin = 0.02;
constexpr Color kInside = with_alpha(kShapeEdge, 0.6f);
constexpr Swatch kMarginSwatch{LegendGroup::Shapes, 2,
                               [](auto& pen) { pen.area(kInside, 0, 1.2, true); }};

bool shows_margin(const PlacedShape& shape) {
  const trace::Shape* const core = shape.mesh->core;
  return core != nullptr && core->margin > kSeenMargin * shape.mesh->radius;
}

// Edges of the core within the margin, like the segment in a capsule.
void draw_core(const PlacedShape& shape, Sketch& sketch) {
  for (int e = 0; e < count_of(shape.mesh->core->edges); ++e)
    if (const auto ends = shape.edge(e)) sketch.line((*ends)[0], (*ends)[1], {1.0f, kInside, true});
}

// With more shapes than this, hidden edges would only be noise.
bool is_full(const Scene& scene) { return scene.shapes.size() > 100 || scene.scales.heap; }

// Shapes around those in focus, which they would hide.
constexpr LineStyle kContextOutline{1.0f, with_alpha(kShapeEdge, 0.3f)};

constexpr LineStyle kWallOutline{1.6f, with_alpha(kShapeEdge, 0.6f)};

// A wall of a container between the eye and a heap: it is thin, most shapes are much smaller, and
// nearly all of these are behind one of its faces.
bool is_front_wall(const Scene& scene, const PlacedShape& wall) {
  if (!scene.scales.heap || wall.is_mesh() || wall.traced().half_space) return false;
  constexpr double kWall = 2.5, kBehind = 0.7;  // radii of the smaller shapes; share of them
  constexpr double kMaxThickness = 0.5;         // of its radius
  std::vector<Vec3d> centers;
  for (const PlacedShape& shape : scene.shapes)
    if (kWall * shape.mesh->radius < wall.mesh->radius)
      centers.push_back(shape.pose.transform(shape.traced().center_of_mass));
  if (2 * centers.size() < scene.shapes.size()) return false;
  for (int f = 0; f < count_of(wall.traced().faces); ++f) {
    const Vec3d on = wall.polygon(f).front(), normal = wall.normal(f);
    const auto below = [&](const Vec3d& vertex) { return normal.dot(on - vertex); };
    if (scene.camera.faces(on, normal) ||
        below(std::ranges::max(wall.vertices, {}, below)) > kMaxThickness * wall.mesh->radius)
      continue;
    const auto behind =
        std::ranges::count_if(centers, [&](const Vec3d& c) { return normal.dot(c - on) > 0; });
    if (double(behind) > kBehind * double(centers.size())) return true;
  }
  return false;
}

// With the edges between two front faces, so that the wall is seen to stand in front of the heap.
void draw_wall(const Camera& camera, const PlacedShape& wall, Sketch& sketch) {
  draw_ghost(camera, wall, kWallOutline, sketch);
  const auto front = [&](int face) {
    return face >= 0 && camera.faces(wall.polygon(face).front(), wall.normal(face));
  };
  for (const ShapeMesh::Edge& edge : wall.mesh->edges)
    if (front(edge.left) && front(edge.right))
      sketch.line(wall.vertex(edge.from), wall.vertex(edge.to), kWallOutline);
}

// Surfaces of a heap hide what is behind them: translucent ones on each other have no outlines.
void make_opaque(std::span<Surface> surfaces) {
  for (Surface& surface : surfaces) {
    if (surface.kind != Surface::Kind::Body) continue;
    const float alpha = surface.color.a;
    for (float Color::*const part : {&Color::r, &Color::g, &Color::b})
      surface.color.*part = alpha * surface.color.*part + (1 - alpha);  // over white
    surface.color.a = 1;
  }
}

// Removes hidden edges and core marks that were added after these counts.
void hide_insides(std::size_t lines, std::size_t curves, std::size_t marks, Sketch& sketch) {
  for (Line& line : std::span(sketch.lines).subspan(lines))
    line.style.hidden = LineStyle::Hidden::Gone;
  for (Curve& curve : std::span(sketch.curves).subspan(curves))
    curve.style.hidden = LineStyle::Hidden::Gone;
  sketch.marks.resize(marks);
}

// With a field, its surface is the subject. The shape shows only what the field has lost.
constexpr LineStyle kLostOutline{1.3f, kDropped, true, LineStyle::Hidden::Same};
constexpr float kWithin = 1.2f;      // thinner lines are not outlines
constexpr double kMinLost = 0.15;    // cells from the field's surface, at some point
constexpr double kOnSurface = 0.02;  // cells from the surface, at all points
constexpr int kOutlineSteps = 256;
constexpr Swatch kLostSwatch{LegendGroup::Shapes, 3,
                             [](auto& pen) { pen.dashes(kLostOutline.width, kLostOutline.color); }};

const trace::FieldSlice* slice_of(const Scene& scene, const PlacedShape& shape) {
  if (!scene.shows(Layer::Field)) return nullptr;
  const auto& slices = scene.frame.field_slices;
  const auto found =
      std::ranges::find(slices, shape.traced().name, [](const auto& slice) { return slice.name; });
  return found == slices.end() ? nullptr : &*found;
}

// Distance in cells, for a place projected along the slice's normal; nothing outside the slice.
std::optional<double> distance_at(const trace::FieldSlice& slice, const Vec3d& place) {
  const Vec3d offset = place - slice.origin;
  const double column = offset.dot(slice.next) / slice.next.squaredNorm();
  const double row = offset.dot(slice.next_row) / slice.next_row.squaredNorm();
  const int left = static_cast<int>(std::floor(column)), below = static_cast<int>(std::floor(row));
  if (left < 0 || below < 0 || left + 1 >= slice.columns || below + 1 >= slice.rows()) return {};
  const auto value = [&](int x, int y) { return at(slice.distances, y * slice.columns + x); };
  const double u = column - left, v = row - below;
  return (1 - v) * ((1 - u) * value(left, below) + u * value(left + 1, below)) +
         v * ((1 - u) * value(left, below + 1) + u * value(left + 1, below + 1));
}

// Replaces the lines that were added after this count.
void draw_what_is_lost(const trace::FieldSlice& slice, std::size_t lines, Sketch& sketch) {
  const Vec3d normal = slice.next.cross(slice.next_row).normalized();
  const std::size_t first = sketch.curves.size();
  // Edges that coincide on the screen are drawn once, because their dashes would fill the gaps.
  const auto add_once = [&](const std::vector<Vec3d>& ends) {
    const auto seen_together = [&](const Vec3d& p, const Vec3d& q) {
      return normal.cross(p - q).norm() < kMinLost * slice.cell;
    };
    for (const Curve& other : std::span(sketch.curves).subspan(first)) {
      const Vec3d &p = other.points.front(), &q = other.points.back();
      if ((seen_together(ends[0], p) && seen_together(ends[1], q)) ||
          (seen_together(ends[0], q) && seen_together(ends[1], p)))
        return;
    }
    sketch.curves.push_back({ends, kLostOutline});
  };
  for (const Line& line : std::span(sketch.lines).subspan(lines)) {
    const Vec3d offset = line.to - line.from;
    if (line.style.width < kWithin || normal.cross(offset).norm() < kMinLost * slice.cell) continue;
    std::vector<Vec3d> outside;  // consecutive points of the line
    double farthest = 0;
    for (int i = 0; i <= kOutlineSteps + 1; ++i) {
      const Vec3d place = line.from + i * offset / kOutlineSteps;
      const double away = i > kOutlineSteps ? 0 : distance_at(slice, place).value_or(0);
      if (away > kOnSurface) {
        outside.push_back(place);
        farthest = std::max(farthest, away);
        continue;
      }
      if (outside.size() > 1 && farthest > kMinLost) add_once({outside.front(), outside.back()});
      outside.clear();
      farthest = 0;
    }
  }
  sketch.lines.resize(lines);
  if (sketch.curves.size() > first)
    sketch.explain(kLostSwatch, "what the field has lost of the shape");
}

void draw_shapes(const Scene& scene, Sketch& sketch) {
  const std::size_t lines = sketch.lines.size(), curves = sketch.curves.size(),
                    marks = sketch.marks.size();
  for (const PlacedShape& shape : scene.shapes) {
    const bool is_wall = is_front_wall(scene, shape);
    if (is_wall || scene.is_context(shape)) {
      if (is_wall)
        draw_wall(scene.camera, shape, sketch);
      else if (!shape.traced().half_space)
        draw_ghost(scene.camera, shape, kContextOutline, sketch);
      continue;
    }
    const Color fill = shape.is_a ? kShapeA : kShapeB;
    const std::size_t before = sketch.lines.size(), occluders = sketch.occluders.size();
    if (shape.is_mesh()) {
      draw_mesh(scene, shape, fill, sketch);
    } else {
      const bool heap = scene.scales.heap;
      const auto draw = shape.traced().half_space   ? draw_plane
                        : shape.traced().radius > 0 ? (heap ? draw_small_round : draw_round)
                        : heap                      ? draw_small_solid
                                                    : draw_solid;
      draw(scene.camera, shape, fill, sketch);
    }
    if (const trace::FieldSlice* slice = slice_of(scene, shape)) {
      draw_what_is_lost(*slice, before, sketch);
      // The shape is cut along the slice. The part in front is removed and hides nothing.
      sketch.occluders.resize(occluders);
    }
    if (shows_margin(shape)) draw_core(shape, sketch);
  }
  if (is_full(scene)) hide_insides(lines, curves, marks, sketch);
  if (scene.scales.heap) make_opaque(sketch.surfaces);
}

// The widest margin, because a wrong margin is the first suspect if bodies float.
void explain_margin(const Scene& scene, Legend& legend) {
  if (is_full(scene)) return;
  const PlacedShape* widest = nullptr;
  for (const PlacedShape& shape : scene.shapes) {
    if (!shows_margin(shape) || !in_view(scene.camera, shape)) continue;
    if (widest == nullptr || shape.mesh->core->margin > widest->mesh->core->margin) widest = &shape;
  }
  if (widest == nullptr) return;
  const trace::Shape& core = *widest->mesh->core;
  if (!scene.frame.field_slices.empty()) return;  // fields have enough signs of their own
  legend.explain(kMarginSwatch, "shape without its margin of " +
                                    spell_length(core.margin, 0, scene.scales.length));
}

// Measures a shape's margin at its leftmost contact point, once for each shape.
void measure_margin(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  constexpr double kMinMeasured = 30;  // pixels
  if (scene.crowded() || !scene.shows(Layer::Contacts) || scene.shows(Layer::Core)) return;
  const std::vector<PairPoint> points = all_points(pair);
  if (points.empty() || !scene.frame.field_slices.empty()) return;
  const Vec3d right = scene.camera.right();
  const PairPoint& at = *std::ranges::min_element(
      points, {}, [&](const PairPoint& any) { return right.dot(any.point->position); });
  for (const bool of_a : {true, false}) {
    const std::string& name = of_a ? pair.a : pair.b;
    const PlacedShape* shape = scene.find(name);
    const auto touches = [&](const trace::Pair& other) {
      return (other.a == name || other.b == name) && !other.manifolds.empty();
    };
    if (shape == nullptr || !shows_margin(*shape) ||
        &*std::ranges::find_if(scene.frame.pairs, touches) != &pair)
      continue;
    const double margin = shape->mesh->core->margin;
    const Vec3d from = at.point->position,
                to = from + (of_a ? -margin : margin) * at.manifold->normal;
    const std::optional<float> pixels = seen_distance(scene.camera, from, to);
    if (!pixels || *pixels < kMinMeasured * scene.scales.pixel) continue;
    sketch.measure(from, to, 2.2f, 10, kMargin);
    sketch.label(0.5 * (from + to), "margin " + spell_length(margin, 0, scene.scales.length),
                 kMargin, 17, 10, Vec3d(-right));
  }
}

}  // namespace

const LayerDrawing kShapesLayer{
    .beneath = draw_shapes, .result = measure_margin, .explain = explain_margin};

}  // namespace contactscope::draw
