#pragma once

#include <cxxabi.h>

#include <memory>
#include <string>
#include <typeinfo>

#include <nlohmann/json.hpp>

#include "trace/json.h"

/// Makes src/trace/trace.schema.json from the lists of fields and the tables of the reference.
namespace contactscope::trace {

class SchemaMaker {
 public:
  using Json = nlohmann::ordered_json;

  /// One line for each definition.
  std::string text() {
    add<Header>();
    add<Frame>();
    // Read, and never written: see read_trace.cpp.
    Json& shape = definitions_["Shape"];
    shape.erase("required");  // the vertices alone
    shape["properties"]["half_extents"] = {{"$ref", "#/$defs/vector"}};
    definitions_["Header"]["required"].push_back("schema");
    definitions_["Header"]["properties"]["schema"] = {{"const", kSchema}};
    std::string lines;
    const auto add_line = [&](const std::string& name, const Json& definition) {
      lines += (lines.empty() ? "  " : ",\n  ") + Json(name).dump() + ": " + definition.dump();
    };
    add_line("vector", of_numbers(3));
    for (const auto& [name, definition] : definitions_.items()) add_line(name, definition);
    return R"({
 "$schema": "https://json-schema.org/draft/2020-12/schema",
 "title": ")" +
           std::string(kSchema) + R"(",
 "description": "One line of a trace: the header, or a frame. Readers ignore other keys.",
 "anyOf": [{"$ref": "#/$defs/Header"}, {"$ref": "#/$defs/Frame"}],
 "$defs": {
)" + lines +
           "\n }\n}\n";
  }

  /// The name of a fact: "Manifold".
  template <class T> static std::string name() {
    int status = 0;
    const std::unique_ptr<char, void (*)(void*)> whole(
        abi::__cxa_demangle(typeid(T).name(), nullptr, nullptr, &status), std::free);
    std::string text = whole.get();
    text = text.substr(0, text.find('<'));
    text = text.substr(text.rfind(':') + 1);
    return text == "pair" ? "Placement" : text;
  }

  /// The name of the table with the keys of a fact; "Stages" of one that has none of its own.
  static std::string table_of(const std::string& fact) {
    return fact_key(fact, fact == "Frame"      ? "time"
                          : fact == "Pair"     ? "manifolds"
                          : fact == "Header"   ? "up"
                          : fact == "Manifold" ? "points"
                                               : "position")
               ? fact
           : fact == "Shape" ? "Shape"
                             : "Stages";
  }

 private:
  static Json of(const std::string& key, const Json& value) {
    Json json;
    json[key] = value;
    return json;
  }
  static Json of_numbers(std::size_t count) {
    Json json = of("type", "array");
    json["items"] = of("type", "number");
    json["minItems"] = count;
    json["maxItems"] = count;
    return json;
  }

  template <Listed T> void add() {
    if (definitions_.contains(name<T>())) return;
    definitions_[name<T>()] = Json();  // its place, also for a fact that contains itself
    Json required = Json::array(), properties = Json::object();
    add_keys<T>(name<T>(), required, properties);
    Json definition = of("type", "object");
    if (!required.empty()) definition["required"] = required;
    definition["properties"] = properties;
    definitions_[name<T>()] = definition;
  }

  template <Listed T> void add_keys(const std::string& fact, Json& required, Json& properties) {
    each_field<T>([&]<class V>(const Field<T, V>& field) {
      if (field.is_object_key) return;
      if constexpr (Listed<V>) {
        if (field.is_merged) return add_keys<V>(fact, required, properties);
      }
      Json value = schema<V>();
      const Key* const key = fact_key(table_of(fact), field.key);
      const bool is_own = table_of(fact) != "Stages" && key != nullptr;
      if (is_own && !key->words.empty() && std::same_as<V, std::string>) {
        value["enum"] = key->words;
        if (field.presence == Presence::Optional) value["enum"].push_back("");  // unknown
      }
      if (is_own) value["description"] = plain(key->text);
      if (field.presence == Presence::OrNull) {
        Json either = Json::array();
        either.push_back(std::move(value));
        either.push_back(of("type", "null"));
        value = of("anyOf", either);
      }
      if (field.within == nullptr) {
        properties[field.key] = value;
        if (field.needed()) required.push_back(field.key);
        return;
      }
      Json& owner = properties[field.within];
      owner["type"] = "object";
      owner["properties"][field.key] = value;
      if (field.needed() && std::ranges::find(required, field.within) == required.end())
        required.push_back(field.within);
    });
  }

  template <class T> Json schema() {
    if constexpr (std::same_as<T, double>) {
      return of("type", "number");
    } else if constexpr (std::same_as<T, int>) {
      return of("type", "integer");
    } else if constexpr (std::same_as<T, bool>) {
      return of("type", "boolean");
    } else if constexpr (std::same_as<T, std::string>) {
      return of("type", "string");
    } else if constexpr (std::same_as<T, Vec3d>) {
      return of("$ref", "#/$defs/vector");
    } else if constexpr (std::same_as<T, Quatd>) {
      return of_numbers(4);
    } else if constexpr (Listed<T>) {
      add<T>();
      return of("$ref", "#/$defs/" + name<T>());
    } else if constexpr (kIsOptional<T>) {
      return schema<typename Unwrapped<T>::type>();
    } else {
      using Entry = typename T::value_type;
      const Json entry = schema<Entry>();
      if constexpr (Listed<Entry>) {
        if (has_name<Entry>()) {
          Json names = of("type", "object");
          names["additionalProperties"] = entry;
          return names;
        }
      }
      Json list = of("type", "array");
      list["items"] = entry;
      if constexpr (requires { std::tuple_size<T>::value; })
        list["minItems"] = list["maxItems"] = std::tuple_size_v<T>;
      return list;
    }
  }

  Json definitions_;
};

}  // namespace contactscope::trace
