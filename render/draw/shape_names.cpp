#include "draw/scene/outlines.h"
#include "draw/scene/pairs.h"
#include "draw/scene/points.h"
#include "draw/scene/solid.h"
#include "draw/staging.h"

/// Names of shapes, written on the shapes, so that the legend need not list them.
namespace contactscope::draw {
namespace {

constexpr std::size_t kMaxNamedShapes = 3;  // more names would crowd the picture
constexpr std::size_t kMaxCopies = 3;       // more copies are obviously a stack or a heap
constexpr std::size_t kMaxRoles = 12;       // shapes
constexpr std::size_t kMaxVertices = 5000;  // of a mesh whose exact outline is computed
constexpr double kMaxOfCore = 0.12;         // share of the outline's area, with visible cores
constexpr double kMaxOfMesh = 0.3;          // share of its width that a name may take
constexpr float kNameSize = 16;             // pixels
constexpr int kColumns = 18, kRowsTried = 12;
constexpr double kNameFarEnough = 260;  // pixels from the contact; more is no better
constexpr double kMinEdge = 0.5;        // pixels
constexpr double kFromBorder = 5;       // pixels between letters and the border of the shape
constexpr double kFromPairLabel = 10;   // pixels
constexpr double kFromFrame = 8;        // pixels between letters and the border of the view
constexpr double kInside = 16;          // pixels from the border of its shape to a leader's end

/// "small crate" for "small_crate_3".
std::string kind_in_words(std::string_view name) { return name_in_words(kind_of_name(name)); }

/// Shapes with a common name; one of them is labelled.
struct Named {
  std::string words;
  const PlacedShape* shape = nullptr;
  bool of_a = false, of_b = false;
  std::size_t copies = 0;
};

/// Convex outline of the shape on the screen, y down; of its box for a mesh with many vertices.
std::vector<Vec2d> seen_outline(const Camera& camera, const PlacedShape& shape) {
  std::vector<Vec3d> points;
  if (shape.mesh->patch) {
    points = patch_corners(*shape.mesh->patch, shape.pose);
  } else if (shape.is_mesh() && shape.vertices.size() <= kMaxVertices) {
    points = shape.vertices;
  } else if (shape.is_mesh()) {
    const Eigen::AlignedBox3d box = box_around(shape.vertices);
    for (int i = 0; i < 8; ++i)
      points.push_back(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)));
  } else {
    points = extent_points(shape);
  }
  const auto is_behind = [&](const Vec3d& point) { return !camera.project(point); };
  if (shape.mesh->patch || shape.is_mesh() || std::ranges::none_of(points, is_behind))
    return outline_around(camera, points);
  std::vector<Vec2d> seen;  // of faces that the camera's plane cuts
  for (int f = 0; f < count_of(shape.mesh->normals); ++f)
    for (const Point2& corner : project_polygon(camera, shape.polygon(f)))
      seen.emplace_back(corner.x, corner.y);
  return seen.size() < 3 ? Outline() : convex_polygon(std::move(seen));
}

/// Depth of a point inside a convex polygon with the winding of convex_polygon(); negative outside.
double depth_in(const std::vector<Vec2d>& polygon, const Vec2d& p) {
  double depth = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2d edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    const double length = edge.norm();
    // The direction of shorter edges is rounding noise.
    if (length > kMinEdge) depth = std::min(depth, cross(edge, Vec2d(p - polygon[i])) / length);
  }
  return polygon.size() < 3 ? -1 : depth;
}

/// Width of an outline, pixels.
double width_of(const std::vector<Vec2d>& outline) {
  if (outline.empty()) return 0;
  const auto [left, right] =
      std::ranges::minmax_element(outline, {}, [](const Vec2d& p) { return p.x(); });
  return right->x() - left->x();
}

std::vector<Named> named_shapes(const Scene& scene) {
  std::vector<Named> named;
  for (const PlacedShape& shape : scene.shapes) {
    if (!in_view(scene.camera, shape)) continue;
    std::string words = kind_in_words(shape.traced().name);
    // The pair's label contains the name already.
    const auto says_so = [&](const trace::Pair& pair) {
      return kind_in_words(pair.label) == words;
    };
    if (std::ranges::any_of(scene.frame.pairs, says_so)) continue;
    auto known = std::ranges::find(named, words, &Named::words);
    if (known == named.end()) known = named.insert(known, Named{std::move(words), &shape});
    const auto has_it = [&](const trace::Pair& pair) {
      return pair.a == shape.traced().name || pair.b == shape.traced().name;
    };
    if (std::ranges::any_of(scene.frame.pairs, has_it))
      (shape.is_a ? known->of_a : known->of_b) = true;
    ++known->copies;
  }
  return named;
}

