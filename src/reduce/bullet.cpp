#include "reduce/bullet.h"

#include <algorithm>
#include <array>

#include "reduce/steps.h"

namespace contactscope {
namespace {

constexpr std::size_t kPlaces = 4;

/// Twice the area of a quadrilateral, squared, from its diagonals: the new point to `a`, and b to
/// c.
template <class S>
S squared_area(const Vec3<S>& arriving, const Vec3<S>& a, const Vec3<S>& b, const Vec3<S>& c) {
  return Vec3<S>(arriving - a).cross(Vec3<S>(b - c)).squaredNorm();
}

}  // namespace

/// Behaviour of Bullet, written from a description. Steps: the first four points take the four
/// places; every further one looks which of the five is the deepest, and takes the place, other
/// than that one's, where the diagonals of the new quadrilateral span the largest area. Only one
/// pairing of diagonals is tried for each place, and the arriving point is never turned away, so
/// that area gets lost. Deviation: where no place gives an area, the first that is free to go is
/// taken.
template <class S>
KeptIndices reduce_like_bullet(std::span<const ContactPoint<S>> points, const Vec3<S>& /*normal*/,
                               const ReduceOptions& options) {
  const auto separation = [&](int i) { return points[static_cast<std::size_t>(i)].separation; };
  const int all = steps::count(points);
  std::array<int, kPlaces> places = {0, 1, 2, 3};
  for (int arriving = static_cast<int>(kPlaces); arriving < all; ++arriving) {
    std::size_t deepest = kPlaces;  // the arriving point
    S least = separation(arriving);
    for (std::size_t k = 0; k < kPlaces; ++k) {
      if (separation(places[k]) < least) {
        least = separation(places[k]);
        deepest = k;
      }
    }
    // The diagonal from the arriving point, then the other one, when it takes place k.
    constexpr std::array<std::array<std::size_t, 3>, kPlaces> kDiagonals = {
        {{1, 3, 2}, {0, 3, 2}, {0, 3, 1}, {0, 2, 1}}};
    std::size_t best = kPlaces;
    S most = S(-1);
    for (std::size_t k = 0; k < kPlaces; ++k) {
      if (k == deepest) continue;
      const auto [a, b, c] = kDiagonals[k];
      const S area = squared_area(steps::at(points, arriving), steps::at(points, places[a]),
                                  steps::at(points, places[b]), steps::at(points, places[c]));
      if (area > most) {
        most = area;
        best = k;
      }
    }
    places[best] = arriving;
  }

  const std::span<const int> held(places.data(), std::min(points.size(), kPlaces));
  KeptIndices choices;
  choices.push_back(*std::min_element(held.begin(), held.end(),
                                      [&](int a, int b) { return separation(a) < separation(b); }));
  for (const int place : held) steps::add_once(choices, place);
  return steps::first_of(choices, options);
}

template KeptIndices reduce_like_bullet(std::span<const ContactPoint<float>>, const Vec3<float>&,
                                        const ReduceOptions&);
template KeptIndices reduce_like_bullet(std::span<const ContactPoint<double>>, const Vec3<double>&,
                                        const ReduceOptions&);

}  // namespace contactscope
