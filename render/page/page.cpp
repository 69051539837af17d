#include "page/page.h"

#include <nlohmann/json.hpp>

#include "page/facts.h"
#include "vector/svg.h"

namespace contactscope::page {
namespace {

/// Value of an attribute of a tag; empty if missing.
std::string_view attribute_of(std::string_view tag, std::string_view name) {
  const std::string opening = " " + std::string(name) + "=\"";
  const std::size_t begin = tag.find(opening);
  if (begin == std::string_view::npos) return {};
  const std::string_view value = tag.substr(begin + opening.size());
  return value.substr(0, value.find('"'));
}

using draw::Drawing;
using nlohmann::ordered_json;

constexpr int kPause = 160;                     // milliseconds per frame
constexpr double kSignWidth = 28;               // of a legend symbol, pixels at 720 lines
constexpr double kSignToText = 32;              // from its left end to the text
constexpr std::string_view kLabels = "labels";  // of the view; without a row in the legend
constexpr double kBorder = 3;                   // around view and panels, pixels at 720 lines

Drawing part_of(const Drawing& drawing, std::string_view layer) {
  return drawing.taken([&](const draw::Part& part) { return part.layer == layer; });
}

/// Parts that the page shows as scalable text.
bool is_said_by_page(const draw::Part& part) {
  return part.layer == draw::kTitlePart || part.layer == draw::kSourcePart ||
         part.layer == draw::kMomentPart || part.layer == draw::kLegendPart;
}

/// The texts of a part, which may have several lines; empty without any.
std::string words_of(const Drawing& drawing, std::string_view layer) {
  std::string words;
  for (const draw::Primitive& primitive : part_of(drawing, layer).primitives)
    if (const auto* text = std::get_if<draw::Text>(&primitive))
      words += (words.empty() ? "" : " ") + text->text;
  return words;
}

std::vector<SvgGroup> groups_of(Drawing drawing) {
  drawing.background.a = 0;
  return groups_in(vector::svg_of(drawing, {.embed_font = false}));
}

/// "reference face" for the layer "reference_face".
std::string in_words(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

/// A resolution of 0.1 pixel is enough for the pointer.
double tenths(double value) { return std::round(10 * value) / 10; }

ordered_json point_json(const PointFacts& point) {
  ordered_json json{{"key", point.key},        {"name", point.name},      {"of", point.of},
                    {"x", tenths(point.at.x)}, {"y", tenths(point.at.y)}, {"layers", point.layers},
                    {"rows", point.rows}};
  if (point.is_contact) json["row"] = true;
  return json;
}

ordered_json area_json(const AreaFacts& area) {
  ordered_json polygon = ordered_json::array();
  for (const draw::Point2& corner : area.polygon)
    polygon.push_back({std::round(corner.x), std::round(corner.y)});
  return {{"key", area.key},     {"name", area.name},  {"of", area.of},
          {"layer", area.layer}, {"polygon", polygon}, {"rows", area.rows}};
}

std::string view_box(const draw::Rect& rect) {
  return separated(std::array{rect.x, rect.y, rect.width, rect.height}, " ", vector::number);
}

/// Fills in a template's @NAMES@.
std::string filled(std::string_view markup, const std::map<std::string_view, std::string>& values) {
  std::string text;
  while (!markup.empty()) {
    const std::size_t begin = markup.find('@');
    text += markup.substr(0, begin);
    if (begin == std::string_view::npos) break;
    markup.remove_prefix(begin + 1);
    const std::size_t end = markup.find('@');
    const auto value = values.find(markup.substr(0, end));
    if (end == std::string_view::npos || value == values.end()) {
      text += '@';
      continue;
    }
    text += value->second;
    markup.remove_prefix(end + 1);
  }
  return text;
}

}  // namespace

/// page.html, page.css and page.js, embedded by the build.
std::string_view page_markup();
std::string_view page_style();
std::string_view page_script();

Page::Page(const draw::Staging& staging, const PictureOrigin& origin)
    : staging_(staging), origin_(origin), title_(origin.title) {
  std::string letters = "←→−×²³µ°·…";
  for (char c = ' '; c <= '~'; ++c) letters += c;
  for (const char32_t code_point : code_points(letters + origin.title + staging.header->source))
    for (const FontWeight weight : {FontWeight::Regular, FontWeight::Bold})
      if (has_glyph(code_point, weight)) used_[weight].insert(code_point);
}

// Symbols and texts alternate. Each symbol becomes its own picture, so that the page can wrap the
// legend. Entries outside of the legend are labels in the scene; they are appended to `view`.
std::vector<int> Page::legend_of(const Drawing& drawing, Drawing& view) {
  const float scale = staging_.layout.scale;
  std::vector<int> numbers;
  Drawing sign;
  for (const draw::Primitive& primitive : part_of(drawing, draw::kLegendPart).primitives) {
    const auto* text = std::get_if<draw::Text>(&primitive);
    if (text == nullptr) {
      sign.primitives.push_back(primitive);
      continue;
    }
    if (!staging_.cells && !staging_.layout.legend.grown(1).contains(text->at)) {
      view.begin(kLabels, {}, "label");
      view.primitives.insert(view.primitives.end(), sign.primitives.begin(), sign.primitives.end());
      view.primitives.push_back(primitive);
      sign.primitives.clear();
      continue;
    }
    const auto row = static_cast<float>(scale * draw::kLegendRow);
    Drawing entry{.width = static_cast<int>(std::lround(scale * kSignWidth)),
                  .height = static_cast<int>(std::lround(row)),
                  .background = {1, 1, 1, 0}};
    const draw::Point2 middle = {text->at.x - scale * static_cast<float>(kSignToText),
                                 text->at.y - 0.36f * text->size};
    entry.append(sign, draw::Point2{scale * 2, 0.5f * row} - middle);
    sign.primitives.clear();
    const std::pair<std::string, std::string> record = {
        vector::svg_of(entry, {.embed_font = false,
                               .width = vector::number(kSignWidth),
                               .height = vector::number(draw::kLegendRow)}),
        text->text};
    const auto known = std::ranges::find(legend_, record);
    numbers.push_back(static_cast<int>(known - legend_.begin()));
    if (known == legend_.end()) legend_.push_back(record);
  }
  return numbers;
}

void Page::add(const trace::Frame& frame, const Drawing& drawing) {
  const auto is_panel = [](const draw::Part& part) { return part.layer == draw::kPanelPart; };
  Drawing view = drawing.taken(
      [&](const draw::Part& part) { return !is_panel(part) && !is_said_by_page(part); });
  const Drawing panels = drawing.taken(is_panel);
  const std::vector<int> legend = legend_of(drawing, view);
  for (const draw::Part& part : view.parts) layers_.insert(part.layer);
  const int known = groups_.size();
  const std::vector<int> in_view = groups_.add(groups_of(view));
  const std::vector<int> in_panels = groups_.add(groups_of(panels));
  vector::add_characters(drawing, used_);

  std::string moment = words_of(drawing, draw::kMomentPart);
  if (moment.empty()) moment = "frame " + std::to_string(frame.frame);
  const std::string title = words_of(drawing, draw::kTitlePart);
  ordered_json json{{"frame", frame.frame}, {"moment", moment}};
  if (!title.empty()) json["title"] = title;
  json["view"] = in_view;
  json["panels"] = in_panels;
  json["legend"] = legend;
  json["points"] = ordered_json::array();
  json["faces"] = ordered_json::array();
  json["pairs"] = ordered_json::array();
  if (!staging_.cells) {
    for (const PointFacts& point : point_facts(staging_, frame, drawing))
      json["points"].push_back(point_json(point));
    for (const AreaFacts& area : area_facts(staging_, frame, drawing))
      json["faces"].push_back(area_json(area));
  }
  for (const PairFacts& pair : pair_facts(frame))
    json["pairs"].push_back(
        {{"key", pair.key}, {"name", pair.name}, {"parts", pair.parts}, {"rows", pair.rows}});
  if (frames_.empty()) {
    first_view_ = in_view;
    first_panels_ = in_panels;
    first_moment_ = moment;
    ground_ = drawing.background;
    if (!title.empty()) title_ = title;
  }
  frames_.push_back(json.dump());
  size_ += frames_.back().size();
  for (int number = known; number < groups_.size(); ++number) size_ += groups_.text(number).size();
}

Page::Areas Page::areas() const {
  const draw::Layout& layout = staging_.layout;
  const double border = layout.px(kBorder);
  const bool has_panels = layout.panels.width > 0;
  Areas areas;
  areas.view = layout.view;
  for (const draw::Rect& inset : layout.insets) areas.view.width = inset.right() - areas.view.x;
  areas.view = areas.view.grown(border);
  if (has_panels) areas.panels = layout.panels.grown(border);
  return areas;
}

std::string Page::html() const {
  const Areas areas = this->areas();
  ordered_json data{{"pause", kPause},
                    {"scale", staging_.layout.scale},
                    {"panels", areas.panels.width > 0},
                    {"points", !staging_.cells},
                    {"layers", ordered_json::array()},
                    {"legend", ordered_json::array()},
                    {"frames", ordered_json::array()}};
  std::vector<std::string> layers(kLayerNames.begin(), kLayerNames.end());
  for (const std::string_view part :
       {draw::kShapeNamesPart, draw::kInsetPart, draw::kPairLabelPart, kLabels})
    layers.emplace_back(part);
  for (const std::string& layer : layers)
    if (layers_.contains(layer))
      data["layers"].push_back({{"name", layer}, {"words", in_words(layer)}});
  for (const auto& [sign, text] : legend_)
    data["legend"].push_back({{"sign", sign}, {"text", text}});
  std::string json = data.dump();
  // One line per frame, so that the file can be read and compared.
  std::string frames;
  for (const std::string& frame : frames_) frames += (frames.empty() ? "\n" : ",\n") + frame;
  json.insert(json.rfind("[]") + 1, frames + "\n");

  std::set<int> hung(first_view_.begin(), first_view_.end());
  hung.insert(first_panels_.begin(), first_panels_.end());
  const auto texts_of = [&](const std::vector<int>& numbers) {
    std::string text;
    for (const int number : numbers) text += groups_.text(number);
    return text;
  };
  std::vector<int> others;
  for (int number = 0; number < groups_.size(); ++number)
    if (!hung.contains(number)) others.push_back(number);

  vector::FontFaces fonts;
  const std::string& source = staging_.header->source;
  const std::string made = origin_.command.empty()
                               ? std::string()
                               : "<code>" + vector::escaped(origin_.command) + "</code>";
  return filled(
      page_markup(),
      {{"GENERATOR", vector::escaped("contactscope " + origin_.version)},
       {"DESCRIPTION", vector::escaped(origin_.scenario + ", made by " + origin_.command)},
       {"NAME", vector::escaped(title_.empty() ? origin_.scenario : title_)},
       {"FONTS", fonts.css(used_)},
       {"STYLE", std::string(page_style())},
       {"TITLE", vector::escaped(title_)},
       {"VIEW_WIDTH", vector::number(areas.view.width)},
       {"PANELS_WIDTH", vector::number(areas.panels.width)},
       {"HEIGHT", vector::number(areas.view.height)},
       {"GROUND", ground_.a > 0 ? vector::hex(ground_) : "transparent"},
       {"VIEW_BOX", view_box(areas.view)},
       {"PANELS_BOX", view_box(areas.panels)},
       {"FIRST_PICTURE", texts_of(first_view_)},
       {"FIRST_PANELS", texts_of(first_panels_)},
       {"LAST", std::to_string(frames_.size() - 1)},
       {"MOMENT", vector::escaped(first_moment_)},
       {"SOURCE", vector::escaped(source)},
       {"MADE", made},
       {"GROUPS", texts_of(others)},
       {"DATA", vector::in_script(json)},
       {"SCRIPT", std::string(page_script())}});
}

std::vector<SvgGroup> groups_in(std::string_view svg) {
  constexpr std::string_view kOpening = "\n<g ", kClosing = "</g>", kClass = "layer ";
  std::vector<SvgGroup> groups;
  for (std::size_t begin = svg.find(kOpening); begin != std::string_view::npos;
       begin = svg.find(kOpening, begin)) {
    const std::size_t inside = svg.find('>', begin) + 1;
    const std::size_t end = svg.find(kClosing, inside);
    const std::string_view tag = svg.substr(begin, inside - begin);
    std::string_view markup = svg.substr(inside, end - inside);
    while (!markup.empty() && markup.front() == '\n') markup.remove_prefix(1);
    begin = end;
    if (markup.empty()) continue;
    std::string_view layer = attribute_of(tag, "class");
    if (layer.starts_with(kClass)) layer.remove_prefix(kClass.size());
    groups.push_back({std::string(layer), std::string(attribute_of(tag, "data-pair")),
                      std::string(attribute_of(tag, "data-role")), std::string(markup)});
  }
  return groups;
}

std::vector<int> GroupStore::add(const std::vector<SvgGroup>& groups) {
  std::map<const SvgGroup*, int> before;  // number of uses in this picture
  std::vector<int> numbers;
  for (const SvgGroup& group : groups) {
    const auto first = numbers_.find({group, 0});
    const int times = first == numbers_.end() ? 0 : before[&first->first.first]++;
    const auto [found, is_new] = numbers_.try_emplace({group, times}, size());
    if (is_new) in_order_.push_back(&found->first.first);
    if (first == numbers_.end()) before[&found->first.first] = 1;
    numbers.push_back(found->second);
  }
  return numbers;
}

std::string GroupStore::text(int number) const {
  const SvgGroup& group = *at(in_order_, number);
  std::string text = "<g id=\"g" + std::to_string(number) + "\" data-layer=\"" + group.layer + '"';
  if (!group.pair.empty()) text += " data-pair=\"" + group.pair + '"';
  if (!group.role.empty()) text += " data-role=\"" + group.role + '"';
  return text + ">\n" + group.markup + "</g>\n";
}

}  // namespace contactscope::page
