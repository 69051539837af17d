#include "trace/read_trace.h"

#include <istream>

#include "core/input_error.h"
#include "trace/json_line.h"

namespace contactscope::trace {
namespace {

/// Sizes of the lists read so far in a fact and in those that contain it.
struct Counts {
  const Counts* around = nullptr;
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

template <Listed T>
T read(const Node& node, const Counts* around) {
  T fact;
  Counts counts{around};
  each_field<T>([&]<class V>(const Field<T, V>& field) {
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
    if constexpr (requires { value.push_back(value.front()); })
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

std::optional<Frame> TraceReader::next() {
  if (torn_) return std::nullopt;
  Frame frame;
  const bool any = next_line([&](const Node& node) {
    if (node.is_object() && node.find("schema"))
      throw Complaint{"this is a second header; a file holds one trace: start a new file with it"};
    frame = read<Frame>(node, nullptr);
    know(frame.shapes);
    complete(kinds_, frame);
    frame.line = number_;
  });
  if (any) ++frames_;
  return any ? std::optional(std::move(frame)) : std::nullopt;
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
