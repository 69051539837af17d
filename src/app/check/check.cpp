#include <iostream>

#include "app/check/check_run.h"
#include "app/check/reports/report.h"
#include "app/cli/progress.h"
#include "vector/svg.h"

namespace contactscope::app {
namespace {

ExitCode run_check_verb(const Options& options) {
  note_interrupts();
  if (options.accept) return run_accept(options);
  std::vector<Input> inputs = load_inputs(options, Hold::Sample, Unreadable::Kept);
  if (options.update != snapshot::Update::None && snapshot::is_ci(std::getenv("CI")))
    std::cerr << "CI=true: nothing is written; unset CI to store snapshots\n";
  const snapshot::Outcome outcome = [&] {
    try {
      return run_check(inputs, options);
    } catch (const gl::ContextError& error) {
      throw gl::ContextError(std::string(error.what()) +
                             "\nor compare only traces and expectations, without OpenGL: "
                             "contactscope check --facts-only");
    }
  }();
  write_reports({outcome, report_folder(options), options});
  return exit_code(outcome);
}

using Parts = std::vector<std::pair<std::string, std::string>>;  // layer name and its SVG

/// Splits an SVG of a drawing by layer; separate groups of one layer are joined.
Parts parts_of(const std::string& svg) {
  constexpr std::string_view kBegin = "<g id=\"";
  Parts parts;
  for (std::size_t at = svg.find(kBegin); at != std::string::npos;) {
    const std::size_t next = svg.find(kBegin, at + 1);
    const std::size_t begin = at + kBegin.size();
    std::string name = svg.substr(begin, svg.find('"', begin) - begin);
    while (!name.empty() && std::isdigit(static_cast<unsigned char>(name.back())) != 0)
      name.pop_back();
    if (name.ends_with('-')) name.pop_back();
    auto part = std::ranges::find(parts, name, &Parts::value_type::first);
    if (part == parts.end()) part = parts.insert(parts.end(), {name, {}});
    const std::size_t end = next == std::string::npos ? svg.rfind("</svg>") : next;
    const std::size_t rest = svg.find('"', begin) + 1;  // drops the id of the whole drawing
    part->second += "<g" + svg.substr(rest, end - rest);
    at = next;
  }
  return parts;
}

/// SVG of a layer; empty if the drawing does not have it.
std::string part_of(const Parts& parts, const std::string& name) {
  const auto part = std::ranges::find(parts, name, &Parts::value_type::first);
  return part == parts.end() ? "" : part->second;
}

std::string group(const std::string& version, const std::string& name, const std::string& part) {
  return "<g class=\"" + version + " " + name + "\">\n" + part + "</g>\n";
}

}  // namespace

Verb check_verb() { return {"check", "Compare with the stored snapshots", &run_check_verb}; }

MovedLayers moved_layers(const draw::Staging& staging, const trace::Frame& expected,
                         const trace::Frame& actual) {
  vector::SvgOptions options;
  options.embed_font = false;
  const Parts before = parts_of(vector::svg_of(draw::illustrate(staging, expected), options));
  const std::string svg = vector::svg_of(draw::illustrate(staging, actual), options);
  const Parts now = parts_of(svg);
  MovedLayers moved;
  for (const auto& [name, text] : now)
    if (part_of(before, name) != text) moved.names.push_back(name);
  for (const auto& [name, text] : before)
    if (part_of(now, name).empty()) moved.names.push_back(name);
  if (moved.names.empty()) return moved;
  moved.svg = svg.substr(0, svg.find('>') + 1) + "\n";
  for (const std::string& name : moved.names)
    moved.svg +=
        group("expected", name, part_of(before, name)) + group("actual", name, part_of(now, name));
  moved.svg += "</svg>\n";
  return moved;
}

}  // namespace contactscope::app
