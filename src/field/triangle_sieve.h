#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/pack.h"
#include "field/nearest_point.h"

namespace contactscope {

/// Finds which triangles of a surface can be nearest to a point, or to some point of a cube, four at a
/// time in single precision; a double decides among the few that are left. For fields: points are in a
/// lattice whose corner is the origin, with coordinates that float holds exactly, as all multiples of 1/8
/// of a cell up to 2^20 are.
///
/// A triangle can be nearest to a point p of a cube only if it has a point x that is no farther from p than
/// q is, the point of the surface that is nearest to the middle c: |p-x|^2 <= |p-q|^2. The difference of
/// both sides is linear in p, so that it is largest at a corner of the cube, and
///
///     |c-x|^2  <=  |c-q|^2 + 2 h |x-q|_1        h: half the side of the cube; |.|_1: sum of the axes
///
/// holds for each such x. On a flat surface that leaves a disc about q whose radius is some three h,
/// however far from the surface the cube is; any other point of the surface does in the place of q, and
/// leaves more. And x is where the way from p to it leans little from the triangle's normal (lean.h): the
/// cube must meet the prism over the triangle, its sides tilted outward so much. That leaves little more
/// than the shadow of the cube.
class TriangleSieve {
  using Floats = lanes::Pack<float>;
  /// The numbers of four triangles side by side (Number).
  using Four = std::array<Floats, 24>;

 public:
  /// `size`: the largest coordinate, of points and of triangles. Keeps a reference to `triangles`.
  TriangleSieve(const NearestTriangles& triangles, double size);

  /// Triangles laid out for the questions below.
  class List {
   public:
    std::span<const int> triangles() const { return triangles_; }
    /// Most of them have no small lean: to sift them is dear.
    bool leaning() const { return leaning_; }

   private:
    friend class TriangleSieve;
    std::vector<int> triangles_;
    std::vector<Four> fours_;
    std::vector<Floats> squared_;  // distances from the point that was asked last
    bool leaning_ = false;
  };

  // Lists are filled, and not returned, so that they keep their memory.

  void fill(std::span<const int> triangles, List& list) const;
  /// All triangles that can be nearest to a point of a cube. `near`: a point of the surface, best the
  /// one that is nearest to the cube's middle.
  void fill_around(const Vec3d& middle, double half_side, const Vec3d& near, List& list) const;
  /// The same among those of a list, and some others.
  void fill_within(List& from, const Vec3d& middle, double half_side, const Vec3d& near,
                   List& list) const;
  /// Without the others, appended to `found`.
  void append(const List& from, const Vec3d& middle, double half_side, const Vec3d& near,
              std::vector<int>& found) const;

  /// The nearest of all triangles. `seed`: tried first, a triangle near by makes the search short.
  NearestPoint nearest(const Vec3d& point, int seed) const;
  /// The nearest of a list.
  NearestPoint nearest(List& list, const Vec3d& point) const;
  /// The distance from the nearest of a list, off by kRoughness of the size at most, negative behind it.
  float rough_distance(const List& list, const Vec3d& point) const;

  /// What rounding may add to a distance, as a part of the size. Some 20 roundings of 2^-24.
  static constexpr double kRoughness = 0x1p-18;

 private:
  /// A triangle in a frame of its own: its longest edge from the origin along the first axis, the normal
  /// along the third.
  enum Number {
    kOrigin = 0,
    kAxes = 3,     // three of three numbers each
    kBase = 12,    // length of the longest edge
    kSecond = 13,  // direction of the edge after it, two numbers, and its length
    kThird = 16,   // direction from the origin to the third corner, and its length
    kLean = 19,    // lean.h
    kInward = 20,  // of each edge, in the order above: |.|_1 of the direction inward
    kNormal = 23,  // the same of the normal
    kNumbers = 24
  };
  using Flat = std::array<float, kNumbers>;
  /// Where triangles lean less, those that a cube is over are few, and distances hardly leave out more.
  static constexpr float kTrustedLean = 0.25F;

  Flat flat(const Mesh<double>& mesh, int triangle, float lean) const;
  void lay_out(List& list) const;
  /// Four triangles of this many; the last one fills up the others.
  void lay_out(std::span<const int> triangles, Four& four) const;
  /// From the nearest point of each triangle to a point, in the triangles' frames.
  struct InFrame {
    Floats x, y, height;
  };
  /// A cube as triangles are asked about it.
  struct Cube {
    std::array<Floats, 3> middle, nearest;  // points, the latter on the surface
    Floats most, by_nearest, rise;
    Floats half_side, slack;
  };
  Cube cube(const Vec3d& middle, double half_side, const Vec3d& near) const;
  /// A bit for each triangle whose tilted prism meets the cube.
  static std::uint32_t over_triangles(const Four& four, const Cube& cube);
  /// A bit for each that is near enough.
  static std::uint32_t near_enough(const Four& four, const Cube& cube);
  /// Appends the triangles of each four i for which sift(i) has a bit.
  template <class Sift>
  static void append_if(const List& from, std::vector<int>& found, const Sift& sift);
  static Floats squared_distance(const Four& four, const std::array<Floats, 3>& point,
                                 InFrame& offset);

  const NearestTriangles& triangles_;
  double size_, slack_;  // the latter of a distance
  std::vector<Flat> flat_;
  std::vector<Four> leaves_;        // the triangles of each leaf of the mesh's tree, four by four
  std::vector<int> first_of_leaf_;  // of `leaves_`; by number of the tree's node
};

}  // namespace contactscope
