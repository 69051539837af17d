#include "scenario/readers.h"
#include "view/title.h"

namespace contactscope {
namespace scenario_file {
std::string read_title(const Value& value) {
  std::string text = value.string();
  const ParsedTitle parsed = parse_title(text);
  if (!parsed.problem.empty()) value.fail(parsed.problem);
  return text;
}

namespace {

/// A view's name is also a folder of pictures.
std::string read_view_name(const Value& value) {
  std::string name = value.non_empty_string();
  const bool plain = name.size() <= 64 && std::ranges::all_of(name, [](char c) {
                       return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                              (c >= '0' && c <= '9') || c == '_' || c == '-';
                     });
  if (!plain)
    value.fail("the view's name becomes a folder; use up to 64 letters, digits, '_' and '-'");
  return name;
}

template <class Word, std::size_t N>
std::vector<Word> read_words(const Value& value, const std::array<std::string_view, N>& names,
                             const char* kind) {
  std::vector<Word> words;
  for (const Value& item : value.array()) {
    const std::string name = item.one_of(Keys(names.begin(), names.end()), kind);
    const Word word = *word_named<Word>(names, name);
    if (std::ranges::find(words, word) != words.end())
      item.fail(std::string("the ") + kind + " '" + name + "' is listed twice; once is enough");
    words.push_back(word);
  }
  return words;
}

/// Metres of arrow per newton second.
double read_impulse_scale(const Value& value) {
  const double scale = value.number();
  const double decade = std::pow(10.0, std::floor(std::log10(scale) + 1e-9));
  const double leading = scale / decade;
  if (std::ranges::none_of(std::array{1.0, 2.0, 5.0},
                           [&](double step) { return std::abs(leading - step) < 1e-6; }))
    value.fail("the legend shows one digit of the scale; give 1, 2 or 5 times a power of ten");
  return scale;
}

/// A view of kind "contact_plane" has no camera, layers or panels.
View read_contact_plane(const Value& table) {
  View view;
  view.kind = ViewKind::ContactPlane;
  for (const char* key : {"eye", "target", "fov_degrees", "orthographic_height", "focus", "story",
                          "layers", "panels", "impulse_scale", "layout", "inset"}) {
    if (const auto value = table.find(key))
      value->fail(std::string("'") + key +
                  "' has no effect on a view of kind \"contact_plane\"; remove it");
  }
  table.read("name", view.name, read_view_name);
  table.read("title", view.title, read_title);
  table.read("choices", view.choices);
  if (const auto charts = table.find("charts")) {
    view.charts = read_words<Chart>(*charts, kChartNames, "chart");
    if (*view.charts != std::vector{Chart::Margin})
      charts->fail("the only chart of a view of kind \"contact_plane\" is \"margin\"");
  }
  return view;
}

View read_view(const Value& value) {
  const Value table = value.table({"views"});
  View view = default_view();
  table.read("kind", view.kind);
  if (view.kind == ViewKind::ContactPlane) return read_contact_plane(table);
  if (const auto choices = table.find("choices"))
    choices->fail("'choices' is for a view of kind = \"contact_plane\"; set that kind");
  view.focus = Focus::Contact;  // a custom view should show the contact
  table.read("name", view.name, read_view_name);
  table.read("title", view.title, read_title);
  table.read("eye", view.eye);
  table.read("target", view.target);
  if (view.eye && view.target) {
    const double extent = std::max(view.eye->norm(), view.target->norm());
    if ((*view.eye - *view.target).norm() <= 1e-9 * extent)  // rounding leaves no direction
      table.find("eye")->fail(
          "'eye' and 'target' are the same point; move the eye away from the target");
  }
  table.not_both("fov_degrees", "orthographic_height");
  table.read("fov_degrees", view.fov_degrees);
  table.read("orthographic_height", view.orthographic_height);
  table.read("impulse_scale", view.impulse_scale, read_impulse_scale);
  table.read("focus", view.focus);
  table.read("layout", view.layout);
  table.read("inset", view.inset);
  table.read("story", view.story);
  table.read("layers", view.layers,
             [](const Value& layers) { return read_words<Layer>(layers, kLayerNames, "layer"); });
  table.read("panels", view.panels,
             [](const Value& panels) { return read_words<Panel>(panels, kPanelNames, "panel"); });
  if (const auto charts = table.find("charts"))
    view.charts = read_words<Chart>(*charts, kChartNames, "chart");
  return view;
}

PictureLimits read_limits(const Value& value) {
  const Value table = value.table({"limits"});
  PictureLimits limits;
  table.read("channel", limits.channel);
  table.read("cluster", limits.cluster);
  table.read("total", limits.total);
  return limits;
}

}  // namespace

void check_title(const Value& value, const Scenario& scenario) {
  const auto is_known = [&](const std::string& name) {
    return std::ranges::find(scenario.shapes, name, &ScenarioShape::name) !=
               scenario.shapes.end() ||
           std::ranges::find(scenario.pairs, name, &ScenarioPair::label) != scenario.pairs.end();
  };
  for (const TitleAlternative& pieces : parse_title(value.string()).title)
    for (const TitlePiece& piece : pieces)
      for (const std::string& name : {piece.of, piece.of_other})
        if (!name.empty() && !is_known(name))
          value.fail("the title names '" + name +
                     "', which is neither a shape nor the label of a pair");
}

std::vector<View> read_views(const Value& value) {
  std::vector<View> views;
  std::set<std::string> names;
  for (const Value& item : value.array_of_tables()) {
    views.push_back(read_view(item));
    if (!names.insert(views.back().name).second)
      item.fail("two views are named '" + views.back().name + "'; give each its own 'name'");
  }
  if (views.empty()) value.fail("'views' is empty; leave it out for one view of all shapes");
  return views;
}

SnapshotSettings read_snapshots(const std::optional<Value>& value, int frames,
                                const std::vector<View>& views) {
  SnapshotSettings snapshots;
  for (const int frame : {0, (frames - 1) / 2, frames - 1})
    if (snapshots.frames.empty() || frame > snapshots.frames.back())
      snapshots.frames.push_back(frame);
  if (!value) return snapshots;
  const Value table = value->table({"snapshots"});
  if (const auto list = table.find("frames")) {
    snapshots.frames.clear();
    for (const Value& item : list->array()) {
      const int frame = item.integer(0, frames - 1);
      if (!snapshots.frames.empty() && frame <= snapshots.frames.back())
        item.fail("the frames to store must be in ascending order, each once");
      snapshots.frames.push_back(frame);
    }
    if (snapshots.frames.empty())
      list->fail("'frames' is empty; name at least one frame, or leave it out");
  }
  if (const auto size = table.find("size")) {
    const std::vector<Value> sides = size->array();
    if (sides.size() != 2) size->fail("'size' is width and height in pixels, such as [640, 360]");
    snapshots.width = sides[0].integer();
    snapshots.height = sides[1].integer();
  }
  table.read("limits", snapshots.limits, read_limits);
  if (const auto own = table.find("view_limits")) {
    for (const Value& limits : own->members()) {
      if (std::ranges::find(views, limits.name(), &View::name) == views.end())
        limits.fail("'" + limits.name() + "' is not a view of this scenario");
      snapshots.view_limits[limits.name()] = read_limits(limits);
    }
  }
  return snapshots;
}

}  // namespace scenario_file

View default_view() {
  View view;
  view.focus = Focus::Shapes;  // one view that fits all shapes
  view.layers = {Layer::Shapes,   Layer::ReferenceFace, Layer::IncidentFace, Layer::ClipPolygons,
                 Layer::Contacts, Layer::Reduced,       Layer::Normals};
  return view;
}

}  // namespace contactscope
