#include "image/picture_origin.h"

namespace contactscope {

std::vector<std::pair<std::string, std::string>> entries_of(const PictureOrigin& origin) {
  std::vector<std::pair<std::string, std::string>> entries;
  const auto add = [&](const char* key, const std::string& value) {
    if (!value.empty()) entries.emplace_back(key, value);
  };
  add("Title", origin.title);
  if (!origin.version.empty()) add("Software", "contactscope " + origin.version);
  add("Scenario", origin.scenario);
  if (origin.frames.empty())
    add("Frame", std::to_string(origin.frame));
  else
    add("Frames", origin.frames);
  add("View", origin.view);
  add("Scenario SHA-256", origin.sha256);
  add("Command", origin.command);
  return entries;
}

}  // namespace contactscope
