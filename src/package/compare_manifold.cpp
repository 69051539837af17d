#include <algorithm>
#include <cmath>
#include <limits>

#include "core/at.h"
#include "core/spell.h"
#include "package/contactscope/snapshot.h"
#include "package/facts.h"
#include "snapshot/spelling.h"

namespace contactscope::package {
namespace {

struct Nearest {
  int expected = -1, actual = -1;
  double distance = 0;
};

/// NaN counts as infinitely far.
double distance_of(const Vec3d& one, const Vec3d& other) {
  const double distance = (one - other).norm();
  return std::isnan(distance) ? std::numeric_limits<double>::infinity() : distance;
}

/// Pairs points greedily by distance, so that a moved point does not take another's partner.
std::vector<Nearest> paired_off(const std::vector<Vec3d>& expected,
                                const std::vector<Vec3d>& actual) {
  std::vector<Nearest> all;
  for (int i = 0; i < count_of(expected); ++i)
    for (int j = 0; j < count_of(actual); ++j)
      all.push_back({i, j, distance_of(at(expected, i), at(actual, j))});
  std::ranges::stable_sort(all, {}, &Nearest::distance);
  std::vector<Nearest> pairs;
  for (const Nearest& one : all) {
    const auto is_taken = [&](const Nearest& other) {
      return other.expected == one.expected || other.actual == one.actual;
    };
    if (std::ranges::none_of(pairs, is_taken)) pairs.push_back(one);
  }
  std::ranges::sort(pairs, {}, &Nearest::expected);
  return pairs;
}

bool is_near(const Vec3d& one, const Vec3d& other, double tolerance) {
  return ((one - other).array().abs() <= tolerance).all();  // false of nan
}

}  // namespace

Comparison compare_manifold(const Manifold& manifold, const Vec3& normal, double depth,
                            const std::vector<Vec3>& points, double tolerance) {
  std::vector<std::string> wrong;
  const Vec3d expected_normal = to_inside(normal), actual_normal = to_inside(manifold.normal);
  if (!is_near(expected_normal, actual_normal, tolerance))
    wrong.push_back("normal " + snapshot::spell_turn(expected_normal, actual_normal) + ": " +
                    snapshot::spell_vector(actual_normal) + " instead of " +
                    snapshot::spell_vector(expected_normal));
  const double deep = -separation_of(manifold);
  if (!manifold.points.empty() && !(std::abs(deep - depth) <= tolerance))
    wrong.push_back("depth " + snapshot::spell_length(deep) + " instead of " +
                    snapshot::spell_length(depth));
  if (manifold.points.size() != points.size())
    wrong.push_back(counted(manifold.points.size(), "point") + " instead of " +
                    std::to_string(points.size()));
  const auto places = [](const auto& list, const auto& place) {
    return mapped(list, [&](const auto& one) { return to_inside(place(one)); });
  };
  const std::vector<Vec3d> expected = places(points, [](const Vec3& point) { return point; });
  const std::vector<Vec3d> actual =
      places(manifold.points, [](const ContactPoint& point) { return point.position; });
  std::vector<bool> is_met(expected.size()), is_used(actual.size());
  for (const Nearest& pair : paired_off(expected, actual)) {
    is_met[static_cast<std::size_t>(pair.expected)] = true;
    is_used[static_cast<std::size_t>(pair.actual)] = true;
    const Vec3d &from = at(expected, pair.expected), &to = at(actual, pair.actual);
    if (!is_near(from, to, tolerance))
      wrong.push_back("point " + snapshot::spell_vector(from) + " " +
                      snapshot::spell_move(from, to));
  }
  for (std::size_t i = 0; i < is_met.size(); ++i)
    if (!is_met[i]) wrong.push_back("no point at " + snapshot::spell_vector(expected[i]));
  for (std::size_t i = 0; i < is_used.size(); ++i)
    if (!is_used[i]) wrong.push_back("an extra point at " + snapshot::spell_vector(actual[i]));
  return {wrong.empty(), separated(wrong, "; ")};
}

}  // namespace contactscope::package
