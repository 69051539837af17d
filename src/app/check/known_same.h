#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "app/cli/catalogue.h"
#include "snapshot/finding.h"

namespace contactscope::app {

/// Cache of scenarios that matched in an earlier run with the same --out, keyed by content: the
/// scenario's file with the files it names, its snapshots, this program, and the driver. If none of
/// them changed, a new run would find nothing.
class KnownSame {
 public:
  /// Reads the cache of the report in `folder`. `surroundings` is the content common to all.
  KnownSame(const std::filesystem::path& folder, std::string surroundings);

  /// Earlier outcome; nullopt if anything changed since.
  std::optional<snapshot::ScenarioOutcome> find(const std::string& scenario,
                                                const std::string& content) const;
  /// Stores the outcome of a run.
  void add(const snapshot::ScenarioOutcome& outcome, const std::string& content);

  /// Text of known_same.json, including scenarios that were not part of this run.
  std::string text() const;

 private:
  struct Entry {
    std::string content;
    snapshot::ScenarioOutcome outcome;

    static constexpr auto fields() {
      using namespace trace::field;
      return list(exact("content", &Entry::content), merged(&Entry::outcome));
    }
  };
  struct File {
    std::string surroundings;
    std::map<std::string, Entry> scenarios{};

    static constexpr auto fields() {
      using namespace trace::field;
      return list(exact("surroundings", &File::surroundings), exact("scenarios", &File::scenarios));
    }
  };
  File file_;
};

/// Identifies this build by 64 hexadecimal digits: a hash of the linker's build id, or without one
/// of the program file; empty if neither is available. Hashing the file of a sanitized build takes
/// ten seconds, reading the build id almost none.
std::string program_id();

/// Content hashes of scenarios, in order; computed on several threads.
std::vector<std::string> contents_of(const std::vector<Input>& inputs,
                                     const std::filesystem::path& snapshots);

}  // namespace contactscope::app
