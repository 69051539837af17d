#include "app/cli/source_map.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>

#include "image/encoding.h"
#include "image/png.h"
#include "image/webp.h"
#include "snapshot/store.h"
#include "vector/markup.h"

namespace contactscope {

/// scenarios/sources.tsv and course.tsv: lines of id, place in the document, claim, and the scenes,
/// studies or files that show it, separated by tabs; after a line of headings.
std::string_view sources();
std::string_view course();

}  // namespace contactscope

namespace contactscope::app {
namespace {

namespace fs = std::filesystem;

struct Document {
  std::string_view name, letter, title;
};
constexpr Document kDocuments[] = {
    {"sources", "", "The four documents"},
    {"gregorius", "G", "D. Gregorius, Robust Contact Creation for Physics Simulations, 2015"},
    {"catto", "C", "E. Catto, Contact Manifolds, 2007"},
    {"survey", "S", "Survey of overlap tests"},
    {"lecture", "L", "Lecture on contact generation"},
    {"course", "", "A course on contacts"},
};

const Document& document_of(const std::string& what) {
  return *std::ranges::find(kDocuments, what, &Document::name);
}

constexpr std::string_view kStyle =
    "body{font:16px/1.4 system-ui,sans-serif;margin:2em auto;max-width:1320px;padding:0 1em;"
    "color:#1b1e23;background:#fff}main{display:grid;gap:1.5em;"
    "grid-template-columns:repeat(auto-fill,minmax(min(400px,100%),1fr))}"
    "h2{grid-column:1/-1;font-size:1.15em;margin:1em 0 0}figure{margin:0}"
    ".p{aspect-ratio:16/9;background-size:contain;background-repeat:no-repeat;"
    "border:1px solid #ccc;background-color:#fff}"
    "figcaption b{color:#666}code{font-size:.85em;color:#555;overflow-wrap:anywhere}"
    "@media(prefers-color-scheme:dark){body{color:#e6e6e6;background:#16181c}"
    "code,figcaption b{color:#a8a8a8}.p{border-color:#444}}";

/// Half the size, each pixel the mean of four.
Image halved(const Image& image) {
  Image half(image.width / 2, image.height / 2);
  const auto byte = [&](int x, int y, int channel) {
    return int{image.rgb[static_cast<std::size_t>(3 * (y * image.width + x) + channel)]};
  };
  auto to = half.rgb.begin();
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x)
      for (int c = 0; c < 3; ++c)
        *to++ = static_cast<std::uint8_t>((byte(2 * x, 2 * y, c) + byte(2 * x + 1, 2 * y, c) +
                                           byte(2 * x, 2 * y + 1, c) +
                                           byte(2 * x + 1, 2 * y + 1, c) + 2) /
                                          4);
  return half;
}

/// The stored picture of a scene in the frame, or in the nearest one; or the first of a study.
std::optional<fs::path> picture_of(const std::string& shown, const fs::path& root) {
  std::optional<fs::path> best;
  int least = 0;
  const auto consider = [&](const fs::path& path, int distance) {
    if (path.extension() != ".png" || (best && distance >= least)) return;
    best = path;
    least = distance;
  };
  std::error_code missing;
  if (shown.starts_with("study ")) {
    const std::string name = shown.substr(6);
    for (const auto& file : fs::directory_iterator(root / "study", missing)) {
      const std::string stem = file.path().stem().string();
      if (stem == name || stem.starts_with(name + "_"))
        consider(file.path(), static_cast<int>(stem.size()));
    }
    return best;
  }
  const std::size_t colon = shown.find(':');
  const int frame = colon < shown.size() ? std::stoi(shown.substr(colon + 1)) : 0;
  std::vector<fs::path> files;
  for (const auto& file : fs::recursive_directory_iterator(root / shown.substr(0, colon), missing))
    files.push_back(file.path());
  std::ranges::sort(files);
  for (const fs::path& file : files) {
    const std::string stem = file.stem().string();
    if (stem.starts_with("frame_") && stem.find('.') == std::string::npos)
      consider(file, std::abs(std::stoi(stem.substr(6)) - frame));
  }
  return best;
}

}  // namespace

std::vector<SourceRow> source_rows(const std::string& what) {
  std::vector<SourceRow> rows;
  std::istringstream lines{std::string(what == "course" ? course() : sources())};
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    SourceRow row;
    std::string shown;
    std::getline(cells, row.id, '\t');
    std::getline(cells, row.place, '\t');
    std::getline(cells, row.claim, '\t');
    while (std::getline(cells >> std::ws, shown, ',')) row.shown.push_back(shown);
    if (row.id.starts_with(document_of(what).letter)) rows.push_back(std::move(row));
  }
  return rows;
}

std::string write_source_page(const std::string& what, const Options& options) {
  const std::string title = vector::escaped(document_of(what).title);
  std::map<fs::path, std::size_t> pictures;  // their numbers: each is in the page once
  std::string style(kStyle), body, place;
  for (const SourceRow& row : source_rows(what)) {
    if (row.place != place) body += "<h2>" + vector::escaped(row.place) + "</h2>\n";
    place = row.place;
    const std::string claim = vector::escaped(row.claim);
    body += "<figure>";
    for (const std::string& shown : row.shown) {
      const auto picture = picture_of(shown, options.snapshot_root);
      if (!picture) continue;
      const auto [found, is_new] = pictures.try_emplace(*picture, pictures.size());
      const std::string number = "p" + std::to_string(found->second);
      if (is_new) {
        const Bytes webp = encode_webp(halved(read_png(picture->string())));
        style += "." + number + "{background-image:url(data:image/webp;base64," +
                 base64({reinterpret_cast<const char*>(webp.data()), webp.size()}) + ")}";
      }
      body += "<div class=\"p " + number + "\" role=img aria-label=\"" + claim + "\"></div>";
    }
    body += "<figcaption><b>" + vector::escaped(row.id) + "</b> " + claim;
    for (const std::string& shown : row.shown)
      body += "<br><code>" + vector::escaped(shown) + "</code>";
    body += "</figcaption></figure>\n";
  }
  const fs::path path = fs::path(options.out) / (what + ".html");
  snapshot::write_text(path,
                       "<!doctype html><html lang=en><meta charset=utf-8><meta name=viewport "
                       "content=\"width=device-width\"><title>" +
                           title + "</title><style>" + style + "</style><h1>" + title +
                           "</h1><main>\n" + body + "</main></html>\n");
  return path.string();
}

}  // namespace contactscope::app
