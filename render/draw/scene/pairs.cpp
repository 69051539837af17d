#include "draw/scene/pairs.h"

#include "draw/scene/points.h"

namespace contactscope::draw {
namespace {

// Share of the overlap that lies behind the surface of A. A point of a face contact lies on the
// reference face. Points of incremental manifolds, of two edges or of two round shapes lie midway
// between both surfaces. If a round shape touches a flat one, the point is on the flat one. One
// exception: if the capsule's axis has passed an edge, the point is midway between edge and axis
// (Gregorius 2015, "Capsule vs Hull: Deep Contact"), and the capsule's surface is a radius further.
// For a distance field, the point is on the other shape, at the queried distance from the field.
double share_behind_a(const trace::Pair& pair, const trace::Manifold& manifold,
                      const trace::Point& point, double radius_a, double radius_b) {
  if (pair.incremental) return 0.5;
  if (pair.kind == "hull-sdf") return 1;
  if (pair.kind == "sdf-hull") return 0;
  if (manifold.axis == "face_a") return 0;
  if (manifold.axis == "face_b") return 1;
  if ((radius_a > 0) == (radius_b > 0)) return 0.5;
  const bool deepest = std::ranges::none_of(manifold.points, [&](const trace::Point& other) {
    return other.separation < point.separation;
  });
  if (manifold.axis == "edge_edge" && point.separation < 0 && deepest)
    return 0.5 + 0.5 * (radius_b - radius_a) / point.separation;
  return radius_a > 0 ? 1 : 0;
}

// Face, or two edges, of the axis that the test chose.
std::array<int, 2> chosen_features(const trace::Sat& sat) {
  if (sat.chosen == "face_a" && sat.face_a) return {sat.face_a->face, -1};
  if (sat.chosen == "face_b" && sat.face_b) return {sat.face_b->face, -1};
  if (sat.edge) return {sat.edge->a, sat.edge->b};
  return {-1, -1};
}

OnBoth surfaces_scaled(const Scene& scene, const trace::Pair& pair, const PairPoint& at,
                       double scale) {
  const auto& [manifold, point] = at;
  const auto radius = [&](const std::string& name) {
    const PlacedShape* shape = scene.find(name);
    return shape == nullptr ? 0.0 : shape->traced().radius;
  };
  const double behind_a = share_behind_a(pair, *manifold, *point, radius(pair.a), radius(pair.b));
  const Vec3d overlap = scale * point->separation * manifold->normal;
  return {point->position - behind_a * overlap, point->position + (1 - behind_a) * overlap};
}

}  // namespace

const trace::Clip* own_clip(const trace::Pair& pair) {
  const bool is_merged = pair.merge && !pair.merge->manifolds.empty() &&
                         pair.merge->manifolds.front().triangles.size() > 1;
  return pair.clip && pair.manifolds.size() == 1 && !is_merged ? &*pair.clip : nullptr;
}

std::vector<PairPoint> all_points(const trace::Pair& pair) {
  std::vector<PairPoint> points;
  for (const trace::Manifold& manifold : pair.manifolds)
    for (const trace::Point& point : manifold.points) points.push_back({&manifold, &point});
  return points;
}

std::vector<Vec3d> positions_of(const trace::Pair& pair) {
  return mapped(all_points(pair), [](const PairPoint& any) { return any.point->position; });
}

std::vector<PairPoint> kept_points(const trace::Pair& pair) {
  if (pair.manifolds.size() != 1 || !pair.reduction) return all_points(pair);
  const trace::Manifold& manifold = pair.manifolds.front();
  std::vector<PairPoint> points;
  if (manifold.points.empty()) return points;
  const std::vector<int>& kept = pair.reduction->kept;
  const std::vector<trace::Point>& all = pair.reduction->points;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (std::ranges::find(kept, static_cast<int>(i)) != kept.end())
      points.push_back({&manifold, &all[i]});
  }
  return points;
}

std::vector<Vec3d> kept_polygon(const trace::Reduction& reduction, const Vec3d& normal) {
  const Vec3d u = any_perpendicular(normal), v = normal.cross(u);
  const auto flat = [&](int i) -> Vec2d {
    const Vec3d& place = at(reduction.points, i).position;
    return {u.dot(place), v.dot(place)};
  };
  std::vector<Vec3d> corners;
  for (const Vec2d& corner : convex_polygon(mapped(reduction.kept, flat))) {
    const auto found = std::ranges::find(reduction.kept, corner, flat);
    corners.push_back(at(reduction.points, *found).position);
  }
  return corners;
}

bool is_kept(const trace::Pair& pair, const trace::DroppedPoint& dropped) {
  const Vec3d& normal = pair.clip->reference.normal;
  const double size = reach_of(pair.clip->incident.polygon);
  return std::ranges::any_of(all_points(pair), [&](const PairPoint& kept) {
    const Vec3d offset = dropped.position - kept.point->position;
    return (offset - offset.dot(normal) * normal).norm() < 1e-5 * size;
  });
}

OnBoth surfaces_at(const Scene& scene, const trace::Pair& pair, const PairPoint& at) {
  return surfaces_scaled(scene, pair, at, 1);
}

OnBoth whisker_at(const Scene& scene, const trace::Pair& pair, const PairPoint& at) {
  const bool separated = at.point->separation > 0;
  return surfaces_scaled(scene, pair, at, separated ? scene.scales.gap : scene.scales.overlap);
}

