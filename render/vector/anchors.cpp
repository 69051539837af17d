#include "vector/anchors.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "draw/scene/points.h"
#include "image/font.h"

namespace contactscope::vector {
namespace {

using Json = nlohmann::ordered_json;
using draw::Point2;
using draw::Rect;

constexpr int kSchema = 1;
// Pixels at 720 lines: the length of drawn normals.
constexpr double kNormalLength = 78;

/// Rounds to 1 / steps.
double rounded(double value, double steps) {
  return std::round(value * steps) / steps;
}

/// A bounding box of points.
struct Reach {
  double left = 1e30, top = 1e30, right = -1e30, bottom = -1e30;

  void extend(const Point2& p, double around = 0) {
    left = std::min(left, p.x - around);
    top = std::min(top, p.y - around);
    right = std::max(right, p.x + around);
    bottom = std::max(bottom, p.y + around);
  }
  bool empty() const { return left > right; }
  Rect rect() const { return {left, top, right - left, bottom - top}; }
};

Rect box_of(const draw::Text& text) {
  const double width = text_width(text.text, text.size, text.weight);
  const double up = ascent(text.size, text.weight), down = descent(text.size, text.weight);
  const double left = text.at.x - 0.5 * static_cast<double>(text.align) * width;
  return {left, text.at.y - up, width, up + down};
}

void extend(const draw::Fill& fill, Reach& extent) {
  for (const Point2& corner : fill.polygon) extent.extend(corner);
}
void extend(const draw::Stroke& stroke, Reach& extent) {
  extent.extend(stroke.from);
  extent.extend(stroke.to);
}
void extend(const draw::Disc& disc, Reach& extent) {
  extent.extend(disc.center, disc.outer);
}
void extend(const draw::Text& text, Reach& extent) {
  const Rect box = box_of(text);
  extent.extend(draw::pixel(box.x, box.y));
  extent.extend(draw::pixel(box.right(), box.bottom()));
}

struct Anchors {
  const draw::Staging& staging;
  const trace::Frame& frame;
  const draw::Drawing& drawing;
  const draw::Camera& camera = staging.camera;

  Json place(const Point2& at) const {
    Json json;
    json["pixels"] = {rounded(at.x, 100), rounded(at.y, 100)};
    json["fraction"] = {rounded(at.x / drawing.width, 1e5), rounded(at.y / drawing.height, 1e5)};
    return json;
  }

  Json place(const Rect& rect) const {
    Json json;
    json["pixels"] = {rounded(rect.x, 100), rounded(rect.y, 100), rounded(rect.width, 100),
                      rounded(rect.height, 100)};
    json["fraction"] = {rounded(rect.x / drawing.width, 1e5), rounded(rect.y / drawing.height, 1e5),
                        rounded(rect.width / drawing.width, 1e5),
                        rounded(rect.height / drawing.height, 1e5)};
    return json;
  }

  /// Position of a point in the view; nullopt if it is outside.
  std::optional<Point2> seen(const Vec3d& at) const {
    const std::optional<Point2> found = camera.project(at);
    if (!found || !staging.layout.view.contains(*found)) return std::nullopt;
    return found;
  }

  static Json pair_of(const trace::Pair& pair) {
    Json json = {pair.a, pair.b};
    return json;
  }

  Json points() const {
    Json all = Json::array();
    for (const trace::Pair& pair : frame.pairs) {
      int number = 0;  // index within the pair
      for (const trace::Manifold& manifold : pair.manifolds) {
        for (const trace::Point& point : manifold.points) {
          ++number;
          const std::optional<Point2> at = seen(point.position);
          if (!at) continue;
          Json json;
          json["pair"] = pair_of(pair);
          if (!pair.label.empty()) json["label"] = pair.label;
          json["number"] = number;
          if (!point.id.empty()) json["id"] = point.id;
          json["separation"] = point.separation;
          json["at"] = place(*at);
          all.push_back(std::move(json));
        }
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
        Json json;
        json["pair"] = pair_of(pair);
        if (!pair.label.empty()) json["label"] = pair.label;
        json["at"] = place(*at);
        json["tip"] = place(*tip);
        all.push_back(std::move(json));
      }
    }
    return all;
  }

  void add_face(const trace::Pair& pair, const std::string& name, const std::string& shape,
                int face, const trace::Polygon& polygon, Json& all) const {
    if (polygon.size() < 3) return;
    const std::optional<Point2> middle = seen(draw::mean_of(polygon));
    if (!middle) return;
    Json json;
    json["name"] = name;
    json["shape"] = shape;
    json["face"] = face;
    json["pair"] = pair_of(pair);
    if (!pair.label.empty()) json["label"] = pair.label;
    json["at"] = place(*middle);
    Json corners = Json::array();
    for (const Point2& corner : draw::project_polygon(camera, polygon))
      corners.push_back(place(corner));
    json["polygon"] = std::move(corners);
    all.push_back(std::move(json));
  }

  Json faces() const {
    Json all = Json::array();
    for (const trace::Pair& pair : frame.pairs) {
      if (!pair.clip) continue;
      const trace::Clip& clip = *pair.clip;
      add_face(pair, "reference face", clip.reference.shape, clip.reference.face,
               clip.reference.polygon, all);
      add_face(pair, "incident face", clip.incident.shape, clip.incident.face,
               clip.incident.polygon, all);
    }
    return all;
  }

  Json shapes() const {
    Json all = Json::array();
    for (const draw::PlacedShape& shape : draw::place_shapes(staging.meshes, frame)) {
      const std::optional<Point2> at = seen(shape.pose.transform(shape.traced().center_of_mass));
      if (!at || shape.traced().half_space) continue;
      Json json;
      json["name"] = shape.traced().name;
      json["at"] = place(*at);
      all.push_back(std::move(json));
    }
    return all;
  }

  Json labels() const {
    Json all = Json::array();
    for (const draw::Callout& callout : drawing.callouts) {
      const auto& text = std::get<draw::Text>(drawing.primitives[callout.text]);
      Json json;
      json["text"] = text.text;
      json["layer"] = callout.layer;
      if (!callout.pair.empty()) json["pair"] = callout.pair;
      const std::string of = callout.of.empty() ? thing_at(callout.at) : callout.of;
      if (!of.empty()) json["of"] = of;
      json["at"] = place(callout.at);
      json["box"] = place(box_of(text));
      all.push_back(std::move(json));
    }
    return all;
  }

  /// Name of the contact point or shape at a position; empty without one.
  std::string thing_at(const Point2& at) const {
    const auto is_there = [&](const Vec3d& position) {
      const std::optional<Point2> found = seen(position);
      return found && distance(*found, at) < 0.5f;
    };
    for (const trace::Pair& pair : frame.pairs) {
      for (const trace::Manifold& manifold : pair.manifolds) {
        for (const trace::Point& point : manifold.points) {
          if (is_there(point.position)) return "point " + point.id;
        }
      }
    }
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
      Json json;
      json["name"] = name;
      json["rect"] = place(rect);
      all.push_back(std::move(json));
    };
    add("view", staging.layout.view);
    std::vector<std::pair<std::string, Reach>> extents;
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
      if (!extent.empty()) add(name, extent.rect());
    }
    return all;
  }

  std::string write() const {
    Json json;
    json["schema"] = kSchema;
    json["scenario"] = staging.header->scenario;
    json["frame"] = frame.frame;
    json["view"] = staging.view.name;
    json["size"] = {drawing.width, drawing.height};
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
