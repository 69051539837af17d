#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <toml++/toml.h>

#include "core/vec3.h"
#include "scenario/nearest_word.h"

/// Typed access to a TOML file in which every complaint knows its line and column. All functions
/// throw InputError when the file says something else than asked for; messages name the key, what
/// was found, and what would be right.
namespace contactscope::scenario_file {

using Keys = std::vector<std::string_view>;

/// One value of the file. `name` is what messages call it, "half_extents" or "vertices[3]". Refers
/// to the parsed document and to the file's name, which must outlive it.
class Value {
 public:
  Value(const std::string& file, const toml::node& node, std::string name)
      : file_(&file), node_(&node), name_(std::move(name)) {}

  const std::string& name() const { return name_; }
  int line() const { return static_cast<int>(node_->source().begin.line); }
  bool is_table() const { return node_->is_table(); }
  bool is_array() const { return node_->is_array(); }

  /// Throws InputError at this value; the message is made one printable line of bounded length.
  [[noreturn]] void fail(const std::string& message) const;

  /// Finite numbers; integers count. `unit` is for messages: "a number in metres".
  double number(const char* unit = nullptr) const;
  double positive(const char* unit = nullptr) const;
  double not_negative(const char* unit = nullptr) const;
  std::vector<double> numbers(std::size_t count) const;
  Vec3d vector3() const;
  /// From `low` to `high`, inclusive.
  int integer(int low, int high) const;
  bool boolean() const;
  std::string string() const;
  std::string non_empty_string() const;
  /// A string that is one of `choices`; `kind` names what they are, for messages.
  std::string one_of(const Keys& choices, const char* kind) const;
  std::vector<Value> array() const;
  /// An array of tables, as [[name]] makes it.
  std::vector<Value> array_of_tables() const;
  /// This, which must be a table; refuses the first key in the file that is not in `keys`.
  const Value& table(const Keys& keys) const;
  /// The value of a key of this table. Nothing when the key is missing or this is no table.
  std::optional<Value> find(std::string_view key) const;
  /// Sets `target` to what `reader` makes of a key's value, where the file has the key.
  template <class Target, class Reader>
  void read(std::string_view key, Target& target, const Reader& reader) const {
    if (const std::optional<Value> value = find(key)) target = std::invoke(reader, *value);
  }
  /// A missing key is an error at the table; `example` shows how to write it.
  Value require(std::string_view key, const std::string& example) const;
  /// The names in a table of named tables and the values that they name, in file order.
  std::vector<Value> members() const;

 private:
  /// Throws: this value is of the wrong type, `wanted` is what would be right.
  [[noreturn]] void wrong_type(const std::string& wanted) const;

  const std::string* file_;
  const toml::node* node_;
  std::string name_;
};

/// Readers of Value::read(): an integer from `low` to `high`, and the enumerator that has the place of
/// a string among `words`.
inline auto integer_in(int low, int high) {
  return [=](const Value& value) { return value.integer(low, high); };
}
template <class Enum>
auto word_of(const Keys& words, const char* kind) {
  return [words, kind](const Value& value) {
    return static_cast<Enum>(std::ranges::find(words, value.one_of(words, kind)) - words.begin());
  };
}

/// Parses TOML; what is no TOML throws InputError.
toml::table parse_document(const std::string& text, const std::string& file);

}  // namespace contactscope::scenario_file
