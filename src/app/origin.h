#pragma once

#include "app/catalogue.h"
#include "image/picture_origin.h"

namespace contactscope::app {

/// What the pictures of a scenario or trace say of where they come from; their frame and format come with
/// each. The hash is of the file as it is now; of the standard input and of traces beyond 64 MB there is
/// none.
PictureOrigin origin_of(const Input& input, const trace::Header& header, const Options& options);

/// The same for one of its views. `is_one_of_several`: the command has to name it.
PictureOrigin of_view(PictureOrigin origin, const View& view, bool is_one_of_several,
                      const Options& options);

/// " --frames 0:23:4" where that was given; else nothing.
std::string frames_option(const Options& options);

/// A word as a shell takes it: in quotes where it needs some.
std::string for_shell(const std::string& word);

}  // namespace contactscope::app
