#include "draw/scene/scene.h"

namespace contactscope::draw {
namespace {

constexpr double kLarge = 4;     // radii of the median body: a floor, a tray, a landscape
constexpr double kInner = 0.75;  // share of the bodies that set the scale
constexpr double kFree = 1.5;    // of their reach
constexpr double kInContact = 3;
constexpr double kMinReach = 8;        // radii of the median body
constexpr double kFarOff = 4;          // reaches: surely no part of the scene
constexpr double kAround = 0.15;       // of the region's size, on each side
constexpr std::size_t kMinBodies = 8;  // of a scene that has bodies which fly off

/// A body in a frame.
struct Spot {
  Vec3d center;
  double radius;
  bool touches;
};

double quantile(std::vector<double> values, double share) {
  const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, values.begin() + place);
  return values[static_cast<std::size_t>(place)];
}

Vec3d median_of(const std::vector<Spot>& spots) {
  Vec3d middle;
  for (int axis = 0; axis < 3; ++axis)
    middle[axis] =
        quantile(mapped(spots, [&](const Spot& spot) { return spot.center[axis]; }), 0.5);
  return middle;
}

bool is_body(const ShapeMesh& mesh) { return mesh.radius > 0 && std::isfinite(mesh.radius); }

}  // namespace

std::vector<bool> shapes_in_contact(const ShapeMeshes& meshes, const trace::Frame& frame) {
  std::vector<bool> touches(meshes.size(), false);
  for (const trace::Pair& pair : frame.pairs) {
    const auto has_points = [](const trace::Manifold& manifold) {
      return !manifold.points.empty();
    };
    if (std::ranges::none_of(pair.manifolds, has_points)) continue;
    for (const std::string* name : {&pair.a, &pair.b})
      if (const auto place = meshes.find(*name)) touches[*place] = true;
  }
  return touches;
}

std::optional<HomeRegion> home_region(const ShapeMeshes& meshes,
                                      const std::vector<trace::Frame>& frames,
                                      const std::vector<bool>& only) {
  HomeRegion home;
  const auto counts = [&](std::size_t place) {
    return is_body(meshes[place]) && (only.empty() || only[place]);
  };
  std::vector<double> radii;
  for (std::size_t i = 0; i < meshes.size(); ++i)
    if (counts(i)) radii.push_back(meshes[i].radius);
  if (radii.empty()) return std::nullopt;
  const double radius = quantile(radii, 0.5);  // of two the smaller one
  for (const ShapeMesh& mesh : meshes)
    home.is_large.push_back(!is_body(mesh) || mesh.radius > kLarge * radius);

  std::vector<Spot> spots, large;
  for (const trace::Frame& frame : frames) {
    const std::vector<bool> touches = shapes_in_contact(meshes, frame);
    for (const auto& [name, pose] : frame.poses) {
      const auto place = meshes.find(name);
      if (!place || !counts(*place)) continue;
      const Vec3d center = pose.transform(meshes[*place].shape->center_of_mass);
      if (!center.allFinite()) continue;
      (home.is_large[*place] ? large : spots)
          .push_back({center, meshes[*place].radius, touches[*place]});
    }
  }
  std::vector<Spot> inner;
  std::ranges::copy_if(spots, std::back_inserter(inner), &Spot::touches);
  if (inner.empty()) inner = spots;
  if (inner.empty()) return std::nullopt;
  home.middle = median_of(inner);
  const auto away = [&](const Spot& spot) { return (spot.center - home.middle).norm(); };
  const double scale = quantile(mapped(inner, away), kInner);
  home.reach = std::max(kFree * scale, kMinReach * radius);
  home.reach_in_contact = std::max(kInContact * scale, kMinReach * radius);
  for (const Spot& spot : spots) {
    const bool inside = home.holds(spot.center, spot.touches);
    home.cuts_off = home.cuts_off || !inside;
    home.fly_off = home.fly_off || away(spot) > kFarOff * home.reach_in_contact;
    if (!inside) continue;
    home.box.extend(Vec3d(spot.center + Vec3d::Constant(spot.radius)));
    home.box.extend(Vec3d(spot.center - Vec3d::Constant(spot.radius)));
  }
  if (radii.size() < kMinBodies) home.fly_off = false;
  const Vec3d more = Vec3d::Constant(kAround * home.box.sizes().maxCoeff());
  home.around = {home.box.min() - more, home.box.max() + more};
  for (const Spot& spot : large) {
    const double out = (spot.center - home.around.center()).norm() + spot.radius;
    home.cuts_off = home.cuts_off || out > 0.5 * home.around.diagonal().norm();
  }
  return home;
}

void keep_home(const HomeRegion& home, const std::vector<bool>& in_contact,
               std::vector<PlacedShape>& shapes) {
  std::erase_if(shapes, [&](const PlacedShape& shape) {
    if (home.is_large[shape.place]) return false;
    const Vec3d center = shape.pose.transform(shape.traced().center_of_mass);
    return !center.allFinite() || !home.holds(center, in_contact[shape.place]);
  });
  for (PlacedShape& shape : shapes) {
    if (!home.is_large[shape.place]) continue;
    for (Vec3d& vertex : shape.vertices)
      vertex = vertex.cwiseMax(home.around.min()).cwiseMin(home.around.max());
  }
}

}  // namespace contactscope::draw
