#include <algorithm>
#include <cctype>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "app/cli/catalogue.h"
#include "app/cli/source_map.h"
#include "app/cli/verbs.h"
#include "broadphase/broad_phase.h"
#include "continuous/impact_of_shapes.h"
#include "core/at.h"
#include "reduce/reducer.h"
#include "study/study.h"
#include "view/title.h"
#include "view/words.h"

namespace contactscope::app {
namespace {

struct Item {
  std::string name;
  std::string summary;
};

std::vector<Item> items_of_map(const std::string& what) {
  return mapped(source_rows(what), [](const SourceRow& row) {
    std::string shown;
    for (const std::string& one : row.shown) shown += (shown.empty() ? "" : ", ") + one;
    return Item{row.id,
                row.place + ": " + row.claim + "  [" + (shown.empty() ? "nothing" : shown) + "]"};
  });
}

bool is_map(const std::string& what) {
  return std::ranges::find(kListed, "sources") <= std::ranges::find(kListed, what) &&
         std::ranges::count(kListed, what) > 0;
}

std::vector<Item> items_of(const std::string& what, const Options& options) {
  const auto with_summary = [](const auto& info) { return Item{info.name, info.summary}; };
  const auto name_alone = [](std::string_view name) { return Item{std::string(name), ""}; };
  if (what == "reducers") return mapped(reducers(), with_summary);
  if (what == "broad_phases") return mapped(broad_phases(), with_summary);
  if (what == "continuous") {
    std::vector<Item> items{
        {"discrete", "none: a body that passes another one between two frames is not noticed"}};
    std::ranges::transform(impact_methods(), std::back_inserter(items), with_summary);
    return items;
  }
  if (what == "layers") return mapped(kLayerNames, name_alone);
  if (what == "panels") return mapped(kPanelNames, name_alone);
  if (what == "studies") return mapped(studies(), with_summary);
  if (what == "words") return mapped(known_words(), name_alone);
  if (is_map(what)) return items_of_map(what);
  return mapped(scenario_files(options.scenario_root), [](const std::string& file) {
    const Scenario scenario = load_scenario(file);
    return Item{scenario.name, plain_title(scenario.title)};
  });
}

ExitCode run_list(const Options& options) {
  if (options.formats != Options{}.formats) {
    if (options.formats != std::vector<std::string>{"html"} || !is_map(options.what))
      throw UsageError(
          "only 'list sources', a document of them, and 'list course' are pages; "
          "write list sources --format html");
    std::cout << write_source_page(options.what, options) << '\n';
    return ExitCode::Same;
  }
  std::vector<std::string> kinds(kListed.begin(), std::ranges::find(kListed, "sources"));
  if (!options.what.empty()) kinds = {options.what};
  nlohmann::ordered_json json;
  for (const std::string& kind : kinds) {
    const std::vector<Item> items = items_of(kind, options);
    if (options.json) {
      json[kind] = nlohmann::ordered_json::array();
      for (const Item& item : items) {
        nlohmann::ordered_json entry{{"name", item.name}};
        if (!item.summary.empty()) entry["summary"] = item.summary;
        json[kind].push_back(entry);
      }
      continue;
    }
    if (kinds.size() > 1) std::cout << kind << ":\n";
    const char* indent = kinds.size() > 1 ? "  " : "";
    std::size_t width = 0;
    for (const Item& item : items) width = std::max(width, item.name.size());
    for (const Item& item : items) {
      std::cout << indent << item.name;
      if (!item.summary.empty())
        std::cout << std::string(width - item.name.size() + 2, ' ') << item.summary;
      std::cout << '\n';
    }
  }
  if (options.json) std::cout << json.dump() << '\n';
  return ExitCode::Same;
}

}  // namespace

Verb list_verb() {
  return {"list", "List scenarios, reducers, layers and other names", &run_list,
          "Examples:\n"
          "  contactscope list scenarios\n"
          "  contactscope list sources\n"
          "  contactscope list course --format html\n"
          "Exit codes: 0 done, 2 an error."};
}

}  // namespace contactscope::app
