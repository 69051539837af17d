#pragma once

#include "app/catalogue.h"
#include "app/formats/sinks.h"
#include "app/progress.h"
#include "app/studio.h"

namespace contactscope::app {

/// Whether `render` was asked for one picture of many cells: --strip or --sheet. Throws UsageError where
/// options or formats do not go together.
bool wants_cells(const Options& options, const std::vector<const Format*>& formats);

/// So many of these frames, evenly, the first and the last among them.
std::vector<int> evenly(const std::vector<int>& frames, int count);

/// --strip: of each view of a scene one picture, OUT/GROUP/IDEA/[VIEW/]strip.EXTENSION.
void draw_strips(const Input& input, Sequence& sequence, const PictureOrigin& origin,
                 const std::shared_ptr<const Words>& words, const Options& options, Studio& studio,
                 Sinks& sinks);

/// --sheet: the first stored frame of each, as OUT/GROUP/sheet.EXTENSION, or OUT/sheet.EXTENSION of
/// several groups. `run`: makes the sequence of one.
void draw_sheet(std::vector<Input>& inputs, const std::function<Sequence(Input&)>& run,
                const Options& options, Studio& studio, Sinks& sinks, Progress& progress);

}  // namespace contactscope::app
