#pragma once

#include "app/cli/catalogue.h"
#include "draw/staging.h"

namespace contactscope::app {

/// Runs and draws scenarios, compares them with snapshots, writes the report folder and returns the
/// outcome; the caller prints it. The first, middle and last frames of a trace are stored. Throws
/// InputError if there is no snapshot folder and none is to be written.
snapshot::Outcome run_check(std::vector<Input>& inputs, const Options& options);

// check.cpp

/// Parts of a picture that moved with the facts.
struct MovedLayers {
  std::vector<std::string> names;  // layers, panels and insets, in drawing order
  /// SVG in the size of the picture. Each name has groups of class "expected" and "actual", with
  /// the name as second class. Empty if nothing moved.
  std::string svg;
};

/// Compares two versions of a frame, both drawn by this program with the same camera.
MovedLayers moved_layers(const draw::Staging& staging, const trace::Frame& expected,
                         const trace::Frame& actual);

/// Folder of a check's report.
std::filesystem::path report_folder(const Options& options);

/// Findings that match the patterns, each once. Throws UsageError if a pattern matches none.
std::vector<snapshot::Finding*> findings_named(snapshot::Outcome& outcome,
                                               const std::vector<std::string>& patterns);

/// `check --accept PATTERN...`: stores candidates of the last report, without running anything.
ExitCode run_accept(const Options& options);

enum class TerminalPictures { None, HalfBlocks, Kitty };

/// Capability of the terminal on standard output, by its environment; None without a terminal.
TerminalPictures terminal_pictures();

/// Prints a finding with its details, and its pictures or their paths.
void show(const snapshot::Finding& finding, const std::string& folder, TerminalPictures how,
          std::ostream& out);

}  // namespace contactscope::app
