#include "versus/request.h"

#include <set>

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

std::string to_text(const trace::Trace& trace) {
  std::string text = trace::to_json_line(trace.header) + "\n";
  for (const trace::Frame& frame : trace.frames) text += trace::to_json_line(frame) + "\n";
  return text;
}

}  // namespace contactscope::versus
