#include "snapshot/outcome_json.h"

#include "core/input_error.h"
#include "trace/listed_json.h"

namespace contactscope::snapshot {

std::string to_json(const Outcome& outcome) {
  const Tally counts = tally(outcome);
  trace::Json json = trace::written("findings", outcome, {{"schema", kFindingsSchema}});
  json["same"] = counts.failing == 0;
  json["summary"] = summary(counts);
  json["counts"] = {{"scenarios", counts.scenarios}, {"same", counts.same},
                    {"failing", counts.failing},     {"frames", counts.frames},
                    {"pictures", counts.pictures},   {"written", counts.written}};
  for (std::size_t kind = 0; kind < kFindingKinds.size(); ++kind)
    json["counts"][std::string(kFindingKinds[kind])] = counts.kinds[kind];
  json["scenarios"] = trace::Json::array();
  for (const ScenarioOutcome& scenario : outcome.scenarios)
    json["scenarios"].push_back(trace::written("findings", scenario));
  // File names may be any bytes; invalid UTF-8 is replaced.
  return json.dump(1, ' ', false, trace::Json::error_handler_t::replace) + "\n";
}

Outcome parse_outcome(const std::string& text, const std::string& name) {
  try {
    const trace::Json json = trace::Json::parse(text);
    if (json.at("schema") != kFindingsSchema)
      throw std::runtime_error("its schema is not " + std::string(kFindingsSchema));
    Outcome outcome;
    trace::read_json(json, outcome);
    trace::read_json(json.at("scenarios"), outcome.scenarios);
    for (ScenarioOutcome& scenario : outcome.scenarios)
      for (Finding& finding : scenario.findings) finding.scenario = scenario.scenario;
    return outcome;
  } catch (const std::exception& error) {
    throw InputError(name, 0, 0, std::string("not the findings of a check: ") + error.what());
  }
}

}  // namespace contactscope::snapshot
