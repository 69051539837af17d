#include "image/webp.h"

#include <webp/encode.h>
#include <webp/mux.h>

#include <cassert>

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
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;

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

}  // namespace contactscope
