#include "trace/json.h"

#include "trace/exploration.h"
#include "trace/json_node.h"
#include "trace/listed_json.h"
#include "trace/study.h"

namespace contactscope::trace {
namespace {

/// Removes the keys for panels from studies without panels.
Json written(const Study& study) {
  Json json = written("study", study, {{"schema", kStudySchema}});
  if (has_panels(study)) return json;
  for (const char* key : {"form", "row", "signal"}) json.erase(key);
  for (Json& series : json["series"])
    for (const char* key : {"panel", "parameter", "row"}) series.erase(key);
  return json;
}

constexpr const char* kNoJson =
    "this line is not valid JSON from here on; a trace has one object per line: correct it, or, if "
    "it is cut off, record it again";

/// Explains why a line is not JSON from a column on, counted from 1.
std::string why_no_json(const std::string& line, std::size_t column, const std::string& record) {
  if (line.starts_with("\x1f\x8b")) return "the file is compressed; unpack it first";
  if (line.starts_with("\xff\xfe") || line.starts_with("\xfe\xff"))
    return "the file is UTF-16; a trace is UTF-8";
  if (record.find("UTF-8") != std::string::npos)
    return "from here on this line is not UTF-8; it may be Latin-1 or binary";
  constexpr std::size_t kBefore = 6;  // a sign, and the letters parsed as a literal
  std::string near = line.substr(column > kBefore ? column - kBefore : 0, 2 * kBefore);
  std::ranges::transform(near, near.begin(), [](unsigned char c) { return std::tolower(c); });
  if (near.find("nan") != std::string::npos || near.find("inf") != std::string::npos)
    return "this line is not valid JSON from here on, which has no nan and no infinity; find where "
           "the engine computes it, or leave the pair out";
  return kNoJson;
}

/// Maximum nesting of lists and objects; less than the fast parser accepts.
constexpr int kDeepest = 1000;

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

Node JsonLine::parse(std::string& line) {
  line.reserve(line.size() + simdjson::SIMDJSON_PADDING);
  simdjson::dom::element tree;
  if (parser_.parse(line.data(), line.size(), false).get(tree) == simdjson::SUCCESS)
    return Node(tree);
  return parse_again(line);
}

/// Second parser: reports where and why the fast one failed. It also accepts some more spellings,
/// such as integers of twenty digits and a byte order mark, and normalises them.
Node JsonLine::parse_again(const std::string& line) {
  std::string again;
  int deepest = 0;
  // Deeper levels are dropped: destroying the tree recurses once per level.
  const auto is_shallow = [&](int depth, nlohmann::json::parse_event_t, const auto&) {
    deepest = std::max(deepest, depth);
    return depth < kDeepest;
  };
  try {
    again = nlohmann::ordered_json::parse(line, is_shallow).dump();
    if (deepest >= kDeepest)
      throw Complaint{"lists and objects are nested more than " + std::to_string(kDeepest) +
                      " deep; a trace needs a dozen"};
  } catch (const nlohmann::json::parse_error& error) {
    throw NoJson{static_cast<int>(error.byte), why_no_json(line, error.byte, error.what())};
  } catch (const nlohmann::json::out_of_range& error) {
    const std::string record = error.what();
    throw Complaint{"a number is too large for a double: " +
                    record.substr(record.find_last_of(' ') + 1)};
  } catch (const nlohmann::json::exception& error) {
    throw Complaint{std::string("not read: ") + error.what()};
  }
  simdjson::dom::element tree;
  if (const auto error = parser_.parse(again).get(tree); error != simdjson::SUCCESS)
    throw Complaint{std::string("not read: ") + simdjson::error_message(error)};
  return Node(tree);
}

}  // namespace contactscope::trace
