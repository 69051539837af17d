#pragma once

#include <memory>

#include "image/png.h"

namespace contactscope {

/// libwebp failed: a side over 16383 pixels, or out of memory.
class WebpError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Encodes lossless WebP, with alpha if the picture has it. `about` is optional XMP. Equal pictures
/// give equal bytes. Throws WebpError.
Bytes encode_webp(const Image& image, const std::string& about = {});

/// Encodes an endlessly looping lossless animation picture by picture. Throws WebpError.
class WebpAnimation {
 public:
  WebpAnimation();
  ~WebpAnimation();

  /// Adds a picture of the first one's size, shown for `milliseconds`.
  void add(const Image& image, int milliseconds);

  /// Returns the whole file; at least one picture was added.
  Bytes finish(const std::string& about = {});

 private:
  struct Encoder;
  std::unique_ptr<Encoder> encoder_;
};

/// Encodes an endlessly looping animated PNG picture by picture. After the first, only the smallest
/// rectangle with all changed pixels is stored. Viewers without animation support show the first
/// picture.
class ApngEncoder {
 public:
  /// `level` is that of zlib_stream(), 0 to 12.
  explicit ApngEncoder(int level = 6) : level_(level) {}

  /// Adds a picture of the first one's size, shown for `milliseconds`. It has an alpha channel if
  /// the first one does.
  void add(const Image& image, int milliseconds);

  /// Returns the whole file; at least one picture was added. Equal pictures, times and texts give
  /// equal bytes.
  Bytes finish(const PngText& text = {}) const;

 private:
  void append_control(const PixelBox& box, int milliseconds);

  int level_;
  std::uint32_t frames_ = 0, numbers_ = 0;  // numbers_: sequence number, common to fcTL and fdAT
  Image last_;
  Bytes begin_, body_;
};

/// Smallest rectangle with all pixels that differ between two pictures of equal size; one pixel at
/// the top left if none does.
PixelBox changed_box(const Image& before, const Image& after);

}  // namespace contactscope
