#include "versus/own.h"

#include "lint/claims.h"
#include "manifold/dispatch.h"

namespace contactscope::versus {

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

}  // namespace contactscope::versus
