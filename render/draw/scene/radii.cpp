#include "draw/scene/outlines.h"
#include "draw/scene/pairs.h"
#include "draw/scene/solid.h"

/// Gregorius 2015, "Sphere vs Sphere", "Sphere vs Capsule", "Capsule vs Capsule", "Sphere vs Hull:
/// Shallow Contact, Deep Contact": the line between the nearest points of the cores, and both radii.
namespace contactscope::draw {
namespace {

// Pixels at 720 lines.
constexpr double kColumn =
    34;  // from the line between the cores to the first length, and between lengths
constexpr double kBeyondColumn = 6;  // a line from a core extends this far beyond its column
constexpr double kMinLength = 12;
// Position of the text along a length: nearer to its core than to the overlap of both radii.
constexpr double kLabelled = 0.4;
constexpr float kLengthSize = 17, kSumSize = 20, kCoreSize = 16;
constexpr double kCoreGap = 14;      // from a core to its name
constexpr double kBeneathAxis = 34;  // from a core to its name, where the axis continues
constexpr double kOnArrow = 45, kSideOfRightAngle = 44;
constexpr double kSame = 1e-4;  // of a shape's size: nearer points count as the same

constexpr LineStyle kVirtual{1.8f, kShapeEdge, true, LineStyle::Hidden::Same};
constexpr LineStyle kToColumn{1.0f, with_alpha(kQuietText, 0.8f)};
constexpr LineStyle kAlongAxis{2.2f, kShapeEdge, false, LineStyle::Hidden::Same};
constexpr LineStyle kRightAngle{1.6f, kText, false, LineStyle::Hidden::Same};
constexpr Swatch kVirtualSwatch{LegendGroup::Cores, 4, [](auto& pen) {
                                  for (const double from : {0.0, 8.0, 16.0})
                                    pen.level_line(from, from + 6, 1.8, kShapeEdge);
                                }};

/// Nearest points of the cores of two shapes; the core of a hull is its surface.
struct Cores {
  Vec3d a, b;
  Vec3d normal;           // unit, from A to B
  double separation = 0;  // metres, between the surfaces
};

bool is_pill(const PlacedShape& shape) {
  return shape.traced().radius > 0 && shape.vertices.size() == 2;
}

// At each contact point. For separated shapes at their nearest points, if the trace contains them.
std::vector<Cores> cores_of(const Scene& scene, const trace::Pair& pair, const PlacedShape& a,
                            const PlacedShape& b) {
  const double radius_a = a.traced().radius, radius_b = b.traced().radius;
  std::vector<Cores> cores;
  for (const PairPoint& at : all_points(pair)) {
    const Vec3d& normal = at.manifold->normal;
    const OnBoth surfaces = surfaces_at(scene, pair, at);
    cores.push_back({surfaces.on_a - radius_a * normal, surfaces.on_b + radius_b * normal, normal,
                     at.point->separation});
  }
  if (!cores.empty() || !(pair.separation > 0)) return cores;
  std::optional<OnBoth> nearest;
  if (is_ball(a) && is_ball(b)) nearest = {a.vertices[0], b.vertices[0]};
  if (pair.gjk && pair.gjk->status == "separated") nearest = {pair.gjk->point_a, pair.gjk->point_b};
  if (!nearest || nearest->on_a == nearest->on_b) return {};
  return {{nearest->on_a, nearest->on_b, (nearest->on_b - nearest->on_a).normalized(),
           pair.separation}};
}

/// Millimetres with the digits that the smallest of the lengths needs.
std::string millimetres(double metres, double least) {
  const double digits = std::abs(least) >= 9.95e-3 ? 0 : std::abs(least) >= 0.995e-3 ? 1 : 2;
  return printed("%.*f", static_cast<int>(digits), 1e3 * metres);
}

bool is_end(const PlacedShape& pill, const Vec3d& place) {
  return std::ranges::any_of(pill.vertices, [&](const Vec3d& v) {
    return (v - place).norm() < kSame * pill.mesh->radius;
  });
}

struct RadiiSketch {
  const Scene& scene;
  const PlacedShape& a;
  const PlacedShape& b;
  Sketch& sketch;
  std::optional<std::string> degenerate{};  // geometry without a normal
  double radius_a = a.traced().radius, radius_b = b.traced().radius;

  double metres(const Vec3d& at, double pixels) const {
    return pixels * scene.scales.pixel / scene.camera.pixels_per_metre(at);
  }

