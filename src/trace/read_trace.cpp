#include "trace/read_trace.h"

#include <istream>

#include "core/input_error.h"
#include "trace/json_line.h"

namespace contactscope::trace {
namespace {

/// Sizes of the lists read so far in a fact and in those that contain it.
struct Counts {
  const Counts* around = nullptr;
  const Parts* parts = nullptr;  // to read; null: all
  std::vector<std::pair<std::string_view, std::size_t>> lists{};

  std::size_t of(std::string_view list) const {
    for (const auto& [key, count] : lists) {
      if (key == list) return count;
    }
    return around != nullptr ? around->of(list) : 0;
  }
};

template <Listed T>
T read(const Node& node, const Counts* around);

template <class Owner, class V>
struct Value {
  const Field<Owner, V>& field;
  const Counts& counts;

  void read(const Node& node, std::string& value) const { value = node.string(); }
  void read(const Node& node, bool& value) const { value = node.boolean(); }
  void read(const Node& node, double& value) const { value = node.number(); }
  void read(const Node& node, int& value) const {
    value = node.integer();
    if (field.counts_in == nullptr || (field.may_be_none && value < 0)) return;
    value = node.index(counts.of(field.counts_in), field.things);
  }
  void read(const Node& node, Vec3d& value) const {
    const auto v = node.numbers<3>("must have three numbers");
    value = {v[0], v[1], v[2]};
  }
  void read(const Node& node, Quatd& value) const {
    const auto q = node.numbers<4>("needs four numbers");
    value = Quatd(q[0], q[1], q[2], q[3]);
  }
  template <class T>
  requires kIsOptional<T>
  void read(const Node& node, T& value) const { read(node, value.emplace()); }
  template <Listed T>
  void read(const Node& node, T& value) const {
    value = trace::read<T>(node, &counts);
  }
  template <class T>
  void read(const Node& node, std::vector<T>& list) const {
    if constexpr (Listed<T>) {
      if constexpr (has_name<T>()) {
        for (const auto& [name, item] : node.members()) {
          read(item, list.emplace_back());
          name_of(list.back()) = name;
        }
        return;
      }
    }
    for (const Node& item : node.items()) read(item, list.emplace_back());
  }
  template <class T, std::size_t Count>
  void read(const Node& node, std::array<T, Count>& list) const {
    const std::vector<Node> parts = node.items();
    if (parts.size() != Count) {
      node.fail(std::same_as<T, int>      ? "must have " + std::to_string(Count) + " indices"
                : std::same_as<T, double> ? "must have two numbers"
                                          : "must have two points");
    }
    for (std::size_t i = 0; i < Count; ++i) read(parts[i], list[i]);
  }
};

template <class T>
void require_more(const Node&, const T&) {}
/// Only some rules measure against an edge; their measures require one.
void require_more(const Node& node, const Choice& choice) {
  if (!choice.is_against_edges()) return;
  const Node measures = node.at("measures");
  for (const Node& measure : measures.items()) measure.at("edge");
}

template <class T>
inline constexpr bool kIsStage = false;
template <class T>
inline constexpr bool kIsStage<Stage<T>> = true;

/// Whether a field belongs to parts that are not read.
template <class T, class V>
bool is_left_out(const Field<T, V>& field, const Parts& parts) {
  const std::string_view key = field.key;
  if constexpr (std::same_as<T, Frame>)
    return key == "poses"   ? !parts.poses
           : key == "pairs" ? !parts.pairs
                            : !parts.stages && key != "frame" && key != "time" && key != "shapes";
  if constexpr (std::same_as<T, Pair>)
    return !parts.stages && (kIsStage<V> || key == "intersections" || key == "decisions");
  return false;
}

template <Listed T>
T read(const Node& node, const Counts* around) {
  T fact;
  Counts counts{around, around != nullptr ? around->parts : nullptr};
  each_field<T>([&]<class V>(const Field<T, V>& field) {
    if (counts.parts != nullptr && is_left_out(field, *counts.parts)) return;
    V& value = fact.*field.member;
    const Value<T, V> reader{field, counts};
    if (field.is_object_key) return;
    if (field.is_merged) return reader.read(node, value);
    const Node owner = field.within != nullptr ? node.at(field.within) : node;
    if (const auto found = field.needed() ? owner.at(field.key) : owner.find(field.key)) {
      reader.read(*found, value);
    } else if (field.otherwise != nullptr) {
      field.otherwise(fact);
    }
    if constexpr (requires { value.push_back(value.front()); } && !std::same_as<V, std::string>)
      counts.lists.emplace_back(field.key, value.size());
  });
  require_more(node, fact);
  return fact;
}

Header read_header(const Node& node) {
  const Node schema = node.at("schema");
  const std::string name = schema.string();
  if (name == kSchema) return read<Header>(node, nullptr);
  const std::string_view family(kSchema, std::string_view(kSchema).find('/') + 1);
  schema.fail("is '" + name + "'; only '" + kSchema + "' can be read" +
              (name.starts_with(family) ? ": update contactscope, or write that schema" : ""));
}

Frame read_frame(const Node& node, const Parts& parts) {
  if (node.is_object() && node.find("schema"))
    throw Complaint{"this is a second header; a file holds one trace: start a new file with it"};
  const Counts counts{nullptr, &parts};
  return read<Frame>(node, &counts);
}

bool is_blank(const std::string& line) {
  return line.find_first_not_of(" \t\r") == std::string::npos;
}

}  // namespace

TraceReader::TraceReader(std::istream& in, std::string name)
    : in_(in), name_(std::move(name)), json_(std::make_unique<JsonLine>()) {
  const bool any = next_line([&](const Node& line) { header_ = read_header(line); });
  if (!any)
    throw InputError(name_, 0, 0,
                     std::string("the trace is empty; its first line must be a header with "
                                 "\"schema\":\"") +
                         kSchema + "\"");
  know(header_.shapes);
  first_ = in_.tellg();
  first_number_ = number_;
}

TraceReader::~TraceReader() = default;

void TraceReader::know(const std::vector<Shape>& shapes) {
  for (const Shape& shape : shapes) kinds_.emplace(shape.name, kind_of(shape));
}

void TraceReader::finish(Frame& frame, int line) {
  know(frame.shapes);
  complete(kinds_, frame);
  frame.line = line;
  ++frames_;
}

std::optional<Frame> TraceReader::next() {
  if (torn_) return std::nullopt;
  Frame frame;
  const bool any = next_line([&](const Node& node) { frame = read_frame(node, {}); });
  if (!any) return std::nullopt;
  finish(frame, number_);
  return frame;
}

bool TraceReader::take(FrameText& next) {
  while (!torn_ && std::getline(in_, next.text)) {
    ++number_;
    if (is_blank(next.text)) continue;
    next.line = number_;
    next.is_open = in_.eof();
    return true;
  }
  return false;
}

std::vector<Frame> TraceReader::read(std::vector<FrameText>& texts, const Parts& parts,
                                     Workers& workers) {
  while (parsers_.size() < static_cast<std::size_t>(workers.count()))
    parsers_.push_back(std::make_unique<JsonLine>());
  std::vector<Frame> frames(texts.size());
  workers.for_each(static_cast<int>(texts.size()), [&](int i, int worker) {
    const auto piece = static_cast<std::size_t>(i);
    FrameText& one = texts[piece];
    try {
      frames[piece] =
          read_frame(parsers_[static_cast<std::size_t>(worker)]->parse(one.text), parts);
    } catch (const NoJson& broken) {
      if (!one.is_open || frames_ + i == 0)
        throw InputError(name_, one.line, broken.column, broken.why);
      torn_ = Torn{one.line, broken.column, broken.why};  // the last one: no other thread is here
    } catch (const Complaint& complaint) {
      throw InputError(name_, one.line, 1, complaint.message);
    }
  });
  if (torn_) frames.pop_back();
  for (std::size_t i = 0; i < frames.size(); ++i) finish(frames[i], texts[i].line);
  return frames;
}

bool TraceReader::skip() {
  while (!torn_ && std::getline(in_, line_)) {
    ++number_;
    if (is_blank(line_)) continue;
    ++frames_;
    return true;
  }
  return false;
}

void TraceReader::rewind() {
  in_.clear();
  in_.seekg(first_);
  number_ = first_number_;
  frames_ = 0;
  torn_.reset();
}

template <class Read>
bool TraceReader::next_line(const Read& read_it) {
  while (std::getline(in_, line_)) {
    ++number_;
    if (is_blank(line_)) continue;
    try {
      read_it(json_->parse(line_));
      return true;
    } catch (const NoJson& broken) {
      // A process that dies leaves an unfinished last line.
      if (in_.eof() && frames_ > 0) {
        torn_ = Torn{number_, broken.column, broken.why};
        return false;
      }
      throw InputError(name_, number_, broken.column, broken.why);
    } catch (const Complaint& complaint) {
      throw InputError(name_, number_, 1, complaint.message);
    }
  }
  return false;
}

Trace read_trace(std::istream& in, const std::string& name) {
  TraceReader reader(in, name);
  Trace trace{reader.header(), {}};
  while (std::optional<Frame> frame = reader.next()) trace.frames.push_back(std::move(*frame));
  if (const auto& torn = reader.torn(); torn)
    throw InputError(name, torn->line, torn->column, torn->why);
  if (trace.header.frames == 0 && !trace.frames.empty())
    trace.header.frames = trace.frames.back().frame + 1;
  return trace;
}

}  // namespace contactscope::trace
