#pragma once

#include <ranges>

#include <nlohmann/json.hpp>

#include "core/vec3.h"
#include "trace/field.h"

/// JSON of structs that list their fields. Reports are read here as well; traces, which are large,
/// by read_trace.h. A member function in a list of fields gives a value that is written and not
/// read: `field::exact<&Finding::fails>`.
namespace contactscope::trace {

using Json = nlohmann::ordered_json;  // keeps the order of the lists

/// An enum that is read again: words_of() returns the names of its values, in order.
template <class Enum>
concept Worded = std::is_enum_v<Enum> && requires(Enum value) {
  words_of(value);
};
template <Worded Enum> constexpr std::string_view to_string(Enum value) {
  return words_of(value)[static_cast<std::size_t>(value)];
}

/// Writes the fields of one kind of document, which errors name. JSON cannot represent numbers that
/// are not finite and the library would silently write null, so every function throws
/// std::domain_error with the key.
class JsonWriter {
 public:
  explicit JsonWriter(const char* document) : document_(document) {}

  template <Listed T> void add(Json& object, const T& fact) const {
    [[maybe_unused]] static const T kDefault{};
    each_field<T>([&]<class Value>(const Field<T, Value>& field) {
      const auto& value = std::invoke(field.member, fact);
      if (field.is_object_key) return;
      if constexpr (Listed<Value>) {
        if (field.is_merged) return add(object, value);
      }
      if (field.presence == Presence::WhereSet &&
          is_unset(value, std::invoke(field.member, kDefault)))
        return;
      Json& owner = field.within != nullptr ? object[field.within] : object;
      owner[field.key] = json(value, field.key);
    });
  }

 private:
  template <class T> static bool is_unset(const T& value, const T& fallback) {
    if constexpr (kIsOptional<T>) {
      return !value.has_value();
    } else if constexpr (requires(T filled) { filled.clear(); }) {
      return value.empty();
    } else if constexpr (Listed<T>) {
      return false;
    } else {
      return value == fallback;
    }
  }

  Json json(double value, const char* key) const {
    if (!std::isfinite(value))
      throw std::domain_error(std::string(document_) + ": '" + key +
                              "' is not a finite number, which JSON cannot hold");
    return value;
  }
  template <class T>
  requires std::integral<T> Json json(T value, const char*)
  const { return value; }
  Json json(const std::string& value, const char*) const { return value; }
  template <class Enum>
  requires std::is_enum_v<Enum> Json json(Enum value, const char*)
  const { return to_string(value); }
  Json json(const Quatd& q, const char* key) const {
    return Json::array({json(q.w(), key), json(q.x(), key), json(q.y(), key), json(q.z(), key)});
  }
  template <class T>
  requires kIsOptional<T> Json json(const T& value, const char* key)
  const { return value ? json(*value, key) : Json(nullptr); }
  template <Listed T> Json json(const T& fact, const char*) const {
    Json object = Json::object();
    add(object, fact);
    return object;
  }
  template <class T> Json json(const std::map<std::string, T>& map, const char* key) const {
    Json object = Json::object();
    for (const auto& [name, value] : map) object[name] = json(value, key);
    return object;
  }
  /// A vector of three, or any list.
  template <std::ranges::range List> Json json(const List& list, const char* key) const {
    using Entry = std::ranges::range_value_t<List>;
    if constexpr (Listed<Entry>) {
      if constexpr (has_name<Entry>()) {
        Json object = Json::object();
        for (const Entry& entry : list) object[name_of(entry)] = json(entry, key);
        return object;
      }
    }
    Json array = Json::array();
    for (const auto& entry : list) array.push_back(json(entry, key));
    return array;
  }

  const char* document_;
};

template <Listed T>
Json written(const char* document, const T& facts, Json object = Json::object()) {
  JsonWriter(document).add(object, facts);
  return object;
}

/// Reads what written() has written, or a value in it. Throws std::exception if a needed key is
/// missing or a value is of another type. Ignores unknown keys.
template <class T> void read_json(const Json& json, T& value) {
  if constexpr (Listed<T>) {
    each_field<T>([&]<class Value>(const Field<T, Value>& field) {
      if constexpr (!std::is_function_v<Value>) {
        if (field.is_merged)
          read_json(json, value.*field.member);
        else if (field.needed() || json.contains(field.key))
          read_json(json.at(field.key), value.*field.member);
      }
    });
  } else if constexpr (kIsOptional<T>) {
    read_json(json, value.emplace());
  } else if constexpr (Worded<T>) {
    const auto& words = words_of(value);
    const auto found = std::ranges::find(words, json.get<std::string>());
    if (found == words.end()) throw std::invalid_argument("unknown word " + json.dump());
    value = static_cast<T>(found - words.begin());
  } else if constexpr (requires { requires Listed<typename T::mapped_type>; }) {
    for (const auto& [key, entry] : json.items()) read_json(entry, value[key]);
  } else if constexpr (requires { requires Listed<typename T::value_type>; }) {
    for (const Json& entry : json) read_json(entry, value.emplace_back());
  } else {
    json.get_to(value);
  }
}

}  // namespace contactscope::trace