  /// The virtual sphere: a ball about the contact's point of a capsule's axis.
  void virtual_sphere(const PlacedShape& shape, const Vec3d& center) {
    if (!is_pill(shape)) return;
    const RoundBody ball{{center}, shape.traced().radius};
    sketch.curves.push_back({ball.outline(scene.camera), kVirtual, true});
    sketch.explain(kVirtualSwatch, "virtual sphere",
                   Vec3d(center + ball.radius * scene.camera.up()));
  }

  void core(const PlacedShape& shape, const Vec3d& at, const Vec3d& away, bool named,
            double clearance = kCoreGap) {
    if (!(shape.traced().radius > 0)) return;
    sketch.mark(MarkKind::Node, at, kText);
    if (!named) return;
    const bool both = (radius_a > 0) == (radius_b > 0);
    const std::string whose = !both ? "" : &shape == &a ? "A's " : "B's ";
    std::string name = whose + "centre";
    if (is_pill(shape)) {
      const bool end = is_end(shape, at);
      name = end ? "end of " + whose + "axis" : "nearest on " + whose + "axis";
      if (!both) name = end ? "end of the axis" : "nearest on the axis";
    }
    sketch.label(at, name, kText, kCoreSize, clearance, away).bold = false;
  }

  /// Direction and distance of the name of B's core. If a capsule's axis continues both ways inside
  /// a hull, the name avoids that axis and the length measured to the surface.
  std::pair<Vec3d, double> next_to_core(const Cores& at, const Vec3d& right) const {
    const bool passed =
        is_pill(b) && !(radius_a > 0) && (at.b - at.a).dot(at.normal) < 0 && !is_end(b, at.b);
    if (passed) return {-2 * at.normal - right, kBeneathAxis};
    return {at.normal + right, kCoreGap};
  }

  /// Cores of two round shapes are "apart"; a hull is solid: the other core is in- or outside.
  const char* stands(double gap) const {
    if (radius_a > 0 && radius_b > 0) return "apart";
    return gap < 0 ? "inside" : "outside";
  }

  /// A length along the line between the cores, drawn in a column parallel to it. Columns are
  /// numbered 1, 2, ... from the line to the right; -1 is on its left.
  void dimension(const Vec3d& from, const Vec3d& offset, const Vec3d& right, int column,
                 const std::string& text, const Color& line, const Color& ink) {
    if (offset.norm() < metres(from, kMinLength)) return;
    const Vec3d outwards = column < 0 ? Vec3d(-right) : right;
    const double pixels = kColumn * std::abs(column);
    const Vec3d sideways = metres(from, pixels) * outwards;
    const Vec3d beyond = metres(from, pixels + kBeyondColumn) * outwards;
    for (const Vec3d& end : {from, Vec3d(from + offset)}) sketch.line(end, end + beyond, kToColumn);
    sketch.measure(from + sideways, from + sideways + offset, 1.8f, 9, line);
    sketch.label(from + sideways + kLabelled * offset, text, ink, kLengthSize, 8, outwards);
  }

  void radius(const Vec3d& from, const Vec3d& offset, const Vec3d& right, int column) {
    const double length = offset.norm();
    dimension(from, offset, right, column, "r " + millimetres(length, length) + " mm", kShapeEdge,
              kText);
  }

  /// Parallel axes: draws on both the stretch between the two contact points.
  void shared_stretch(const Cores& from, const Cores& to) {
    sketch.line(from.a, to.a, kAlongAxis);
    sketch.line(from.b, to.b, kAlongAxis);
    if (degenerate) return;  // the label of collinear axes names that instead
    sketch.label(0.5 * (from.a + to.a), "shared stretch", kText, kCoreSize, kCoreGap, -from.normal)
        .bold = false;
  }

  /// Crossing axes: shows that the normal is at right angles to both of them, so it is their cross
  /// product. In perspective no angle is seen in its true size.
  void cross_product(const Cores& at, const Vec3d& aside) {
    if (scene.shows(Layer::Normals)) {
      const Vec3d on_arrow = at.a + (radius_a + metres(at.a, kOnArrow)) * at.normal;
      sketch.label(on_arrow, "cross product of both axes", kText, kLengthSize, 10, aside);
    }
    const double side = metres(at.a, kSideOfRightAngle);
    for (const PlacedShape* shape : {&a, &b}) {
      const Vec3d axis = shape->vertices[1] - shape->vertices[0];
      // One on each side, so that both are visible.
      const bool is_right = axis.dot(scene.camera.right()) > 0;
      const Vec3d along = is_right == (shape == &b) ? axis : Vec3d(-axis);
      sketch.line(shape->vertices[0], shape->vertices[1], kAlongAxis);
      const Vec3d out = at.a + side * along.normalized(), up = side * at.normal;
      sketch.line(out, out + up, kRightAngle);
      sketch.line(out + up, at.a + up, kRightAngle);
    }
  }

