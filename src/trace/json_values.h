#pragma once

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "trace/trace.h"

/// How the writers spell the values that they share.
namespace contactscope::trace {

using Json = nlohmann::ordered_json;  // keys in the order of FORMATS.md

/// The library would write nan and infinity as null, and nobody would notice.
inline Json number(double value, const char* key) {
  if (!std::isfinite(value))
    throw std::domain_error(std::string("trace: '") + key +
                            "' is not a finite number, which JSON cannot hold");
  return value;
}

inline Json vector(const Vec3d& v, const char* key) {
  return Json::array({number(v.x(), key), number(v.y(), key), number(v.z(), key)});
}

inline Json vectors(const std::vector<Vec3d>& items, const char* key) {
  Json list = Json::array();
  for (const Vec3d& item : items) list.push_back(vector(item, key));
  return list;
}

inline Json impulse(const Impulse& i) {
  return {{"normal", number(i.normal, "normal")},
          {"friction", vector(i.friction, "friction")},
          {"warm_start", number(i.warm_start, "warm_start")}};
}

inline Json point(const Point& p) {
  Json json = {{"position", vector(p.position, "position")},
               {"separation", number(p.separation, "separation")},
               {"id", p.id}};
  if (p.impulse) json["impulse"] = impulse(*p.impulse);
  if (p.relative_velocity)
    json["relative_velocity"] = {{"before", vector(p.relative_velocity->before, "before")},
                                 {"after", vector(p.relative_velocity->after, "after")}};
  return json;
}

inline Json points(const std::vector<Point>& items) {
  Json list = Json::array();
  for (const Point& item : items) list.push_back(point(item));
  return list;
}

}  // namespace contactscope::trace
