#pragma once

#include <string>
#include <string_view>

#include "image/image.h"

/// Encodes pictures for display in a terminal, with a final newline.
namespace contactscope {

/// Kitty graphics protocol, also supported by other terminals: the PNG itself, in pieces.
std::string to_kitty(std::string_view png);

/// Two pixels per character in 24-bit colours, for any modern terminal. Scales the picture to
/// `columns` by averaging pixels.
std::string to_half_blocks(const Image& image, int columns);

/// Reduces a picture to at most this width by averaging pixels.
Image shrunk(const Image& image, int width);

}  // namespace contactscope
