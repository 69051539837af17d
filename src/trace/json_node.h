#pragma once

#include <simdjson.h>

#include "core/standard.h"

namespace contactscope::trace {

/// An error inside a line of valid JSON; the reader of the file adds its name and the line.
struct Complaint {
  std::string message;
};

/// A JSON value and its path in the line, "pairs[0].sat.face_a", for error messages. The path is
/// only built for an error, so a node must outlive its children.
class Node {
 public:
  using Value = simdjson::dom::element;

  explicit Node(const Value& value) : value_(value) {}

  [[noreturn]] void fail(const std::string& message) const {
    throw Complaint{"'" + place() + "' " + message};
  }

  std::string where() const { return around_ == nullptr ? "the line" : "'" + place() + "'"; }
  bool is_object() const { return value_.is_object(); }

  Node at(const char* key) const {
    if (auto found = find(key)) return *found;
    lacks(key, "");
  }
  /// Throws: a needed key is missing. `wanted` describes its value; `hint` names the key that is there
  /// instead.
  [[noreturn]] void lacks(const char* key, const std::string& wanted,
                          const std::string& hint = "") const {
    throw Complaint{where() + " has no key '" + key + "'; " + hint + "a trace needs it" +
                    (wanted.empty() ? "" : ": ") + wanted};
  }
  /// Empty if the key is missing or null, which some writers use for "missing". The last of
  /// duplicate keys wins.
  std::optional<Node> find(const char* key) const {
    const std::string_view wanted = key;
    std::optional<Value> found;
    const simdjson::dom::object object = this->object();
    for (auto member = object.begin(); member != object.end(); ++member)
      if (member.key_equals(wanted)) found = member.value();
    if (!found || found->is_null()) return std::nullopt;
    return Node(*found, *this, wanted);
  }
  std::vector<Node> items() const {
    const simdjson::dom::array array = this->array();
    std::vector<Node> nodes;
    nodes.reserve(array.size());
    for (const Value item : array) nodes.push_back(Node(item, *this, nodes.size()));
    return nodes;
  }
  /// The keys are valid as long as the line. A duplicate key has its first position and last value.
  std::vector<std::pair<std::string_view, Node>> members() const {
    const simdjson::dom::object object = this->object();
    std::vector<std::pair<std::string_view, Node>> nodes;
    nodes.reserve(object.size());
    for (const auto& [key, value] : object) nodes.emplace_back(key, Node(value, *this, key));
    keep_last_of_each(nodes);
    return nodes;
  }

  std::string string() const {
    if (!value_.is_string()) wrong_type("a string");
    return std::string(std::string_view(value_));
  }
  bool boolean() const {
    if (!value_.is_bool()) wrong_type("true or false");
    return bool(value_);
  }
  double number() const {
    if (!value_.is_number()) wrong_type("a number");
    return double(value_);
  }
  int integer() const {
    constexpr auto kMax = std::numeric_limits<int>::max();
    // Values from 2^63 on have a type of their own.
    if (value_.type() == simdjson::dom::element_type::UINT64) fail("is out of range");
    if (value_.type() != simdjson::dom::element_type::INT64) wrong_type("an integer");
    const auto value = std::int64_t(value_);
    if (value > kMax || value < -1) fail("is out of range");
    return static_cast<int>(value);
  }
  int index(std::size_t count, const char* things) const {
    const int value = integer();
    if (value < 0 || static_cast<std::size_t>(value) >= count)
      fail("is " + std::to_string(value) + ", but there are " + std::to_string(count) + " " +
           things);
    return value;
  }
  template <std::size_t Count> std::array<double, Count> numbers(const char* complaint) const {
    std::array<double, Count> list{};
    std::size_t i = 0;
    for (const Value item : array()) {
      const double value = Node(item, *this, i).number();
      if (i < Count) list[i] = value;
      ++i;
    }
    if (i != Count) fail(complaint);
    return list;
  }

 private:
  Node(const Value& value, const Node& around, std::string_view key)
      : value_(value), around_(&around), key_(key) {}
  Node(const Value& value, const Node& around, std::size_t index)
      : value_(value), around_(&around), index_(index) {}

  simdjson::dom::object object() const {
    if (!value_.is_object()) wrong_type("an object");
    return simdjson::dom::object(value_);
  }
  simdjson::dom::array array() const {
    if (!value_.is_array()) wrong_type("an array");
    return simdjson::dom::array(value_);
  }
  static void keep_last_of_each(std::vector<std::pair<std::string_view, Node>>& nodes) {
    std::vector<std::string_view> keys;
    keys.reserve(nodes.size());
    for (const auto& [key, node] : nodes) keys.push_back(key);
    std::ranges::sort(keys);
    if (std::ranges::adjacent_find(keys) == keys.end()) return;
    std::vector<std::pair<std::string_view, Node>> once;
    for (const auto& one : nodes) {
      const auto same =
          std::ranges::find(once, one.first, [](const auto& other) { return other.first; });
      if (same == once.end()) {
        once.push_back(one);
      } else {
        *same = one;
      }
    }
    nodes = std::move(once);
  }

  std::string place() const {
    if (around_ == nullptr) return {};
    const std::string before = around_->place();
    if (key_.data() == nullptr) return before + "[" + std::to_string(index_) + "]";
    return before.empty() ? std::string(key_) : before + "." + std::string(key_);
  }
  const char* type_name() const {
    if (value_.is_object()) return "object";
    if (value_.is_array()) return "array";
    if (value_.is_string()) return "string";
    if (value_.is_bool()) return "boolean";
    return value_.is_null() ? "null" : "number";
  }
  [[noreturn]] void wrong_type(const char* wanted) const {
    throw Complaint{where() + " is of type " + type_name() + "; " + wanted + " is needed"};
  }

  Value value_;
  const Node* around_ = nullptr;  // the parent object or list; null for the line
  std::string_view key_{};        // key in the parent; null data for entries of a list
  std::size_t index_ = 0;
};

/// Why and where a line is not JSON.
struct NoJson {
  int column = 0;  // from 1
  std::string why;
};

/// Parses a line of JSON into a tree; reuses its memory for the next line.
class JsonLine {
 public:
  /// The next call invalidates the tree; the line may grow by some bytes of padding. Throws NoJson,
  /// or Complaint for JSON that cannot be held: numbers beyond a double, or too deep nesting.
  Node parse(std::string& line);

 private:
  Node parse_again(const std::string& line);

  simdjson::dom::parser parser_;
};

}  // namespace contactscope::trace
