#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace contactscope {

/// The part of JSON Schema that the schemas of src/trace use. An unknown keyword is an error of the
/// schema, so that nothing in it remains unchecked.
class JsonSchema {
 public:
  using Json = nlohmann::json;

  explicit JsonSchema(Json whole) : whole_(std::move(whole)) {}

  /// Places at which a document violates the schema.
  std::vector<std::string> faults(const Json& document) const {
    std::vector<std::string> found;
    check(document, whole_, "", found);
    return found;
  }

 private:
  static bool has_type(const Json& value, const std::string& type) {
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "number") return value.is_number();
    if (type == "null") return value.is_null();
    return type == "integer" && value.is_number_integer();
  }

  bool is_valid(const Json& value, const Json& schema) const {
    std::vector<std::string> found;
    check(value, schema, "", found);
    return found.empty();
  }

  void check(const Json& value, const Json& schema, const std::string& at,
             std::vector<std::string>& found) const {
    const auto fault = [&](const std::string& what) { found.push_back(at + ": " + what); };
    for (const auto& [word, said] : schema.items()) {
      if (word == "$ref")
        check(value, whole_.at(Json::json_pointer(said.get<std::string>().substr(1))), at, found);
      else if (word == "type")
        has_type(value, said) ? void() : fault("no " + said.get<std::string>());
      else if (word == "const")
        value == said ? void() : fault("is another");
      else if (word == "enum")
        std::ranges::count(said, value) > 0 ? void() : fault(value.dump() + " is no such word");
      else if (word == "minimum")
        value >= said ? void() : fault("too small");
      else if (word == "required")
        for (const std::string key : said) value.contains(key) ? void() : fault("no " + key);
      else if (word == "minItems")
        value.size() >= said ? void() : fault("too few");
      else if (word == "maxItems")
        value.size() <= said ? void() : fault("too many");
      else if (word == "anyOf")
        std::ranges::any_of(said, [&](const Json& one) { return is_valid(value, one); })
            ? void()
            : fault("is none of those that it may be");
      else if (word == "items")
        for (const Json& item : value) check(item, said, at + "/-", found);
      else if (word == "properties" || word == "additionalProperties")
        check_members(value, schema, at, word == "properties", found);
      else if (word != "$schema" && word != "$defs" && word != "title" && word != "description")
        ADD_FAILURE() << "this test does not know '" << word << "'";
    }
  }

  void check_members(const Json& value, const Json& schema, const std::string& at, bool are_listed,
                     std::vector<std::string>& found) const {
    const Json listed = schema.value("properties", Json::object());
    for (const auto& [key, member] : value.items()) {
      if (listed.contains(key) != are_listed) continue;
      const Json& said = are_listed ? listed.at(key) : schema.at("additionalProperties");
      if (said.is_boolean())
        said.get<bool>() ? void() : found.push_back(at + ": '" + key + "' is not listed");
      else
        check(member, said, at + "/" + key, found);
    }
  }

  Json whole_;
};

}  // namespace contactscope