bool has_whisker(const Scene& scene, const trace::Pair& pair, const PairPoint& at) {
  constexpr double kMinWhisker = 6.5;  // pixels: the dot hides shorter ones
  if (!scene.shows(Layer::Contacts) || pair.query ||
      (pair.incremental && scene.shows(Layer::Persistent)))
    return false;
  auto [from, to] = whisker_at(scene, pair, at);
  const Vec3d& middle = at.point->position;
  // The impulse arrow covers the part on its side.
  if (scene.shows(Layer::Impulses) && at.point->impulse) {
    const Vec3d out = (scene.body(pair.b) != nullptr ? 1 : -1) * at.manifold->normal;
    for (Vec3d* end : {&from, &to})
      if ((*end - middle).dot(out) > 0) *end = middle;
  }
  const std::optional<float> pixels = seen_distance(scene.camera, from, to);
  return pixels && *pixels > kMinWhisker * scene.scales.pixel;
}

std::optional<Vec3d> usual_normal(const trace::Frame& frame) {
  std::vector<Vec3d> normals;
  for (const trace::Pair& pair : frame.pairs) {
    if (pair.manifolds.size() <= kFewManifolds) continue;
    for (const trace::Manifold& manifold : pair.manifolds)
      if (!manifold.points.empty()) normals.push_back(manifold.normal);
  }
  const auto alike = [&](const Vec3d& usual) {
    return static_cast<std::size_t>(std::ranges::count_if(
        normals, [&](const Vec3d& normal) { return is_like(usual, normal); }));
  };
  for (const Vec3d& normal : normals) {
    const std::size_t count = alike(normal);
    if (count == normals.size()) return std::nullopt;
    if (2 * count > normals.size()) return normal;
  }
  return std::nullopt;
}

std::vector<PairFeature> features_in(std::string_view id) {
  std::vector<PairFeature> features;
  while (!id.empty()) {
    const std::string_view word = id.substr(0, id.find(' '));
    id.remove_prefix(std::min(word.size() + 1, id.size()));
    if (word.size() < 4 || word[1] != ':') continue;
    int index = -1;
    const auto parsed = std::from_chars(word.data() + 3, word.data() + word.size(), index);
    if (parsed.ec == std::errc() && parsed.ptr == word.data() + word.size())
      features.push_back({word[0] == 'a', index, word[2]});
  }
  return features;
}

std::vector<PairFeature> edges_in(std::string_view id) {
  std::vector<PairFeature> edges = features_in(id);
  std::erase_if(edges, [](const PairFeature& feature) { return feature.kind != 'e'; });
  return edges;
}

const trace::Pair* first_pair(const trace::Frame& frame, bool (*holds)(const trace::Pair&)) {
  const auto found = std::ranges::find_if(frame.pairs, holds);
  return found == frame.pairs.end() ? nullptr : &*found;
}

std::vector<const trace::Pair*> distinct_pairs(const std::vector<trace::Frame>& frames,
                                               bool (*holds)(const trace::Pair&)) {
  std::set<std::array<std::string_view, 3>> known;
  std::vector<const trace::Pair*> pairs;
  for (const trace::Frame& frame : frames) {
    for (const trace::Pair& pair : frame.pairs)
      if (holds(pair) && known.insert({pair.a, pair.b, pair.label}).second) pairs.push_back(&pair);
  }
  return pairs;
}

std::vector<const trace::Pair*> pair_history(const std::vector<trace::Frame>& frames,
                                             const trace::Pair& wanted) {
  std::vector<const trace::Pair*> history;
  const auto is_wanted = [&](const trace::Pair& pair) {
    return pair.a == wanted.a && pair.b == wanted.b && pair.label == wanted.label;
  };
  std::size_t usual = 0;  // previous index: most traces keep the order of pairs
  for (const trace::Frame& frame : frames) {
    const std::vector<trace::Pair>& pairs = frame.pairs;
    if (usual >= pairs.size() || !is_wanted(pairs[usual]))
      usual = static_cast<std::size_t>(std::ranges::find_if(pairs, is_wanted) - pairs.begin());
    history.push_back(usual < pairs.size() ? &pairs[usual] : nullptr);
  }
  return history;
}

std::string pair_name(const trace::Pair& pair) {
  if (!pair.label.empty()) return pair.label;
  return name_in_words(pair.a) + " and " + name_in_words(pair.b);
}

std::string axis_of(const trace::Pair& pair) {
  if (pair.sat) return pair.sat->chosen;
  return pair.cache && pair.cache->hit ? pair.cache->axis : std::string();
}

std::vector<AxisMoment> axis_history(const std::vector<const trace::Pair*>& pairs) {
  std::vector<AxisMoment> history;
  std::string last;
  std::optional<std::array<int, 2>> last_features;
  for (const trace::Pair* pair : pairs) {
    AxisMoment& moment = history.emplace_back();
    if (pair == nullptr || axis_of(*pair).empty()) continue;
    std::optional<std::array<int, 2>> features;
    if (pair->sat) features = chosen_features(*pair->sat);
    moment = {pair, axis_of(*pair), false};
    const bool other_axis = !last.empty() && moment.axis != last;
    moment.switched =
        other_axis || (!last.empty() && features && last_features && *features != *last_features);
    if (features || other_axis) last_features = features;
    last = moment.axis;
  }
  return history;
}

void add_frame(const trace::Frame& frame, const std::string& a, const std::string& b,
               PairHistory& history) {
  double deepest = std::numeric_limits<double>::quiet_NaN(), count = 0;
  for (const trace::Pair& pair : frame.pairs) {
    if (std::minmax(pair.a, pair.b) != std::minmax(a, b)) continue;
    for (const PairPoint& one : all_points(pair))
      deepest = std::fmax(deepest, std::max(0.0, -one.point->separation)), ++count;
  }
  history.frames.push_back(frame.frame);
  history.overlaps.push_back(deepest);
  history.points.push_back(count);
}

}  // namespace contactscope::draw
