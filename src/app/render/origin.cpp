#include "app/render/origin.h"

#include <filesystem>

#include "app/cli/narrow.h"
#include "image/encoding.h"
#include "image/whole_file.h"
#include "view/title.h"

namespace contactscope::app {
namespace {

namespace fs = std::filesystem;

std::string hash_of_file(const std::string& path) {
  constexpr std::uintmax_t kMax = 64u << 20;
  std::error_code unknown;
  if (!fs::is_regular_file(path, unknown) || fs::file_size(path, unknown) > kMax) return "";
  try {
    const std::vector<std::uint8_t> bytes = read_whole_file(path);
    return sha256({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  } catch (const std::exception&) {
    return "";
  }
}

/// Prevents a path with a leading dash from being taken for an option.
std::string no_option(const std::string& path) {
  return path.starts_with('-') ? "./" + path : path;
}

/// Argument for a command line: the name of a scenario if it is below the root, else its path.
std::string argument_of(const Input& input, const Options& options) {
  if (input.trace || !input.file.empty())
    return input.file == "standard input" ? "-" : no_option(input.file);
  const Scenario& scenario = input.scenario;
  return is_found_by_name(scenario, options) && scenario.name[0] != '-' ? scenario.name
                                                                        : no_option(scenario.path);
}

}  // namespace

std::string for_shell(const std::string& word) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=+:,./@%";
  const bool is_plain = word.find_first_not_of(kPlain) == std::string::npos;
  if (is_plain && !word.empty() && word[0] != '=') return word;  // zsh expands "=ls" to a path
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string frames_option(const Options& options) {
  if (!options.frames) return "";
  const auto& [first, last, step] = *options.frames;
  if (last == first) return " --frames " + std::to_string(first);
  return " --frames " + std::to_string(first) + ":" + std::to_string(last) +
         (step == 1 ? "" : ":" + std::to_string(step));
}

PictureOrigin origin_of(const Input& input, const trace::Header& header, const Options& options) {
  PictureOrigin origin;
  origin.version = CONTACTSCOPE_VERSION;
  origin.scenario = input.scenario.name;
  origin.title = plain_title(header.title);
  origin.sha256 = hash_of_file(input.file.empty() ? input.scenario.path : input.file);
  origin.command = "contactscope render " + for_shell(argument_of(input, options)) + options.given;
  return origin;
}

PictureOrigin of_view(PictureOrigin origin, const View& view, bool is_one_of_several,
                      const Options& options) {
  origin.view = view.name;
  if (views_are_of_file(options))
    origin.command += " --view " + for_shell(options.view);
  else if (is_one_of_several)
    origin.command += " --view " + for_shell(view.name);
  return origin;
}

}  // namespace contactscope::app
