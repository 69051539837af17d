#include <ranges>

#include "draw/scene/outlines.h"
#include "draw/scene/pairs.h"
#include "draw/scene/solid.h"
#include "draw/staging.h"

namespace contactscope::draw {
namespace {

constexpr float kPairLabelSize = 20;  // pixels
constexpr double kPairLabelGap = 9;   // pixels between a silhouette and the label
constexpr int kMaxRows = 4;           // for labels of pairs with a common body
constexpr double kRowHeight = 24;     // pixels

/// Number of labels of other pairs that contain this body.
std::size_t other_labels_of(const std::string& body, const Scene& scene, const trace::Pair& pair) {
  std::set<std::string_view> labels;
  for (const trace::Pair& other : scene.frame.pairs)
    if ((other.a == body || other.b == body) && other.label != pair.label)
      labels.insert(other.label);
  labels.erase(std::string_view());
  return labels.size();
}

// The only moving body, even if it has fallen below the other. Otherwise the body with fewer labels
// of other pairs, or the upper one.
const PlacedShape* labelled_body(const Scene& scene, const trace::Pair& pair) {
  const Vec3d up = up_axis(scene.header);
  const auto rests = [&](const std::string& name) { return scene.body(name) == nullptr; };
  const bool one_moves = scene.frame.solver && rests(pair.a) != rests(pair.b);
  const PlacedShape* best = nullptr;
  std::size_t fewest = 0;
  for (const std::string* name : {&pair.a, &pair.b}) {
    const PlacedShape* shape = one_moves && rests(*name) ? nullptr : scene.find(*name);
    if (shape == nullptr || shape->vertices.empty()) continue;
    const std::size_t others = other_labels_of(*name, scene, pair);
    const bool is_higher =
        best == nullptr || up.dot(shape->pose.position - best->pose.position) > 0;
    if (best != nullptr && (others > fewest || (others == fewest && !is_higher))) continue;
    best = shape;
    fewest = others;
  }
  return best;
}

// An unnamed pair is named by its features if the view shows features: "edge on face: 2 points".
// Queries of bounds add their answer, because it is the picture's subject.
std::string pair_label_text(const Scene& scene, const trace::Pair& pair) {
  if (!pair.label.empty())
    return pair.query && !pair.query->bounds.empty() ? label_with_answer(pair) : pair.label;
  if (!scene.shows(Layer::Features) || pair.manifolds.size() != 1) return {};
  const trace::Manifold& manifold = pair.manifolds.front();
  const std::size_t count = manifold.points.size();
  if (manifold.type.find('-') == std::string::npos) return {};
  return spell_features(manifold.type) + ": " + counted(count, "point", "points");
}

}  // namespace

// Above the silhouette of its body, if that place is free; otherwise above both shapes, below or
// next to the body, or a row or two farther out. If nothing is free, above the body inside the
// view.
void draw_pair_label(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  // Only bodies in the picture are labelled.
  const auto is_seen = [&](const std::string& name) {
    const PlacedShape* shape = scene.find(name);
    return shape != nullptr && in_view(scene.camera, *shape);
  };
  const std::string words = pair_label_text(scene, pair);
  // The panel of intervals names the bounds of each pair.
  if (std::ranges::find(scene.view.panels, Panel::AxisIntervals) != scene.view.panels.end()) return;
  if (words.empty() || (!is_seen(pair.a) && !is_seen(pair.b))) return;
  const trace::Pair* end = scene.frame.pairs.data() + scene.frame.pairs.size();
  if (!pair.label.empty() &&
      std::ranges::find(&pair + 1, end, pair.label, &trace::Pair::label) != end)
    return;
  // If several queries use the same two shapes, no place in the picture identifies one of them.
  const auto is_queried_too = [&](const trace::Pair& other) {
    const bool same =
        (other.a == pair.a && other.b == pair.b) || (other.a == pair.b && other.b == pair.a);
    return &other != &pair && same && (pair.query || other.query);
  };
  if (std::ranges::any_of(scene.frame.pairs, is_queried_too)) return;
  const PlacedShape* body = labelled_body(scene, pair);
  if (body == nullptr) return;
  const Camera& camera = scene.camera;
  const auto middle_of = [](const PlacedShape& shape) -> Vec3d {
    return shape.pose.transform(shape.traced().center_of_mass);
  };
  Vec3d middle = middle_of(*body);
  std::vector<Vec2d> own = outline_around(camera, extent_points(*body));
  // The answer of bounds belongs to both shapes.
  const PlacedShape* partner = scene.find(body->traced().name == pair.a ? pair.b : pair.a);
  if (pair.query && !pair.query->bounds.empty() && partner != nullptr) {
    middle = 0.5 * (middle + middle_of(*partner));
    const std::vector<Vec2d> more = outline_around(camera, extent_points(*partner));
    own.insert(own.end(), more.begin(), more.end());
  }
  const std::optional<Point2> at = camera.project(middle);
  if (!at || own.empty()) return;

  const auto is_plane = [&](const std::string& name) {
    const PlacedShape* shape = scene.find(name);
    return shape != nullptr && shape->traced().half_space.has_value();
  };
  const bool on_plane = is_plane(pair.a) || is_plane(pair.b);
  std::vector<std::vector<Vec2d>> all;
  std::vector<Vec2d> both = own;
  for (const PlacedShape& shape : scene.shapes) {
    if (shape.traced().half_space || shape.is_mesh()) continue;
    all.push_back(outline_around(camera, extent_points(shape)));
    const std::string& name = shape.traced().name;
    if (name == pair.a || name == pair.b)
      both.insert(both.end(), all.back().begin(), all.back().end());
  }
  const double pixel = scene.scales.pixel;
  const float size = static_cast<float>(pixel) * kPairLabelSize;
  const Vec2d half(0.5 * text_width(words, size, FontWeight::Bold) + 2, 0.5 * size);
  const Vec2d origin(at->x, at->y);
  const Rect& view = camera.viewport();
  const Vec2d low(view.x, view.y), high(view.right(), view.bottom());
  // Where the label begins, at the border of a silhouette, and the outward direction.
  struct Place {
    Vec2d begin, out;
  };
  const auto border = [&](const std::vector<Vec2d>& points, const Vec2d& out) -> Place {
    double reach = -1e300;
    for (const Vec2d& p : points) reach = std::max(reach, out.dot(p - origin));
    return {origin + reach * out, out};
  };
  const auto text_box = [&](const Place& place) -> Eigen::AlignedBox2d {
    const Vec2d center =
        place.begin + kPairLabelGap * pixel * place.out + place.out.cwiseProduct(half);
    return {center - half, center + half};
  };
  const auto is_free = [&](const Place& place) {
    const Eigen::AlignedBox2d box = text_box(place);
    if ((box.min() - low).minCoeff() < 0 || (high - box.max()).minCoeff() < 0) return false;
    const auto meets = [&](const Eigen::AlignedBox2d& other) { return other.intersects(box); };
    return std::ranges::none_of(sketch.pair_labels, meets) &&
           std::ranges::none_of(all, [&](const auto& polygon) { return overlap(polygon, box); });
  };
  const Vec2d up(0, -1), right(1, 0);
  std::vector<Place> places;
  for (int row = 0; row < kMaxRows; ++row) {
    std::array<Place, 5> around = {border(own, up), border(both, up), border(own, -up),
                                   border(own, right), border(own, -right)};
    if (on_plane) std::swap(around[2], around[4]);  // the ground is below
    for (const Place& place : around)
      places.push_back({place.begin + row * kRowHeight * pixel * place.out, place.out});
  }
  const auto found = std::ranges::find_if(places, is_free);
  const Place& place = found == places.end() ? places.front() : *found;
  sketch.pair_labels.push_back(text_box(place));
  const Vec2d inside = Vec2d::Constant(pixel);
  const Vec2d begin = place.begin.cwiseMax(low + inside).cwiseMin(high - inside);
  const double metres = 1 / camera.pixels_per_metre(middle);
  const auto in_world = [&](const Vec2d& pixels) -> Vec3d {
    return metres * (pixels.x() * camera.right() - pixels.y() * camera.up());
  };
  sketch.label(middle + in_world(begin - origin), words, kText, kPairLabelSize, kPairLabelGap,
               Vec3d(in_world(place.out).normalized()));
}

}  // namespace contactscope::draw
