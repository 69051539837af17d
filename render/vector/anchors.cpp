#include "vector/pieces.h"

#include <nlohmann/json.hpp>

#include "draw/scene/pairs.h"
#include "draw/scene/points.h"

namespace contactscope::vector {
namespace {

using Json = nlohmann::ordered_json;
using draw::Point2;
using draw::Rect;
using Extent = Eigen::AlignedBox2d;  // pixels

constexpr int kSchema = 1;
// Pixels at 720 lines: the length of drawn normals.
constexpr double kNormalLength = 78;

/// Rounds to 1 / steps.
double rounded(double value, double steps) { return std::round(value * steps) / steps; }

Rect box_of(const draw::Text& text) {
  const double width = text_width(text.text, text.size, text.weight);
  const double up = ascent(text.size, text.weight), down = descent(text.size, text.weight);
  const double left = text.at.x - 0.5 * static_cast<double>(text.align) * width;
  return {left, text.at.y - up, width, up + down};
}

void extend(const draw::Fill& fill, Extent& extent) {
  for (const Point2& corner : fill.polygon) extent.extend(draw::flat(corner));
}
void extend(const draw::Stroke& stroke, Extent& extent) {
  extent.extend(draw::flat(stroke.from)).extend(draw::flat(stroke.to));
}
void extend(const draw::Disc& disc, Extent& extent) {
  const Vec2d center = draw::flat(disc.center), reach = Vec2d::Constant(disc.outer);
  extent.extend(Vec2d(center - reach)).extend(Vec2d(center + reach));
}
void extend(const draw::Text& text, Extent& extent) {
  const Rect box = box_of(text);
  extent.extend(draw::flat(draw::pixel(box.x, box.y)));
  extent.extend(draw::flat(draw::pixel(box.right(), box.bottom())));
}

struct Anchors {
  const draw::Staging& staging;
  const trace::Frame& frame;
  const draw::Drawing& drawing;
  const draw::Camera& camera = staging.camera;

  /// `all`: horizontal and vertical numbers by turns.
  Json numbers(const std::vector<double>& all) const {
    Json json;
    for (const double number : all) {
      const int side = json["pixels"].size() % 2 == 0 ? drawing.width : drawing.height;
      json["pixels"].push_back(rounded(number, 100));
      json["fraction"].push_back(rounded(number / side, 1e5));
    }
    return json;
  }
  Json place(const Point2& at) const { return numbers({at.x, at.y}); }
  Json place(const Rect& rect) const { return numbers({rect.x, rect.y, rect.width, rect.height}); }

  /// Position of a point in the view; nullopt if it is outside.
  std::optional<Point2> seen(const Vec3d& at) const {
    const std::optional<Point2> found = camera.project(at);
    if (!found || !staging.layout.view.contains(*found)) return std::nullopt;
    return found;
  }

  static void add_pair(const trace::Pair& pair, Json& json) {
    json["pair"] = Json::array({pair.a, pair.b});
    if (!pair.label.empty()) json["label"] = pair.label;
  }

  Json points() const {
    Json all = Json::array();
    for (const trace::Pair& pair : frame.pairs) {
      int number = 0;  // index within the pair
      for (const auto& [manifold, point] : draw::all_points(pair)) {
        ++number;
        const std::optional<Point2> at = seen(point->position);
        if (!at) continue;
        Json& json = all.emplace_back();
        add_pair(pair, json);
        json["number"] = number;
        if (!point->id.empty()) json["id"] = point->id;
        json["separation"] = point->separation;
        json["at"] = place(*at);
      }
    }
    return all;
  }

  Json normals() const {
    Json all = Json::array();
    for (const trace::Pair& pair : frame.pairs) {
      for (const trace::Manifold& manifold : pair.manifolds) {
        if (manifold.points.empty()) continue;
        const Vec3d from = draw::mean_of(mapped(manifold.points, &trace::Point::position));
        const std::optional<Point2> at = seen(from);
        if (!at) continue;
        const double metres = staging.layout.px(kNormalLength) / camera.pixels_per_metre(from);
        const std::optional<Point2> tip = camera.project(from + metres * manifold.normal);
        if (!tip) continue;
        Json& json = all.emplace_back();
        add_pair(pair, json);
        json["at"] = place(*at);
        json["tip"] = place(*tip);
      }
    }
    return all;
  }

  void add_face(const trace::Pair& pair, const char* name, const trace::ClipFace& face,
                Json& all) const {
    if (face.polygon.size() < 3) return;
    const std::optional<Point2> middle = seen(draw::mean_of(face.polygon));
    if (!middle) return;
    Json& json = all.emplace_back(Json{{"name", name}, {"shape", face.shape}, {"face", face.face}});
    add_pair(pair, json);
    json["at"] = place(*middle);
    json["polygon"] = Json::array();
    for (const Point2& corner : draw::project_polygon(camera, face.polygon))
      json["polygon"].push_back(place(corner));
  }

