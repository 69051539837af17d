#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "image/image.h"
#include "image/png_chunks.h"

namespace contactscope {

/// libwebp refused a picture: larger than 16383 pixels, or no memory is left.
class WebpError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A lossless WebP, with alpha where the picture has some. `about`: XMP that is put in, where there is
/// some. Throws WebpError. Equal pictures give equal bytes.
Bytes encode_webp(const Image& image, const std::string& about = {});

/// A lossless animated WebP that plays forever, made a picture at a time. Throws WebpError.
class WebpAnimation {
 public:
  WebpAnimation();
  ~WebpAnimation();

  /// The next picture, as large as the first one. `milliseconds`: how long it is shown.
  void add(const Image& image, int milliseconds);

  /// The whole file, after the last picture; there was at least one.
  Bytes finish(const std::string& about = {});

 private:
  struct Encoder;
  std::unique_ptr<Encoder> encoder_;
};

}  // namespace contactscope