/// Place for a text box that is fully on the shape and not on a smaller one that may be in front of
/// it. Prefers places far from `contact`.
std::optional<Vec2d> place_on(const std::vector<Vec2d>& own,
                              const std::vector<std::vector<Vec2d>>& smaller, const Vec2d& half,
                              const Vec2d& contact, const Rect& view, const Sketch& sketch,
                              double pixel) {
  Eigen::AlignedBox2d around;
  for (const Vec2d& p : own) around.extend(p);
  const Vec2d frame = Vec2d::Constant(kFromFrame * pixel);
  const Vec2d low = around.min().cwiseMax(Vec2d(view.x, view.y) + frame) + half;
  const Vec2d high = around.max().cwiseMin(Vec2d(view.right(), view.bottom()) - frame) - half;
  if ((high - low).minCoeff() <= 0) return std::nullopt;
  std::optional<Vec2d> best;
  double most = 0;
  for (int row = 0; row <= kRowsTried; ++row) {
    for (int column = 0; column <= kColumns; ++column) {
      const Vec2d at =
          low +
          (high - low).cwiseProduct(Vec2d(double(column) / kColumns, double(row) / kRowsTried));
      double inside = std::numeric_limits<double>::infinity(), clear = inside;
      for (const Vec2d& corner : {Vec2d(half.x(), half.y()), Vec2d(-half.x(), half.y()),
                                  Vec2d(half.x(), -half.y()), Vec2d(-half.x(), -half.y())}) {
        inside = std::min(inside, depth_in(own, at + corner));
        for (const std::vector<Vec2d>& other : smaller)
          clear = std::min(clear, -depth_in(other, at + corner));
      }
      for (const std::vector<Vec2d>& other : smaller) clear = std::min(clear, -depth_in(other, at));
      if (inside < kFromBorder * pixel || clear < 0) continue;
      const Eigen::AlignedBox2d box(Vec2d(at - half), Vec2d(at + half));
      const auto near_label = [&](const Eigen::AlignedBox2d& label) {
        return label.squaredExteriorDistance(box.center()) <
               std::pow(half.norm() + kFromPairLabel * pixel, 2);
      };
      if (std::ranges::any_of(sketch.pair_labels, near_label)) continue;
      const double value = std::min((at - contact).norm(), kNameFarEnough * pixel) +
                           0.2 * std::min(inside, 40 * pixel);
      if (best && value <= most) continue;
      best = at;
      most = value;
    }
  }
  return best;
}

}  // namespace

