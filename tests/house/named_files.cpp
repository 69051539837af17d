#include "house/named_files.h"

#include <algorithm>
#include <filesystem>
#include <regex>
#include <sstream>

namespace contactscope::house {
namespace {

/// Files outside the project that comments cite or that a document tells its reader to make.
const std::set<std::string> kElsewhere = {
    "GL/gl.h",     "GL/glcorearb.h", "GL/osmesa.h",
    "my.toml",     "my/crate.toml",  "btGjkEpa2.cpp",
    "GLES2/gl2.h", "EGL/egl.h",      "collision_trimesh_box.cpp",
};

/// The part of a line that is for readers; empty if there is none.
std::string words_of(const std::string& path, const std::string& line) {
  if (path.ends_with(".md")) return line;
  const bool source = path.ends_with(".h") || path.ends_with(".cpp");
  const bool hash = path.ends_with(".toml") || path.ends_with("CMakeLists.txt");
  if (!source && !hash) return {};
  const std::size_t start = line.find(source ? "//" : "#");
  if (start == std::string::npos) return {};
  const bool in_text = source && std::count(line.begin(), line.begin() + long(start), '"') % 2 == 1;
  return in_text ? std::string() : line.substr(start);
}

/// NAME.cpp and collide_A_B.cpp are placeholders for files that a reader is to write.
bool is_pattern(const std::string& name) {
  return name.find("NAME") != std::string::npos || name.find("_A_B") != std::string::npos;
}

bool names_a_file(const std::string& name, const std::set<std::string>& paths) {
  // Installed headers of adapters are below contactscope/.
  const std::string in_source =
      name.starts_with("contactscope/adapters/") ? name.substr(sizeof "contactscope") : name;
  return kElsewhere.contains(name) || is_pattern(name) ||
         std::ranges::any_of(paths, [&](const std::string& path) {
           return path == in_source || path.ends_with("/" + in_source);
         });
}

/// Target of a document's link, relative to the root; empty for places on the page and the web.
std::string target_of(const std::string& document, std::string link) {
  link = link.substr(0, link.find('#'));
  if (link.empty() || link.find("://") != std::string::npos) return {};
  return (std::filesystem::path(document).parent_path() / link).lexically_normal().generic_string();
}

/// All matches of the first group of `pattern`.
std::vector<std::string> matches(const std::string& text, const std::regex& pattern) {
  std::vector<std::string> found;
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match)
    found.push_back((*match)[1]);
  return found;
}

}  // namespace

std::vector<std::string> missing_files(const std::vector<SourceFile>& files,
                                       const std::set<std::string>& paths) {
  const std::regex file_name(
      R"(([A-Za-z0-9_][A-Za-z0-9_./-]*\.(?:md|h|cpp|toml))(?![A-Za-z0-9_]))");
  const std::regex link(R"(\]\(([^)\s]+)\))");
  std::vector<std::string> missing;
  for (const SourceFile& file : files) {
    std::istringstream lines(file.text);
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
      ++number;
      const auto miss = [&](const std::string& name) {
        missing.push_back(file.path + ":" + std::to_string(number) + ": there is no file " + name);
      };
      std::string words = words_of(file.path, line);
      if (file.path.ends_with(".md")) {
        for (const std::string& to : matches(words, link)) {
          const std::string target = target_of(file.path, to);
          if (!target.empty() && !paths.contains(target)) miss(target);
        }
        words = std::regex_replace(words, link, "]");
      }
      for (const std::string& name : matches(words, file_name))
        if (!names_a_file(name, paths)) miss(name);
    }
  }
  return missing;
}

}  // namespace contactscope::house
