#include "image/png.h"

#include <libdeflate.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <memory>

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#include <stb/stb_image.h>

namespace contactscope {
namespace {

bool has_signature(std::span<const std::uint8_t> bytes) {
  return bytes.size() >= kPngSignature.size() &&
         std::equal(kPngSignature.begin(), kPngSignature.end(), bytes.begin(),
                    [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
}

bool is_plain(const std::string& text) {
  return std::ranges::all_of(text, [](char c) { return c == '\n' || (c >= ' ' && c <= '~'); });
}

void append(std::string_view text, Bytes& to) { to.insert(to.end(), text.begin(), text.end()); }

}  // namespace

std::vector<std::uint8_t> encode_png(const Image& image, int level, const PngText& text) {
  assert(image.width > 0 && image.height > 0 && level >= 0 && level <= 12);
  Bytes png;
  append_png_begin(image, png);
  append_png_text(text, png);  // before the pixels, where `head -c` and viewers find it
  append_chunk("IDAT", deflated_rows(image, {0, 0, image.width, image.height}, level), png);
  append_chunk("IEND", {}, png);
  return png;
}

void write_png(const std::string& path, const Image& image, int level, const PngText& text) {
  write_whole_file(path, encode_png(image, level, text));
}

Image decode_png(std::span<const std::uint8_t> bytes, const std::string& name) {
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw PngError(name + ": cannot be read as a PNG: larger than 2 GB");
  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<unsigned char, void (*)(void*)> pixels(
      stbi_load_from_memory(bytes.data(), static_cast<int>(bytes.size()), &width, &height,
                            &channels, 3),
      stbi_image_free);
  if (!pixels) {
    throw PngError(name + ": cannot be read as a PNG: " +
                   (has_signature(bytes) ? "it is cut off or damaged" : "it is not one"));
  }
  Image image(width, height);
  image.rgb.assign(pixels.get(), pixels.get() + image.rgb.size());
  return image;
}

Image read_png(const std::string& path) { return decode_png(read_whole_file(path), path); }

void append_be32(std::uint32_t value, Bytes& to) {
  for (const int shift : {24, 16, 8, 0}) to.push_back(static_cast<std::uint8_t>(value >> shift));
}

void append_be16(std::uint16_t value, Bytes& to) {
  to.push_back(static_cast<std::uint8_t>(value >> 8));
  to.push_back(static_cast<std::uint8_t>(value));
}

void append_chunk(std::string_view type, std::span<const std::uint8_t> data, Bytes& to) {
  assert(type.size() == 4);
  append_be32(static_cast<std::uint32_t>(data.size()), to);
  const std::size_t begin = to.size();
  append(type, to);
  to.insert(to.end(), data.begin(), data.end());
  append_be32(libdeflate_crc32(0, to.data() + begin, to.size() - begin), to);
}

void append_png_begin(const Image& image, Bytes& to) {
  constexpr std::uint8_t kRgb = 2, kRgba = 6;
  append(kPngSignature, to);
  Bytes header;
  append_be32(static_cast<std::uint32_t>(image.width), header);
  append_be32(static_cast<std::uint32_t>(image.height), header);
  // Bits per channel, colour type, compression, filter method, not interlaced.
  for (const std::uint8_t byte : {std::uint8_t{8}, image.alpha.empty() ? kRgb : kRgba,
                                  std::uint8_t{0}, std::uint8_t{0}, std::uint8_t{0}})
    header.push_back(byte);
  append_chunk("IHDR", header, to);
}

void append_png_text(const PngText& text, Bytes& to) {
  for (const auto& [key, value] : text) {
    assert(!key.empty() && key.size() < 80 && is_plain(key));
    Bytes data;
    append(key, data);
    data.push_back(0);
    // Not compressed, no language, no translated keyword.
    if (!is_plain(value)) data.insert(data.end(), 4, 0);
    append(value, data);
    append_chunk(is_plain(value) ? "tEXt" : "iTXt", data, to);
  }
}

Bytes deflated_rows(const Image& image, const PixelBox& box, int level) {
  assert(box.right > box.left && box.bottom > box.top && level >= 0 && level <= 12);
  const auto index = [](int n) { return static_cast<std::size_t>(n); };
  const std::size_t channels = image.alpha.empty() ? 3 : 4;
  const std::size_t width = index(box.right - box.left), row = 1 + channels * width;
  // Flat areas and thin lines compress as well unfiltered, twice as fast. The buffer of some
  // megabytes is written once, so it is not cleared before.
  const std::size_t size = row * index(box.bottom - box.top);
  const auto rows = std::make_unique_for_overwrite<std::uint8_t[]>(size);
  for (int y = box.top; y < box.bottom; ++y) {
    const std::size_t first = index(y) * index(image.width) + index(box.left);
    const std::uint8_t* rgb = image.rgb.data() + 3 * first;
    std::uint8_t* to = rows.get() + index(y - box.top) * row;
    *to++ = 0;  // no filter
    if (channels == 3) {
      std::copy_n(rgb, 3 * width, to);
      continue;
    }
    for (std::size_t x = 0; x < width; ++x, rgb += 3, to += 4) {
      std::copy_n(rgb, 3, to);
      to[3] = image.alpha[first + x];
    }
  }
  return zlib_stream({rows.get(), size}, level);
}

std::vector<std::pair<std::string, std::string>> entries_of(const PictureOrigin& origin) {
  std::vector<std::pair<std::string, std::string>> entries;
  const auto add = [&](const char* key, const std::string& value) {
    if (!value.empty()) entries.emplace_back(key, value);
  };
  add("Title", origin.title);
  if (!origin.version.empty()) add("Software", "contactscope " + origin.version);
  add("Scenario", origin.scenario);
  if (origin.frames.empty())
    add("Frame", std::to_string(origin.frame));
  else
    add("Frames", origin.frames);
  add("View", origin.view);
  add("Scenario SHA-256", origin.sha256);
  add("Command", origin.command);
  return entries;
}

}  // namespace contactscope
