#include <Eigen/Core>
#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/verbs.h"
#include "image/font.h"

namespace contactscope::app {
namespace {

std::string compiler() {
#if defined(__clang__)
  return "clang " __clang_version__;
#else
  return "gcc " __VERSION__;
#endif
}

std::string eigen_version() {
  return std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
         std::to_string(EIGEN_MINOR_VERSION);
}

}  // namespace

// What each route to OpenGL answers, and what to do where one does not.
ExitCode doctor(const Options& options) {
  const std::vector<gl::RouteReport> routes = gl::probe_routes();
  const bool any = std::any_of(routes.begin(), routes.end(),
                               [](const gl::RouteReport& route) { return route.works; });
  const std::size_t font_bytes = font_data(FontWeight::Regular).size();
  if (options.json) {
    nlohmann::ordered_json json{{"version", CONTACTSCOPE_VERSION},
                                {"compiler", compiler()},
                                {"eigen", eigen_version()},
                                {"font", "Roboto, embedded"},
                                {"routes", nlohmann::ordered_json::array()}};
    for (const gl::RouteReport& route : routes) {
      nlohmann::ordered_json entry{{"route", route.route}, {"works", route.works}};
      if (route.works) {
        entry["version"] = route.version;
        entry["renderer"] = route.renderer;
      } else {
        entry["failure"] = route.failure;
      }
      json["routes"].push_back(entry);
    }
    std::cout << json.dump() << '\n';
    return any ? ExitCode::Same : ExitCode::Trouble;
  }
  std::cout << "contactscope " << CONTACTSCOPE_VERSION << "\n"
            << "  compiler  " << compiler() << "\n"
            << "  Eigen     " << eigen_version() << "\n"
            << "  font      Roboto, embedded, " << font_bytes / 1024 << " kB\n";
  for (const gl::RouteReport& route : routes) {
    if (route.works) {
      std::cout << "  ok        " << route.route << ": " << route.version << ", " << route.renderer
                << "\n";
    } else {
      std::cout << "  no        " << route.route << ": " << route.failure << "\n";
    }
  }
  std::cout
      << (any ? "Pictures can be rendered.\n"
              : "No route to OpenGL works, so nothing can be rendered; `trace` needs none.\n");
  return any ? ExitCode::Same : ExitCode::Trouble;
}

}  // namespace contactscope::app
