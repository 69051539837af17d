#include <cstdint>
#include <istream>
#include <limits>
#include <string>

#include <nlohmann/json.hpp>

#include "core/input_error.h"
#include "trace/json.h"

namespace contactscope::trace {
namespace {

using Json = nlohmann::ordered_json;

/// What is wrong inside of a line that is JSON; read_trace adds file and line.
struct Complaint {
  std::string message;
};

/// A JSON value and the place in its line, "pairs[0].sat.face_a", which complaints name.
class Node {
 public:
  Node(const Json& json, std::string place) : json_(&json), place_(std::move(place)) {}

  [[noreturn]] void fail(const std::string& message) const {
    throw Complaint{"'" + place_ + "' " + message};
  }

  Node at(const char* key) const {
    if (auto found = find(key)) return *found;
    throw Complaint{where() + " has no key '" + key + "'; a trace needs it"};
  }
  /// Nothing when the key is missing or null: null is how some writers say "not there".
  std::optional<Node> find(const char* key) const {
    if (!json_->is_object()) wrong_type("an object");
    const auto found = json_->find(key);
    if (found == json_->end() || found->is_null()) return std::nullopt;
    return Node(*found, place_.empty() ? key : place_ + "." + key);
  }
  std::vector<Node> items() const {
    if (!json_->is_array()) wrong_type("an array");
    std::vector<Node> nodes;
    for (std::size_t i = 0; i < json_->size(); ++i)
      nodes.emplace_back((*json_)[i], place_ + "[" + std::to_string(i) + "]");
    return nodes;
  }
  std::vector<std::pair<std::string, Node>> members() const {
    if (!json_->is_object()) wrong_type("an object");
    std::vector<std::pair<std::string, Node>> nodes;
    for (const auto& [key, value] : json_->items())
      nodes.emplace_back(key, Node(value, place_ + "." + key));
    return nodes;
  }

  std::string string() const { return get<std::string>(json_->is_string(), "a string"); }
  bool boolean() const { return get<bool>(json_->is_boolean(), "true or false"); }
  double number() const { return get<double>(json_->is_number(), "a number"); }
  int integer() const {
    if (!json_->is_number_integer()) wrong_type("an integer");
    constexpr auto kMax = std::numeric_limits<int>::max();
    // Unsigned first: the signed reading of a number beyond 2^63 would wrap.
    const bool huge = json_->is_number_unsigned() &&
                      json_->get<std::uint64_t>() > static_cast<std::uint64_t>(kMax);
    if (huge || json_->get<std::int64_t>() < -1) fail("is out of range");
    return json_->get<int>();
  }
  /// An index into `count` things.
  int index(std::size_t count, const char* things) const {
    const int value = integer();
    if (value < 0 || static_cast<std::size_t>(value) >= count)
      fail("is " + std::to_string(value) + ", but there are " + std::to_string(count) + " " +
           things);
    return value;
  }
  /// `count` numbers.
  std::vector<double> numbers(std::size_t count, const char* complaint) const {
    std::vector<double> list;
    for (const Node& item : items()) list.push_back(item.number());
    if (list.size() != count) fail(complaint);
    return list;
  }

 private:
  template <class T>
  T get(bool is_right, const char* wanted) const {
    if (!is_right) wrong_type(wanted);
    return json_->get<T>();
  }
  std::string where() const { return place_.empty() ? "the line" : "'" + place_ + "'"; }
  [[noreturn]] void wrong_type(const char* wanted) const {
    throw Complaint{where() + " is of type " + json_->type_name() + "; " + wanted + " is needed"};
  }

  const Json* json_;
  std::string place_;
};

/// How many entries the lists have that were read of a fact and of those around it.
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

/// Reads the value of one field.
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
    const std::vector<double> v = node.numbers(3, "must have three numbers");
    value = {v[0], v[1], v[2]};
  }
  void read(const Node& node, Quatd& value) const {
    const std::vector<double> q = node.numbers(4, "needs four numbers");
    value = Quatd(q[0], q[1], q[2], q[3]);
  }
  template <class T>
  void read(const Node& node, std::optional<T>& value) const {
    read(node, value.emplace());
  }
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
/// Only some rules measure against an edge, and those need it.
void require_more(const Node& node, const Choice& choice) {
  if (!choice.is_against_edges()) return;
  for (const Node& measure : node.at("measures").items()) measure.at("edge");
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
  if (schema.string() != kSchema)
    schema.fail("is '" + schema.string() + "'; '" + kSchema + "' is what can be read here");
  return read<Header>(node, nullptr);
}

}  // namespace

Trace read_trace(std::istream& in, const std::string& name) {
  Trace trace;
  std::vector<Shape> shapes;  // of the header and of all frames up to here
  bool has_header = false;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    try {
      const Json json = Json::parse(line);
      const Node node(json, "");
      if (has_header) {
        Frame& frame = trace.frames.emplace_back(read<Frame>(node, nullptr));
        shapes.insert(shapes.end(), frame.shapes.begin(), frame.shapes.end());
        complete(shapes, frame);
        frame.line = number;
      } else {
        trace.header = read_header(node);
        shapes = trace.header.shapes;
        has_header = true;
      }
    } catch (const nlohmann::json::parse_error& error) {
      throw InputError(name, number, static_cast<int>(error.byte),
                       "this line is no JSON from here on; a trace has one whole object on each "
                       "line, so it may be torn: make it again");
    } catch (const nlohmann::json::exception& error) {
      throw InputError(name, number, 1, std::string("not read: ") + error.what());
    } catch (const Complaint& complaint) {
      throw InputError(name, number, 1, complaint.message);
    }
  }
  if (!has_header)
    throw InputError(name, 0, 0,
                     std::string("the trace is empty; its first line must be a header with "
                                 "\"schema\":\"") +
                         kSchema + "\"");
  if (trace.header.frames == 0 && !trace.frames.empty())
    trace.header.frames = trace.frames.back().frame + 1;
  return trace;
}

}  // namespace contactscope::trace