  Json faces() const {
    Json all = Json::array();
    for (const trace::Pair& pair : frame.pairs) {
      if (!pair.clip) continue;
      add_face(pair, "reference face", pair.clip->reference, all);
      add_face(pair, "incident face", pair.clip->incident, all);
    }
    return all;
  }

  Json shapes() const {
    Json all = Json::array();
    for (const draw::PlacedShape& shape : draw::place_shapes(staging.meshes, frame)) {
      const std::optional<Point2> at = seen(shape.pose.transform(shape.traced().center_of_mass));
      if (!at || shape.traced().half_space) continue;
      all.push_back({{"name", shape.traced().name}, {"at", place(*at)}});
    }
    return all;
  }

  Json labels() const {
    Json all = Json::array();
    for (const draw::Callout& callout : drawing.callouts) {
      const auto& text = std::get<draw::Text>(drawing.primitives[callout.text]);
      Json& json = all.emplace_back(Json{{"text", text.text}, {"layer", callout.layer}});
      if (!callout.pair.empty()) json["pair"] = callout.pair;
      if (const std::string of = thing_at(callout.at); !of.empty()) json["of"] = of;
      json["at"] = place(callout.at);
      json["box"] = place(box_of(text));
    }
    return all;
  }

  /// Name of the contact point or shape at a position; empty without one.
  std::string thing_at(const Point2& at) const {
    const auto is_there = [&](const Vec3d& position) {
      const std::optional<Point2> found = seen(position);
      return found && distance(*found, at) < 0.5f;
    };
    for (const trace::Pair& pair : frame.pairs)
      for (const auto& [manifold, point] : draw::all_points(pair))
        if (is_there(point->position)) return "point " + point->id;
    for (const draw::PlacedShape& shape : draw::place_shapes(staging.meshes, frame)) {
      if (is_there(shape.pose.transform(shape.traced().center_of_mass)))
        return "shape " + shape.traced().name;
    }
    return {};
  }

  /// The view, and bounds of captions, legend, panels, insets and cells.
  Json rectangles() const {
    Json all = Json::array();
    const auto add = [&](const std::string& name, const Rect& rect) {
      all.push_back({{"name", name}, {"rect", place(rect)}});
    };
    add("view", staging.layout.view);
    std::vector<std::pair<std::string, Extent>> extents;
    for (std::size_t i = 0; i < drawing.parts.size(); ++i) {
      const draw::Part& part = drawing.parts[i];
      const bool named = part.layer == draw::kPanelPart || part.layer == draw::kInsetPart ||
                         part.layer == draw::kPlanePart;
      // A label of the legend is in the view, next to its object.
      const bool caption =
          part.role.empty() && (part.layer == draw::kTitlePart || part.layer == draw::kSourcePart ||
                                part.layer == draw::kMomentPart || part.layer == draw::kLegendPart);
      if (!named && !caption) continue;
      const std::string name = part.role.empty() ? part.layer : part.layer + " " + part.role;
      auto found = std::ranges::find(extents, name, [](const auto& entry) { return entry.first; });
      if (found == extents.end()) found = extents.insert(found, {name, {}});
      const std::size_t end =
          i + 1 < drawing.parts.size() ? drawing.parts[i + 1].first : drawing.primitives.size();
      for (std::size_t k = part.first; k < end; ++k)
        std::visit([&](const auto& shape) { extend(shape, found->second); }, drawing.primitives[k]);
    }
    for (const auto& [name, extent] : extents) {
      const Vec2d sizes = extent.sizes();
      if (!extent.isEmpty()) add(name, {extent.min().x(), extent.min().y(), sizes.x(), sizes.y()});
    }
    return all;
  }

  std::string write() const {
    Json json{{"schema", kSchema},
              {"scenario", staging.header->scenario},
              {"frame", frame.frame},
              {"view", staging.view.name},
              {"size", Json::array({drawing.width, drawing.height})}};
    // A contact plane shows pairs in cells without a camera.
    const bool space = !staging.cells;
    json["points"] = space ? points() : Json::array();
    json["normals"] = space ? normals() : Json::array();
    json["faces"] = space ? faces() : Json::array();
    json["shapes"] = space ? shapes() : Json::array();
    json["labels"] = labels();
    json["rectangles"] = rectangles();
    return json.dump(1) + "\n";
  }
};

}  // namespace

std::string anchors_of(const draw::Staging& staging, const trace::Frame& frame,
                       const draw::Drawing& drawing) {
  return Anchors{staging, frame, drawing}.write();
}

}  // namespace contactscope::vector
