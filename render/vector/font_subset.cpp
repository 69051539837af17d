#include "vector/font_subset.h"

#include <dlfcn.h>
#include <hb-subset.h>

#include "image/encoding.h"

namespace contactscope::vector {
namespace {

/// Functions of HarfBuzz in use.
struct HarfBuzz {
  SharedLibrary library{"libharfbuzz-subset.so.0", "libharfbuzz-subset0",
                        "the font in a vector picture"};
#define CONTACTSCOPE_HARFBUZZ(ROW)    \
  ROW(hb_blob_create)                 \
  ROW(hb_blob_destroy)                \
  ROW(hb_blob_get_data)               \
  ROW(hb_face_create)                 \
  ROW(hb_face_destroy)                \
  ROW(hb_face_reference_blob)         \
  ROW(hb_set_add)                     \
  ROW(hb_subset_input_create_or_fail) \
  ROW(hb_subset_input_destroy)        \
  ROW(hb_subset_input_set)            \
  ROW(hb_subset_input_set_flags)      \
  ROW(hb_subset_input_unicode_set)    \
  ROW(hb_subset_or_fail)
  CONTACTSCOPE_FUNCTIONS(HarfBuzz, CONTACTSCOPE_HARFBUZZ)
#undef CONTACTSCOPE_HARFBUZZ
};

const HarfBuzz& harfbuzz() {
  static const HarfBuzz functions;
  return functions;
}

std::string family(std::size_t number) {
  return number == 0 ? "Roboto" : "contactscope-font-" + std::to_string(number);
}

}  // namespace

std::string families(const UsedCharacters& used) {
  std::set<std::size_t> numbers = {0};
  for (const auto& [font, characters] : used) numbers.insert(font.number);
  std::string list;
  for (const std::size_t number : numbers) list += family(number) + ", ";
  return list + "'Helvetica Neue', Helvetica, Arial, 'Liberation Sans', sans-serif";
}

void add_characters(const draw::Drawing& drawing, UsedCharacters& used) {
  for (const draw::Primitive& primitive : drawing.primitives) {
    const auto* text = std::get_if<draw::Text>(&primitive);
    if (text == nullptr || text->text.empty()) continue;
    for (const char32_t code : code_points(text->text))
      used[{text->weight, font_for(code, text->weight)}].insert(code);
  }
}

std::string font_subset(const FontKey& font, const std::set<char32_t>& characters) {
  const HarfBuzz& hb = harfbuzz();
  const auto owned = [](auto* object, auto* destroy) {
    return std::unique_ptr<std::remove_pointer_t<decltype(object)>, decltype(destroy)>(object,
                                                                                       destroy);
  };
  const std::span<const unsigned char> data = font_data(font.weight, font.number);
  const auto whole_file = owned(hb.hb_blob_create(reinterpret_cast<const char*>(data.data()),
                                                  static_cast<unsigned>(data.size()),
                                                  HB_MEMORY_MODE_READONLY, nullptr, nullptr),
                                hb.hb_blob_destroy);
  const auto whole = owned(hb.hb_face_create(whole_file.get(), 0), hb.hb_face_destroy);
  const auto input = owned(hb.hb_subset_input_create_or_fail(), hb.hb_subset_input_destroy);
  if (!input) throw std::bad_alloc();
  for (const char32_t code : characters)
    hb.hb_set_add(hb.hb_subset_input_unicode_set(input.get()), code);
  hb_set_t* dropped = hb.hb_subset_input_set(input.get(), HB_SUBSET_SETS_DROP_TABLE_TAG);
  for (const hb_tag_t table : {HB_TAG('G', 'P', 'O', 'S'), HB_TAG('G', 'S', 'U', 'B'),
                               HB_TAG('G', 'D', 'E', 'F'), HB_TAG('k', 'e', 'r', 'n')})
    hb.hb_set_add(dropped, table);
  // Missing characters are boxes, as in pixels.
  hb.hb_subset_input_set_flags(input.get(),
                               HB_SUBSET_FLAGS_NO_HINTING | HB_SUBSET_FLAGS_NOTDEF_OUTLINE);
  const auto subset = owned(hb.hb_subset_or_fail(whole.get(), input.get()), hb.hb_face_destroy);
  if (!subset) throw std::runtime_error("libharfbuzz-subset could not make a subset of the font");
  const auto file = owned(hb.hb_face_reference_blob(subset.get()), hb.hb_blob_destroy);
  unsigned length = 0;
  const char* bytes = hb.hb_blob_get_data(file.get(), &length);
  return {bytes, length};
}

void require_font_subsets() { harfbuzz(); }

std::string FontFaces::css(const UsedCharacters& used) {
  constexpr std::size_t kMaxKept = 64;  // rules; a sequence uses few sets of characters
  const std::lock_guard lock(mutex_);
  if (rules_.size() > kMaxKept) rules_.clear();
  std::string css;
  for (const auto& key : used) {
    std::string& rule = rules_[key];
    if (rule.empty()) {
      rule = "@font-face{font-family:" + family(key.first.number) +
             ";font-weight:" + (key.first.weight == FontWeight::Bold ? "700" : "400") +
             ";src:url(data:font/ttf;base64," + base64(font_subset(key.first, key.second)) + ")}";
    }
    css += rule;
  }
  return css;
}

SharedLibrary::SharedLibrary(const std::string& name, const std::string& package,
                             const std::string& purpose)
    : name_(name), package_(package), handle_(dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL)) {
  if (handle_ == nullptr) {
    throw MissingLibrary(purpose + " needs " + name +
                         ", which is not installed; install the Debian package " + package);
  }
}

void* SharedLibrary::address(const char* name) const {
  void* found = dlsym(handle_, name);
  if (found == nullptr) {
    throw MissingLibrary(name_ + " has no function " + name + ": it is older than in the package " +
                         package_ + " of Debian 12");
  }
  return found;
}

}  // namespace contactscope::vector
