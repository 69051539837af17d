#pragma once

#include <map>
#include <string>
#include <vector>

#include "app/cli/verbs.h"
#include "image/image.h"
#include "trace/json.h"
#include "versus/rollout.h"

namespace contactscope::app {

/// `versus --rollout`: each engine steps the scenarios itself. Prints a table and draws a picture
/// per scenario, or prints JSON. `programs` are by engine name, without this program.
ExitCode run_rollout(const Options& options, const std::vector<std::string>& engines,
                     const std::map<std::string, std::string>& programs);

class Renderer;

/// One scenario stepped by every engine.
struct Rollout {
  std::string name;  // "group/idea"
  trace::Trace request;
  std::vector<versus::EngineRun> engine_runs{};
  std::vector<versus::RolloutScore> scores{};  // one per engine
};

/// Height, penetration and, if nothing falls, energy over time with a line per engine, above each
/// engine's scene at frame `shown` or its last before. Engines without frames are only named.
Image rollout_picture(const Rollout& rollout, int shown, const std::optional<Size>& size,
                      Renderer& renderer);

}  // namespace contactscope::app
