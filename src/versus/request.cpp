#include "versus/request.h"

#include <set>

#include "core/at.h"
#include "core/convex_polygon.h"
#include "lint/claims.h"
#include "lint/own_contacts.h"
#include "manifold/dispatch.h"

namespace contactscope::versus {

void keep_queried_pairs(trace::Frame& frame) {
  std::set<std::pair<std::string, std::string>> seen;
  std::erase_if(frame.pairs, [&](const trace::Pair& pair) {
    return pair.query || !seen.emplace(pair.a, pair.b).second;
  });
}

trace::Trace request_of(const trace::Trace& whole) {
  trace::Trace request;
  request.header = whole.header;
  for (const trace::Frame& frame : whole.frames) {
    trace::Frame& requested = request.frames.emplace_back();
    requested.frame = frame.frame;
    requested.time = frame.time;
    requested.poses = frame.poses;
    requested.deformed = frame.deformed;
    requested.shapes = frame.shapes;
    requested.pairs = frame.pairs;
    keep_queried_pairs(requested);
    for (trace::Pair& pair : requested.pairs) {
      trace::Pair one;
      one.a = pair.a;
      one.b = pair.b;
      one.kind = pair.kind;
      one.state = "separated";
      pair = one;
    }
  }
  return request;
}

trace::Trace own_contacts(const trace::Trace& request) {
  lint::Solids solids;
  for (const trace::Shape& shape : request.header.shapes) solids.add(shape);
  trace::Trace answer = request;
  answer.header.scalar = "double";
  CollideOptions options;
  options.reducer = find_reducer(kDefaultReducer);
  for (trace::Frame& frame : answer.frames) {
    for (const trace::Shape& shape : frame.shapes) solids.add(shape);
    solids.deform(frame.deformed);
    for (trace::Pair& pair : frame.pairs) {
      const auto a = lint::place(solids, &frame, pair.a, {});
      const auto b = lint::place(solids, &frame, pair.b, {});
      if (!a || !b) continue;
      const Shape<double>&one = a->solid->shape(), &other = b->solid->shape();
      if (!can_collide(kind_of(one), kind_of(other))) continue;
      Manifolds<double> manifolds;
      collide(one, a->pose, other, b->pose, options, manifolds, nullptr, &pair,
              trace::Stages::none());
    }
  }
  return answer;
}

std::string to_text(const trace::Trace& trace) {
  std::string text = trace::to_json_line(trace.header) + "\n";
  for (const trace::Frame& frame : trace.frames) text += trace::to_json_line(frame) + "\n";
  return text;
}

namespace {

double area_of_points(const std::vector<Vec3d>& points, const Vec3d& normal) {
  if (points.size() < 3) return 0;
  return contactscope::area_of(convex_polygon(project(points, normal)));
}

}  // namespace

double area_of(const trace::Manifold& manifold) {
  return area_of_points(mapped(manifold.points, &trace::Point::position), manifold.normal);
}

std::vector<Truth> truths_of(const lint::Solids& solids, const trace::Frame& frame) {
  std::vector<Truth> truths;
  for (const trace::Pair& pair : frame.pairs) {
    Truth& truth = truths.emplace_back();
    truth.a = pair.a;
    truth.b = pair.b;
    const auto a = lint::place(solids, &frame, pair.a, {});
    const auto b = lint::place(solids, &frame, pair.b, {});
    if (!a || !b) continue;
    truth.tolerance = lint::tolerance_of(*a, *b);
    if (const std::optional<lint::Separation> best = best_separation(*a, *b))
      truth.separation = best->distance;
    const std::optional<lint::OwnContacts> own = lint::own_contacts(*a, *b);
    if (!own) continue;
    if (!truth.separation) {
      // The distance is not computed for a mesh, only that they are separated.
      truth.separation = own->separation;
    } else if (own->manifolds.size() == 1) {
      const Manifold<double>& manifold = own->manifolds.front();
      truth.area =
          area_of_points(mapped(manifold.points, &ContactPoint<double>::position), manifold.normal);
    }
  }
  return truths;
}

}  // namespace contactscope::versus
