#include <iostream>
#include <nlohmann/json.hpp>

#include "app/cli/faults.h"

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

/// One-line summary of a valid scenario; an invalid one has thrown InputError.
std::string looked_through(const Scenario& scenario) {
  return scenario.path + ": scenario " + scenario.name + ", frames " +
         std::to_string(scenario.frames) + ", shapes " + std::to_string(scenario.shapes.size()) +
         ", pairs " + std::to_string(scenario.pairs.size());
}

/// Counts the contents of a trace's frames.
class Inventory {
 public:
  void add(const trace::Frame& frame) {
    ++frames_;
    found_["solver"] += frame.solver.has_value();
    for (const trace::Pair& pair : frame.pairs) {
      found_["manifolds"] += static_cast<int>(pair.manifolds.size());
      trace::each_field<trace::Pair>([&](const auto& field) {
        if constexpr (requires { (pair.*field.member).has_value(); })
          if ((pair.*field.member).has_value()) ++found_[field.key];
      });
    }
  }

  std::string words(const trace::Header& header) const {
    std::string text = "trace of " + header.scenario + ", frames " + std::to_string(frames_) +
                       ", shapes " + std::to_string(header.shapes.size());
    for (const auto& [what, count] : found_)
      if (count > 0) text += ", " + what + " " + std::to_string(count);
    return text;
  }

 private:
  int frames_ = 0;
  std::map<std::string, int> found_;
};

// Probes each OpenGL backend, with a remedy if it fails, and validates files.
ExitCode run_doctor(const Options& options) {
  std::vector<std::string> files, wrong;
  nlohmann::ordered_json findings = nlohmann::ordered_json::array();
  const auto look_through = [&](TraceFile& file) {
    Inventory inventory;
    const auto found = lint_trace(file, {}, options.frames,
                                  [&](const trace::Frame& frame) { inventory.add(frame); });
    files.push_back(inventory.words(file.header()));
    for (const lint::Finding& finding : found) {
      if (!lint::is_reported(finding)) continue;
      wrong.push_back(record(file.name(), finding));
      findings.push_back(to_json(finding));
    }
  };
  // Scenarios are not run, only parsed.
  each_input(
      options, [&](const Input& input) { files.push_back(looked_through(input.scenario)); },
      look_through);
  const std::vector<gl::RouteReport> routes = gl::probe_routes();
  const bool any = std::ranges::any_of(routes, &gl::RouteReport::works);
  const std::size_t font_bytes = font_data(FontWeight::Regular).size();
  const ExitCode code =
      !any ? ExitCode::Trouble : (wrong.empty() ? ExitCode::Same : ExitCode::Different);
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
    if (!files.empty()) json["files"] = files;
    if (!findings.empty()) json["findings"] = findings;
    std::cout << json.dump() << '\n';
    return code;
  }
  for (const std::string& one : wrong) std::cout << one << '\n';
  if (options.quiet && any) return code;
  for (const std::string& file : files)
    std::cout << (wrong.empty() ? "ok  " : "read  ") << file << '\n';
  std::cout << "contactscope " << CONTACTSCOPE_VERSION << "\n"
            << "  compiler  " << compiler() << "\n"
            << "  Eigen     " << eigen_version() << "\n"
            << "  font      Roboto, embedded, " << font_bytes / 1024 << " kB\n";
  for (const gl::RouteReport& route : routes) {
    std::cout << (route.works ? "  ok        " : "  no        ") << route.route << ": "
              << (route.works ? route.version + ", " + route.renderer : route.failure) << '\n';
  }
  std::cout << (any ? "Pictures can be rendered.\n"
                    : "No OpenGL backend works, so nothing can be rendered; `trace` needs none.\n");
  return code;
}

}  // namespace

Verb doctor_verb() {
  return {"doctor", "Test each OpenGL backend, and inspect scenarios and traces", &run_doctor};
}

}  // namespace contactscope::app
