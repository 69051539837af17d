#pragma once

#include <stdexcept>
#include <utility>

#include "image/compare.h"
#include "image/encoding.h"

/// PNG pictures, and the parts that APNG files share with them. PNG specification, third edition,
/// W3C 2025.
namespace contactscope {

/// Keywords (1 to 79 letters) and values (UTF-8).
using PngText = std::vector<std::pair<std::string, std::string>>;

inline constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1a\n";

/// Big-endian.
void append_be32(std::uint32_t value, Bytes& to);
void append_be16(std::uint16_t value, Bytes& to);

/// A chunk: length, four-letter type, data, checksum.
void append_chunk(std::string_view type, std::span<const std::uint8_t> data, Bytes& to);

/// Signature and header for 8 bits per channel: RGB, or RGBA if the picture has alpha.
void append_png_begin(const Image& image, Bytes& to);
/// One chunk per text: tEXt for ASCII, else iTXt.
void append_png_text(const PngText& text, Bytes& to);

/// Compressed rows of a part of a picture, unfiltered: the data of IDAT and fdAT. The box has at
/// least one pixel; `level` is that of zlib_stream().
Bytes deflated_rows(const Image& image, const PixelBox& box, int level);

/// Invalid PNG data. what() has the path.
class PngError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Encodes a PNG of 8 bits per channel, RGB, or RGBA if the picture has alpha. `level` is that of
/// zlib_stream(), 0 (stored) to 12 (smallest); level 1 takes 1 to 2.5 ms for 1280x720. The picture
/// must not be empty. Deterministic on one machine. Thread-safe.
std::vector<std::uint8_t> encode_png(const Image& image, int level = kFastestDeflate,
                                     const PngText& text = {});

/// Writes encode_png(); the file is complete or absent. Throws std::filesystem::filesystem_error.
void write_png(const std::string& path, const Image& image, int level = kFastestDeflate,
               const PngText& text = {});

/// Reads any PNG as 8-bit RGB without alpha. Throws std::filesystem::filesystem_error if the file
/// is unreadable, PngError if it is not a PNG.
Image read_png(const std::string& path);

/// Decodes bytes; `name` identifies them in a PngError.
Image decode_png(std::span<const std::uint8_t> bytes, const std::string& name);

/// Origin of a picture, embedded so that it can be reproduced: metadata in SVG and PDF, text chunks
/// in PNG.
struct PictureOrigin {
  std::string version;   // of the program, "1.2.3"
  std::string scenario;  // "hull/face_contact"
  std::string title;     // of the scenario
  int frame = 0;
  std::string frames{};  // for several frames: "0, 8, 16"; `frame` is ignored then
  std::string view;
  std::string sha256;   // sha256() of the scenario's text
  std::string command;  // "contactscope render hull/face_contact --frames 3 --format svg"
};

/// Non-empty entries as keys and values, in a fixed order. Keys are Latin letters, as PNG requires.
std::vector<std::pair<std::string, std::string>> entries_of(const PictureOrigin& origin);

// terminal.cpp: pictures for display in a terminal, with a final newline.

/// Kitty graphics protocol, also supported by other terminals: the PNG itself, in pieces.
std::string to_kitty(std::string_view png);

/// Two pixels per character in 24-bit colours, for any modern terminal. Scales the picture to
/// `columns` by averaging pixels.
std::string to_half_blocks(const Image& image, int columns);

/// Reduces a picture to at most this width by averaging pixels.
Image shrunk(const Image& image, int width);

}  // namespace contactscope
