#include "reduce/steps.h"

namespace contactscope {
namespace {

constexpr std::size_t kPlaces = 4;

/// Four times the squared area of the quadrilateral a b c d in any order: whichever two of its
/// segments cross span the most.
template <class S>
S squared_area(const Vec3<S>& a, const Vec3<S>& b, const Vec3<S>& c, const Vec3<S>& d) {
  const Vec3<S> pairings[] = {(a - b).cross(c - d), (a - c).cross(b - d), (a - d).cross(b - c)};
  return std::max(
      {pairings[0].squaredNorm(), pairings[1].squaredNorm(), pairings[2].squaredNorm()});
}

/// As Bullet's persistent manifold takes points one by one, written from a description. Steps: the
/// first four points take the four places; every further one looks which of the five is the
/// deepest, and takes the place, other than that one's, which leaves the largest quadrilateral. The
/// arriving point is never turned away, so that area gets lost, the more the more points there are.
/// The deepest is always kept; the rest depends on the order of the points. Four points at most.
/// Deviations: areas of all three pairings of diagonals, the more careful of Bullet's two ways;
/// where no place gives an area, the first that is free to go is taken.
template <class S>
KeptIndices reduce_like_bullet(ContactPoints<S> points, const Vec3<S>& /*normal*/,
                               const ReduceOptions& options) {
  const auto separation = [&](int i) { return at(points, i).separation; };
  std::array<int, kPlaces> places = {0, 1, 2, 3};
  const int all = count_of(points);
  for (int arriving = static_cast<int>(kPlaces); arriving < all; ++arriving) {
    std::size_t deepest = kPlaces;  // the arriving point
    S least = separation(arriving);
    for (std::size_t k = 0; k < kPlaces; ++k) {
      if (separation(places[k]) < least) {
        least = separation(places[k]);
        deepest = k;
      }
    }
    std::size_t best = kPlaces;
    S most = S(-1);
    for (std::size_t k = 0; k < kPlaces; ++k) {
      if (k == deepest) continue;
      const auto other = [&](std::size_t turn) -> const Vec3<S>& {
        return steps::position(points, places[(k + turn) % kPlaces]);
      };
      const S area = squared_area(steps::position(points, arriving), other(1), other(2), other(3));
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

}  // namespace

ReducerInfo bullet_reducer() {
  return {"bullet", "one by one, the deepest protected, largest area", &reduce_like_bullet<float>,
          &reduce_like_bullet<double>};
}

}  // namespace contactscope
