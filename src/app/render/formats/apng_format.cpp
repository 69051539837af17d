#include "app/render/formats/format.h"
#include "image/apng.h"

namespace contactscope::app {

const Format kApngFormat{
    .name = "apng",
    .extension = ".apng",
    .what = "an animated PNG, one file per sequence",
    .needs_pixels = true,
    .begin =
        [](const ReelPlan& plan) {
          return reel_of(plan, std::make_unique<EncodedAnimation<ApngEncoder, PngText>>(
                                   plan, entries_of(plan.origin)));
        },
};

}  // namespace contactscope::app
