#include "viewer/viewer.h"

#include "find/finder.h"
#include "vector/svg.h"

namespace contactscope::viewer {
namespace {

using nlohmann::ordered_json;

/// The layers that the page can show, in drawing order.
constexpr std::array kShown = {Layer::Shapes,       Layer::CenterOfMass, Layer::ReferenceFace,
                               Layer::SidePlanes,   Layer::ClipPolygons, Layer::Dropped,
                               Layer::IncidentFace, Layer::Candidates,   Layer::Normals,
                               Layer::Contacts,     Layer::Reduced,      Layer::Ids,
                               Layer::Impulses,     Layer::Velocities,   Layer::Names};

struct Role {
  const char* name;
  draw::Color color;
  draw::ColorUse use = draw::ColorUse::Line;
};
constexpr std::array kRoles = {Role{"shape_a", draw::kShapeA, draw::ColorUse::Fill},
                               Role{"shape_b", draw::kShapeB, draw::ColorUse::Fill},
                               Role{"edge", draw::kShapeEdge},
                               Role{"reference_face", draw::kReferenceFace},
                               Role{"side_planes", draw::kSidePlane},
                               Role{"incident_face", draw::kIncidentFace},
                               Role{"clip_polygons", draw::kClipPolygon},
                               Role{"contacts", draw::kContact},
                               Role{"dropped", draw::kDropped},
                               Role{"velocities", draw::kMotion},
                               Role{"impulses", draw::kImpulse},
                               Role{"normals", draw::kNormal},
                               Role{"finding", draw::kAxisText, draw::ColorUse::Text},
                               Role{"text", draw::kText, draw::ColorUse::Text},
                               Role{"quiet", draw::kQuietText, draw::ColorUse::Text},
                               Role{"ground", draw::kWhite, draw::ColorUse::Halo}};

ordered_json colors_of(draw::Theme theme) {
  ordered_json colors;
  for (const Role& role : kRoles)
    colors[role.name] =
        vector::hex(draw::themed(role.color, role.use, theme, draw::ground_of(theme)));
  return colors;
}

ordered_json vector_json(const Vec3d& v) { return {v.x(), v.y(), v.z()}; }

ordered_json camera_json(const draw::Camera& camera) {
  const Vec3d forward = camera.up().cross(camera.right());
  return {{"eye", vector_json(camera.eye())},
          {"forward", vector_json(forward)},
          {"perspective", camera.is_perspective()},
          // Height of the view at one metre, or everywhere.
          {"height", camera.viewport().height / camera.pixels_per_metre(camera.eye() + forward)}};
}

/// `bodies`: their numbers. Marks are triples of a frame, a body and another one or -1; `where`: their
/// places, with as many digits as it takes to recognise a point.
ordered_json finding_json(const lint::Finding& finding, const std::map<std::string, int>& bodies) {
  ordered_json json{{"cause", finding.cause},
                    {"what", finding.what},
                    {"remedy", finding.remedy},
                    {"count", finding.count},
                    {"of", finding.of}};
  if (finding.a.empty()) return json;
  json.update({{"frame", finding.frame},
               {"a", finding.a},
               {"b", finding.b},
               {"said", finding.said},
               {"is", finding.is}});
  if (const auto of = bodies.find(finding.fits.first);
      of != bodies.end() && finding.fits.second > 0)
    json["fits"] = {of->second, finding.fits.second};
  const auto any_has = [&](auto what) {
    return std::ranges::any_of(finding.marks, [&](const auto& mark) { return bool(mark.*what); });
  };
  const bool has_normals = any_has(&lint::Mark::normal), has_paths = any_has(&lint::Mark::path);
  for (const lint::Mark& mark : finding.marks) {
    for (const int number :
         {mark.frame, bodies.at(mark.a), mark.b.empty() ? -1 : bodies.at(mark.b)})
      json["marks"].push_back(number);
    const auto add = [&](const char* list, const std::optional<Vec3d>& vector) {
      ordered_json& entry = json[list].emplace_back(nullptr);
      for (int i = 0; vector && i < 3; ++i)
        entry.push_back(std::strtod(printed("%.4g", (*vector)[i]).c_str(), nullptr));
    };
    add("where", mark.at);
    if (has_normals) add("normals", mark.normal);
    if (!has_paths) continue;
    add("from", mark.path ? std::optional((*mark.path)[0]) : std::nullopt);
    add("steps",
        mark.path ? std::optional<Vec3d>((*mark.path)[1] - (*mark.path)[0]) : std::nullopt);
  }
  return json;
}

/// Compressed, as a text that is safe in HTML: each 13 bits as two of 91 characters.
std::string packed(std::string_view bytes) {
  std::string text;
  const auto put = [&](unsigned digit) {
    text += static_cast<char>(digit + (digit > 24 ? 36 : 35));
  };
  unsigned bits = 0, count = 0;
  for (const std::uint8_t byte :
       zlib_stream({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, 9)) {
    bits |= unsigned{byte} << count;
    count += 8;
    if (count < 13) continue;
    put((bits & 8191) % 91);
    put((bits & 8191) / 91);
    bits >>= 13;
    count -= 13;
  }
  if (count > 0) put(bits % 91);
  if (count > 6) put(bits / 91);
  return text;
}

}  // namespace

Viewer::Viewer(const draw::Staging& staging, const PictureOrigin& origin, lint::LintOptions options,
               std::function<bool(lint::Finding&)> is_known)
    : staging_(staging),
      origin_(origin),
      facts_(*staging.header),
      ignores_(!options.ignored.empty()),
      linter_(*staging.header,
              (
                  options.is_marked = [](int) { return true; }, std::move(options))),
      is_known_(std::move(is_known)) {}

void Viewer::add(const trace::Frame& frame) {
  titles_.push_back(draw::fill_title(staging_, frame));
  facts_.add(frame);
  linter_.frame(frame);
}

std::string Viewer::html() {
  ordered_json page{{"titles", titles_},
                    {"title", origin_.scenario},
                    {"command", origin_.command},
                    {"version", origin_.version},
                    {"light", colors_of(draw::Theme::Light)},
                    {"dark", colors_of(draw::Theme::Dark)},
                    {"tones",
                     {draw::toned(draw::kWhite, 1).r, draw::toned(draw::kWhite, 0.3).r,
                      draw::toned(draw::kWhite, 0).r}},
                    {"tone_borders", draw::kToneBorders},
                    {"quantities", ordered_json::object()}};
  for (const find::Quantity& known : find::pair_quantities())
    page["quantities"][known.name] = known.is_change;
  if (!staging_.cells) page["camera"] = camera_json(staging_.camera);
  page["layers"] = ordered_json::array();
  for (const Layer layer : kShown) {
    const std::string name(name_of(layer));
    std::string words = name;
    std::ranges::replace(words, '_', ' ');
    page["layers"].push_back(
        {{"name", name},
         {"words", words},
         {"on", layer == Layer::Shapes || layer == Layer::Contacts || staging_.view.shows(layer)}});
  }
  page["findings"] = ordered_json::array();
  std::map<std::string, int> bodies;
  for (const trace::Shape& shape : staging_.header->shapes)
    bodies.emplace(shape.name, count_of(bodies));
  page["leaves_out"] = ignores_;  // findings, by --ignore or --known
  for (lint::Finding& finding : linter_.findings())
    if (is_known_ && is_known_(finding))
      page["leaves_out"] = true;
    else if (lint::is_reported(finding))
      page["findings"].push_back(finding_json(finding, bodies));

  const std::map<std::string_view, std::string> values{
      {"GENERATOR", vector::escaped("contactscope " + origin_.version)},
      {"NAME", vector::escaped(origin_.scenario)},
      {"STYLE", std::string(viewer_style())},
      {"DATA", packed(facts_.bytes(std::move(page)))},
      {"THREE", packed(three_script())},
      {"SCRIPT", std::string(viewer_script())}};
  std::string html;
  for (std::string_view rest = viewer_markup(); !rest.empty();) {
    const std::size_t begin = rest.find('@'), end = rest.find('@', begin + 1);
    html += rest.substr(0, begin);
    if (begin == std::string_view::npos) break;
    html += values.at(rest.substr(begin + 1, end - begin - 1));
    rest.remove_prefix(end + 1);
  }
  return html;
}

}  // namespace contactscope::viewer
