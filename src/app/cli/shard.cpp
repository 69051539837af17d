#include "app/cli/shard.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/at.h"
#include "core/input_error.h"
#include "snapshot/store.h"

namespace contactscope::app {

void read_times(const std::string& path, std::vector<Costed>& scenarios) {
  const std::optional<std::string> text = snapshot::read_text_file(path);
  if (!text)
    throw InputError(path, 0, 0, "there is no such file; check writes one to OUT/check/times.json");
  try {
    const nlohmann::json times = nlohmann::json::parse(*text);
    std::vector<double> known;
    for (const Costed& scenario : scenarios)
      if (times.contains(scenario.name)) known.push_back(times.at(scenario.name));
    std::ranges::sort(known);
    const double otherwise = known.empty() ? 1 : known[known.size() / 2];
    for (Costed& scenario : scenarios) scenario.cost = times.value(scenario.name, otherwise);
  } catch (const nlohmann::json::exception& error) {
    throw InputError(path, 0, 0, std::string("this file has no times of a check: ") + error.what());
  }
}

std::vector<std::string> names_in_shard(std::vector<Costed> scenarios,
                                        const snapshot::Shard& shard) {
  std::ranges::sort(scenarios, [](const Costed& a, const Costed& b) {
    return a.cost != b.cost ? a.cost > b.cost : a.name < b.name;
  });
  std::vector<double> load(static_cast<std::size_t>(shard.of));
  std::vector<std::string> names;
  for (const Costed& scenario : scenarios) {
    const auto least = std::ranges::min_element(load);
    *least += scenario.cost;
    if (least - load.begin() == shard.part - 1) names.push_back(scenario.name);
  }
  std::ranges::sort(names);
  return names;
}

std::vector<std::string> keep_shard(std::vector<Input>& inputs, const Options& options,
                                    const std::function<double(const Input&)>& cost) {
  std::vector<Costed> scenarios;
  for (const Input& input : inputs) scenarios.push_back({input.scenario.name, cost(input)});
  if (!options.times.empty()) read_times(options.times, scenarios);
  std::vector<std::string> names = mapped(scenarios, &Costed::name);
  const std::vector<std::string> own = names_in_shard(std::move(scenarios), *options.shard);
  std::erase_if(inputs, [&](const Input& input) {
    return !std::ranges::binary_search(own, input.scenario.name);
  });
  std::ranges::sort(names);
  return names;
}

std::string folder_of(const snapshot::Shard& shard) {
  return "check_" + std::to_string(shard.part) + "_of_" + std::to_string(shard.of);
}

}  // namespace contactscope::app
