#pragma once

#include <cstdint>
#include <string>
#include <utility>

namespace contactscope {

enum class Owner : std::uint8_t { A = 0, B = 1 };

constexpr Owner other(Owner owner) {
  return owner == Owner::A ? Owner::B : Owner::A;
}

/// One edge of one shape. `edge` is the undirected edge, half-edge index / 2.
struct EdgeRef {
  Owner owner = Owner::A;
  std::uint32_t edge = 0;

  friend constexpr auto operator<=>(const EdgeRef&, const EdgeRef&) = default;
};

/// Contact id: the two edges whose crossing made the point (Catto 2007, "Feature-Based Contact
/// Points"). Kept sorted, A before B and then by edge, so that the same crossing has the same id
/// whichever shape was the reference.
struct FeatureId {
  EdgeRef first;
  EdgeRef second;

  static constexpr FeatureId of(EdgeRef one, EdgeRef two) {
    return one < two ? FeatureId{one, two} : FeatureId{two, one};
  }

  /// The id of the same point when the shapes trade places.
  constexpr FeatureId flipped() const {
    return of({other(first.owner), first.edge}, {other(second.owner), second.edge});
  }

  friend constexpr auto operator<=>(const FeatureId&, const FeatureId&) = default;
};

/// "a:e3 b:e7", as traces spell it.
std::string to_string(const FeatureId& id);

}  // namespace contactscope
