#include "trace/mirror.h"

#include <algorithm>

namespace contactscope::trace {
namespace {

/// Features keep the order of FeatureId: those of a first, then by kind (vertex, edge, face) and
/// number. Flipped features of two shapes trade places; two of one shape stay in order.
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
  const bool trade = first.starts_with("b:") && second.starts_with("a:");
  return trade ? second + " " + first : first + " " + second;
}

std::string renamed_axis(const std::string& axis) {
  if (axis == "face_a") return "face_b";
  return axis == "face_b" ? "face_a" : axis;
}

std::string turned_kind(const std::string& kind) {
  const std::size_t dash = kind.find('-');
  if (dash == std::string::npos) return kind;
  return kind.substr(dash + 1) + "-" + kind.substr(0, dash);
}

void negate(Vec3d& direction) {
  direction = -direction;
}
void negate(std::optional<Vec3d>& direction) {
  if (direction) negate(*direction);
}
void negate(std::vector<Vec3d>& points) {
  for (Vec3d& point : points) negate(point);
}

template <class Faces>
void rewind(Faces& faces) {
  for (auto& face : faces) {
    if (!face.empty()) std::reverse(face.begin() + 1, face.end());
  }
}

template <class T>
void mirror_fact(T& fact);
template <class T>
void mirror_fact(std::optional<T>& fact) {
  if (fact) mirror_fact(*fact);
}
template <class T>
void mirror_fact(std::vector<T>& facts) {
  for (T& fact : facts) mirror_fact(fact);
}

template <class T>
void mirror_fact(T& fact) {
  if constexpr (Listed<T>) {
    each_field<T>([&]<class Value>(const Field<T, Value>& field) {
      Value& value = fact.*field.member;
      if (field.partner != nullptr) std::swap(value, fact.*field.partner);
      if constexpr (requires { negate(value); }) {
        if (field.mirrored == Mirrored::Negated) negate(value);
      }
      if constexpr (std::same_as<Value, std::string>) {
        if (field.mirrored == Mirrored::IdFlipped) value = flipped_id(value);
        if (field.mirrored == Mirrored::AxisRenamed) value = renamed_axis(value);
        if (field.mirrored == Mirrored::KindTurned) value = turned_kind(value);
      }
      if constexpr (requires { value.front().front(); }) {
        if constexpr (std::same_as<std::remove_cvref_t<decltype(value.front().front())>, int>) {
          if (field.mirrored == Mirrored::Rewound) rewind(value);
        }
      }
    });
    each_field<T>([&](const auto& field) { mirror_fact(fact.*field.member); });
  }
}

}  // namespace

void mirror(Pair& pair) {
  mirror_fact(pair);
}

}  // namespace contactscope::trace
