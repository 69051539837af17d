#pragma once

#include "field/nearest_point.h"

namespace contactscope {

// lean.cpp

/// Bounds, as tangents, on how far the direction from a point to its nearest surface point leans
/// from the normal of the triangle there. One per triangle; kAnyLean if unknown.
///
/// Inside a triangle the direction is its normal. On an edge it is between the normals of both
/// triangles. At a vertex v the direction d makes no acute angle with an edge there, d.e <= 0: the
/// normal cone of v. Let m be the mean of the normals around v. Let all edges be within an angle a
/// of the plane perpendicular to m, and neighbouring ones, seen along m, within an angle g < 180
/// degrees. Then some edge is within g/2 of d's part in that plane, and d.e <= 0 limits the angle b
/// of d and m:
///
///     tan b  <=  tan a / cos(g/2).
///
/// The bound is small for triangles that approximate a smooth surface. It needs neighbours all
/// around each vertex; triangles without them have kAnyLean.
std::vector<float> largest_leans(const Mesh<double>& mesh);

inline constexpr float kAnyLean = 1e9F;

/// Finds the triangles of a surface that can be nearest to a point, or to a point of a cube, four
/// at a time in single precision; a double decides among the rest. Points are in a lattice whose
/// corner is the origin, exact in float, like all multiples of 1/8 cell up to 2^20.
///
/// A triangle can be nearest to a point p of a cube only if it has a point x with |p-x|^2 <=
/// |p-q|^2, where q is the surface point nearest to the middle c. The difference of both sides is
/// linear in p, so it is largest at a corner of the cube, and each such x satisfies
///
///     |c-x|^2  <=  |c-q|^2 + 2 h |x-q|_1        h: half the cube's side; |.|_1: sum of the axes
///
/// On a flat surface this leaves a disc about q with a radius of some three h, at any distance of
/// the cube. Any other surface point can replace q, but leaves more triangles. The direction from p
/// to x also leans little from the triangle's normal (largest_leans): the cube must meet the prism over
/// the triangle, its sides tilted outward by the lean. This leaves little but the cube's shadow.
class TriangleSieve {
  using Floats = lanes::Pack<float>;
  /// The numbers of four triangles side by side (Number).
  using Four = std::array<Floats, 24>;

 public:
  /// `size`: largest coordinate of points and triangles. Keeps a reference to `triangles`.
  TriangleSieve(const NearestTriangles& triangles, double size);

  /// Triangles laid out for the queries below.
  class List {
   public:
    std::span<const int> triangles() const { return triangles_; }
    /// Whether most have no small lean, which makes sifting expensive.
    bool leaning() const { return leaning_; }

   private:
    friend class TriangleSieve;
    std::vector<int> triangles_;
    std::vector<Four> fours_;
    std::vector<Floats> squared_;  // distances from the last query point
    bool leaning_ = false;
  };

  // Lists are filled, not returned, so that they reuse their memory.

  void fill(std::span<const int> triangles, List& list) const;
  /// All triangles that can be nearest to a point of a cube. `near`: a surface point by its middle.
  void fill_around(const Vec3d& middle, double half_side, const Vec3d& near, List& list) const;
  /// The same within a list, plus some others.
  void fill_within(List& from, const Vec3d& middle, double half_side, const Vec3d& near,
                   List& list) const;
  /// The same without those others, appended to `found`.
  void append(const List& from, const Vec3d& middle, double half_side, const Vec3d& near,
              std::vector<int>& found) const;

  /// The nearest of all triangles. `seed`: tried first; a triangle nearby shortens the search.
  NearestPoint nearest(const Vec3d& point, int seed) const;
  NearestPoint nearest(List& list, const Vec3d& point) const;
  /// Distance from the nearest of a list, negative behind it; error up to kRoughness of the size.
  float rough_distance(const List& list, const Vec3d& point) const;

  /// Bound on the rounding of a distance, relative to the size. Some 20 roundings of 2^-24.
  static constexpr double kRoughness = 0x1p-18;

 private:
  /// A triangle in its own frame: longest edge from the origin on axis 1, normal on axis 3.
  enum Number {
    kOrigin = 0,
    kAxes = 3,     // three axes of three numbers
    kBase = 12,    // length of the longest edge
    kSecond = 13,  // direction of the next edge, two numbers, and its length
    kThird = 16,   // direction from the origin to the third corner, and its length
    kLean = 19,    // largest_leans
    kInward = 20,  // for each edge in this order: |.|_1 of its inward direction
    kNormal = 23,  // the same for the normal
    kNumbers = 24
  };
  using Flat = std::array<float, kNumbers>;
  /// Below this lean few triangles are over a cube, and distances hardly exclude more.
  static constexpr float kTrustedLean = 0.25F;

  Flat flat(const Mesh<double>& mesh, int triangle, float lean) const;
  void lay_out(List& list) const;
  /// Lays out four triangles of a list; fewer are padded with the last one.
  void lay_out(std::span<const int> triangles, Four& four) const;
  /// Offsets from the nearest point of each triangle to a point, in the triangles' frames.
  struct InFrame {
    Floats x, y, height;
  };
  /// A cube in the form of the queries.
  struct Cube {
    std::array<Floats, 3> middle, nearest;  // points; the second is on the surface
    Floats most, by_nearest, rise;
    Floats half_side, slack;
  };
  Cube cube(const Vec3d& middle, double half_side, const Vec3d& near) const;
  /// Bit mask of the triangles whose tilted prism meets the cube.
  static std::uint32_t over_triangles(const Four& four, const Cube& cube);
  /// Bit mask of the triangles that are near enough.
  static std::uint32_t near_enough(const Four& four, const Cube& cube);
  /// Appends the triangles of each four i whose bit is set in sift(i).
  template <class Sift>
  static void append_if(const List& from, std::vector<int>& found, const Sift& sift);
  static Floats squared_distance(const Four& four, const std::array<Floats, 3>& point,
                                 InFrame& offset);

  const NearestTriangles& triangles_;
  double size_, slack_;  // slack_: of a distance
  std::vector<Flat> flat_;
  std::vector<Four> leaves_;        // the triangles of each leaf of the mesh's tree, in fours
  std::vector<int> first_of_leaf_;  // in `leaves_`, by node of the tree
};

}  // namespace contactscope
