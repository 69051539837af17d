#include "snapshot/outcome_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/input_error.h"

namespace contactscope::snapshot {
namespace {

using Json = nlohmann::ordered_json;

void set(Json& json, const char* key, const std::string& text) {
  if (!text.empty()) json[key] = text;
}

Json to_json(const PixelMeasures& pixels) {
  const PixelComparison& found = pixels.found;
  const PixelBox& box = found.largest_cluster_at;
  return {{"size_differs", found.verdict == PixelVerdict::SizeDiffers},
          {"differing", found.differing},
          {"largest_cluster", found.largest_cluster},
          {"largest_cluster_at", {box.left, box.top, box.right, box.bottom}},
          {"largest_channel_difference", found.largest_channel_difference},
          {"allowed",
           {{"channel", pixels.limits.channel},
            {"cluster", pixels.limits.cluster},
            {"total", pixels.limits.total}}}};
}

Json to_json(const Finding& finding) {
  Json json{{"key", finding.key()}, {"kind", name_of(finding.kind)}};
  set(json, "view", finding.view);
  if (finding.frame) json["frame"] = *finding.frame;
  set(json, "file", finding.file);
  json["sentence"] = finding.sentence;
  if (!finding.details.empty()) json["details"] = finding.details;
  json["cause"] = finding.cause;
  if (finding.pixels) json["pixels"] = to_json(*finding.pixels);
  if (!finding.layers.empty()) json["layers"] = finding.layers;
  if (!finding.layers_picture.empty()) json["layers_picture"] = finding.layers_picture;
  set(json, "candidate", finding.candidate);
  set(json, "expected", finding.expected);
  set(json, "difference", finding.difference);
  set(json, "stored_sha256", finding.stored_sha256);
  set(json, "candidate_sha256", finding.candidate_sha256);
  json["done"] = kDone[static_cast<std::size_t>(finding.done)];
  json["review"] = kReviews[static_cast<std::size_t>(finding.review)];
  json["fails"] = finding.fails();
  return json;
}

Json to_json(const ScenarioOutcome& scenario) {
  Json json{{"scenario", scenario.scenario}};
  set(json, "file", scenario.file);
  json["same"] = !scenario.fails();
  json["frames"] = scenario.frames;
  json["pictures"] = scenario.pictures;
  json["written"] = scenario.written;
  if (!scenario.notes.empty()) json["notes"] = scenario.notes;
  if (!scenario.brittle.empty()) json["brittle"] = scenario.brittle;
  json["findings"] = Json::array();
  for (const Finding& finding : scenario.findings) json["findings"].push_back(to_json(finding));
  return json;
}

template <class Enum, std::size_t N>
Enum word(const Json& json, const char* key, const std::array<std::string_view, N>& words) {
  const std::string text = json.at(key);
  const auto found = std::ranges::find(words, text);
  if (found == words.end()) throw std::runtime_error("'" + text + "' is not a " + key);
  return static_cast<Enum>(found - words.begin());
}

PixelMeasures pixels_of(const Json& json) {
  PixelMeasures pixels;
  PixelComparison& found = pixels.found;
  found.verdict = json.at("size_differs") ? PixelVerdict::SizeDiffers : PixelVerdict::Different;
  found.differing = json.at("differing");
  found.largest_cluster = json.at("largest_cluster");
  const std::array<int, 4> box = json.at("largest_cluster_at");
  found.largest_cluster_at = {box[0], box[1], box[2], box[3]};
  found.largest_channel_difference = json.at("largest_channel_difference");
  const Json& allowed = json.at("allowed");
  pixels.limits = {allowed.at("channel"), allowed.at("cluster"), allowed.at("total")};
  return pixels;
}

Finding finding_of(const Json& json, const std::string& scenario) {
  Finding finding;
  finding.scenario = scenario;
  finding.kind = word<FindingKind>(json, "kind", kFindingKinds);
  finding.view = json.value("view", "");
  if (json.contains("frame")) finding.frame = json.at("frame").get<int>();
  finding.file = json.value("file", "");
  finding.sentence = json.at("sentence");
  if (json.contains("details"))
    finding.details = json.at("details").get<std::vector<std::string>>();
  finding.cause = json.at("cause");
  if (json.contains("pixels")) finding.pixels = pixels_of(json.at("pixels"));
  finding.layers_picture = json.value("layers_picture", "");
  if (json.contains("layers")) finding.layers = json.at("layers").get<std::vector<std::string>>();
  finding.candidate = json.value("candidate", "");
  finding.expected = json.value("expected", "");
  finding.difference = json.value("difference", "");
  finding.stored_sha256 = json.value("stored_sha256", "");
  finding.candidate_sha256 = json.value("candidate_sha256", "");
  finding.done = word<Done>(json, "done", kDone);
  finding.review = word<Review>(json, "review", kReviews);
  return finding;
}

ScenarioOutcome scenario_of(const Json& json) {
  ScenarioOutcome scenario{json.at("scenario").get<std::string>()};
  scenario.file = json.value("file", "");
  scenario.frames = json.at("frames");
  scenario.pictures = json.at("pictures");
  scenario.written = json.at("written");
  if (json.contains("notes")) scenario.notes = json.at("notes").get<std::vector<std::string>>();
  if (json.contains("brittle"))
    scenario.brittle = json.at("brittle").get<std::vector<std::string>>();
  for (const Json& finding : json.at("findings"))
    scenario.findings.push_back(finding_of(finding, scenario.scenario));
  return scenario;
}

}  // namespace

std::string to_json(const Outcome& outcome) {
  const Tally counts = tally(outcome);
  Json json{{"schema", kFindingsSchema}, {"snapshots", outcome.snapshots}};
  if (outcome.facts_only) json["facts_only"] = true;
  if (outcome.shard) {
    json["shard"] = {{"part", outcome.shard->part}, {"of", outcome.shard->of}};
    json["all"] = outcome.all;
    set(json, "made_of", outcome.made_of);
  }
  json["same"] = counts.failing == 0;
  json["summary"] = summary(counts);
  json["counts"] = {{"scenarios", counts.scenarios}, {"same", counts.same},
                    {"failing", counts.failing},     {"frames", counts.frames},
                    {"pictures", counts.pictures},   {"written", counts.written}};
  for (std::size_t kind = 0; kind < kFindingKinds.size(); ++kind)
    json["counts"][std::string(kFindingKinds[kind])] = counts.kinds[kind];
  json["scenarios"] = Json::array();
  for (const ScenarioOutcome& scenario : outcome.scenarios)
    json["scenarios"].push_back(to_json(scenario));
  // File names may be any bytes; invalid UTF-8 is replaced.
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Outcome parse_outcome(const std::string& text, const std::string& name) {
  try {
    const Json json = Json::parse(text);
    if (json.at("schema") != kFindingsSchema)
      throw std::runtime_error("its schema is not " + std::string(kFindingsSchema));
    Outcome outcome;
    outcome.snapshots = json.at("snapshots");
    outcome.facts_only = json.value("facts_only", false);
    if (json.contains("shard")) {
      outcome.shard = Shard{json.at("shard").at("part"), json.at("shard").at("of")};
      outcome.all = json.at("all").get<std::vector<std::string>>();
      outcome.made_of = json.value("made_of", "");
    }
    for (const Json& scenario : json.at("scenarios"))
      outcome.scenarios.push_back(scenario_of(scenario));
    return outcome;
  } catch (const std::exception& error) {
    throw InputError(name, 0, 0, std::string("not the findings of a check: ") + error.what());
  }
}

}  // namespace contactscope::snapshot
