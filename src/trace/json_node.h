#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace contactscope::trace {

using Json = nlohmann::ordered_json;

/// What is wrong inside of a line that is JSON; who reads the file adds its name and the line.
struct Complaint {
  std::string message;
};

/// A JSON value and where in its line it stands, "pairs[0].sat.face_a", which complaints name. The words for
/// that are made only where there is something to complain about, so a node must outlive those below it.
class Node {
 public:
  /// The whole line.
  explicit Node(const Json& json) : json_(&json) {}

  [[noreturn]] void fail(const std::string& message) const {
    throw Complaint{"'" + place() + "' " + message};
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
    return Node(*found, *this, key);
  }
  std::vector<Node> items() const {
    if (!json_->is_array()) wrong_type("an array");
    std::vector<Node> nodes;
    nodes.reserve(json_->size());
    for (std::size_t i = 0; i < json_->size(); ++i) nodes.push_back(Node((*json_)[i], *this, i));
    return nodes;
  }
  /// The keys stay where they are as long as the line does.
  std::vector<std::pair<std::string_view, Node>> members() const {
    if (!json_->is_object()) wrong_type("an object");
    std::vector<std::pair<std::string_view, Node>> nodes;
    for (const auto& [key, value] : json_->get_ref<const Json::object_t&>())
      nodes.emplace_back(key, Node(value, *this, key));
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
  template <std::size_t Count>
  std::array<double, Count> numbers(const char* complaint) const {
    if (!json_->is_array()) wrong_type("an array");
    std::array<double, Count> list{};
    for (std::size_t i = 0; i < json_->size(); ++i) {
      const double value = Node((*json_)[i], *this, i).number();
      if (i < Count) list[i] = value;
    }
    if (json_->size() != Count) fail(complaint);
    return list;
  }

 private:
  Node(const Json& json, const Node& around, std::string_view key)
      : json_(&json), around_(&around), key_(key) {}
  Node(const Json& json, const Node& around, std::size_t index)
      : json_(&json), around_(&around), index_(index) {}

  template <class T>
  T get(bool is_right, const char* wanted) const {
    if (!is_right) wrong_type(wanted);
    return json_->get<T>();
  }
  std::string place() const {
    if (around_ == nullptr) return {};
    const std::string before = around_->place();
    if (key_.data() == nullptr) return before + "[" + std::to_string(index_) + "]";
    return before.empty() ? std::string(key_) : before + "." + std::string(key_);
  }
  std::string where() const { return around_ == nullptr ? "the line" : "'" + place() + "'"; }
  [[noreturn]] void wrong_type(const char* wanted) const {
    throw Complaint{where() + " is of type " + json_->type_name() + "; " + wanted + " is needed"};
  }

  const Json* json_;
  const Node* around_ = nullptr;  // the object or list that it is in; null of the line
  std::string_view key_{};        // its key there, without data where it is the entry of a list
  std::size_t index_ = 0;
};

}  // namespace contactscope::trace
