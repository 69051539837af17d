#include "trace/json.h"

#include "trace/exploration.h"
#include "trace/listed_json.h"
#include "trace/study.h"

namespace contactscope::trace {
namespace {

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
