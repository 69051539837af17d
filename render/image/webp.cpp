#include "image/webp.h"

#include <webp/encode.h>
#include <webp/mux.h>
#include <algorithm>
#include <cassert>
#include <cstring>

namespace contactscope {
namespace {

/// Effort, 0 to 9: higher values save little on flat areas and thin lines.
constexpr int kEffort = 2;

WebPConfig lossless() {
  WebPConfig config;
  if (!WebPConfigInit(&config) || !WebPConfigLosslessPreset(&config, kEffort))
    throw WebpError("libwebp and its headers have different versions");
  config.exact = 1;  // keep colours of transparent pixels, so that decoding is exact
  return config;
}

/// A picture in libwebp's format.
class Picture {
 public:
  explicit Picture(const Image& image) {
    if (!WebPPictureInit(&picture_))
      throw WebpError("libwebp and its headers have different versions");
    picture_.use_argb = 1;
    picture_.width = image.width;
    picture_.height = image.height;
    if (!WebPPictureImportRGB(&picture_, image.rgb.data(), 3 * image.width))
      throw WebpError("libwebp cannot import a picture of " + std::to_string(image.width) + "x" +
                      std::to_string(image.height));
    for (std::size_t p = 0; p < image.alpha.size(); ++p) {
      std::uint32_t& argb = picture_.argb[p];  // rows have no padding after an import
      argb = (argb & 0x00FFFFFFu) | static_cast<std::uint32_t>(image.alpha[p]) << 24;
    }
  }
  ~Picture() { WebPPictureFree(&picture_); }
  Picture& operator=(Picture&&) = delete;

  WebPPicture* get() { return &picture_; }

  [[noreturn]] void fail() const {
    throw WebpError("libwebp cannot write a picture of " + std::to_string(picture_.width) + "x" +
                    std::to_string(picture_.height) + ", error " +
                    std::to_string(picture_.error_code) +
                    "; it takes up to 16383 pixels a side, choose a smaller --size or PNG");
  }

 private:
  WebPPicture picture_{};
};

Bytes with_about(Bytes file, const std::string& about) {
  if (about.empty()) return file;
  const WebPData whole{file.data(), file.size()};
  const std::unique_ptr<WebPMux, void (*)(WebPMux*)> mux(WebPMuxCreate(&whole, 0), WebPMuxDelete);
  const WebPData xmp{reinterpret_cast<const std::uint8_t*>(about.data()), about.size()};
  WebPData out{};
  if (!mux || WebPMuxSetChunk(mux.get(), "XMP ", &xmp, 0) != WEBP_MUX_OK ||
      WebPMuxAssemble(mux.get(), &out) != WEBP_MUX_OK)
    throw WebpError("libwebpmux cannot add a description to a picture");
  Bytes result(out.bytes, out.bytes + out.size);
  WebPDataClear(&out);
  return result;
}

// PNG specification, third edition, W3C 2025, section 11.3.6: acTL before the pixels has the number
// of pictures. Each picture has an fcTL, and pixels in an IDAT (the first) or an fdAT.

constexpr std::uint8_t kLeaveInPlace = 0, kOverwrite = 0;  // dispose_op, blend_op

std::size_t pixel_at(const Image& image, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
         static_cast<std::size_t>(x);
}

}  // namespace

Bytes encode_webp(const Image& image, const std::string& about) {
  const WebPConfig config = lossless();
  Picture picture(image);
  WebPMemoryWriter writer;
  WebPMemoryWriterInit(&writer);
  picture.get()->writer = WebPMemoryWrite;
  picture.get()->custom_ptr = &writer;
  const bool is_written = WebPEncode(&config, picture.get()) != 0;
  Bytes file(writer.mem, writer.mem + writer.size);
  WebPMemoryWriterClear(&writer);
  if (!is_written) picture.fail();
  return with_about(std::move(file), about);
}

struct WebpAnimation::Encoder {
  std::unique_ptr<WebPAnimEncoder, void (*)(WebPAnimEncoder*)> pictures{nullptr,
                                                                        WebPAnimEncoderDelete};
  WebPConfig config = lossless();
  int begin = 0;  // of the next picture, milliseconds
};

WebpAnimation::WebpAnimation() : encoder_(std::make_unique<Encoder>()) {}
WebpAnimation::~WebpAnimation() = default;

void WebpAnimation::add(const Image& image, int milliseconds) {
  if (!encoder_->pictures) {
    WebPAnimEncoderOptions options;
    if (!WebPAnimEncoderOptionsInit(&options))
      throw WebpError("libwebpmux and its headers have different versions");
    options.anim_params.loop_count = 0;  // endless
    encoder_->pictures.reset(WebPAnimEncoderNew(image.width, image.height, &options));
    if (!encoder_->pictures) throw WebpError("libwebpmux cannot start an animation");
  }
  Picture picture(image);
  if (!WebPAnimEncoderAdd(encoder_->pictures.get(), picture.get(), encoder_->begin,
                          &encoder_->config))
    picture.fail();
  encoder_->begin += milliseconds;
}

Bytes WebpAnimation::finish(const std::string& about) {
  assert(encoder_->pictures);
  WebPData out{};
  if (!WebPAnimEncoderAdd(encoder_->pictures.get(), nullptr, encoder_->begin, nullptr) ||
      !WebPAnimEncoderAssemble(encoder_->pictures.get(), &out))
    throw WebpError(std::string("libwebpmux cannot write an animation: ") +
                    WebPAnimEncoderGetError(encoder_->pictures.get()));
  Bytes file(out.bytes, out.bytes + out.size);
  WebPDataClear(&out);
  return with_about(std::move(file), about);
}

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
