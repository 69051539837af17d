#include "trace/read_trace.h"

#include <istream>

#include "core/input_error.h"
#include "core/spell.h"
#include "trace/json_node.h"

namespace contactscope::trace {
namespace {

/// Problems of a header; all are reported.
using Problems = std::vector<std::string>;

/// Sizes of the lists read so far in a fact and in those that contain it.
struct Counts {
  const Counts* around = nullptr;
  Problems* problems = nullptr;  // null: the first one is thrown
  const Parts* parts = nullptr;  // to read; null: all
  Problems* doubts = nullptr;    // null: they are not looked for
  std::vector<std::pair<std::string_view, std::size_t>> lists{};

  std::size_t of(std::string_view list) const {
    for (const auto& [key, count] : lists)
      if (key == list) return count;
    return around != nullptr ? around->of(list) : 0;
  }
};

template <Listed T> T read(const Node& node, const Counts* around, Problems* problems = nullptr);

template <class Owner, class V> struct Value {
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
  template <Listed T> void read(const Node& node, T& value) const {
    value = trace::read<T>(node, &counts, counts.problems);
  }
  template <class T> void read(const Node& node, std::vector<T>& list) const {
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

template <class T> void require_more(const Node&, const T&) {}
/// Only some rules measure against an edge; their measures require one.
void require_more(const Node& node, const Choice& choice) {
  if (!choice.is_against_edges()) return;
  const Node measures = node.at("measures");
  for (const Node& measure : measures.items()) measure.at("edge");
}

/// Why a text is wrong for a key of the reference; empty if it is allowed, or means "missing".
std::string wrong_word(const char* table, const char* key, const std::string& text) {
  const Key* const known = fact_key(table, key);
  if (known == nullptr || (text.empty() && known->otherwise != "needed")) return {};
  return not_among(known->words, printable(text));
}

/// Whether the needed key of a fact follows from other keys.
template <class T> bool is_derived(const Node&, T&) { return false; }
/// The vertices of a shape: of a box from its half extents, of a sphere with a radius, of a plane.
bool is_derived(const Node& node, Shape& shape) {
  if (shape.type == "sphere" && node.find("radius")) shape.vertices = {Vec3d::Zero()};
  if (const auto size = shape.type == "box" ? node.find("half_extents") : std::nullopt) {
    const auto half = size->numbers<3>("must have three numbers");
    for (const double z : {-half[2], half[2]})
      for (const double y : {-half[1], half[1]})
        for (const double x : {-half[0], half[0]}) shape.vertices.emplace_back(x, y, z);
  }
  return !shape.vertices.empty() || (shape.type == "plane" && node.find("half_space")) ||
         !wrong_word("Shape", "type", shape.type)
              .empty();  // that is reported; what it needs is unknown
}

/// The table of a fact in the reference.
template <class T>
constexpr const char* kTableOf = std::same_as<T, Header>     ? "Header"
                                 : std::same_as<T, Shape>    ? "Shape"
                                 : std::same_as<T, Frame>    ? "Frame"
                                 : std::same_as<T, Pair>     ? "Pair"
                                 : std::same_as<T, Manifold> ? "Manifold"
                                 : std::same_as<T, Point>    ? "Point"
                                                             : "";

/// Facts whose problems are all reported.
template <class T>
inline constexpr bool kIsOfHeader = std::same_as<T, Header> || std::same_as<T, Shape>;

/// How the value of a key that others write differs from the one here; else empty.
std::string other_order(std::string_view name) {
  if (name.ends_with("xyzw")) return "write w first; ";
  const bool is_depth = name.find("depth") != name.npos || name.find("penetration") != name.npos;
  return is_depth ? "write separation = -depth, which is negative in overlap; " : "";
}

/// `names` are the keys of the fact.
[[noreturn]] void report_missing(const Node& owner, const char* table, const char* key,
                                 std::vector<std::string_view> names) {
  const Key* const known = fact_key(table, key);
  const std::string_view otherwise = known != nullptr ? known->otherwise : "needed";
  if (otherwise != "needed") names.push_back("half_extents");  // it follows from others
  std::string hint;
  for (const auto& [name, value] : owner.members()) {
    const std::string near = nearest(name, names);
    const bool is_meant = near == key || otherwise.find("`" + near + "`") != otherwise.npos;
    if (is_meant && near != name)
      hint += "by '" + printable(name) + "' did you mean '" + near + "'? " + other_order(name);
  }
  if (known == nullptr) owner.lacks(key, "", hint);
  const bool follows = otherwise != "needed";
  owner.lacks(key, plain(known->type) + (follows ? "; or " + plain(otherwise) : ""), hint);
}

/// Calls `part`, and keeps its complaint if there is a list of problems.
template <class Part> void collecting(Problems* problems, const Part& part) {
  try {
    part();
  } catch (const Complaint& complaint) {
    if (problems == nullptr) throw;
    problems->push_back(complaint.message);
  }
}

/// Notes keys of a shape that are not read, though they resemble one that is not there.
void note_doubts(const Node& node, Problems& doubts) {
  std::vector<std::string_view> names = {"half_extents"};
  each_field<Shape>([&](const auto& field) { names.push_back(field.key); });
  for (const auto& [name, value] : node.members())
    if (const std::string near = nearest(name, names);
        !near.empty() && near != name && !node.find(near.c_str()))
      doubts.push_back(node.where() + " has a key '" + printable(name) +
                       "', which is not read; did you mean '" + near + "'?");
}

template <class T> inline constexpr bool kIsStage = false;
template <class T> inline constexpr bool kIsStage<Stage<T>> = true;

/// Whether a field belongs to parts that are not read.
template <class T, class V> bool is_left_out(const Field<T, V>& field, const Parts& parts) {
  const std::string_view key = field.key;
  if constexpr (std::same_as<T, Frame>)
    return key == "poses"   ? !parts.poses
           : key == "pairs" ? !parts.pairs
                            : !parts.stages && key != "frame" && key != "time" && key != "shapes";
  if constexpr (std::same_as<T, Pair>)
    return !parts.stages && (kIsStage<V> || key == "intersections" || key == "decisions");
  return false;
}

template <Listed T> T read(const Node& node, const Counts* around, Problems* problems) {
  T fact;
  Counts counts{around, problems, around != nullptr ? around->parts : nullptr,
                around != nullptr ? around->doubts : nullptr};
  if constexpr (std::same_as<T, Shape>)
    if (counts.doubts != nullptr) note_doubts(node, *counts.doubts);
  each_field<T>([&]<class V>(const Field<T, V>& field) {
    if (counts.parts != nullptr && is_left_out(field, *counts.parts)) return;
    const auto read_field = [&] {
      V& value = fact.*field.member;
      const Value<T, V> reader{field, counts};
      if (field.is_object_key) return;
      if (field.is_merged) return reader.read(node, value);
      const Node owner = field.within != nullptr ? node.at(field.within) : node;
      if (const auto found = owner.find(field.key)) {
        reader.read(*found, value);
        if constexpr (std::same_as<V, std::string> && kIsOfHeader<T>)
          if (const std::string wrong = wrong_word(kTableOf<T>, field.key, value); !wrong.empty())
            found->fail(wrong);
      } else if (field.needed() && !is_derived(node, fact)) {
        std::vector<std::string_view> names;
        each_field<T>([&](const auto& other) { names.push_back(other.key); });
        report_missing(owner, kTableOf<T>, field.key, names);
      } else if (field.otherwise != nullptr) {
        field.otherwise(fact);
      }
      if constexpr (requires { value.push_back(value.front()); } && !std::same_as<V, std::string>)
        counts.lists.emplace_back(field.key, value.size());
    };
    if constexpr (kIsOfHeader<T>)
      collecting(problems, read_field);
    else
      read_field();
  });
  collecting(problems, [&] { require_more(node, fact); });
  return fact;
}

/// Throws all problems at once, or appends them to `problems`.
Header read_header(const Node& node, const std::string& place, Problems* problems,
                   Problems& doubts) {
  if (!node.find("schema"))
    node.lacks("schema", std::string("\"") + kSchema + "\"",
               node.find("frame") ? "this is a frame, and the first line is the header; " : "");
  const Node schema = node.at("schema");
  const std::string name = schema.string();
  const std::string_view family(kSchema, std::string_view(kSchema).find('/') + 1);
  if (name != kSchema)
    schema.fail("is '" + name + "'; only '" + kSchema + "' can be read" +
                (name.starts_with(family) ? ": update contactscope, or write that schema" : ""));
  Problems own;
  const Counts around{nullptr, nullptr, nullptr, &doubts, {}};
  Header header = read<Header>(node, &around, problems != nullptr ? problems : &own);
  if (!own.empty()) throw Complaint{in_lines(own, place)};
  return header;
}

Frame read_frame(const Node& node, const Parts& parts) {
  if (node.is_object() && node.find("schema"))
    throw Complaint{"this is a second header; a file holds one trace: start a new file with it"};
  const Counts counts{nullptr, nullptr, &parts, nullptr, {}};
  return read<Frame>(node, &counts, nullptr);
}

bool is_blank(const std::string& line) {
  return line.find_first_not_of(" \t\r") == std::string::npos;
}

}  // namespace

std::string in_lines(const std::vector<std::string>& problems, const std::string& place) {
  constexpr std::size_t kMaxListed = 12;
  std::string text;
  for (std::size_t i = 0; i < std::min(problems.size(), kMaxListed); ++i)
    text += (i == 0 ? "" : "\n" + place) + problems[i];
  if (problems.size() <= kMaxListed) return text;
  return text + "\n" + place + "and " + std::to_string(problems.size() - kMaxListed) +
         " more problems of this kind";
}

TraceReader::TraceReader(std::istream& in, std::string name, std::vector<std::string>* problems)
    : in_(in), name_(std::move(name)), json_(std::make_unique<JsonLine>()) {
  const bool any = next_line([&](const Node& line) {
    header_ = read_header(line, name_ + ":" + std::to_string(number_) + ":1: ", problems, doubts_);
  });
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
  if (torn_ && !frames.empty()) frames.pop_back();  // after it there is nothing
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

template <class Read> bool TraceReader::next_line(const Read& read_it) {
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
