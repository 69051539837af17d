#include "app/options.h"

#include <algorithm>
#include <charconv>

#include "scenario/nearest_word.h"

namespace contactscope::app {
namespace {

// All of `text` as a whole number, or nothing.
std::optional<int> whole_number(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t at = text.find(separator);
    parts.push_back(text.substr(0, at));
    if (at == std::string_view::npos) return parts;
    text.remove_prefix(at + 1);
  }
}

template <class Word, std::size_t N>
std::optional<std::vector<Word>> parse_words(const std::string& option,
                                             const std::vector<std::string>& names,
                                             const std::array<std::string_view, N>& known) {
  if (names.empty()) return std::nullopt;
  std::vector<Word> words;
  if (names.size() == 1 && names.front() == "none") return words;
  for (const std::string& name : names) {
    if (name == "none") throw UsageError(option + " 'none' stands alone; leave the others out");
    const std::optional<Word> word = word_named<Word>(known, name);
    if (!word) {
      const std::vector<std::string_view> all(known.begin(), known.end());
      const std::string near = nearest(name, all);
      throw UsageError(
          option + " '" + name + "' is not known; " +
          (near.empty() ? "there is " + quoted_list(all) : "did you mean '" + near + "'?"));
    }
    words.push_back(*word);
  }
  return words;
}

}  // namespace

std::optional<std::vector<Layer>> parse_layers(const std::vector<std::string>& names) {
  return parse_words<Layer>("--layers", names, kLayerNames);
}

std::optional<std::vector<Panel>> parse_panels(const std::vector<std::string>& names) {
  return parse_words<Panel>("--panels", names, kPanelNames);
}

std::vector<int> FrameRange::select(int frames) const {
  std::vector<int> selected;
  for (int f = first; f <= std::min(last, frames - 1); f += step) selected.push_back(f);
  return selected;
}

bool FrameRange::names(int frame) const {
  return frame >= first && frame <= last && (frame - first) % step == 0;
}

FrameRange parse_frame_range(const std::string& text) {
  const std::vector<std::string_view> parts = split(text, ':');
  std::vector<int> numbers;
  for (const std::string_view part : parts) {
    const std::optional<int> number = whole_number(part);
    if (!number || *number < 0) {
      throw UsageError("--frames '" + text + "' is no range; write A:B or A:B:STEP, as 0:23:4");
    }
    numbers.push_back(*number);
  }
  FrameRange range;
  range.first = numbers[0];
  range.last = numbers.size() > 1 ? numbers[1] : numbers[0];
  range.step = numbers.size() > 2 ? numbers[2] : 1;
  if (numbers.size() > 3 || range.step < 1 || range.last < range.first) {
    throw UsageError("--frames '" + text +
                     "' is no range; write A:B or A:B:STEP with A <= B and STEP >= 1");
  }
  return range;
}

Size roomy_size(std::size_t methods) {
  constexpr std::size_t kOfOneScreen = 9;
  Size size;
  if (methods > kOfOneScreen) size.height *= 2;
  return size;
}

Size parse_size(const std::string& text) {
  constexpr int kLeast = 64, kMost = 8192;  // what every OpenGL 3.3 driver can hold
  const std::vector<std::string_view> parts = split(text, 'x');
  if (parts.size() == 2) {
    const std::optional<int> width = whole_number(parts[0]);
    const std::optional<int> height = whole_number(parts[1]);
    if (width && height && std::min(*width, *height) >= kLeast &&
        std::max(*width, *height) <= kMost) {
      return {*width, *height};
    }
  }
  throw UsageError("--size '" + text +
                   "' is no size; write WxH with both between 64 and 8192, as 1280x720");
}

Update parse_update(const std::string& text) {
  if (text == "never") return Update::Never;
  if (text == "failed") return Update::Failed;
  if (text == "all") return Update::All;
  throw UsageError("--update=" + text + " is not known; write --update, --update=all or nothing");
}

gl::Backend parse_backend(const std::string& where, const std::string& text) {
  if (text == "auto") return gl::Backend::Auto;
  if (text == "egl") return gl::Backend::Egl;
  if (text == "osmesa") return gl::Backend::Osmesa;
  throw UsageError(where + " '" + text + "' is no route to OpenGL; it is auto, egl or osmesa");
}

}  // namespace contactscope::app