  /// Convex outlines of the round shapes on the screen.
  std::vector<std::vector<Vec2d>> silhouettes() const {
    std::vector<std::vector<Vec2d>> list;
    for (const PlacedShape* shape : {&a, &b}) {
      const double radius = shape->traced().radius;
      if (radius > 0)
        list.push_back(
            outline_around(scene.camera, RoundBody{shape->vertices, radius}.outline(scene.camera)));
    }
    return list;
  }

  /// Edges of a hull on the screen. Text may cover its faces, but not its edges.
  std::vector<Segment2> edges_of_hull() const {
    std::vector<Segment2> list;
    for (const PlacedShape* shape : {&a, &b}) {
      if (shape->traced().radius > 0) continue;
      for (const ShapeMesh::Edge& edge : shape->mesh->edges)
        if (const std::optional<Segment2> seen =
                project_segment(scene.camera, shape->vertex(edge.from), shape->vertex(edge.to)))
          list.push_back(*seen);
    }
    return list;
  }

  /// Box for a text near a point, inside the view, off the round shapes and a hull's edges, and not
  /// along the normal. Prefers the left; nothing if there is no room.
  std::optional<Rect> free_ground(const Vec3d& from, const Vec3d& normal, float width) const {
    constexpr double kRow = 26, kStep = 12, kFarthest = 480;  // pixels
    constexpr int kDirections = 24;
    constexpr float kAlong = 0.93f;   // cosine
    constexpr double kSlanted = 1.5;  // extra cost of a vertical leader
    const Camera& camera = scene.camera;
    const double pixel = scene.scales.pixel, height = kRow * pixel;
    const std::optional<Point2> at = camera.project(from);
    const std::optional<Point2> ahead =
        camera.project(from + 20 / camera.pixels_per_metre(from) * normal);
    if (!at || !ahead) return std::nullopt;
    const float seen = distance(*at, *ahead);
    const std::vector<std::vector<Vec2d>> covered = silhouettes();
    const std::vector<Segment2> edges = edges_of_hull();
    std::optional<Rect> best;
    double least = 0;
    // The cost of a place is at least its reach.
    for (double reach = 3 * kStep; reach < kFarthest && !(best && reach >= least); reach += kStep) {
      for (int i = 0; i < kDirections; ++i) {
        // From the left: 0, +1, -1, +2, ...
        const int step = (i % 2 == 1 ? 1 : -1) * ((i + 1) / 2);
        const double angle = std::numbers::pi + step * 2 * std::numbers::pi / kDirections;
        const auto x = static_cast<float>(std::cos(angle)), y = static_cast<float>(std::sin(angle));
        const Point2 corner = *at + static_cast<float>(reach * pixel) * Point2{x, y};
        const Rect box{x >= 0 ? corner.x : corner.x - width, corner.y - 0.5 * height, width,
                       height};
        const Point2 offset = corner - *at;
        const bool is_along =
            seen > 1 && std::abs(dot(offset, *ahead - *at)) > kAlong * length(offset) * seen;
        const Rect room = box.grown(6 * pixel);
        const Eigen::AlignedBox2d taken(Vec2d(room.x, room.y), Vec2d(room.right(), room.bottom()));
        const auto meets = [&](const auto& outline) { return overlap(outline, taken); };
        const auto crosses = [&](const Segment2& edge) {
          return clip_segment(room, edge.from, edge.to).has_value();
        };
        if (is_along || !camera.viewport().encloses(box) || std::ranges::any_of(covered, meets) ||
            std::ranges::any_of(edges, crosses))
          continue;
        const double cost = reach * (1 + kSlanted * std::abs(y));
        if (best && cost >= least) continue;
        best = box;
        least = cost;
      }
    }
    return best;
  }

