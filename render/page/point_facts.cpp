#include "draw/scene/pairs.h"
#include "page/facts.h"

namespace contactscope::page {
namespace {

/// Layers with symbols at contact points.
constexpr Layer kPointLayers[] = {
    Layer::Contacts, Layer::Reduced,  Layer::Ids,      Layer::Persistent,       Layer::Impulses,
    Layer::Loads,    Layer::Friction, Layer::Coherent, Layer::RelativeVelocity, Layer::Normals};

std::string pair_key(const trace::Pair& pair) { return pair.a + "|" + pair.b + "|" + pair.label; }

void add_impulse(const trace::Point& point, FactRows& rows) {
  if (!point.impulse) return;
  rows.emplace_back("impulse", draw::spell_quantity(point.impulse->normal, "N s"));
  if (const double friction = point.impulse->friction.norm(); friction > 0)
    rows.emplace_back("friction", draw::spell_quantity(friction, "N s"));
  if (point.impulse->warm_start != 0)
    rows.emplace_back("warm start", draw::spell_quantity(point.impulse->warm_start, "N s"));
}

/// Adds the points of one pair.
struct PairPoints {
  const draw::Staging& staging;
  const trace::Pair& pair;
  const std::vector<std::string>& layers;  // that show contact points of the pair
  std::vector<PointFacts>& all;

  /// Null if the point is not in the picture.
  PointFacts* add(const Vec3d& position, const std::string& key, const std::string& name,
                  const std::vector<std::string>& by) const {
    const std::optional<draw::Point2> at = staging.camera.project(position);
    if (!at || !staging.layout.view.contains(*at)) return nullptr;
    all.push_back({pair_key(pair) + "|" + key, name, draw::pair_name(pair), *at, false, by, {}});
    return &all.back();
  }

  void add_contacts() const {
    std::map<std::string, int> seen;  // engines may give two points the same id
    for (const trace::Manifold& manifold : pair.manifolds) {
      const auto m = &manifold - pair.manifolds.data();
      for (const trace::Point& point : manifold.points) {
        // Numbered as lint and the 3D page do.
        const std::string number = std::to_string(&point - manifold.points.data()) +
                                   (m > 0 ? " of manifold " + std::to_string(m) : "");
        const std::string id = point.id.empty() ? number : point.id;
        const int times = seen[id]++;
        PointFacts* const facts =
            add(point.position, id + (times > 0 ? "#" + std::to_string(times) : ""),
                "point " + number, layers);
        if (facts == nullptr) continue;
        facts->is_contact = true;
        facts->rows.push_back(gap_row(point.separation));
        add_impulse(point, facts->rows);
        if (!point.active) facts->rows.emplace_back("solver", "did not act on it");
        if (!point.id.empty()) facts->rows.emplace_back("made by", feature_words(point.id, pair));
        if (const trace::PersistentPoint* old = persistent(point))
          facts->rows.emplace_back("state", old->state + ", " + frames(old->age));
        if (manifold.triangle)
          facts->rows.emplace_back("triangle", std::to_string(*manifold.triangle));
        facts->rows.emplace_back("normal", spell_vector(manifold.normal));
        facts->rows.emplace_back("position", spell_vector(point.position) + " m");
      }
    }
  }

  /// Candidates that are not in the manifold.
  void add_dropped(bool reduced, bool cut) const {
    if (pair.reduction && reduced) {
      for (int i = 0; i < count_of(pair.reduction->points); ++i) {
        if (std::ranges::find(pair.reduction->kept, i) != pair.reduction->kept.end()) continue;
        const trace::Point& point = at(pair.reduction->points, i);
        PointFacts* const facts = add(point.position, "reduced " + point.id, "dropped point",
                                      {std::string(name_of(Layer::Reduced))});
        if (facts == nullptr) continue;
        facts->rows = {{"why", "reduced away by " + pair.reduction->method},
                       gap_row(point.separation)};
        if (!point.id.empty()) facts->rows.emplace_back("made by", feature_words(point.id, pair));
      }
    }
    if (!pair.clip || !cut) return;
    int number = 0;
    for (const trace::DroppedPoint& point : pair.clip->dropped) {
      PointFacts* const facts = add(point.position, "dropped " + std::to_string(number++),
                                    "dropped point", {std::string(name_of(Layer::Dropped))});
      if (facts != nullptr) facts->rows = {{"why", point.reason}};
    }
  }

  const trace::PersistentPoint* persistent(const trace::Point& point) const {
    if (!pair.incremental) return nullptr;
    const auto& points = pair.incremental->points;
    const auto found = std::ranges::find_if(points, [&](const trace::PersistentPoint& one) {
      return one.state != "broken" && one.point.id == point.id &&
             one.point.position == point.position;
    });
    return found == points.end() ? nullptr : &*found;
  }

  static std::string frames(int age) { return counted(age, "frame old", "frames old"); }
};

}  // namespace

std::pair<std::string, std::string> gap_row(double separation) {
  if (separation == 0) return {"gap", "0"};
  return {separation < 0 ? "overlap" : "gap", draw::spell_length(std::abs(separation))};
}

std::string spell_vector(const Vec3d& vector) {
  // Beyond six digits, small components of a direction are noise.
  const double least = 1e-6 * vector.cwiseAbs().maxCoeff();
  const auto spell = [&](double one) {
    return draw::spell_number(std::abs(one) < least ? 0.0 : one);
  };
  return "(" + separated(vector, ", ", spell) + ")";
}

std::string feature_words(const std::string& id, const trace::Pair& pair) {
  const std::vector<draw::PairFeature> features = draw::features_in(id);
  const auto as_in_id = [](const draw::PairFeature& feature) {
    return (feature.of_a ? "a:" : "b:") + (feature.kind + std::to_string(feature.index));
  };
  static const std::map<char, const char*> kinds = {
      {'v', "vertex "}, {'e', "edge "}, {'f', "face "}};
  const auto is_known = [&](const draw::PairFeature& one) { return kinds.contains(one.kind); };
  if (!std::ranges::all_of(features, is_known) || separated(features, " ", as_in_id) != id)
    return id;
  return separated(features, ", ", [&](const draw::PairFeature& feature) {
    return kinds.at(feature.kind) + std::to_string(feature.index) + " of " +
           (feature.of_a ? pair.a : pair.b);
  });
}

std::string parts_of(const trace::Pair& pair) { return pair.a + " " + pair.b; }

bool shows_layer(const draw::Drawing& drawing, std::string_view layer, std::string_view pair) {
  return std::ranges::any_of(drawing.parts, [&](const draw::Part& part) {
    return part.layer == layer && (pair.empty() || part.pair == pair);
  });
}

std::vector<PointFacts> point_facts(const draw::Staging& staging, const trace::Frame& frame,
                                    const draw::Drawing& drawing) {
  std::vector<PointFacts> all;
  for (const trace::Pair& pair : frame.pairs) {
    const std::string parts = parts_of(pair);
    std::vector<std::string> layers;
    for (const Layer layer : kPointLayers)
      if (shows_layer(drawing, name_of(layer), parts)) layers.emplace_back(name_of(layer));
    const PairPoints points{staging, pair, layers, all};
    if (!layers.empty()) points.add_contacts();
    points.add_dropped(shows_layer(drawing, name_of(Layer::Reduced), parts),
                       shows_layer(drawing, name_of(Layer::Dropped), parts));
  }
  return all;
}

}  // namespace contactscope::page
