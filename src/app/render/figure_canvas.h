#pragma once

#include <memory>
#include <vector>

#include "app/cli/catalogue.h"
#include "app/cli/verbs.h"
#include "draw/scene/drawing.h"
#include "draw/scene/figure_style.h"
#include "draw/staging.h"
#include "image/image.h"
#include "trace/trace.h"
#include "view/view.h"

namespace contactscope::app {

/// Size and style of a picture.
struct FigureCanvas {
  Size size;
  draw::FigureStyle style;
};

/// Size from the command line, else `otherwise`. If only the width of a figure is set, its height
/// fits view, legend and panels. Throws UsageError for a size out of range.
FigureCanvas canvas_of(const trace::Header& header, const std::vector<trace::Frame>& frames,
                       const View& view, const Options& options, Size otherwise,
                       std::shared_ptr<const Words> words);

/// Replacement texts for the pictures of an input: those of --words take precedence over the
/// scenario's. Null if there are none. Throws InputError and UsageError.
std::shared_ptr<const Words> words_of(const Input& input, const Options& options);

/// Only the scenario's, as `check` uses them. Throws InputError.
std::shared_ptr<const Words> words_of(const Scenario& scenario);

/// A canvas with a view, without captions and legend, in the size of a cell.
draw::Staging stage_cell(const trace::Header& header, const std::vector<trace::Frame>& frames,
                         const View& view, const draw::Rect& cell);

/// Copies the centre of a crop to the centre of a cell.
void paste(const Image& from, const draw::Rect& part, const draw::Rect& cell, Image& to);

}  // namespace contactscope::app
