#pragma once

#include <string>

namespace contactscope {

/// "<group>/<idea>": the folder that a scenario file is in, and the file.
std::string scenario_name(const std::string& path);

}  // namespace contactscope
