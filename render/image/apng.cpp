#include "image/apng.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstring>

// PNG specification, third edition, W3C 2025, section 11.3.6: acTL before the pixels has the number
// of pictures. Each picture has an fcTL, and pixels in an IDAT (the first) or an fdAT.
namespace contactscope {
namespace {

constexpr std::uint8_t kLeaveInPlace = 0, kOverwrite = 0;  // dispose_op, blend_op

std::size_t pixel_at(const Image& image, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
         static_cast<std::size_t>(x);
}

}  // namespace

PixelBox changed_box(const Image& before, const Image& after) {
  assert(before.width == after.width && before.height == after.height);
  const auto differ = [&](int x, int y) {
    const std::size_t p = pixel_at(after, x, y);
    return std::memcmp(&before.rgb[3 * p], &after.rgb[3 * p], 3) != 0 ||
           (!after.alpha.empty() && before.alpha[p] != after.alpha[p]);
  };
  PixelBox box{after.width, after.height, 0, 0};
  const std::size_t row = 3 * static_cast<std::size_t>(after.width);
  for (int y = 0; y < after.height; ++y) {
    const std::size_t p = pixel_at(after, 0, y);
    if (after.alpha.empty() && std::memcmp(&before.rgb[3 * p], &after.rgb[3 * p], row) == 0)
      continue;
    // Search from both ends.
    int left = 0, right = after.width;
    while (left < right && !differ(left, y)) ++left;
    if (left == right) continue;
    while (!differ(right - 1, y)) --right;
    box = {std::min(box.left, left), std::min(box.top, y), std::max(box.right, right), y + 1};
  }
  return box.right == 0 ? PixelBox{0, 0, 1, 1} : box;
}

void ApngEncoder::append_control(const PixelBox& box, int milliseconds) {
  Bytes control;
  append_be32(numbers_++, control);
  for (const int number : {box.right - box.left, box.bottom - box.top, box.left, box.top})
    append_be32(static_cast<std::uint32_t>(number), control);
  // The delay is a fraction of two 16-bit numbers: in whole seconds if it is over 65 s.
  const bool is_long = milliseconds > 0xFFFF;
  append_be16(
      static_cast<std::uint16_t>(std::min(is_long ? milliseconds / 1000 : milliseconds, 0xFFFF)),
      control);
  append_be16(is_long ? 1 : 1000, control);
  control.push_back(kLeaveInPlace);
  control.push_back(kOverwrite);
  append_chunk("fcTL", control, body_);
}

void ApngEncoder::add(const Image& image, int milliseconds) {
  if (frames_++ == 0) {
    const PixelBox all{0, 0, image.width, image.height};
    append_png_begin(image, begin_);
    append_control(all, milliseconds);
    append_chunk("IDAT", deflated_rows(image, all, level_), body_);
  } else {
    const PixelBox box = changed_box(last_, image);
    append_control(box, milliseconds);
    Bytes data;
    append_be32(numbers_++, data);
    const Bytes pixels = deflated_rows(image, box, level_);
    data.insert(data.end(), pixels.begin(), pixels.end());
    append_chunk("fdAT", data, body_);
  }
  last_ = image;
}

Bytes ApngEncoder::finish(const PngText& text) const {
  assert(frames_ > 0);
  Bytes file = begin_;
  Bytes animation;
  append_be32(frames_, animation);
  append_be32(0, animation);  // plays: endless
  append_chunk("acTL", animation, file);
  append_png_text(text, file);
  file.insert(file.end(), body_.begin(), body_.end());
  append_chunk("IEND", {}, file);
  return file;
}

}  // namespace contactscope