  /// The sum: overlap = radii less the distance of the cores. That distance is negative if the core
  /// of a round shape is inside a hull.
  void sum(const Cores& at, const Vec3d& aside) {
    const double gap = (at.b - at.a).dot(at.normal);
    const double least = std::abs(at.separation);
    const bool overlaps = at.separation <= 0;
    std::string text;
    for (const double radius : {radius_a, radius_b}) {
      if (!(radius > 0)) continue;
      text += (text.empty() ? "" : overlaps ? " + " : " − ") + millimetres(radius, least);
    }
    const std::string distance = millimetres(std::abs(gap), least);
    const bool in_one_place = overlaps && distance.find_first_not_of("0.") == std::string::npos;
    const bool is_sum = !in_one_place || (radius_a > 0 && radius_b > 0);
    text = in_one_place ? "overlap " + text
           : overlaps   ? "overlap " + text + (gap < 0 ? " + " : " − ") + distance
                        : "gap " + distance + " − " + text;
    text += (is_sum ? " = " + millimetres(least, least) : "") + " mm";
    // For a hull, the part of the whisker next to which no length is measured.
    const double share = radius_a > 0 && radius_b > 0 ? 0.5 : radius_b > 0 ? 0.75 : 0.25;
    const Vec3d on_a = at.a + radius_a * at.normal, on_b = at.b - radius_b * at.normal;
    const Vec3d middle = (1 - share) * on_a + share * on_b;
    const Color& ink = overlaps ? kContact : kAxisText;
    const float width =
        text_width(text, static_cast<float>(scene.scales.pixel) * kSumSize, FontWeight::Bold);
    const std::optional<Rect> box = free_ground(middle, at.normal, width);
    if (!box) {
      sketch.label(middle, text, ink, kSumSize, 60, aside).leader = true;
      return;
    }
    // A thin line to the nearer side, and the text beyond it.
    const Camera& camera = scene.camera;
    const Point2 foot = *camera.project(middle);
    const bool is_right = box->x + 0.5 * box->width > foot.x;
    const Point2 end = pixel(is_right ? box->x : box->right(), box->y + 0.5 * box->height);
    const Point2 offset = end - foot;
    const Vec3d there = middle + (offset.x * camera.right() - offset.y * camera.up()) /
                                     camera.pixels_per_metre(middle);
    sketch.bordered_line(middle, there, {1.0f, kQuietText}, 3.5f);
    sketch.label(there, text, ink, kSumSize, 4, Vec3d((is_right ? 1.0 : -1.0) * camera.right()));
  }

  void draw(const std::vector<Cores>& all) {
    if (is_pill(a) && is_pill(b) && all.size() == 2) shared_stretch(all[0], all[1]);
    const bool brief = scene.shows(Layer::Overlap);  // which writes the overlap instead
    bool first = true;
    for (const Cores& at : all) {
      // If both points coincide, the spheres are concentric and show nothing that the radii do not.
      const bool in_one_place = (at.b - at.a).norm() < kSame * (a.mesh->radius + b.mesh->radius);
      if (!(in_one_place && is_pill(a) && is_pill(b))) {
        virtual_sphere(a, at.a);
        virtual_sphere(b, at.b);
      }
      const Vec3d across = at.normal.cross(scene.camera.to_eye(at.a));
      const bool end_on = across.norm() < 0.2;
      const Vec3d right = end_on ? scene.camera.right() : Vec3d(across.normalized());
      if (!(at.b - at.a).isZero(1e-9)) sketch.line(at.a, at.b, {1.6f, kAxisText, true});
      if (first && !brief) sum(at, right);  // before the lengths, which then avoid its leader
      // For crossing axes the normal is the subject; the sum names the radii.
      const bool axes_meet = degenerate == "crossing axes" && all.size() == 1;
      if (axes_meet) cross_product(at, right);
      if (first && !end_on && !axes_meet && !brief) {
        radius(at.a, radius_a * at.normal, right, 1);
        radius(at.b, -radius_b * at.normal, right, radius_a > 0 ? 2 : 1);
      }
      core(a, at.a, -at.normal - right, first && !degenerate);
      const auto [aside, clearance] = next_to_core(at, right);
      core(b, at.b, aside, first && !degenerate, clearance);
      if (first && degenerate)
        sketch.label(at.b, *degenerate, kText, kCoreSize, 14, -right - at.normal).bold = false;
      if (first && !brief) {
        const double gap = (at.b - at.a).dot(at.normal);
        const std::string distance =
            millimetres(std::abs(gap), std::abs(gap)) + " mm " + stands(gap);
        if (!end_on) dimension(at.a, at.b - at.a, right, -1, distance, kAxisText, kAxisText);
      }
      first = false;
    }
  }
};

}  // namespace

void draw_radii(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  if (pair.query || pair.incremental || scene.crowded()) return;
  const PlacedShape* a = scene.find(pair.a);
  const PlacedShape* b = scene.find(pair.b);
  if (a == nullptr || b == nullptr || !(a->traced().radius > 0 || b->traced().radius > 0)) return;
  for (const PlacedShape* shape : {a, b})
    if (shape->is_mesh() || shape->traced().half_space) return;
  RadiiSketch drawing{scene, *a, *b, sketch};
  if (pair.degenerate) drawing.degenerate = pair.degenerate->geometry;
  drawing.draw(cores_of(scene, pair, *a, *b));
}

}  // namespace contactscope::draw
