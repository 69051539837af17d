#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

/// How the reader walks a line and complains of it.
namespace contactscope::trace {

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

  std::string string() const {
    if (!json_->is_string()) wrong_type("a string");
    return json_->get<std::string>();
  }
  bool boolean() const {
    if (!json_->is_boolean()) wrong_type("true or false");
    return json_->get<bool>();
  }
  double number() const {
    if (!json_->is_number()) wrong_type("a number");
    return json_->get<double>();
  }
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
  std::string where() const { return place_.empty() ? "the line" : "'" + place_ + "'"; }
  [[noreturn]] void wrong_type(const char* wanted) const {
    throw Complaint{where() + " is of type " + json_->type_name() + "; " + wanted + " is needed"};
  }

  const Json* json_;
  std::string place_;
};

}  // namespace contactscope::trace
