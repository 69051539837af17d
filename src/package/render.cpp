#include "gl/rasterizer.h"
#include "image/png.h"
#include "overlay/panels.h"
#include "package/facts.h"
#include "scenario/scenario.h"

namespace contactscope::package {
namespace {

gl::Backend backend_named(const std::string& name) {
  if (name == "auto") return gl::Backend::Auto;
  if (name == "egl") return gl::Backend::Egl;
  if (name == "osmesa") return gl::Backend::Osmesa;
  refuse("OpenGL backend", name, {"auto", "egl", "osmesa"});
}

template <class Word, std::size_t N>
std::vector<Word> words_named(const std::string& what, const std::vector<std::string>& names,
                              const std::array<std::string_view, N>& known) {
  return mapped(names, [&](const std::string& name) {
    if (const std::optional<Word> word = word_named<Word>(known, name)) return *word;
    refuse(what, name, {known.begin(), known.end()});
  });
}

View view_of(const RenderOptions& options) {
  View view = default_view();
  view.panels = {contactscope::Panel::Summary};
  if (options.layers) view.layers = words_named<Layer>("layer", *options.layers, kLayerNames);
  if (options.panels) view.panels = words_named<Panel>("panel", *options.panels, kPanelNames);
  if (options.eye) view.eye = to_inside(*options.eye);
  if (options.target) view.target = to_inside(*options.target);
  if (view.eye && view.target && *view.eye == *view.target)
    throw std::invalid_argument("eye and target are the same point; move one of them");
  for (const std::optional<Vec3d>& place : {view.eye, view.target})
    if (place && !place->allFinite())
      throw std::invalid_argument("eye or target is not finite; give metres");
  if (options.fov_degrees != 0) {
    if (!(options.fov_degrees >= 1 && options.fov_degrees <= 150))
      throw std::invalid_argument("fov_degrees is not between 1 and 150");
    view.fov_degrees = options.fov_degrees;
  }
  return view;
}

void require_size(int side) {
  constexpr int kMin = 64, kMax = 8192;  // a size that every OpenGL 3.3 driver supports
  if (side < kMin || side > kMax)
    throw std::invalid_argument("a picture of " + std::to_string(side) +
                                " pixels; width and height must be between 64 and 8192");
}

Picture outside(const Image& image) {
  Picture picture{image.width, image.height};
  picture.rgba.reserve(image.rgb.size() / 3 * 4);
  for (std::size_t i = 0; i < image.rgb.size(); i += 3)
    picture.rgba.insert(picture.rgba.end(),
                        {image.rgb[i], image.rgb[i + 1], image.rgb[i + 2], std::uint8_t{255}});
  return picture;
}

}  // namespace

void draw_frames(const contactscope::trace::Header& header,
                 const std::vector<contactscope::trace::Frame>& fitted,
                 const std::vector<contactscope::trace::Frame>& frames,
                 const std::vector<std::size_t>& which, const RenderOptions& options,
                 const std::function<void(std::size_t, Image)>& take) {
  require_size(options.width);
  require_size(options.height);
  const View view = view_of(options);
  const gl::Backend backend = backend_named(options.backend);
  const draw::Staging staging = draw::stage(header, fitted, view, options.width, options.height);
  std::unique_ptr<gl::Context> context;
  try {
    context = gl::open_context(backend);
  } catch (const gl::ContextError& error) {
    throw RenderError(error.what());
  }
  gl::Rasterizer rasterizer(*context, options.width, options.height);
  std::optional<overlay::PanelColumn> panels;
  if (!view.panels.empty()) panels.emplace(staging, frames);
  for (const std::size_t index : which) {
    draw::Drawing drawing = draw::illustrate(staging, frames[index]);
    if (panels) panels->add({index, {}}, drawing);
    rasterizer.paint(drawing);
    take(index, rasterizer.read());
  }
}

Picture render(const Trace& trace, int index, const RenderOptions& options) {
  if (index < 0 || index >= trace.frame_count())
    throw std::invalid_argument("there is no frame " + std::to_string(index) + "; the trace has " +
                                std::to_string(trace.frame_count()) + ", the first is 0");
  const contactscope::trace::Trace& facts = trace.facts().trace;
  Picture picture;
  draw_frames(facts.header, facts.frames, facts.frames, {static_cast<std::size_t>(index)}, options,
              [&](std::size_t, const Image& image) { picture = outside(image); });
  return picture;
}

void render_all(const Trace& trace, const RenderOptions& options,
                const std::function<void(int index, const Picture& picture)>& take) {
  const contactscope::trace::Trace& facts = trace.facts().trace;
  if (facts.frames.empty()) return;
  std::vector<std::size_t> all(facts.frames.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  draw_frames(facts.header, facts.frames, facts.frames, all, options,
              [&](std::size_t index, const Image& image) {
                take(static_cast<int>(index), outside(image));
              });
}

void write_png(const std::string& path, const Picture& picture) {
  const std::size_t pixels =
      picture.width > 0 && picture.height > 0
          ? static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height)
          : 0;
  if (pixels == 0 || picture.rgba.size() != 4 * pixels)
    throw std::invalid_argument("a picture of " + std::to_string(picture.width) + "x" +
                                std::to_string(picture.height) + " pixels must have " +
                                std::to_string(4 * pixels) + " bytes, more than 0; this has " +
                                std::to_string(picture.rgba.size()));
  Image image(picture.width, picture.height);
  for (std::size_t i = 0; i < pixels; ++i)
    std::copy_n(picture.rgba.begin() + static_cast<std::ptrdiff_t>(4 * i), 3,
                image.rgb.begin() + static_cast<std::ptrdiff_t>(3 * i));
  contactscope::write_png(path, image);
}

}  // namespace contactscope::package
