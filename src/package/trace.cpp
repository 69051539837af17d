#include "app/cli/trace_file.h"
#include "package/facts.h"
#include "snapshot/store.h"

namespace contactscope::package {
namespace {

/// The number at `at`, followed by a colon; otherwise 0, and `at` does not change.
int number_before_colon(const std::string& text, std::size_t& at) {
  const std::size_t end = text.find(':', at);
  if (end == std::string::npos || end == at) return 0;
  if (text.find_first_not_of("0123456789", at) != end) return 0;
  const int number = std::atoi(text.c_str() + at);
  at = end + 1;
  return number;
}

/// Splits "FILE:LINE:COLUMN: problem; remedy".
InputError outside(const std::string& what, const std::string& file) {
  std::size_t at = what.starts_with(file + ":") ? file.size() + 1 : 0;
  const int line = number_before_colon(what, at), column = number_before_colon(what, at);
  const std::size_t remedy = what.find("; ", at);
  return {what, file, line, column,
          remedy == std::string::npos ? std::string() : what.substr(remedy + 2)};
}

/// Reads the whole file. Shapes that frames add are moved to the header.
Trace read_whole(app::TraceFile& file) {
  Trace::Facts facts;
  while (std::optional<contactscope::trace::Frame> frame = file.next()) {
    frame->shapes.clear();
    facts.trace.frames.push_back(std::move(*frame));
  }
  facts.trace.header = file.header();
  if (file.torn()) facts.cut_off_in = file.torn()->line;
  return Trace(std::make_shared<const Trace::Facts>(std::move(facts)));
}

/// `arguments` are those of TraceFile; `name` is the file name in messages.
template <class... Arguments>
Trace read_by_name(const std::string& name, Arguments&&... arguments) {
  try {
    app::TraceFile file(std::forward<Arguments>(arguments)...);
    return read_whole(file);
  } catch (const contactscope::InputError& error) {
    throw outside(error.what(), name);
  }
}

contactscope::trace::Frame inside(const Frame& frame) {
  contactscope::trace::Frame record;
  record.frame = frame.number;
  record.time = frame.time;
  for (const NamedPose& one : frame.poses) record.poses.emplace_back(one.name, to_inside(one.pose));
  for (const Pair& pair : frame.pairs) {
    contactscope::trace::Pair& to = record.pairs.emplace_back();
    to.a = pair.a;
    to.b = pair.b;
    to.manifolds = mapped(pair.manifolds, [](const Manifold& one) { return to_inside(one); });
    to.separation = separation_of(pair.manifolds);
  }
  return record;
}

}  // namespace

Trace::Trace() : facts_(std::make_shared<const Facts>()) {}

Trace::Trace(const TraceInfo& info, const std::vector<NamedShape>& shapes,
             const std::vector<Frame>& frames) {
  contactscope::trace::Trace trace;
  contactscope::trace::Header& header = trace.header;
  header.scenario = info.scenario;
  header.title = info.title;
  header.source = info.source;
  header.scalar = name_of(info.scalar);
  header.up = info.up;
  header.engine = info.engine;
  header.version = info.version;
  header.frames = frames.empty() ? 0 : frames.back().number + 1;
  for (const NamedShape& shape : shapes)
    header.shapes.push_back(traced(shape.name, shape.shape, Scalar::Double));
  for (const Frame& frame : frames) trace.frames.push_back(inside(frame));
  // Parsing derives the remaining facts and validates them, as for a file.
  *this = parse_trace(snapshot::to_json_lines(trace));
}

TraceInfo Trace::info() const {
  const contactscope::trace::Header& header = facts_->trace.header;
  return {header.scenario, header.title,
          header.source,   header.scalar == "float" ? Scalar::Float : Scalar::Double,
          header.up,       header.engine,
          header.version};
}

std::vector<std::string> Trace::shapes() const {
  return mapped(facts_->trace.header.shapes, &contactscope::trace::Shape::name);
}

int Trace::cut_off_in() const { return facts_->cut_off_in; }

int Trace::frame_count() const { return count_of(facts_->trace.frames); }

Frame Trace::frame(int index) const {
  const contactscope::trace::Frame& record = at(facts_->trace.frames, index);
  Frame frame{record.frame, record.time};
  for (const auto& [name, pose] : record.poses) frame.poses.push_back({name, to_outside(pose)});
  for (const contactscope::trace::Pair& pair : record.pairs)
    frame.pairs.push_back(
        {pair.a, pair.b, mapped(pair.manifolds, [](const contactscope::trace::Manifold& one) {
           return to_outside(one);
         })});
  return frame;
}

Trace read_trace(const std::string& path) {
  return read_by_name(path == "-" ? "standard input" : path, path);
}

Trace parse_trace(const std::string& text, const std::string& name) {
  return read_by_name(name, std::make_unique<std::istringstream>(text), name);
}

std::string to_json_lines(const Trace& trace) {
  return snapshot::to_json_lines(trace.facts().trace);
}

void write_trace(const std::string& path, const Trace& trace) {
  snapshot::write_text(std::filesystem::absolute(path), to_json_lines(trace));
}

}  // namespace contactscope::package
