#pragma once

#include "core/random.h"
#include "manifold/pair_cache.h"
#include "study/separation_oracle.h"

/// Random inputs of the studies; the same for a seed on any machine.
namespace contactscope {

/// Shoemake, "Uniform Random Rotations", Graphics Gems III, 1992.
Quatd uniform_rotation(std::mt19937_64& engine);

/// A randomly rotated hull of points on an ellipsoid with semi-axes of 0.5 to 1 times `size`.
Hull<double> ellipsoid_hull(std::mt19937_64& engine, int vertices, double size);

/// A generator for one case at two values > 0, uncorrelated with neighbouring cases.
std::mt19937_64 case_engine(std::uint64_t seed, int index, double one, double other);

/// Input of a reducer for one manifold.
struct ContactPolygon {
  std::vector<ContactPoint<float>> points;
  Vec3f normal = Vec3f::UnitZ();
};

/// A contact patch as made by clipping: `count` >= 3 points in order around an ellipse, planar up
/// to rounding to float.
///
/// Semi-axis 0.1 to 1 m, aspect ratio 1 to 5 (log-uniform); angles jittered by up to 0.4 of their
/// spacing; any plane within 5 m of the origin. The depth is that of a tilted plane, up to twice
/// its mean of 1 to 10 mm, plus noise of a twentieth of the mean.
ContactPolygon elliptical_polygon(std::mt19937_64& engine, int count);

/// The contacts one frame earlier or later: each point moves in the plane by up to `part` of its
/// distance from the centroid, its depth by up to `part` of itself; ids persist.
ContactPolygon neighbouring_frame(const ContactPolygon& polygon, double part,
                                  std::mt19937_64& engine);

/// The contacts of two flat faces: all at the mean depth, up to some roundings of the positions.
ContactPolygon levelled(const ContactPolygon& polygon, std::mt19937_64& engine);

struct OverlappingHulls {
  Hull<double> a, b;
  Pose<double> b_in_a;
  double size = 1;                   // metres: the longest semi-axis of both
  OracleAxis deepest;                // of least overlap
  Vec3d offset = Vec3d::UnitX();     // unit, A's frame: direction of B's earlier motion
  Vec3d turn_axis = Vec3d::UnitX();  // unit, A's frame: axis of its rotation
};

/// Two hulls of `vertices` points each on ellipsoids with semi-axes of 0.5 to 1 times a size of 1
/// mm to 1 km (log-uniform), randomly rotated, moved along a random direction until they overlap by
/// 1 to 10% of the size along it; redrawn if another axis separates them.
OverlappingHulls overlapping_hulls(std::mt19937_64& engine, int vertices);

/// A pair rounded to one scalar.
template <class S> struct RoundedHulls {
  Hull<S> a, b;
  Pose<S> b_in_a;
  PairCache<S> cache{};  // empty unless a study fills it

  explicit RoundedHulls(const OverlappingHulls& hulls)
      : a(hull_cast<S>(hulls.a)), b(hull_cast<S>(hulls.b)), b_in_a(hulls.b_in_a.cast<S>()) {}
};

/// The cases of a study, exact and in both scalars.
struct HullCases {
  std::vector<OverlappingHulls> exact;
  std::vector<RoundedHulls<float>> in_float;
  std::vector<RoundedHulls<double>> in_double;

  void add(const OverlappingHulls& hulls) {
    exact.push_back(hulls);
    in_float.emplace_back(hulls);
    in_double.emplace_back(hulls);
  }
};

/// A closed ball about the origin, poles on z, fronts outside: an even number of `meridians`, and
/// half as many steps from pole to pole. Its radius, metres, varies by the fraction `waves`, three
/// times around and twice from pole to pole.
Mesh<double> ball_mesh(int meridians, double radius = 1, double waves = 0);

/// A point and its distance from the surface of a closed mesh with fronts outside.
struct TruePoint {
  Vec3d place;
  double distance;  // metres, negative inside
  Vec3d gradient;   // of the distance, unit
};

/// By brute force over the triangles in long double. Shares no code with the tested fields.
TruePoint truth_at(const Mesh<double>& mesh, const Vec3d& place);

}  // namespace contactscope
