#include "scenario/readers.h"

#include "core/spell.h"

namespace contactscope {

std::string_view scenario_reference();  // scenarios/README.md

namespace scenario_file {
namespace {

/// One line of limited length: a file may have megabytes of text, and control characters that would
/// garble a terminal. They become "?", and the middle of long text becomes "...".
std::string printable(std::string message) {
  constexpr std::size_t kLongest = 600;
  for (char& c : message)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '?';
  if (message.size() <= kLongest) return message;
  // The remedy is at the end, so cut the middle, between whole UTF-8 sequences.
  std::size_t head = kLongest / 2;
  std::size_t tail = message.size() - kLongest / 2;
  const auto continues = [&](std::size_t i) {
    return (static_cast<unsigned char>(message[i]) & 0xC0) == 0x80;
  };
  while (continues(head)) --head;
  while (continues(tail)) ++tail;
  return message.substr(0, head) + "..." + message.substr(tail);
}

[[noreturn]] void fail_at(const std::string& file, const toml::source_position& where,
                          const std::string& message) {
  throw InputError(file, static_cast<int>(where.line), static_cast<int>(where.column),
                   printable(message));
}

/// Names and texts are printed in terminals, shells and pictures.
void require_plain(const std::string& file, const toml::source_position& where,
                   const std::string& what, const std::string& text) {
  if (const std::string wrong = not_plain(text); !wrong.empty())
    fail_at(file, where, what + " contains " + wrong + "; write plain text");
}

/// Replaces line breaks and tabs by spaces.
std::string on_one_line(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  return text;
}

/// "a string", "an array of two values", for messages.
std::string describe(const toml::node& node) {
  if (const toml::array* array = node.as_array()) {
    if (array->empty()) return "an empty array";
    return "an array of " + counted(array->size(), "value");
  }
  if (node.is_table()) return "a table";
  if (node.is_string()) return "a string";
  if (node.is_integer()) return "an integer";
  if (node.is_floating_point()) return "a number with a fraction";
  return node.is_boolean() ? "a boolean" : "a date or time";
}

/// Keys of other programs and other places, and how to write them; % is the value.
constexpr struct {
  std::string_view key;
  std::string_view known;  // a key of the table
  std::string_view remedy;
} kForeignKeys[] = {
    {"quat", "rotation",
     ", which does not define the order of its components; write rotation = { quat_wxyz = [w, x, "
     "y, "
     "z] } or rotation = { quat_xyzw = [x, y, z, w] }"},
    {"quat", "quat_wxyz",
     ", which does not define the order of its components; write quat_wxyz = [w, x, y, z] or "
     "quat_xyzw = [x, y, z, w]"},
    {"angle", "degrees", ", which has no unit; write 'degrees' or 'radians'"},
    {"angle", "rotation", "; write rotation = { axis = [0, 1, 0], degrees = % }"},
    {"degrees", "rotation", "; write rotation = { axis = [0, 1, 0], degrees = % }"},
    {"mass", "motion", "; write motion = { dynamic = true, mass = % }"},
    {"density", "motion", "; write motion = { dynamic = true, density = % }"},
    {"dynamic", "motion", "; write motion = { dynamic = true, mass = 1.0 }"},
};

/// The value as in the file, if it is short.
std::string written(const toml::node& value) {
  if (const auto* number = value.as_floating_point()) return shortest(number->get());
  std::ostringstream text;
  text << toml::node_view<const toml::node>(value);
  const std::string whole = text.str();
  return whole.size() < 40 && whole.find('\n') == std::string::npos ? whole : "..";
}

}  // namespace

void Value::fail(const std::string& message) const {
  fail_at(*file_, node_->source().begin, message);
}

std::string Value::unknown(std::string_view key, const toml::node& value, const Keys& known) const {
  const std::string found = "unknown key '" + std::string(key) + "'";
  const auto is_known = [&](std::string_view k) {
    return std::ranges::find(known, k) != known.end();
  };
  for (const auto& foreign : kForeignKeys) {
    if ((key != foreign.key && !(key == "quaternion" && foreign.key == "quat")) ||
        !is_known(foreign.known))
      continue;
    std::string remedy(foreign.remedy);
    if (const std::size_t at = remedy.find('%'); at != std::string::npos)
      remedy.replace(at, 1, written(value));
    return found + remedy;
  }
  std::string elsewhere;
  for (const KeyTable& table : key_tables()) {
    if (table.find(key) == nullptr) continue;
    const std::string heading = plain(table.heading);
    if (!heading.starts_with("[")) {
      if (is_known(table.name))
        return found + "; write " + table.name + " = { " + std::string(key) + " = " +
               written(value) + " }";
    } else if (heading.find('.') == std::string::npos) {
      elsewhere += (elsewhere.empty() ? "" : " or ") + heading;
    }
  }
  const std::string near = nearest(key, known);
  if (!near.empty()) return found + "; did you mean '" + near + "'?";
  if (!elsewhere.empty()) return found + "; it belongs in " + elsewhere;
  return found + "; known keys: " + quoted_list(known);
}

void Value::wrong_type(const std::string& wanted) const {
  fail("'" + name_ + "' is " + describe(*node_) + "; " + wanted + " is needed");
}

double Value::number() const {
  std::optional<double> value;
  if (const auto* real = node_->as_floating_point()) value = real->get();
  if (const auto* whole = node_->as_integer()) value = static_cast<double>(whole->get());
  const bool has_range = key_ != nullptr && !key_->range.empty();
  const std::string range = has_range ? std::string(key_->range) : "";
  if (!value) wrong_type(has_range ? "a number, " + range + "," : "a number");
  if (!std::isfinite(*value))
    fail("'" + name_ + "' is " + (std::isnan(*value) ? "not a number (nan)" : "infinite") +
         (has_range ? "; it may be " + range : "; a finite number is needed"));
  if (has_range && !key_->holds(*value))
    fail("'" + name_ + "' is " + written(*node_) + "; it may be " + range);
  return *value;
}

int Value::integer() const {
  return integer(static_cast<int>(key_->low), static_cast<int>(key_->high));
}

int Value::integer(int low, int high) const {
  const std::string range = std::to_string(low) + " to " + std::to_string(high);
  if (!node_->is_integer()) wrong_type("an integer from " + range);
  const std::int64_t value = node_->as_integer()->get();
  if (value < low || value > high)
    fail("'" + name_ + "' is " + std::to_string(value) + "; it may be " + range);
  return static_cast<int>(value);
}

bool Value::boolean() const {
  if (!node_->is_boolean()) wrong_type("true or false");
  return node_->as_boolean()->get();
}

std::string Value::string() const {
  if (!node_->is_string()) wrong_type("a string");
  const std::string& text = node_->as_string()->get();
  require_plain(*file_, node_->source().begin, "'" + name_ + "'", on_one_line(text));
  if (key_ != nullptr && !key_->words.empty()) {
    std::string kind(key_->name);
    std::ranges::replace(kind, '_', ' ');
    require_one(text, key_->words, kind);
  }
  return text;
}

std::string Value::non_empty_string() const {
  std::string text = string();
  if (text.empty()) fail("'" + name_ + "' is an empty string; it needs at least one character");
  return text;
}

std::string Value::one_of(const Keys& choices, const std::string& kind) const {
  const std::string text = string();
  require_one(text, choices, kind);
  return text;
}

void Value::require_one(const std::string& text, const Keys& choices,
                        const std::string& kind) const {
  if (std::ranges::find(choices, text) == choices.end())
    fail("unknown " + kind + " '" + text + "'; " + near_or_all(text, choices));
}

int Value::word() const {
  return static_cast<int>(std::ranges::find(key_->words, string()) - key_->words.begin());
}

std::vector<double> Value::numbers(std::size_t count) const {
  const toml::array* items = node_->as_array();
  if (node_->is_number())
    fail("'" + name_ + "' is one number; give " + std::to_string(count) + ", as [" +
         written(*node_) + ", ..]");
  if (items == nullptr || items->size() != count)
    wrong_type("an array of " + std::to_string(count) + " numbers");
  return mapped(array(), &Value::number);
}

Vec3d Value::vector3() const {
  const std::vector<double> values = numbers(3);
  return {values[0], values[1], values[2]};
}

std::vector<Value> Value::array() const {
  if (!is_array()) wrong_type("an array");
  std::vector<Value> values;
  for (const toml::node& item : *node_->as_array())
    values.push_back(part(item, name_ + "[" + std::to_string(values.size()) + "]"));
  return values;
}

std::vector<Value> Value::array_of_tables() const {
  const std::string wanted = "an array of tables, written as [[" + name_ + "]],";
  if (!node_->is_array()) wrong_type(wanted);
  std::vector<Value> values = array();
  for (const Value& value : values)
    if (!value.is_table()) value.wrong_type("a table, written as [[" + name_ + "]],");
  return values;
}

Value Value::among(const Keys& tables) const {
  Value some = *this;
  some.tables_ = tables;
  return some;
}

Value Value::table(const Keys& tables) const {
  Keys known;
  for (const std::string_view table : tables)
    for (const Key& key : key_table(table).keys)
      if (std::ranges::find(known, key.name) == known.end()) known.push_back(key.name);
  if (!is_table()) wrong_type("a table with the keys " + quoted_list(known));
  const toml::key* first = nullptr;
  for (auto&& [key, item] : *node_->as_table()) {
    if (std::ranges::find(known, key.str()) != known.end()) continue;
    if (first == nullptr || key.source().begin < first->source().begin) first = &key;
  }
  if (first != nullptr)
    fail_at(*file_, first->source().begin,
            unknown(first->str(), *node_->as_table()->get(first->str()), known));
  return among(tables);
}

std::optional<Value> Value::find(std::string_view key) const {
  const toml::table* table = node_->as_table();
  const toml::node* node = table == nullptr ? nullptr : table->get(key);
  if (node == nullptr) return std::nullopt;
  const Key* known = nullptr;
  for (const std::string_view name : tables_)
    if (known == nullptr) known = key_table(name).find(key);
  return Value(*file_, *node, std::string(key), known);
}

Value Value::require(std::string_view key) const {
  if (std::optional<Value> found = find(key)) return *found;
  std::string example;
  for (const std::string_view table : tables_)
    if (const Key* known = key_table(table).find(key)) example = known->example();
  const std::string where = name_.empty() ? "the file" : "'" + name_ + "'";
  fail("missing key '" + std::string(key) + "' in " + where + "; add " + example);
}

void Value::not_both(std::string_view one, std::string_view other) const {
  if (const auto second = find(other); second && find(one))
    second->fail("give '" + std::string(one) + "' or '" + std::string(other) + "', not both");
}

std::vector<Value> Value::members() const {
  const toml::table* table = node_->as_table();
  if (table == nullptr) wrong_type("a table");
  // The library sorts keys by name; restore the file's order from their positions.
  std::vector<std::pair<toml::source_position, Value>> found;
  for (auto&& [key, node] : *table) {
    require_plain(*file_, key.source().begin, "this name", std::string(key.str()));
    found.emplace_back(key.source().begin, part(node, std::string(key.str())));
  }
  std::ranges::stable_sort(found, std::less(), [](const auto& member) { return member.first; });
  return mapped(found, [](const auto& member) { return member.second; });
}

const std::vector<KeyTable>& key_tables() {
  static const std::vector<KeyTable> tables = parse_key_tables(scenario_reference());
  return tables;
}

const KeyTable& key_table(std::string_view name) {
  return *std::ranges::find(key_tables(), name, &KeyTable::name);
}

toml::table parse_document(const std::string& text, const std::string& file) {
  try {
    return toml::parse(std::string_view(text), std::string_view(file));
  } catch (const toml::parse_error& error) {
    std::string message = "this is not valid TOML: " + std::string(error.description());
    if (message.find("redefine") != std::string::npos)
      message += "; a key or table may be given only once";
    else if (message.find("could not be interpreted as a value") != std::string::npos)
      message += "; a number may be up to 1.8e308, an integer up to 9.2e18";
    else
      message += "; look for a quote, bracket or comma that is missing here or before";
    fail_at(file, error.source().begin, message);
  }
}

}  // namespace scenario_file
}  // namespace contactscope
