#pragma once

#include "app/cli/catalogue.h"
#include "draw/staging.h"
#include "image/png.h"

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

/// Origin metadata of the pictures of a scenario or trace, without frame and format. It has a hash
/// of the current file, except for standard input and traces larger than 64 MB.
PictureOrigin origin_of(const Input& input, const trace::Header& header, const Options& options);

/// Origin of one view. `is_one_of_several`: the command must name the view.
PictureOrigin of_view(PictureOrigin origin, const View& view, bool is_one_of_several,
                      const Options& options);

/// " --frames 0:23:4" if given, else empty.
std::string frames_option(const Options& options);

/// Quotes a word for a shell if necessary.
std::string for_shell(const std::string& word);

}  // namespace contactscope::app
