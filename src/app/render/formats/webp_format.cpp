#include "app/render/formats/format.h"
#include "image/webp.h"
#include "vector/markup.h"

namespace contactscope::app {
namespace {

/// Origin metadata as XMP (ISO 16684-1), one line per entry in the description, which viewers show.
std::string xmp_of(const PictureOrigin& origin) {
  std::string all =
      "<x:xmpmeta xmlns:x=\"adobe:ns:meta/\">"
      "<rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\">"
      "<rdf:Description rdf:about=\"\" xmlns:dc=\"http://purl.org/dc/elements/1.1/\">"
      "<dc:description><rdf:Alt><rdf:li xml:lang=\"x-default\">";
  for (const auto& [key, value] : entries_of(origin))
    all += vector::escaped(key + ": " + value) + "\n";
  return all + "</rdf:li></rdf:Alt></dc:description></rdf:Description></rdf:RDF></x:xmpmeta>";
}

}  // namespace

const Format kWebpFormat{
    .name = "webp",
    .extension = ".webp",
    .what = "lossless WebP, animated if there are several frames",
    .needs_pixels = true,
    .encode = [](const Shot& shot) { return encode_webp(*shot.image, xmp_of(shot.origin)); },
    .begin =
        [](const ReelPlan& plan) {
          return reel_of(plan, std::make_unique<EncodedAnimation<WebpAnimation, std::string>>(
                                   plan, xmp_of(plan.origin)));
        },
};

}  // namespace contactscope::app
