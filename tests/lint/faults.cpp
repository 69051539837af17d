#include "lint/faults.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "trace/find.h"

namespace contactscope::lint {
namespace {

Pose<double>& pose_of(trace::Frame& frame, const std::string& name) {
  return std::ranges::find(frame.poses, name, &trace::Placement::first)->second;
}

bool is_between(const trace::Pair& pair, const Target& target) {
  return (pair.a == target.a && pair.b == target.b) || (pair.a == target.b && pair.b == target.a);
}

using Seeding = std::function<void(trace::Frame&, const Target&)>;

Seeding on_pair(const std::function<void(trace::Pair&)>& change) {
  return [=](trace::Frame& frame, const Target& target) {
    for (trace::Pair& pair : frame.pairs)
      if (is_between(pair, target)) change(pair);
  };
}
Seeding on_manifolds(const std::function<void(trace::Manifold&)>& change) {
  return on_pair([=](trace::Pair& pair) { std::ranges::for_each(pair.manifolds, change); });
}
Seeding on_points(const std::function<void(const trace::Manifold&, trace::Point&)>& change) {
  return on_manifolds([=](trace::Manifold& manifold) {
    for (trace::Point& point : manifold.points) change(manifold, point);
  });
}

Seeding impulses_times(double factor) {
  return on_points([=](const trace::Manifold&, trace::Point& point) {
    if (!point.impulse) return;
    point.impulse->normal *= factor;
    point.impulse->friction *= factor;
  });
}

Vec3d sideways(const Vec3d& normal) {
  return normal.cross(std::abs(normal.x()) < 0.8 ? Vec3d::UnitX() : Vec3d::UnitY()).normalized();
}

Seeding normals_turned(double degrees) {
  return on_manifolds([=](trace::Manifold& manifold) {
    const Eigen::AngleAxisd turn(degrees * std::numbers::pi / 180, sideways(manifold.normal));
    manifold.normal = turn * manifold.normal;
  });
}

Seeding separations_less(double metres) {
  return on_points(
      [=](const trace::Manifold&, trace::Point& point) { point.separation -= metres; });
}

Seeding points_kept(std::size_t count) {
  return on_manifolds([=](trace::Manifold& manifold) {
    if (manifold.points.size() > count) manifold.points.resize(count);
  });
}

Seeding points_moved(double along, double across) {
  return on_points([=](const trace::Manifold& manifold, trace::Point& point) {
    const Vec3d by = along * manifold.normal + across * sideways(manifold.normal);
    point.position += by;
    if (point.on_a) *point.on_a += by;
    if (point.on_b) *point.on_b += by;
  });
}

Seeding on_body(const std::function<void(Pose<double>&)>& change) {
  return [=](trace::Frame& frame, const Target& target) { change(pose_of(frame, target.body)); };
}

void lose_pair(trace::Frame& frame, const Target& target) {
  std::erase_if(frame.pairs, [&](const trace::Pair& pair) { return is_between(pair, target); });
}

void twice(trace::Frame& frame, const Target& target, bool is_turned) {
  const std::vector<trace::Pair> pairs = frame.pairs;
  for (trace::Pair pair : pairs) {
    if (!is_between(pair, target)) continue;
    if (is_turned) {
      std::swap(pair.a, pair.b);
      for (trace::Manifold& manifold : pair.manifolds) {
        manifold.normal = -manifold.normal;
        for (trace::Point& point : manifold.points) std::swap(point.on_a, point.on_b);
      }
    }
    frame.pairs.push_back(pair);
  }
}

}  // namespace

const std::vector<Fault>& faults() {
  using trace::Frame;
  using trace::Manifold;
  using trace::Pair;
  using trace::Point;
  static const std::vector<Fault> all = {
      {"the pair is lost", {"pairs_flicker"}, lose_pair},
      {"the pair is never there", {"pairs_flicker"}, lose_pair, {"pair_never_reported"}},
      {"all pairs of a body are lost",
       {"pairs_flicker"},
       [](Frame& frame, const Target& target) {
         std::erase_if(frame.pairs, [&](const Pair& pair) {
           return pair.a == target.body || pair.b == target.body;
         });
       }},
      {"all pairs are lost",
       {"pairs_flicker"},
       [](Frame& frame, const Target&) { frame.pairs.clear(); }},
      {"the pair is separated", {"pairs_flicker", "overlap_told_apart"}, on_pair([](Pair& pair) {
         pair.manifolds.clear();
         pair.state = "separated";
       })},
      {"touching without points",
       {"touching_without_points"},
       on_pair([](Pair& pair) { pair.manifolds.clear(); }),
       {"touching_without_points"}},
      {"two points are kept", {"points_flicker"}, points_kept(2)},
      {"one point is kept", {"points_flicker"}, points_kept(1)},
      {"the first point is lost", {"points_flicker"}, on_manifolds([](Manifold& manifold) {
         if (manifold.points.size() > 1) manifold.points.erase(manifold.points.begin());
       })},
      {"the deepest point is lost", {"points_flicker"}, on_manifolds([](Manifold& manifold) {
         if (manifold.points.size() < 2) return;
         manifold.points.erase(std::ranges::min_element(manifold.points, {}, &Point::separation));
       })},
      {"a point is there twice",
       {"points_twice"},
       on_manifolds([](Manifold& manifold) { manifold.points.push_back(manifold.points.front()); }),
       {"points_twice"}},
      {"a manifold is there twice",
       {"points_twice"},
       on_pair([](Pair& pair) { pair.manifolds.push_back(pair.manifolds.front()); }),
       {"points_twice"}},
      {"the pair is there twice",
       {"pairs_twice"},
       [](Frame& frame, const Target& target) { twice(frame, target, false); },
       {"pairs_twice"}},
      {"the pair is there in both orders",
       {"pairs_twice"},
       [](Frame& frame, const Target& target) { twice(frame, target, true); },
       {"pairs_twice"}},
      {"normals are flipped",
       {"flipped_normals"},
       on_manifolds([](Manifold& manifold) { manifold.normal = -manifold.normal; }),
       {"flipped_normals"}},
      {"normals turn by 8 degrees", {"normals_jump"}, normals_turned(8)},
      {"normals turn by 30 degrees", {"normals_jump"}, normals_turned(30)},
      {"normals turn by 90 degrees", {"normals_jump"}, normals_turned(90)},
      {"separations are 100 mm less", {"depths_jump"}, separations_less(0.1)},
      {"separations are 10 mm less", {"depths_jump"}, separations_less(0.01)},
      {"separations are 1 mm less", {"depths_jump"}, separations_less(0.001)},
      {"one separation is 20 mm less", {"depths_jump"}, on_manifolds([](Manifold& manifold) {
         manifold.points.front().separation -= 0.02;
       })},
      {"points are 50 mm off", {"surface"}, points_moved(0.05, 0), {"surface"}},
      {"points are beyond the faces", {"surface"}, points_moved(0, 2), {"surface"}},
      {"impulses are missing", {"impulses_flicker"}, impulses_times(0)},
      {"impulses are four times as large", {"impulses_flicker"}, impulses_times(4)},
      {"the body is elsewhere", {"poses_jump"}, on_body([](Pose<double>& pose) {
         pose.position += Vec3d(0.1, 0.05, 0.02);
       })},
      {"the body is turned", {"poses_jump"}, on_body([](Pose<double>& pose) {
         pose.rotation =
             Quat<double>(Eigen::AngleAxisd(0.3, Vec3d(1, 2, 3).normalized())) * pose.rotation;
       })},
      {"time stands", {"times_do_not_rise"}, [](Frame& frame, const Target&) { frame.time -= 1; }},
  };
  return all;
}

void seed(Trace& trace, const Fault& fault, const Target& target, Often often) {
  const std::size_t count = trace.frames.size();
  for (std::size_t f = 0; f < count; ++f) {
    const bool is_hit = often == Often::Always   ? !fault.always.empty() || f % 2 == 1
                        : often == Often::Rarely ? f % 30 == 20
                                                 : f == count / 2;
    if (is_hit) fault.seed(trace.frames[f], target);
  }
}

std::vector<Target> targets(const Trace& trace, std::size_t count) {
  struct Candidate {
    Target target;
    std::size_t frames = 0;
    double moved = 0;
  };
  std::map<std::pair<std::string, std::string>, Candidate> all;
  const auto position = [&](std::size_t frame, const std::string& name) {
    return pose_of(const_cast<trace::Frame&>(trace.frames[frame]), name).position;
  };
  std::map<std::string, double> moved;  // the most in a frame, metres
  for (const auto& [name, pose] : trace.frames.front().poses)
    for (std::size_t f = 1; f < trace.frames.size(); ++f)
      moved[name] = std::max(moved[name], (position(f, name) - position(f - 1, name)).norm());
  const auto is_dynamic = [&](const std::string& name) {
    const trace::Body* const body = trace::find_body(trace.frames.front(), name);
    return body != nullptr && body->mass > 0 && std::isfinite(body->mass);
  };
  // If an engine reports no gaps, rounding decides of overlaps of less metres.
  double touching = -2e-5;
  for (const trace::Frame& frame : trace.frames)
    for (const trace::Pair& pair : frame.pairs)
      for (const trace::Manifold& manifold : pair.manifolds)
        for (const trace::Point& point : manifold.points)
          if (point.separation > 1e-5) touching = 1e-5;
  for (const trace::Frame& frame : trace.frames)
    for (const trace::Pair& pair : frame.pairs) {
      const trace::Point* const deepest = trace::deepest_point(pair);
      if (deepest == nullptr || deepest->separation > touching) continue;
      if (pair.manifolds.size() > 1 || pair.manifolds.front().points.size() < 2) continue;
      Candidate& one = all[{pair.a, pair.b}];
      one.target = {pair.a, pair.b, is_dynamic(pair.b) ? pair.b : pair.a};
      one.moved = moved[pair.a] + moved[pair.b];
      ++one.frames;
    }
  std::vector<Candidate> best;
  for (const auto& [names, one] : all)
    if (one.frames == trace.frames.size()) best.push_back(one);
  std::ranges::stable_sort(best, {}, &Candidate::moved);
  std::vector<Target> chosen;
  for (std::size_t i = 0; i < std::min(count, best.size()); ++i) chosen.push_back(best[i].target);
  return chosen;
}

}  // namespace contactscope::lint
