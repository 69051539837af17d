#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "image/image.h"
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

}  // namespace contactscope