void draw_shape_names(const Scene& scene, Sketch& sketch) {
  if (!scene.shows(Layer::Shapes) || scene.shows(Layer::Names) || scene.crowded() ||
      scene.frame.broad_phase || scene.frame.pairs.empty())
    return;
  const std::vector<Named> named = named_shapes(scene);
  // With many names only roles are written, if normals show their direction.
  const bool roles_alone = named.size() > kMaxNamedShapes;
  if (roles_alone && (scene.shapes.size() > kMaxRoles || !scene.shows(Layer::Normals))) return;
  // Letters are meaningless if a body is B of one pair and A of another,
  const bool swaps_roles = std::ranges::any_of(scene.frame.pairs, [&](const trace::Pair& one) {
    return std::ranges::any_of(scene.frame.pairs,
                               [&](const trace::Pair& other) { return one.a == other.b; });
  });
  // or if a solver moves the bodies and no normals are shown.
  const bool names_roles = !swaps_roles && (!scene.frame.solver || scene.shows(Layer::Normals));
  const Camera& camera = scene.camera;
  const Rect& view = camera.viewport();
  const std::optional<Point2> touching = camera.project(sketch.center);
  const Vec2d contact = touching ? Vec2d(touching->x, touching->y)
                                 : Vec2d(view.x + 0.5 * view.width, view.y + 0.5 * view.height);
  std::vector<std::pair<std::vector<Vec2d>, const PlacedShape*>> outlines;
  for (const PlacedShape& shape : scene.shapes)
    outlines.emplace_back(seen_outline(camera, shape), &shape);
  const double pixel = scene.scales.pixel;
  const float size = static_cast<float>(pixel) * kNameSize;
  // A copy has its whole name if the frame has no other copy.
  const auto is_one_of_several = [&](const Named& each) {
    const auto is_alike = [&](const auto& name) { return kind_in_words(name) == each.words; };
    const auto placed = [](const PlacedShape& shape) { return shape.traced().name; };
    return scene.view.layout != ViewLayout::SideBySide &&
           std::ranges::count_if(scene.shapes, is_alike, placed) == 1 &&
           std::ranges::count_if(scene.header.shapes, is_alike, &trace::Shape::name) > 1;
  };
  for (const Named& each : named) {
    if (each.copies > kMaxCopies) continue;
    const bool has_role = each.of_a != each.of_b && names_roles;
    if (roles_alone && !has_role) continue;
    // A name on one of several copies would seem to belong to that copy alone.
    if (each.copies > 1 && !has_role) continue;
    const std::string role = !has_role ? "" : each.of_a ? "A" : "B";
    const std::string text =
        roles_alone
            ? role
            : role + (has_role ? ": " : "") +
                  (is_one_of_several(each) ? name_in_words(each.shape->traced().name) : each.words);
    const auto own = std::ranges::find(outlines, each.shape,
                                       &std::pair<std::vector<Vec2d>, const PlacedShape*>::second);
    const double area = std::abs(area_of(own->first));
    std::vector<std::vector<Vec2d>> smaller;
    for (const auto& [outline, shape] : outlines) {
      if (shape != each.shape && !outline.empty() && std::abs(area_of(outline)) <= area)
        smaller.push_back(outline);
    }
    const Vec2d half(0.5 * text_width(text, size, FontWeight::Bold) + 2 * pixel, 0.5 * size);
    const Color ink = each.shape->is_a ? kArcOfA : kArcOfB;
    // World position behind a screen position, at the depth of the shape.
    Vec3d at = each.shape->pose.transform(each.shape->traced().center_of_mass);
    if (each.shape->mesh->patch || each.shape->vertices.empty() || !camera.project(at))
      at = sketch.center;
    const std::optional<Point2> foot = camera.project(at);
    if (!foot) continue;
    const auto in_world = [&](const Vec2d& pixels) -> Vec3d {
      const Vec2d offset = (pixels - Vec2d(foot->x, foot->y)) / camera.pixels_per_metre(at);
      return at + offset.x() * camera.right() - offset.y() * camera.up();
    };
    // On a small mesh a name would cover the edges, and on a small body the core.
    const bool is_small = scene.shows(Layer::Core) && 4 * half.prod() > kMaxOfCore * area;
    const bool fits =
        !is_small && (!each.shape->is_mesh() || 2 * half.x() < kMaxOfMesh * width_of(own->first));
    if (const auto place =
            !fits ? std::nullopt
                  : place_on(own->first, smaller, half, contact, view, sketch, pixel)) {
      // The text is centred there, so it begins half its height lower and extends upwards.
      Label& label = sketch.label(in_world(*place + Vec2d(0, 0.5 * size)), text, ink, kNameSize, 0,
                                  camera.up());
      label.foot = true;
      label.ground = own->first;
      continue;
    }
    // Next to it, at the corner that is farthest from the contact.
    std::optional<Vec2d> corner;
    for (const Vec2d& p : own->first) {
      if (!view.contains(draw::pixel(p.x(), p.y()))) continue;
      if (!corner || (p - contact).norm() > (*corner - contact).norm()) corner = p;
    }
    if (!corner) continue;
    const Vec2d out = (*corner - contact).normalized();
    Vec2d middle = Vec2d::Zero();
    for (const Vec2d& p : own->first) middle += p / static_cast<double>(own->first.size());
    const Vec2d inwards = middle - *corner;
    const Vec2d inside = *corner + std::min(0.5, kInside * pixel / inwards.norm()) * inwards;
    Label& label = sketch.label(in_world(inside), text, ink, kNameSize, kInside + 9,
                                Vec3d(out.x() * camera.right() - out.y() * camera.up()));
    label.leader = label.foot = true;
  }
}

}  // namespace contactscope::draw
