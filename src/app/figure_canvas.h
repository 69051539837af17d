#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/catalogue.h"
#include "app/verbs.h"
#include "core/view.h"
#include "draw/scene/figure_style.h"
#include "trace/trace.h"

namespace contactscope::app {

/// How large a picture of a view is, and its style.
struct FigureCanvas {
  Size size;
  draw::FigureStyle style;
};

/// As the command line says; else `otherwise`. Of a figure whose width alone is told the height is what
/// its view, legend and panels need. Throws UsageError where no canvas is so large or so small.
FigureCanvas canvas_of(const trace::Header& header, const std::vector<trace::Frame>& frames,
                       const View& view, const Options& options, Size otherwise,
                       std::shared_ptr<const Words> words);

/// What stands in place of the words in pictures of an input: those of --words before those of the
/// scenario itself. Null where both say nothing. Throws InputError and UsageError.
std::shared_ptr<const Words> words_of(const Input& input, const Options& options);

/// Those of the scenario alone, as `check` has its pictures. Throws InputError.
std::shared_ptr<const Words> words_of(const Scenario& scenario);

}  // namespace contactscope::app
