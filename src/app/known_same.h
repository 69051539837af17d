#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "app/catalogue.h"
#include "snapshot/finding.h"

namespace contactscope::app {

/// Which scenarios were the same in an earlier run with the same --out, and of what content: the scenario's file and
/// those that it names, all that is stored of it, this program, and the driver. Where all of it is as it
/// was, running it again would find nothing.
class KnownSame {
 public:
  /// Reads what the report in `folder` knows. `surroundings`: all that is not of one scenario.
  KnownSame(const std::filesystem::path& folder, std::string surroundings);

  /// What came of it then; nothing where anything changed since.
  std::optional<snapshot::ScenarioOutcome> find(const std::string& scenario,
                                                const std::string& content) const;
  /// After a run of it.
  void add(const snapshot::ScenarioOutcome& outcome, const std::string& content);

  /// For known_same.json, with those that were not asked for in this run.
  std::string text() const;

 private:
  struct Entry {
    std::string content;
    int frames = 0, pictures = 0;
    std::vector<std::string> notes{}, brittle{};
  };
  std::string surroundings_;
  std::map<std::string, Entry> entries_;
};

/// Hashes of what each scenario is made of, in their order; on several threads.
std::vector<std::string> contents_of(const std::vector<Input>& inputs,
                                     const std::filesystem::path& snapshots);

}  // namespace contactscope::app
