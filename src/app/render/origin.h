#pragma once

#include "app/cli/catalogue.h"
#include "image/picture_origin.h"

namespace contactscope::app {

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
