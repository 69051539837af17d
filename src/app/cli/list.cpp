#include <iostream>
#include <nlohmann/json.hpp>

#include "app/cli/verbs.h"
#include "broadphase/broad_phase.h"
#include "image/webp.h"
#include "scenario/scenario.h"
#include "snapshot/store.h"
#include "study/study.h"
#include "vector/svg.h"
#include "view/title.h"

namespace contactscope {

/// scenarios/sources.tsv and course.tsv: lines of id, place in the document, claim, and the scenes,
/// studies or files that show it, separated by tabs; after a line of headings.
std::string_view sources();
std::string_view course();

}  // namespace contactscope

namespace contactscope::app {
namespace {

namespace fs = std::filesystem;

/// A claim of one of the source documents, or a step of the course.
struct SourceRow {
  std::string id, place, claim;
  std::vector<std::string> shown;  // "group/idea[:FRAME]", "study NAME[:MEASURE]", or a file
};

struct Document {
  std::string_view name, letter, title;
};
constexpr Document kDocuments[] = {
    {"sources", "", "What the sources say, and where it is shown"},
    {"gregorius", "G", "D. Gregorius, Robust Contact Creation for Physics Simulations, 2015"},
    {"catto", "C", "E. Catto, Contact Manifolds, 2007"},
    {"survey", "S", "Survey of overlap tests"},
    {"lecture", "L", "Lecture on contact generation"},
    {"project", "D", "What the project promises"},
    {"course", "", "A course on contacts"},
};

const Document& document_of(const std::string& what) {
  return *std::ranges::find(kDocuments, what, &Document::name);
}

constexpr std::string_view kStyle =
    "body{font:16px/1.4 system-ui,sans-serif;margin:2em auto;max-width:1320px;padding:0 1em;"
    "color:#1b1e23;background:#fff}main{display:grid;gap:1.5em;"
    "grid-template-columns:repeat(auto-fill,minmax(min(400px,100%),1fr))}"
    "h2{font-size:1em;margin:0 0 .3em}figure{margin:0 0 1em}"
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
    std::string name = shown.substr(6);
    std::ranges::replace(name, ':', '_');
    for (const auto& file : fs::directory_iterator(root / "study", missing)) {
      const std::string stem = file.path().stem().string();
      if (stem.starts_with(name)) consider(file.path(), static_cast<int>(stem.size()));
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

/// Rows of "sources", of one document ("gregorius", ...), or of "course", in their order.
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

/// Writes the rows with the stored pictures of their scenes and studies as a page, OUT/WHAT.html,
/// without network: the path that a student walks. Returns the path. A scene without a picture of
/// the frame shows its nearest one.
std::string write_source_page(const std::string& what, const Options& options) {
  const std::string title = vector::escaped(document_of(what).title);
  std::map<fs::path, std::size_t> pictures;  // their numbers: each is in the page once
  std::string style(kStyle), body;
  for (const SourceRow& row : source_rows(what)) {
    const std::string claim = vector::escaped(row.claim);
    body += "<figure><h2>" + vector::escaped(row.place) + "</h2>";
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

struct Item {
  std::string name;
  std::string summary;
};

std::vector<Item> items_of_map(const std::string& what) {
  return mapped(source_rows(what), [](const SourceRow& row) {
    const std::string shown = row.shown.empty() ? "nothing" : separated(row.shown, ", ");
    return Item{row.id, row.place + ": " + row.claim + "  [" + shown + "]"};
  });
}

bool is_map(const std::string& what) {
  return std::ranges::count(kDocuments, what, &Document::name) > 0;
}

std::vector<Item> items_of(const std::string& what, const Options& options) {
  const auto with_summary = [](const auto& info) { return Item{info.name, info.summary}; };
  const auto name_alone = [](std::string_view name) { return Item{std::string(name), ""}; };
  if (what == "reducers") return mapped(reducers(), with_summary);
  if (what == "broad_phases") return mapped(broad_phases(), with_summary);
  if (what == "continuous") {
    std::vector<Item> items{
        {"discrete", "none: a body that passes another one between two frames is not noticed"}};
    std::ranges::transform(impact_methods(), std::back_inserter(items), with_summary);
    return items;
  }
  if (what == "layers") return mapped(kLayerNames, name_alone);
  if (what == "panels") return mapped(kPanelNames, name_alone);
  if (what == "studies") return mapped(studies(), with_summary);
  if (what == "words") return mapped(known_words(), name_alone);
  if (is_map(what)) return items_of_map(what);
  return mapped(scenario_files(options.scenario_root), [](const std::string& file) {
    const Scenario scenario = load_scenario(file);
    return Item{scenario.name, plain_title(scenario.title)};
  });
}

ExitCode run_list(const Options& given) {
  Options options = given;
  if (!given.document.empty()) options.what = given.document;
  if (options.what != given.what && given.what != "sources")
    throw UsageError("'" + given.document + "' is a document of sources; write list sources " +
                     given.document);
  if (options.formats != Options{}.formats) {
    if (options.formats != std::vector<std::string>{"html"} || !is_map(options.what))
      throw UsageError(
          "only 'list sources', a document of them, and 'list course' are pages; "
          "write list sources --format html");
    std::cout << write_source_page(options.what, options) << '\n';
    return ExitCode::Same;
  }
  std::vector<std::string> kinds(kListed.begin(), std::ranges::find(kListed, "sources"));
  if (!options.what.empty()) kinds = {options.what};
  nlohmann::ordered_json json;
  for (const std::string& kind : kinds) {
    const std::vector<Item> items = items_of(kind, options);
    if (options.json) {
      json[kind] = nlohmann::ordered_json::array();
      for (const Item& item : items) {
        nlohmann::ordered_json entry{{"name", item.name}};
        if (!item.summary.empty()) entry["summary"] = item.summary;
        json[kind].push_back(entry);
      }
      continue;
    }
    if (kinds.size() > 1) std::cout << kind << ":\n";
    const char* indent = kinds.size() > 1 ? "  " : "";
    std::size_t width = 0;
    for (const Item& item : items) width = std::max(width, item.name.size());
    for (const Item& item : items) {
      std::cout << indent << item.name;
      if (!item.summary.empty())
        std::cout << std::string(width - item.name.size() + 2, ' ') << item.summary;
      std::cout << '\n';
    }
  }
  if (options.json) std::cout << json.dump() << '\n';
  return ExitCode::Same;
}

}  // namespace

Verb list_verb() { return {"list", "List scenarios, reducers, layers and other names", &run_list}; }

}  // namespace contactscope::app
