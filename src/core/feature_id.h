#pragma once

#include "core/standard.h"

namespace contactscope {

enum class Owner : std::uint8_t { A = 0, B = 1 };

constexpr Owner other(Owner owner) { return owner == Owner::A ? Owner::B : Owner::A; }

enum class FeatureKind : std::uint8_t { Vertex = 0, Edge = 1, Face = 2 };

/// One feature of one shape; an edge unless a kind is given. Edges are undirected: index =
/// half-edge index / 2. A sphere is vertex 0. A capsule has vertices 0 and 1 and edge 0 between
/// them. A plane is face 0. Features of a triangle are numbered within it, face 0 is its front, 1
/// its back; those of a mesh (merge_triangles.h) within the mesh.
struct FeatureRef {
  Owner owner = Owner::A;
  FeatureKind kind = FeatureKind::Edge;
  std::uint32_t index = 0;
  constexpr FeatureRef() = default;
  constexpr FeatureRef(Owner of, std::uint32_t edge) : owner(of), index(edge) {}
  constexpr FeatureRef(Owner of, FeatureKind feature, std::uint32_t number)
      : owner(of), kind(feature), index(number) {}

  friend constexpr auto operator<=>(const FeatureRef&, const FeatureRef&) = default;
};

constexpr FeatureRef vertex_ref(Owner owner, int vertex) {
  return {owner, FeatureKind::Vertex, static_cast<std::uint32_t>(vertex)};
}
constexpr FeatureRef edge_ref(Owner owner, int edge) {
  return {owner, FeatureKind::Edge, static_cast<std::uint32_t>(edge)};
}
constexpr FeatureRef face_ref(Owner owner, int face) {
  return {owner, FeatureKind::Face, static_cast<std::uint32_t>(face)};
}

/// Contact id: the two features that made the point. For clipped hulls, the two edges that cross at
/// the point (Catto 2007, "Feature-Based Contact Points"); for closest points, the features that
/// contain them. Sorted, A before B, then by kind and index, so the reference does not matter.
struct FeatureId {
  FeatureRef first;
  FeatureRef second;

  static constexpr FeatureId of(FeatureRef one, FeatureRef two) {
    return one < two ? FeatureId{one, two} : FeatureId{two, one};
  }

  /// Id of the same point after the shapes are swapped.
  constexpr FeatureId flipped() const {
    return of({other(first.owner), first.kind, first.index},
              {other(second.owner), second.kind, second.index});
  }

  friend constexpr auto operator<=>(const FeatureId&, const FeatureId&) = default;
};

/// "a:e3 b:e7", "a:v0 b:f2", as written in traces: v vertex, e edge, f face.
inline std::string to_string(const FeatureId& id) {
  const auto spell = [](const FeatureRef& ref) {
    const char kind = "vef"[static_cast<int>(ref.kind)];
    return std::string(ref.owner == Owner::A ? "a:" : "b:") + kind + std::to_string(ref.index);
  };
  return spell(id.first) + " " + spell(id.second);
}

}  // namespace contactscope
