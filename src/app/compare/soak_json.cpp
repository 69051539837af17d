#include <nlohmann/json.hpp>

#include "app/compare/soak.h"
#include "core/input_error.h"

namespace contactscope::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "contactscope.soak/1";

Json line_to_json(const SoakLine& line) {
  Json faults = Json::object(), errors = Json::array();
  for (std::size_t i = 1; i < line.faults.size(); ++i) faults[kContactFaults[i]] = line.faults[i];
  for (const auto& [exponent, count] : line.errors) errors.push_back({exponent, count});
  return {{"sweep", line.sweep},           {"pair", line.pair},
          {"scalar", line.scalar},         {"pairs", line.pairs},
          {"faults", std::move(faults)},   {"worst_ulps", line.worst_ulps},
          {"worst_case", line.worst_case}, {"exact", line.exact},
          {"errors", std::move(errors)}};
}

SoakLine parse_line(const Json& json) {
  SoakLine line{json.at("sweep"), json.at("pair"), json.at("scalar"), json.at("pairs")};
  line.faults[0] = line.pairs;
  for (std::size_t i = 1; i < line.faults.size(); ++i) {
    line.faults[i] = json.at("faults").at(kContactFaults[i]);
    line.faults[0] -= line.faults[i];
  }
  line.worst_ulps = json.at("worst_ulps");
  line.worst_case = json.at("worst_case");
  line.exact = json.at("exact");
  for (const Json& bin : json.at("errors")) line.errors[bin.at(0).get<int>()] = bin.at(1);
  return line;
}

}  // namespace

std::string to_json(const Soak& soak, const std::optional<snapshot::Shard>& shard) {
  Json json{
      {"schema", kSchema}, {"study", "stability"}, {"seed", soak.seed}, {"cases", soak.cases}};
  if (shard) json["shard"] = {{"part", shard->part}, {"of", shard->of}};
  json["wrong"] = soak.wrong();
  json["lines"] = Json::array();
  for (const SoakLine& line : soak.lines) json["lines"].push_back(line_to_json(line));
  json["failures"] = Json::array();
  for (const SoakFailure& failure : soak.failures)
    json["failures"].push_back({{"case", failure.number},
                                {"sweep", failure.sweep},
                                {"pair", failure.pair},
                                {"scalar", failure.scalar},
                                {"fault", failure.fault},
                                {"value", failure.value},
                                {"ulps", failure.ulps}});
  return json.dump(1) + "\n";
}

Soak parse_soak(const std::string& text, const std::string& path,
                std::optional<snapshot::Shard>& shard) {
  try {
    const Json json = Json::parse(text);
    if (json.at("schema") != kSchema)
      throw InputError(
          path, 0, 0,
          std::string("this is not a part of study stability: its schema is not ") + kSchema);
    Soak soak{json.at("seed"), json.at("cases")};
    shard.reset();
    if (json.contains("shard"))
      shard = snapshot::Shard{json.at("shard").at("part"), json.at("shard").at("of")};
    for (const Json& line : json.at("lines")) soak.lines.push_back(parse_line(line));
    for (const Json& failure : json.at("failures"))
      soak.failures.push_back({failure.at("case"), failure.at("sweep"), failure.at("pair"),
                               failure.at("scalar"), failure.at("fault"), failure.at("value"),
                               failure.at("ulps")});
    return soak;
  } catch (const nlohmann::json::exception& error) {
    throw InputError(path, 0, 0,
                     std::string("this part of study stability cannot be read: ") + error.what() +
                         "; run its shard again");
  }
}

}  // namespace contactscope::app
