#pragma once

#include <string>

namespace contactscope {

/// "<group>/<idea>": the folder and the name of a scenario file.
std::string scenario_name(const std::string& path);

}  // namespace contactscope
