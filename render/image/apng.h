#pragma once

#include "image/image.h"
#include "image/png_chunks.h"

namespace contactscope {

/// An animated PNG that plays forever, made a picture at a time. Of each picture after the first only
/// the smallest rectangle is kept that holds all pixels that are not as in the one before. Whoever does
/// not know animations sees the first picture.
class ApngEncoder {
 public:
  /// `level` is that of zlib_stream(), 0 to 12.
  explicit ApngEncoder(int level = 6) : level_(level) {}

  /// The next picture, as large as the first one, and with alpha where that has some. `milliseconds`:
  /// how long it is shown.
  void add(const Image& image, int milliseconds);

  /// The whole file, after the last picture; there was at least one. Equal pictures, times and texts
  /// give equal bytes.
  Bytes finish(const PngText& text = {}) const;

 private:
  void append_control(const PixelBox& box, int milliseconds);

  int level_;
  std::uint32_t frames_ = 0, numbers_ = 0;  // numbers_: of fcTL and fdAT together
  Image last_;
  Bytes begin_, body_;
};

/// The smallest rectangle that holds all pixels that differ between two pictures of one size; one pixel
/// at the top left where none does.
PixelBox changed_box(const Image& before, const Image& after);

}  // namespace contactscope
