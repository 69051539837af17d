#include "field/triangle_sieve.h"

namespace contactscope {
namespace {

using SieveFloats = lanes::Pack<float>;

std::array<SieveFloats, 3> in_all_lanes(const Vec3d& point) {
  return {lanes::all(static_cast<float>(point.x())), lanes::all(static_cast<float>(point.y())),
          lanes::all(static_cast<float>(point.z()))};
}

SieveFloats magnitude(const SieveFloats& pack) { return lanes::larger(pack, -pack); }

/// Distance of `along` beyond the ends of a segment from 0 to `length`, signed.
SieveFloats beyond(const SieveFloats& along, const SieveFloats& length) {
  return along - lanes::smaller(lanes::larger(along, SieveFloats{}), length);
}

constexpr double kDiagonal = 1.7320508075688774;  // of a unit cube, rounded up

}  // namespace

[[gnu::always_inline]] inline TriangleSieve::Floats TriangleSieve::squared_distance(
    const Four& four, const std::array<Floats, 3>& point, InFrame& in_frame) {
  const Floats from_x = point[0] - four[kOrigin], from_y = point[1] - four[kOrigin + 1];
  const Floats from_z = point[2] - four[kOrigin + 2];
  const auto along = [&](std::size_t axis) {
    return four[axis] * from_x + four[axis + 1] * from_y + four[axis + 2] * from_z;
  };
  const Floats x = along(kAxes), y = along(kAxes + 3), z = along(kAxes + 6);
  // For each edge: distance on its inner side, and beyond its ends.
  const Floats first_beyond = beyond(x, four[kBase]);
  const Floats from_second = x - four[kBase];
  const Floats second = y * four[kSecond] - from_second * four[kSecond + 1];
  const Floats second_beyond =
      beyond(from_second * four[kSecond] + y * four[kSecond + 1], four[kSecond + 2]);
  const Floats third = x * four[kThird + 1] - y * four[kThird];
  const Floats third_beyond = beyond(x * four[kThird] + y * four[kThird + 1], four[kThird + 2]);
  const Floats of_first = first_beyond * first_beyond + y * y;
  const Floats of_second = second_beyond * second_beyond + second * second;
  const Floats of_third = third_beyond * third_beyond + third * third;
  const Floats in_plane = lanes::smaller(of_first, lanes::smaller(of_second, of_third));
  const auto outside = (y < 0) | (second < 0) | (third < 0);
  in_frame = {first_beyond, y, z};
  const auto by_second = of_second == in_plane;
  const auto by_third = of_third == in_plane;
  in_frame.x =
      by_second ? second_beyond * four[kSecond] - second * four[kSecond + 1]
                : (by_third ? third_beyond * four[kThird] + third * four[kThird + 1] : in_frame.x);
  in_frame.y =
      by_second ? second_beyond * four[kSecond + 1] + second * four[kSecond]
                : (by_third ? third_beyond * four[kThird + 1] - third * four[kThird] : in_frame.y);
  in_frame.x = outside ? in_frame.x : Floats{};
  in_frame.y = outside ? in_frame.y : Floats{};
  return z * z + (outside ? in_plane : Floats{});
}

NearestPoint TriangleSieve::nearest(const Vec3d& point, int seed) const {
  NearestPoint best = triangles_.nearest_of({&seed, 1}, point);
  const std::array<Floats, 3> at_point = in_all_lanes(point);
  const auto limit = [&] {
    const double distance = std::sqrt(best.squared) + 2 * slack_;
    return static_cast<float>(distance * distance * (1 + 0x1p-20));
  };
  float most = limit();
  const std::vector<int>& in_order = triangles_.mesh().tree.triangles;
  triangles_.search(point, best, [&](int leaf, int first, int count) {
    for (int k = 0; k < count; k += 4) {
      InFrame unused;
      const Floats squared =
          squared_distance(at(leaves_, at(first_of_leaf_, leaf) + k / 4), at_point, unused);
      for (std::uint32_t bits = lanes::bits<float>(squared <= lanes::all(most)); bits != 0;
           bits &= bits - 1) {
        const int lane = __builtin_ctz(bits);
        if (k + lane >= count) break;
        if (squared[lane] > most) continue;
        triangles_.improve(at(in_order, first + k + lane), point, best);
        most = limit();
      }
    }
  });
  return best;
}

NearestPoint TriangleSieve::nearest(List& list, const Vec3d& point) const {
  const std::array<Floats, 3> at_point = in_all_lanes(point);
  Floats least = lanes::all(std::numeric_limits<float>::infinity());
  InFrame unused;
  for (std::size_t i = 0; i < list.fours_.size(); ++i) {
    list.squared_[i] = squared_distance(list.fours_[i], at_point, unused);
    least = lanes::smaller(least, list.squared_[i]);
  }
  const double distance = std::sqrt(double{lanes::smallest<float>(least)[0]}) + 2 * slack_;
  const Floats most = lanes::all(static_cast<float>(distance * distance * (1 + 0x1p-20)));
  NearestPoint best;
  constexpr int kFours = 16;  // fours whose bits fit in a number
  const int all = count_of(list.fours_);
  for (int first = 0; first < all; first += kFours) {
    std::uint64_t near = 0;
    for (int i = first; i < std::min(first + kFours, all); ++i)
      near |= std::uint64_t{lanes::bits<float>(at(list.squared_, i) <= most)} << 4 * (i - first);
    for (; near != 0; near &= near - 1) {
      const int triangle = 4 * first + __builtin_ctzll(near);
      if (triangle < count_of(list.triangles_))
        triangles_.improve(at(list.triangles_, triangle), point, best);
    }
  }
  return best;
}

float TriangleSieve::rough_distance(const List& list, const Vec3d& point) const {
  const std::array<Floats, 3> at_point = in_all_lanes(point);
  Floats least = lanes::all(std::numeric_limits<float>::infinity());
  Floats height_of_least{};
  InFrame offset;
  for (const Four& four : list.fours_) {
    const Floats squared = squared_distance(four, at_point, offset);
    height_of_least = squared < least ? offset.height : height_of_least;
    least = lanes::smaller(least, squared);
  }
  int lane = 0;
  for (int i = 1; i < 4; ++i)
    if (least[i] < least[lane]) lane = i;
  return std::copysign(std::sqrt(least[lane]), height_of_least[lane]);
}

TriangleSieve::Cube TriangleSieve::cube(const Vec3d& middle, double half_side,
                                        const Vec3d& near) const {
  // (sqrt(a) + e)^2 <= (1 + t) a + (1 + 1/t) e^2 for any t: a distance's rounding, for its square.
  constexpr double kShare = 0x1p-8;
  const double own = (middle - near).squaredNorm();
  const double by_distance = std::sqrt(own) + 2 * kDiagonal * half_side;
  const double slack = (1 + 1 / kShare) * 4 * slack_ * slack_;
  const auto limit_of = [&](double squared) {
    return lanes::all(static_cast<float>((1 + kShare) * squared + slack));
  };
  const double squared = own + 8 * half_side * slack_;
  return {in_all_lanes(middle),
          in_all_lanes(near),
          limit_of(by_distance * by_distance),
          limit_of(squared + 3 * half_side * half_side),
          lanes::all(static_cast<float>((1 + kShare) * 2 * half_side)),
          lanes::all(static_cast<float>(half_side)),
          lanes::all(static_cast<float>(2 * slack_))};
}

[[gnu::always_inline]] inline std::uint32_t TriangleSieve::over_triangles(const Four& four,
                                                                          const Cube& cube) {
  const Floats from_x = cube.middle[0] - four[kOrigin];
  const Floats from_y = cube.middle[1] - four[kOrigin + 1];
  const Floats from_z = cube.middle[2] - four[kOrigin + 2];
  const auto along = [&](std::size_t axis) {
    return four[axis] * from_x + four[axis + 1] * from_y + four[axis + 2] * from_z;
  };
  const Floats x = along(kAxes), y = along(kAxes + 3), height = along(kAxes + 6);
  // Largest distance of the cube's points beyond an edge: rounding and the tilt of the side.
  const Floats out =
      cube.slack + four[kLean] * (magnitude(height) + cube.half_side * four[kNormal] + cube.slack);
  const auto reaches = [&](const Floats& inner, std::size_t edge) {
    return inner + cube.half_side * four[kInward + edge] >= -out;
  };
  return lanes::bits<float>((height * height <= cube.most) & reaches(y, 0) &
                            reaches(y * four[kSecond] - (x - four[kBase]) * four[kSecond + 1], 1) &
                            reaches(x * four[kThird + 1] - y * four[kThird], 2));
}

/// See the class: with x*, the triangle's point nearest to c, and r = |x-x*|,
///     |c-x|^2 >= |c-x*|^2 + r^2   and   |x-q|_1 <= |x*-q|_1 + sqrt(3) r,
/// so that |c-x*|^2 <= |c-q|^2 + 2 h |x*-q|_1 + 3 h^2. The worst r is sqrt(3) h.
[[gnu::noinline]] std::uint32_t TriangleSieve::near_enough(const Four& four, const Cube& cube) {
  InFrame offset;
  const Floats own = squared_distance(four, cube.middle, offset);
  Floats sum{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    sum += magnitude((cube.middle[axis] - cube.nearest[axis]) -
                     (four[kAxes + axis] * offset.x + four[kAxes + 3 + axis] * offset.y +
                      four[kAxes + 6 + axis] * offset.height));
  return lanes::bits<float>(own <= lanes::smaller(cube.most, cube.by_nearest + cube.rise * sum));
}

/// No branch depends on whether a triangle is kept, which is unpredictable.
template <class Sift>
void TriangleSieve::append_if(const List& from, std::vector<int>& found, const Sift& sift) {
  const std::size_t before = found.size(), all = from.triangles_.size();
  found.resize(before + all + 4);
  int* to = found.data() + before;
  for (std::size_t i = 0; i < from.fours_.size(); ++i) {
    std::uint32_t kept = sift(i);
    if (4 * i + 4 > all) kept &= (1U << (all - 4 * i)) - 1;
    for (std::size_t lane = 0; lane < 4; ++lane) {
      *to = from.triangles_[std::min(4 * i + lane, all - 1)];
      to += kept >> lane & 1U;
    }
  }
  found.resize(static_cast<std::size_t>(to - found.data()));
}

void TriangleSieve::append(const List& from, const Vec3d& middle, double half_side,
                           const Vec3d& near, std::vector<int>& found) const {
  const Cube requested = cube(middle, half_side, near);
  append_if(from, found, [&](std::size_t i) {
    const std::uint32_t over = over_triangles(from.fours_[i], requested);
    return over == 0 ? 0 : over & near_enough(from.fours_[i], requested);
  });
}

void TriangleSieve::fill(std::span<const int> triangles, List& list) const {
  list.triangles_.assign(triangles.begin(), triangles.end());
  lay_out(list);
}

void TriangleSieve::fill_around(const Vec3d& middle, double half_side, const Vec3d& near,
                                List& list) const {
  list.triangles_.clear();
  const Cube requested = cube(middle, half_side, near);
  const std::vector<int>& in_order = triangles_.mesh().tree.triangles;
  triangles_.around(middle, half_side, near, [&](int leaf, int first, int count) {
    for (int k = 0; k < count; k += 4) {
      const Four& four = at(leaves_, at(first_of_leaf_, leaf) + k / 4);
      std::uint32_t kept = over_triangles(four, requested);
      if (kept == 0) continue;
      kept &= near_enough(four, requested);
      for (int lane = 0; lane < std::min(4, count - k); ++lane)
        if ((kept >> lane & 1U) != 0) list.triangles_.push_back(at(in_order, first + k + lane));
    }
  });
  lay_out(list);
}

void TriangleSieve::fill_within(List& from, const Vec3d& middle, double half_side,
                                const Vec3d& near, List& list) const {
  list.triangles_.clear();
  if (from.leaning_) {
    // Distances decide here, so the nearest point itself is worth its search.
    const Cube requested = cube(middle, half_side, nearest(from, middle).point);
    append_if(from, list.triangles_, [&](std::size_t i) {
      const std::uint32_t in_reach = lanes::bits<float>(from.squared_[i] <= requested.most);
      return in_reach == 0 ? 0 : in_reach & near_enough(from.fours_[i], requested);
    });
  } else {
    const Cube requested = cube(middle, half_side, near);
    append_if(from, list.triangles_, [&](std::size_t i) {
      const Four& four = from.fours_[i];
      const std::uint32_t over = over_triangles(four, requested);
      const auto leaning = lanes::bits<float>(four[kLean] >= lanes::all(kTrustedLean));
      return (over & leaning) == 0 ? over : over & near_enough(four, requested);
    });
  }
  lay_out(list);
}

TriangleSieve::TriangleSieve(const NearestTriangles& triangles, double size)
    : triangles_(triangles), size_(size), slack_(kRoughness * size) {
  const Mesh<double>& mesh = triangles.mesh();
  const std::vector<float> leans = largest_leans(mesh);
  flat_.reserve(mesh.triangles.size());
  for (int t = 0; t < mesh.triangle_count(); ++t) flat_.push_back(flat(mesh, t, at(leans, t)));
  first_of_leaf_.assign(mesh.tree.nodes.size(), -1);
  for (int i = 0; i < count_of(mesh.tree.nodes); ++i) {
    const auto& [box, next, count] = at(mesh.tree.nodes, i);
    if (count == 0) continue;
    at(first_of_leaf_, i) = count_of(leaves_);
    const auto own = std::span(mesh.tree.triangles)
                         .subspan(static_cast<std::size_t>(next), static_cast<std::size_t>(count));
    for (std::size_t first = 0; first < own.size(); first += 4)
      lay_out(own.subspan(first), leaves_.emplace_back());
  }
}

TriangleSieve::Flat TriangleSieve::flat(const Mesh<double>& mesh, int triangle, float lean) const {
  int longest = 0;
  double length = 0;
  for (int k = 0; k < 3; ++k) {
    const double own = (mesh.corner(triangle, (k + 1) % 3) - mesh.corner(triangle, k)).norm();
    if (own <= length) continue;
    length = own;
    longest = k;
  }
  const Vec3d origin = mesh.corner(triangle, longest);
  const Vec3d third = mesh.corner(triangle, (longest + 2) % 3) - origin;
  const Vec3d& normal = mesh.normal(triangle);
  const Vec3d first_axis = (mesh.corner(triangle, (longest + 1) % 3) - origin) / length;
  const Vec3d second_axis = normal.cross(first_axis);
  const Eigen::Vector2d tip(third.dot(first_axis), third.dot(second_axis));
  const Eigen::Vector2d second = tip - Eigen::Vector2d(length, 0);
  Flat numbers{};
  const auto set = [&](int first, const auto& vector) {
    for (int i = 0; i < vector.size(); ++i) at(numbers, first + i) = static_cast<float>(vector[i]);
  };
  set(kOrigin, origin);
  set(kAxes, first_axis);
  set(kAxes + 3, second_axis);
  set(kAxes + 6, normal);
  numbers[kBase] = static_cast<float>(length);
  set(kSecond, Eigen::Vector2d(second.normalized()));
  numbers[kSecond + 2] = static_cast<float>(second.norm());
  set(kThird, Eigen::Vector2d(tip.normalized()));
  numbers[kThird + 2] = static_cast<float>(tip.norm());
  // The error of a sliver's normal grows with the rounding of its corners.
  const double rounding = 0x1p-48 * size_ / tip.y();
  numbers[kLean] = rounding < 1 ? static_cast<float>(lean + rounding) : kAnyLean;
  const auto sum_of = [](const Vec3d& direction) {
    return static_cast<float>(direction.lpNorm<1>() * (1 + 0x1p-20));
  };
  numbers[kInward] = sum_of(second_axis);
  const Eigen::Vector2d second_direction = second.normalized(), third_direction = tip.normalized();
  numbers[kInward + 1] =
      sum_of(second_direction.x() * second_axis - second_direction.y() * first_axis);
  numbers[kInward + 2] =
      sum_of(third_direction.y() * first_axis - third_direction.x() * second_axis);
  numbers[kNormal] = sum_of(normal);
  return numbers;
}

void TriangleSieve::lay_out(List& list) const {
  const std::span<const int> triangles = list.triangles_;
  list.fours_.resize((triangles.size() + 3) / 4);
  list.squared_.resize(list.fours_.size());
  std::size_t leaning = 0;
  for (std::size_t i = 0; i < list.fours_.size(); ++i) {
    lay_out(triangles.subspan(4 * i), list.fours_[i]);
    leaning += lanes::bits<float>(list.fours_[i][kLean] >= lanes::all(kTrustedLean)) != 0 ? 1 : 0;
  }
  list.leaning_ = 2 * leaning > list.fours_.size();
}

void TriangleSieve::lay_out(std::span<const int> triangles, Four& laid_out) const {
  const auto of = [&](std::size_t lane) {
    return at(flat_, triangles[std::min(lane, triangles.size() - 1)]).data();
  };
  const float *a = of(0), *b = of(1), *c = of(2), *d = of(3);
  for (std::size_t k = 0; k < kNumbers; k += 4) {
    const Floats one = lanes::load(a + k), two = lanes::load(b + k);
    const Floats three = lanes::load(c + k), four = lanes::load(d + k);
    const Floats low = __builtin_shufflevector(one, two, 0, 4, 1, 5);
    const Floats high = __builtin_shufflevector(one, two, 2, 6, 3, 7);
    const Floats other_low = __builtin_shufflevector(three, four, 0, 4, 1, 5);
    const Floats other_high = __builtin_shufflevector(three, four, 2, 6, 3, 7);
    Floats* to = laid_out.data() + k;
    to[0] = __builtin_shufflevector(low, other_low, 0, 1, 4, 5);
    to[1] = __builtin_shufflevector(low, other_low, 2, 3, 6, 7);
    to[2] = __builtin_shufflevector(high, other_high, 0, 1, 4, 5);
    to[3] = __builtin_shufflevector(high, other_high, 2, 3, 6, 7);
  }
}

}  // namespace contactscope
