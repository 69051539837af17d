#include "trace/json.h"

#include <cmath>
#include <ranges>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "trace/exploration.h"
#include "trace/study.h"

namespace contactscope::trace {
namespace {

using Json = nlohmann::ordered_json;  // keeps the order of the lists

/// Writes the facts of one kind of document, which errors name. JSON cannot represent numbers that
/// are not finite and the library would silently write null, so every function throws
/// std::domain_error with the key.
class JsonWriter {
 public:
  explicit JsonWriter(const char* document) : document_(document) {}

  template <Listed T> void add(Json& object, const T& fact) const {
    [[maybe_unused]] static const T kDefault{};
    each_field<T>([&]<class Value>(const Field<T, Value>& field) {
      const Value& value = fact.*field.member;
      if (field.is_object_key) return;
      if constexpr (Listed<Value>) {
        if (field.is_merged) return add(object, value);
      }
      if (field.presence == Presence::WhereSet && is_unset(value, kDefault.*field.member)) return;
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
  Json json(int value, const char*) const { return value; }
  Json json(bool value, const char*) const { return value; }
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

/// Removes the keys for panels from studies without panels.
Json written(const Study& study) {
  Json json = written("study", study, {{"schema", kStudySchema}});
  if (has_panels(study)) return json;
  for (const char* key : {"form", "row", "signal"}) json.erase(key);
  for (Json& series : json["series"]) {
    for (const char* key : {"panel", "parameter", "row"}) series.erase(key);
  }
  return json;
}

}  // namespace

std::string to_json_line(const Header& header) {
  return written("trace", header, {{"schema", kSchema}}).dump();
}

std::string to_json_line(const Frame& frame) { return written("trace", frame).dump(); }

std::string to_json_line(const Exploration& exploration) {
  return written("trace", exploration, {{"schema", kExplorationSchema}}).dump();
}

std::string to_json(const Study& study) { return written(study).dump(1) + "\n"; }

std::string to_json_line(const Study& study) { return written(study).dump(); }

}  // namespace contactscope::trace
