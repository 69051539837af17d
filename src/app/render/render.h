#pragma once

#include "app/cli/catalogue.h"
#include "app/cli/progress.h"
#include "app/render/formats/sinks.h"
#include "app/render/renderer.h"

namespace contactscope::app {

/// True if `render` makes one picture of many cells: --strip or --sheet. Throws UsageError for a
/// conflict of options or formats.
bool wants_cells(const Options& options, const std::vector<const Format*>& formats);

/// `count` evenly spaced frames, including the first and the last.
std::vector<int> evenly(const std::vector<int>& frames, int count);

/// --strip: one picture per view, OUT/GROUP/IDEA/[VIEW/]strip.EXTENSION.
void draw_strips(const Input& input, Sequence& sequence, const PictureOrigin& origin,
                 const std::shared_ptr<const Words>& words, const Options& options,
                 Renderer& renderer, Sinks& sinks);

/// --sheet: the first stored frame of each input, as OUT/GROUP/sheet.EXTENSION, or
/// OUT/sheet.EXTENSION for several groups. `run` makes the sequence of an input.
void draw_sheet(std::vector<Input>& inputs, const std::function<Sequence(Input&)>& run,
                const Options& options, Renderer& renderer, Sinks& sinks, Progress& progress);

}  // namespace contactscope::app
