#pragma once

#include <string>
#include <vector>

#include "app/cli/catalogue.h"
#include "draw/staging.h"
#include "snapshot/finding.h"
#include "trace/trace.h"

namespace contactscope::app {

/// Runs and draws scenarios, compares them with snapshots, writes the report folder and returns the
/// outcome; the caller prints it. The first, middle and last frames of a trace are stored. Throws
/// InputError if there is no snapshot folder and none is to be written.
snapshot::Outcome run_check(std::vector<Input>& inputs, const Options& options);

// moved_layers.cpp

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

}  // namespace contactscope::app
