#include <algorithm>

#include "app/cli/verbs.h"
#include "app/render/formats/format.h"
#include "core/nearest_word.h"

namespace contactscope::app {

const std::vector<Format>& formats() {
  static const std::vector<Format> all = {kPngFormat,  kSvgFormat,  kPdfFormat,   kHtmlFormat,
                                          kApngFormat, kWebpFormat, kViewerFormat};
  return all;
}

std::vector<const Format*> formats_named(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (std::ranges::find(formats(), name, &Format::name) == formats().end())
      throw UsageError("--format '" + name + "' is not known; there is " +
                       quoted_list(names_in(formats())));
  }
  std::vector<const Format*> chosen;
  for (const Format& format : formats())
    if (std::ranges::find(names, format.name) != names.end()) chosen.push_back(&format);
  return chosen;
}

}  // namespace contactscope::app
