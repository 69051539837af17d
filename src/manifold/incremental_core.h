#pragma once

#include <memory>
#include <vector>

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
  bool reduced = false;                    // a hull too thin for the margin that was asked for
  Vec3<S> points[2];                       // of spheres (one) and capsules
  Hull<S> hull;                            // of hulls
  std::vector<FeatureRef> vertices{};      // of the shape, for those of `hull`
  std::vector<FeatureRef> edges{};         // likewise
  std::vector<FeatureRef> faces{};         // likewise
  Plane<S> plane{Vec3<S>::UnitX(), S(0)};  // of half-spaces

  /// How many vertices there are; a half-space has none.
  int count() const;
  const Vec3<S>& vertex(int index) const;
  /// Not of half-spaces.
  SupportSet<S> support() const;
  /// No coordinate of the core is larger than this, metres; of a half-space the offset.
  S reach() const;
  /// The feature of the shape that a feature of the core stands for.
  FeatureRef ref(Owner owner, const CoreFeature& feature) const;
};

/// `core_margin`: of hulls, metres. Not for meshes.
template <class S>
ShapeCore<S> core_of(const Shape<S>& shape, double core_margin);

/// The edge of a hull between two of its vertices, half-edge / 2; -1 where there is none.
template <class S>
int edge_between(const Hull<S>& hull, int one, int other);

}  // namespace contactscope
