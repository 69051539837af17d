#include "house/include_order.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string_view>

namespace contactscope::house {
namespace {

struct Folder {
  std::string_view name;
  std::string_view parent;  // "src" or "render"
};

// In the order of src/README.md: a folder uses only folders before it.
constexpr Folder kOrder[] = {
    {"recorder", "src"},   {"core", "src"},        {"view", "src"},      {"trace", "src"},
    {"geometry", "src"},   {"query", "src"},       {"field", "src"},     {"broadphase", "src"},
    {"continuous", "src"}, {"reduce", "src"},      {"manifold", "src"},  {"lint", "src"},
    {"versus", "src"},     {"dynamics", "src"},    {"scenario", "src"},  {"find", "src"},
    {"shrink", "src"},     {"study", "src"},       {"image", "render"},  {"draw", "render"},
    {"gl", "render"},      {"overlay", "render"},  {"vector", "render"}, {"page", "render"},
    {"viewer", "render"},  {"snapshot", "render"}, {"app", "src"},       {"package", "src"},
    {"adapters", "src"},
};

/// The levels of a folder, and the levels that each may use. Other files are the top.
struct Floor {
  std::string_view folder;
  std::string_view name;
  std::array<std::string_view, 4> uses;
};
// The table of options, in cli, lists the picture formats of render.
constexpr Floor kFloors[] = {
    {"draw", "scene", {"scene"}},
    {"draw", "layers", {"scene", "layers"}},
    {"draw", "charts", {"scene", "charts"}},
    {"draw", "insets", {"scene", "charts", "insets"}},
    {"app", "cli", {"cli", "render"}},
    {"app", "render", {"cli", "render"}},
    {"app", "check", {"cli", "render", "check"}},
    {"app", "compare", {"cli", "render", "check", "compare"}},
};

/// All layers include this; they do not include each other.
constexpr std::string_view kLayer = "draw/layers/layer.h";

const Folder* find_folder(std::string_view name) {
  const Folder* found = std::find_if(std::begin(kOrder), std::end(kOrder),
                                     [&](const Folder& folder) { return folder.name == name; });
  return found == std::end(kOrder) ? nullptr : found;
}

bool may_use(const Folder& user, const Folder& used) {
  if (user.name == used.name) return true;
  if (&used > &user) return false;
  if (user.name == "adapters") return used.name == "recorder";  // a user of one copies these two
  if (used.parent == "src" && user.name == "image") return false;
  if (used.parent == "src" && user.name == "draw") {
    return used.name == "core" || used.name == "view" || used.name == "trace";
  }
  return true;
}

const Floor* find_floor(std::string_view folder, std::string_view name) {
  const Floor* found = std::ranges::find_if(
      kFloors, [&](const Floor& floor) { return floor.folder == folder && floor.name == name; });
  return found == std::end(kFloors) ? nullptr : found;
}

std::vector<std::string> components(const std::string& path) {
  std::vector<std::string> parts;
  std::istringstream stream(path);
  for (std::string part; std::getline(stream, part, '/');) parts.push_back(part);
  return parts;
}

/// The folder of "src/core/pose.h"; null, with the reason in `why`, if it is in none.
const Folder* folder_of(const std::string& path, std::string& why) {
  const std::vector<std::string> parts = components(path);
  if (parts.size() < 3) {
    why = path + ": lies in no folder";
    return nullptr;
  }
  const Folder* folder = find_folder(parts[1]);
  if (!folder || folder->parent != parts[0]) {
    why = path + ": " + parts[0] + "/" + parts[1] + " is no folder of the house";
    return nullptr;
  }
  return folder;
}

constexpr std::string_view kBlank = " \t";

/// Removes `word`, and blanks before it, from the front of `text`.
bool take(std::string_view& text, std::string_view word) {
  const std::size_t start = text.find_first_not_of(kBlank);
  if (start == std::string_view::npos || !text.substr(start).starts_with(word)) return false;
  text.remove_prefix(start + word.size());
  return true;
}

/// NAME of a line `#include "NAME"`; empty for any other line.
std::string included_by(std::string_view line) {
  if (!take(line, "#") || !take(line, "include") || !take(line, "\"")) return {};
  return std::string(line.substr(0, line.find('"')));
}

std::string without_comments(const std::string& text) {
  std::string kept;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) kept += line.substr(0, line.find('#')) + "\n";
  return kept;
}

/// Checks one call: `words` are the name of the folder and its arguments.
void check_links(const std::string& path, std::istringstream words,
                 std::vector<std::string>& violations) {
  std::string name;
  words >> name;
  const Folder* folder = find_folder(name);
  if (!folder) {
    violations.push_back(path + ": " + name + " is no folder of the house");
    return;
  }
  bool linking = false;
  for (std::string word; words >> word;) {
    if (word == "SOURCES") linking = false;
    if (word == "LINK" || word == "PRIVATE_LINK") linking = true;
    constexpr std::string_view kOurs = "contactscope::";
    const bool ours = linking && word.starts_with(kOurs);
    const Folder* used = ours ? find_folder(std::string_view(word).substr(kOurs.size())) : nullptr;
    if (used && !may_use(*folder, *used)) {
      violations.push_back(path + ": " + name + " must not link " + std::string(used->name));
    }
  }
}

/// The violation of an include within a folder with levels; empty if there is none.
std::string floor_violation(std::string_view folder, const std::string& path,
                            const std::string& included) {
  const Floor* user = find_floor(folder, components(path)[2]);
  if (user == nullptr) return {};
  const Floor* used = find_floor(folder, components(included)[1]);
  const std::string name(user->name);
  if (used == nullptr) return name + " must not use the top of " + std::string(folder);
  if (std::ranges::find(user->uses, used->name) == user->uses.end())
    return name + " must not use " + std::string(used->name);
  if (user->name == "layers" && used == user && included != kLayer)
    return "layers must not use each other";
  return {};
}

bool is_source(const std::string& path) { return path.ends_with(".h") || path.ends_with(".cpp"); }

void check_include(const SourceFile& file, int line, const std::string& included,
                   const Folder& folder, const std::set<std::string>& known,
                   std::vector<std::string>& violations) {
  const std::string where = file.path + ":" + std::to_string(line) + ": ";
  // The compiler looks in the including file's folder first, then in src and render.
  const std::string next_to = (std::filesystem::path(file.path).parent_path() / included)
                                  .lexically_normal()
                                  .generic_string();
  if (known.contains(next_to)) {
    std::string why;
    const Folder* used = folder_of(next_to, why);
    if (used && !may_use(folder, *used))
      violations.push_back(where + std::string(folder.name) + " must not use " +
                           std::string(used->name));
    return;
  }
  if (!known.contains("src/" + included) && !known.contains("render/" + included)) {
    violations.push_back(where + "\"" + included + "\" is no file of src or render");
    return;
  }
  const Folder* used = find_folder(components(included).front());
  if (used && !may_use(folder, *used)) {
    violations.push_back(where + std::string(folder.name) + " must not use " +
                         std::string(used->name));
  }
  if (used == &folder) {
    const std::string why = floor_violation(folder.name, file.path, included);
    if (!why.empty()) violations.push_back(where + why);
  }
}

}  // namespace

