#include "dynamics/sleep.h"

#include "core/convex_polygon.h"

namespace contactscope {
namespace {

/// The contact plane, with the mean of the points as origin.
PlaneFrame<double> contact_plane(std::span<const Vec3d> points, const Vec3d& normal) {
  Vec3d middle = Vec3d::Zero();
  for (const Vec3d& point : points) middle += (point - points[0]) / double(points.size());
  return {Vec3d(middle + points[0]), normal};
}

struct BorderPoint {
  double distance = std::numeric_limits<double>::infinity();
  std::size_t edge = 0;  // from corner `edge` to the next
  bool corner = false;   // the nearest point is an end of it
};

/// Rounds margins within rounding to zero.
double beyond_rounding(double margin, double rounding) {
  return std::abs(margin) <= rounding ? 0 : margin;
}

BorderPoint nearest_on_border(const std::vector<Vec2d>& corners, const Vec2d& point,
                              double rounding) {
  BorderPoint nearest;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2d along = corners[(i + 1) % corners.size()] - corners[i];
    const Vec2d offset = point - corners[i];
    const double length = along.norm();
    const double at = offset.dot(along) / length;
    const Vec2d foot = corners[i] + std::clamp(at, 0.0, length) / length * along;
    const double distance = Vec2d(point - foot).norm();
    if (distance >= nearest.distance) continue;
    nearest = {distance, i, at < -rounding || at > length + rounding};
  }
  return nearest;
}

bool is_inside(const std::vector<Vec2d>& corners, const Vec2d& point) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2d along = corners[(i + 1) % corners.size()] - corners[i];
    if (cross(along, Vec2d(point - corners[i])) < 0) return false;
  }
  return true;
}

/// The two corners that are farthest from each other.
std::array<Vec2d, 2> ends_of(const std::vector<Vec2d>& corners) {
  std::array<Vec2d, 2> ends{corners[0], corners[0]};
  for (const Vec2d& one : corners)
    for (const Vec2d& other : corners)
      if ((other - one).squaredNorm() > (ends[1] - ends[0]).squaredNorm()) ends = {one, other};
  return ends;
}

/// Largest distance of the corners from a line.
double width_of(const std::vector<Vec2d>& corners, const std::array<Vec2d, 2>& ends) {
  const Vec2d along = ends[1] - ends[0];
  double width = 0;
  for (const Vec2d& corner : corners)
    width = std::max(width, std::abs(cross(along, Vec2d(corner - ends[0]))) / along.norm());
  return width;
}

}  // namespace

Islands::Islands(int bodies) : parents_(static_cast<std::size_t>(bodies)) {
  std::iota(parents_.begin(), parents_.end(), 0);
}

int Islands::of(int body) {
  while (at(parents_, body) != body) body = at(parents_, body) = at(parents_, at(parents_, body));
  return body;
}

void Islands::join(int a, int b) {
  const auto [lower, higher] = std::minmax({of(a), of(b)});
  at(parents_, higher) = lower;
}

template <class S>
Sleepers<S>::Sleepers(const std::vector<Body<S>>& bodies, const SolverSettings& settings) {
  if (!settings.sleep_after) return;
  after_ = *settings.sleep_after;
  speed_ = settled(settings, bodies).sleep_speed.value_or(0);
  asleep_.assign(bodies.size(), false);
  still_.assign(bodies.size(), 0);
}

template <class S>
Islands Sleepers<S>::join(const std::vector<Body<S>>& bodies,
                          std::span<const Touch> touches) const {
  Islands islands(count_of(bodies));
  for (const Touch& touch : touches)
    if (at(bodies, touch.a).dynamic() && at(bodies, touch.b).dynamic())
      islands.join(touch.a, touch.b);
  return islands;
}

template <class S> void Sleepers<S>::wake(int body) {
  if (!may_sleep()) return;
  at(asleep_, body) = false;
  at(still_, body) = 0;
}

template <class S>
bool Sleepers<S>::wake(const std::vector<Body<S>>& bodies, std::span<const Touch> touches) {
  if (std::ranges::none_of(asleep_, [](bool asleep) { return asleep; })) return false;
  Islands islands = join(bodies, touches);
  std::vector<bool> wakes(bodies.size());  // by island
  for (int i = 0; i < count_of(bodies); ++i)
    if (at(bodies, i).dynamic() && !asleep(i)) at(wakes, islands.of(i)) = true;
  const auto is_moved = [&](int i) {
    const Body<S>& body = at(bodies, i);
    return !body.dynamic() && !(body.velocity.isZero(S(0)) && body.angular_velocity.isZero(S(0)));
  };
  for (const Touch& touch : touches) {
    if (is_moved(touch.a)) at(wakes, islands.of(touch.b)) = true;
    if (is_moved(touch.b)) at(wakes, islands.of(touch.a)) = true;
  }
  bool any = false;
  for (int i = 0; i < count_of(bodies); ++i) {
    if (!asleep(i) || !at(wakes, islands.of(i))) continue;
    wake(i);
    any = true;
  }
  return any;
}

template <class S>
void Sleepers<S>::settle(std::vector<Body<S>>& bodies, std::span<const Touch> touches, double dt) {
  if (!may_sleep()) return;
  bool any = false;
  for (int i = 0; i < count_of(bodies); ++i) {
    const Body<S>& body = at(bodies, i);
    if (!body.dynamic() || asleep(i)) continue;
    at(still_, i) = mean_speed(body) <= speed_ ? at(still_, i) + dt : 0;
    any = any || rests(at(still_, i));
  }
  if (!any) return;
  Islands islands = join(bodies, touches);
  std::vector<double> least(still_);  // by island
  for (int i = 0; i < count_of(bodies); ++i)
    at(least, islands.of(i)) = std::min(at(least, islands.of(i)), at(still_, i));
  for (int i = 0; i < count_of(bodies); ++i) {
    Body<S>& body = at(bodies, i);
    if (!body.dynamic() || asleep(i) || !rests(at(least, islands.of(i)))) continue;
    at(asleep_, i) = true;
    body.velocity.setZero();
    body.angular_velocity.setZero();
  }
}

