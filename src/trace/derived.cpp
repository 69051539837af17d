#include "trace/find.h"

namespace contactscope::trace {
namespace {

/// Features keep the order of FeatureId: a's first, then by kind (vertex, edge, face) and number.
/// Flipped features of two shapes swap places; two features of one shape keep their order.
std::string flipped_id(const std::string& id) {
  const std::size_t space = id.find(' ');
  if (space == std::string::npos) return id;
  const auto flipped = [](std::string feature) {
    if (feature.starts_with("a:")) {
      feature[0] = 'b';
    } else if (feature.starts_with("b:")) {
      feature[0] = 'a';
    }
    return feature;
  };
  const std::string first = flipped(id.substr(0, space)), second = flipped(id.substr(space + 1));
  const bool swap = first.starts_with("b:") && second.starts_with("a:");
  return swap ? second + " " + first : first + " " + second;
}

void mirror_value(std::string& text, Mirrored how) {
  const std::size_t dash = text.find('-');
  if (how == Mirrored::IdFlipped) text = flipped_id(text);
  if (how == Mirrored::AxisRenamed && (text == "face_a" || text == "face_b"))
    text.back() = text == "face_a" ? 'b' : 'a';
  if (how == Mirrored::KindTurned && dash != std::string::npos)
    text = text.substr(dash + 1) + "-" + text.substr(0, dash);
}
void mirror_value(Vec3d& direction, Mirrored how) {
  if (how == Mirrored::Negated) direction = -direction;
}
/// An interval along a direction that is negated.
void mirror_value(std::array<double, 2>& interval, Mirrored how) {
  if (how == Mirrored::Negated) interval = {-interval[1], -interval[0]};
}
/// Reverses the corners of a face but keeps the first one first.
template <class Corners>
requires(!kIsOptional<Corners> &&
         std::same_as<typename Corners::value_type, int>) void mirror_value(Corners& face,
                                                                            Mirrored how) {
  if (how == Mirrored::Rewound && !face.empty()) std::reverse(face.begin() + 1, face.end());
}
template <class T> void mirror_value(T&, Mirrored) {}  // a number
template <Listed T> void mirror_value(T& fact, Mirrored);
template <class T>
requires kIsOptional<T>
void mirror_value(T& value, Mirrored how) {
  if (value) mirror_value(*value, how);
}
template <class T>
requires(!std::same_as<T, int>) void mirror_value(std::vector<T>& list, Mirrored how) {
  for (T& value : list) mirror_value(value, how);
}

/// Only the first of two fields that swap values has a partner.
template <Listed T> void mirror_value(T& fact, Mirrored) {
  each_field<T>([&](const auto& field) {
    if (field.partner != nullptr) std::swap(fact.*field.member, fact.*field.partner);
    mirror_value(fact.*field.member, field.mirrored);
  });
}

}  // namespace

void mirror(Pair& pair) { mirror_value(pair, Mirrored::Kept); }

void Shape::edges_from_faces(Shape& shape) {
  std::set<std::array<int, 2>> seen;
  for (const std::vector<int>& face : shape.faces)
    for (std::size_t i = 0; i < face.size(); ++i) {
      const int from = face[i];
      const int to = face[(i + 1) % face.size()];
      if (seen.insert({std::min(from, to), std::max(from, to)}).second)
        shape.edges.push_back({from, to});
    }
}

std::string kind_of(const Shape& shape) {
  const bool is_named = std::ranges::any_of(std::array{"sphere", "capsule", "mesh", "plane", "sdf"},
                                            [&](const char* type) { return shape.type == type; });
  return is_named ? shape.type : "hull";
}

void complete(const Kinds& kinds, Frame& frame) {
  const auto kind = [&](const std::string& name) {
    const auto found = kinds.find(name);
    return found == kinds.end() ? std::string("unknown") : found->second;
  };
  for (Pair& pair : frame.pairs) {
    if (pair.kind.empty()) pair.kind = kind(pair.a) + "-" + kind(pair.b);
    const Point* const deepest = deepest_point(pair);
    if (pair.state.empty()) pair.state = deepest != nullptr ? "touching" : "separated";
    if (std::isnan(pair.separation)) pair.separation = deepest != nullptr ? deepest->separation : 0;
  }
}

void convert_impulses(const ImpulseConvention& from, Frame& frame) {
  const double time = from.unit == "N" ? from.step : 1;
  const bool on_a = from.on == "a";
  for (Pair& pair : frame.pairs)
    for (Manifold& manifold : pair.manifolds)
      for (Point& point : manifold.points) {
        if (!point.impulse) continue;
        Impulse& impulse = *point.impulse;
        // Most engines report a positive push, whichever body the impulse acts on.
        const double side = on_a && impulse.normal < 0 ? -1 : 1;
        impulse.normal *= side * time;
        impulse.warm_start *= side * time;
        impulse.friction *= on_a ? -time : time;
      }
}

Totals totals_of(const Frame& frame) {
  Totals totals;
  for (const Pair& pair : frame.pairs) {
    std::set<std::pair<int, std::string>> ids;
    for (const Manifold& manifold : pair.manifolds) {
      for (const Point& point : manifold.points) {
        if (frame.solver && !point.impulse) continue;
        totals.penetration = std::max(totals.penetration, -point.separation);
        if (point.impulse) totals.normal_impulse += point.impulse->normal;
        ++totals.points;
        ids.emplace(manifold.triangle.value_or(-1), point.id);
      }
    }
    totals.ids += static_cast<int>(ids.size());
  }
  if (!frame.solver) return totals;
  for (const Body& b : frame.solver->bodies) {
    totals.kinetic_energy += b.kinetic_energy;
    totals.potential_energy += b.potential_energy;
  }
  return totals;
}

}  // namespace contactscope::trace
