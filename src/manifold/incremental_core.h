#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/at.h"
#include "core/feature_id.h"
#include "core/plane.h"
#include "geometry/shape.h"
#include "query/support_set.h"

/// Gregorius 2015, "Building Incremental Manifolds (1)": shapes are cores inflated by a margin.
namespace contactscope {

/// A vertex, an edge or a face of a core, by its number there.
struct CoreFeature {
  FeatureKind kind = FeatureKind::Vertex;
  int index = 0;

  friend bool operator==(const CoreFeature&, const CoreFeature&) = default;
};

/// The core of a shape, own frame. Of a sphere the centre and of a capsule the segment, the radius
/// is the margin; of a hull what core_hull() leaves; a half-space is its own core, margin 0.
template <class S>
struct ShapeCore {
  ShapeKind kind = ShapeKind::Sphere;
  S margin = 0;                            // metres
  Vec3<S> points[2];                       // of spheres (one) and capsules
  Hull<S> hull;                            // of hulls
  std::vector<FeatureRef> vertices{};      // of the shape, for those of `hull`
  std::vector<FeatureRef> edges{};         // likewise
  std::vector<FeatureRef> faces{};         // likewise
  Plane<S> plane{Vec3<S>::UnitX(), S(0)};  // of half-spaces

  /// How many vertices there are; a half-space has none.
  int count() const {
    if (kind == ShapeKind::Hull) return hull.vertex_count();
    return kind == ShapeKind::Sphere ? 1 : kind == ShapeKind::Capsule ? 2 : 0;
  }
  const Vec3<S>& vertex(int index) const {
    return kind == ShapeKind::Hull ? at(hull.vertices, index) : points[index];
  }
  /// Not of half-spaces.
  SupportSet<S> support() const {
    if (kind == ShapeKind::Hull) return support_set(hull);
    return kind == ShapeKind::Capsule ? support_set(points) : support_set(points[0]);
  }
  /// No coordinate of the core is larger than this, metres; of a half-space the offset.
  S reach() const {
    return kind == ShapeKind::Plane ? std::abs(plane.offset) : reach_of(support());
  }
  /// The feature of the shape that a feature of the core stands for.
  FeatureRef ref(Owner owner, const CoreFeature& feature) const {
    if (kind != ShapeKind::Hull)
      return {owner, feature.kind, static_cast<std::uint32_t>(feature.index)};
    const auto& refs = feature.kind == FeatureKind::Vertex ? vertices
                       : feature.kind == FeatureKind::Edge ? edges
                                                           : faces;
    FeatureRef result = at(refs, feature.index);
    result.owner = owner;
    return result;
  }
};

}  // namespace contactscope