std::vector<std::string> include_violations(const std::vector<SourceFile>& files) {
  std::set<std::string> known;
  for (const SourceFile& file : files) known.insert(file.path);

  std::vector<std::string> violations;
  for (const SourceFile& file : files) {
    std::string why;
    const Folder* folder = folder_of(file.path, why);
    if (!folder) {
      // src/CMakeLists.txt and the like connect the folders.
      if (is_source(file.path) || components(file.path).size() > 2) violations.push_back(why);
      continue;
    }
    if (!is_source(file.path)) continue;
    std::istringstream lines(file.text);
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
      ++number;
      const std::string included = included_by(line);
      if (!included.empty()) check_include(file, number, included, *folder, known, violations);
    }
  }
  return violations;
}

std::vector<std::string> link_violations(const std::vector<SourceFile>& files) {
  constexpr std::string_view kCall = "contactscope_folder(";
  std::vector<std::string> violations;
  for (const SourceFile& file : files) {
    if (!file.path.ends_with("CMakeLists.txt")) continue;
    const std::string text = without_comments(file.text);
    for (std::size_t at = text.find(kCall); at != std::string::npos; at = text.find(kCall, at)) {
      at += kCall.size();
      check_links(file.path, std::istringstream(text.substr(at, text.find(')', at) - at)),
                  violations);
    }
  }
  return violations;
}

std::vector<SourceFile> read_house(const std::string& root) {
  namespace fs = std::filesystem;
  std::vector<SourceFile> files;
  for (const char* top : {"src", "render"}) {
    for (const fs::directory_entry& entry :
         fs::recursive_directory_iterator(fs::path(root) / top)) {
      if (!entry.is_regular_file()) continue;
      std::ifstream stream(entry.path(), std::ios::binary);
      std::ostringstream text;
      text << stream.rdbuf();
      files.push_back({fs::relative(entry.path(), root).generic_string(), text.str()});
    }
  }
  std::sort(files.begin(), files.end(),
            [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
  return files;
}

}  // namespace contactscope::house
