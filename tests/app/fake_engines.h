#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "app/program.h"

namespace contactscope::test {

/// `contactscope versus` with scripted programs as engines, in a folder on $PATH.
class FakeEngines : public testing::Test {
 protected:
  void engine(const std::string& name, const std::string& script) {
    const std::string file =
        folder_.write("contactscope-engine-" + name, "#!/bin/sh\n" + script + "\n");
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
  }
  ProgramRun versus(const std::string& arguments) {
    return run("versus --out '" + (folder_ / "out") + "' " + arguments,
               "PATH='" + folder_.path().string() + "':\"$PATH\"");
  }
  /// The entry of an engine for the first scenario.
  static nlohmann::json entry(const ProgramRun& run, const std::string& name) {
    const nlohmann::json json = nlohmann::json::parse(run.out, nullptr, false);
    if (!json.is_discarded()) {
      for (const nlohmann::json& engine : json["matches"][0]["engines"])
        if (engine["name"] == name) return engine;
    }
    ADD_FAILURE() << name << " is not in " << run.out << run.err;
    return {};
  }

  TemporaryFolder folder_;
};

}  // namespace contactscope::test
