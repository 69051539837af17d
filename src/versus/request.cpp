#include "versus/request.h"

#include <set>

#include "lint/claims.h"
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

}  // namespace contactscope::versus
