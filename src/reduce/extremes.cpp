#include "reduce/choices.h"
#include "reduce/steps.h"

namespace contactscope {
namespace {

/// Both directions along two axes of the plane.
template <class S>
std::array<Vec3<S>, 4> directions_in_plane(const Vec3<S>& normal) {
  const Vec3<S> u = any_perpendicular(normal);
  const Vec3<S> v = normal.cross(u);
  return {-u, u, -v, v};
}

/// The alternative of Gregorius 2015, "Contact Point Reduction: AABB (1)" to "(3)": the extreme
/// points along two axes in the contact plane. The axes follow the world's, so the choice changes
/// when the same patch turns: a diamond on its corner loses two of four points when its long
/// diagonal is at 45 degrees to them. Steps: an orthonormal basis (u, v) of the plane from the
/// world axis least aligned with the normal; lowest and highest along u, then along v. Points that
/// are extreme along both count once.
constexpr auto reduce_to_extremes = []<class S>(const Candidates<S>& points,
                                                const ReduceOptions& options) {
  const std::array<Vec3<S>, 4> directions = directions_in_plane(points.normal);
  KeptIndices kept;
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const int extreme = points.farthest_along(directions[k]);
    if (steps::contains(kept, extreme)) continue;
    kept.push_back(extreme);
    if (options.choices != nullptr && count_of(kept) <= options.max_points) [[unlikely]]
      options.choices->support(directions_in_plane(options.choices->points.normal)[k]);
  }
  return steps::first_of(kept, options);
};

}  // namespace

std::vector<ReducerInfo> extremes_reducers() {
  return {listed("extremes", "extremes along two axes of the plane", reduce_to_extremes)};
}

}  // namespace contactscope
