#pragma once

#include <string>
#include <string_view>

#include "image/image.h"

/// A picture as text that a terminal turns back into one, with the line's end.
namespace contactscope {

/// The graphics protocol of kitty, which others know too: the PNG itself, in pieces.
std::string to_kitty(std::string_view png);

/// Sixel graphics, DEC STD 070 of 1990: 216 colours, six rows at a time.
std::string to_sixel(const Image& image);

/// Two pixels a character, in 24-bit colours: what every terminal of today can. The picture is made as wide as
/// `columns`, each pixel the mean of those that it stands for.
std::string to_half_blocks(const Image& image, int columns);

/// A picture of at most this width, each pixel the mean of those that it stands for; a smaller one as it is.
Image shrunk(const Image& image, int width);

}  // namespace contactscope