template <class S> double mean_speed(const Body<S>& body) {
  return std::sqrt(2 * kinetic_energy(body) / static_cast<double>(body.mass));
}

template <class S>
void solve_awake(std::vector<Body<S>>& bodies, std::span<const PairContacts<S>> pairs,
                 std::vector<PairImpulses<S>>& impulses, const Vec3<S>& gravity,
                 const SolverSettings& settings, S dt, const Sleepers<S>& sleepers) {
  const SolverSettings of_all = settled(settings, bodies);
  std::vector<int> awake;                     // bodies in the step
  std::vector<int> place(bodies.size(), -1);  // of each body in `awake`
  for (int i = 0; i < count_of(bodies); ++i) {
    if (sleepers.asleep(i)) continue;
    at(place, i) = count_of(awake);
    awake.push_back(i);
  }
  if (awake.size() == bodies.size())
    return solve_step<S>(bodies, pairs, impulses, gravity, of_all, dt);

  impulses.resize(pairs.size());
  std::vector<Body<S>> moving = mapped(awake, [&](int i) { return at(bodies, i); });
  std::vector<std::size_t> acting;
  std::vector<PairContacts<S>> contacts;
  std::vector<PairImpulses<S>> given;
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const PairContacts<S>& pair = pairs[p];
    // Sleeping bodies touch no awake dynamic body, else they would be awake too.
    if (at(place, pair.a) < 0 || at(place, pair.b) < 0) continue;
    acting.push_back(p);
    contacts.push_back(pair);
    contacts.back().a = at(place, pair.a);
    contacts.back().b = at(place, pair.b);
    given.push_back(std::move(impulses[p]));
  }
  solve_step<S>(moving, contacts, given, gravity, of_all, dt);
  for (std::size_t i = 0; i < acting.size(); ++i) impulses[acting[i]] = std::move(given[i]);
  for (std::size_t i = 0; i < awake.size(); ++i) at(bodies, awake[i]) = moving[i];
}

template class Sleepers<float>;
template class Sleepers<double>;
CONTACTSCOPE_FLOAT_AND_DOUBLE(mean_speed, solve_awake);

double rounding_of(std::span<const Vec3d> points, const Vec3d& center_of_mass, double epsilon) {
  double largest = center_of_mass.cwiseAbs().maxCoeff();
  for (const Vec3d& point : points) largest = std::max(largest, point.cwiseAbs().maxCoeff());
  return 64 * epsilon * largest;
}

trace::Stability rest_of(std::span<const Vec3d> points, const Vec3d& normal,
                         const Vec3d& center_of_mass, double rounding) {
  trace::Stability result;
  result.center_of_mass = result.projection = center_of_mass;
  result.verdict = "no contact";
  if (points.empty()) return result;
  const PlaneFrame<double> plane = contact_plane(points, normal);
  const Vec2d projection = plane.seen(center_of_mass);
  result.projection = plane.place(projection);
  const std::vector<Vec2d> corners =
      convex_polygon(mapped(points, [&](const Vec3d& point) { return plane.seen(point); }));
  for (const Vec2d& corner : corners) result.support.push_back(plane.place(corner));

  const std::array<Vec2d, 2> ends = ends_of(corners);
  if ((ends[1] - ends[0]).norm() <= rounding) {
    result.verdict = "turns about a point";
    result.margin = beyond_rounding(-Vec2d(projection - corners[0]).norm(), rounding);
    return result;
  }
  const BorderPoint border = nearest_on_border(corners, projection, rounding);
  if (width_of(corners, ends) <= rounding) {
    result.verdict = "turns about a line";
    result.margin = beyond_rounding(-border.distance, rounding);
    result.axis = {plane.place(ends[0]), plane.place(ends[1])};
    return result;
  }
  const bool inside = is_inside(corners, projection);
  result.margin = beyond_rounding(inside ? border.distance : -border.distance, rounding);
  if (result.margin > 0) {
    result.verdict = "stable";
  } else if (border.corner && result.margin < 0) {
    result.verdict = "turns about a point";
  } else {
    result.verdict = "turns about a line";
    result.axis = {plane.place(corners[border.edge]),
                   plane.place(corners[(border.edge + 1) % corners.size()])};
  }
  return result;
}

trace::Stability rest_of(const trace::Pair& pair, const std::string& shape,
                         const Vec3d& center_of_mass, double epsilon) {
  std::vector<Vec3d> points;
  Vec3d normal = Vec3d::Zero();
  for (const trace::Manifold& manifold : pair.manifolds) {
    for (const trace::Point& point : manifold.points) points.push_back(point.position);
    normal += static_cast<double>(manifold.points.size()) * manifold.normal;
  }
  // If opposite normals cancel, use any of them.
  if (normal.norm() > 0.5)
    normal.normalize();
  else if (!pair.manifolds.empty())
    normal = pair.manifolds.front().normal;
  trace::Stability result =
      rest_of(points, normal, center_of_mass, rounding_of(points, center_of_mass, epsilon));
  result.shape = shape;
  return result;
}

}  // namespace contactscope
