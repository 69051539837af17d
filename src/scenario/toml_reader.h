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
namespace contactscope::toml_reader {

using Keys = std::vector<std::string_view>;
using contactscope::nearest;
using contactscope::quoted_list;

class Table;

/// One value of the file. `name` is what messages call it, "half_extents" or "vertices[3]". Refers
/// to the parsed document and to the file's name, which must outlive it.
class Value {
 public:
  Value(const std::string& file, const toml::node& node, std::string name)
      : file_(&file), node_(&node), name_(std::move(name)) {}

  const std::string& name() const { return name_; }
  const std::string& file() const { return *file_; }
  int line() const { return static_cast<int>(node_->source().begin.line); }
  bool is_table() const { return node_->is_table(); }
  bool is_array() const { return node_->is_array(); }

  /// Throws InputError at this value; the message is made one printable line of bounded length.
  [[noreturn]] void fail(const std::string& message) const;

  /// A finite number; integers count. `unit` is for messages: "a number in metres".
  double number(const char* unit = nullptr) const;
  /// A finite number greater than zero.
  double positive(const char* unit = nullptr) const;
  /// A finite number that is not negative.
  double not_negative(const char* unit = nullptr) const;
  /// An integer from `low` to `high`, inclusive.
  int integer(int low, int high) const;
  bool boolean() const;
  std::string string() const;
  std::string non_empty_string() const;
  /// A string that is one of `choices`; `kind` names what they are, for messages.
  std::string one_of(const std::vector<std::string>& choices, const char* kind) const;
  /// Three finite numbers.
  Vec3d vector3() const;
  /// `count` finite numbers.
  std::vector<double> numbers(std::size_t count) const;
  std::vector<Value> array() const;
  /// An array of tables, as [[name]] makes it.
  std::vector<Value> array_of_tables() const;
  /// A table whose keys must all be in `keys`.
  Table table(const Keys& keys) const;
  /// The value of a key of this table before its keys are checked: what a `type` key says may
  /// decide which others there are. Nothing when the key is missing or this is no table.
  std::optional<Value> peek(std::string_view key) const;
  /// The names in a table of named tables and the values that they name, in file order.
  std::vector<Value> members() const;

 private:
  /// Throws: this value is of the wrong type, `wanted` is what would be right.
  [[noreturn]] void wrong_type(const std::string& wanted) const;

  const std::string* file_;
  const toml::node* node_;
  std::string name_;

  friend class Table;
};

class Table {
 public:
  /// Refuses the first key in the file that is not in `keys`. `node` must be a table.
  Table(const std::string& file, const toml::node& node, std::string name, const Keys& keys);

  std::optional<Value> find(std::string_view key) const;
  /// Sets `target` to what `reader` makes of a key's value, where the file has the key.
  template <class Target, class Reader>
  void read(std::string_view key, Target& target, const Reader& reader) const {
    if (const std::optional<Value> value = find(key)) target = std::invoke(reader, *value);
  }
  /// A missing key is an error at the table; `example` shows how to write it.
  Value require(std::string_view key, const std::string& example) const;

  const Value& value() const { return value_; }
  [[noreturn]] void fail(const std::string& message) const { value_.fail(message); }

 private:
  Value value_;
};

/// Readers of Table::read(): an integer from `low` to `high`, and the enumerator that has the place of
/// a string among `words`.
inline auto integer_in(int low, int high) {
  return [=](const Value& value) { return value.integer(low, high); };
}
template <class Enum>
auto word_of(const std::vector<std::string>& words, const char* kind) {
  return [words, kind](const Value& value) {
    return static_cast<Enum>(std::ranges::find(words, value.one_of(words, kind)) - words.begin());
  };
}

Keys as_keys(const std::vector<std::string>& words);

/// Parses TOML; what is no TOML throws InputError.
toml::table parse_document(const std::string& text, const std::string& file);

}  // namespace contactscope::toml_reader
