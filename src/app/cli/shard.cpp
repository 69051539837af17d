#include "app/cli/shard.h"

#include <algorithm>

namespace contactscope::app {

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

void keep_shard(std::vector<Input>& inputs, const snapshot::Shard& shard,
                const std::function<double(const Input&)>& cost) {
  std::vector<Costed> scenarios;
  for (const Input& input : inputs) scenarios.push_back({input.scenario.name, cost(input)});
  const std::vector<std::string> own = names_in_shard(std::move(scenarios), shard);
  std::erase_if(inputs, [&](const Input& input) {
    return !std::ranges::binary_search(own, input.scenario.name);
  });
}

std::string folder_of(const snapshot::Shard& shard) {
  return "check_" + std::to_string(shard.part) + "_of_" + std::to_string(shard.of);
}

}  // namespace contactscope::app
