#pragma once

#include <optional>
#include <string>
#include <vector>

#include "image/image.h"
#include "trace/json.h"
#include "versus/rollout.h"

namespace contactscope::app {

class Studio;
struct Size;

/// One scenario, as every engine steps it.
struct Rollout {
  std::string name;  // "group/idea"
  trace::Trace request;
  std::vector<versus::Contender> contenders{};
  std::vector<versus::RolloutScore> scores{};  // one a contender
};

/// Height, penetration and, where nothing falls, energy over time, a line an engine, and under them the scene of each in frame `shown` of
/// the request, or the last that it told before. Engines that step nothing are named, and not drawn.
Image rollout_picture(const Rollout& rollout, int shown, const std::optional<Size>& size,
                      Studio& studio);

}  // namespace contactscope::app
