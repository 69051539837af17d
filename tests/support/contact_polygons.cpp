#include "support/contact_polygons.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace contactscope::test {

ContactPolygon random_contact_polygon(Random& random, int count) {
  constexpr double kTurn = 2 * std::numbers::pi;
  const double flat = std::pow(2.5, random.uniform(-1, 0));
  const double tilt = random.uniform(0, 0.5);
  const double downhill = random.uniform(0, kTurn);
  const Pose<double> pose = random.pose(5);
  std::vector<double> angles;
  for (int i = 0; i < count; ++i) angles.push_back(random.uniform(0, kTurn));
  std::sort(angles.begin(), angles.end());

  ContactPolygon polygon{{}, pose.rotation * Vec3d::UnitY()};
  for (const double angle : angles) {
    const Vec3d place(flat * std::sin(angle), 0, std::cos(angle));
    const double below = place.x() * std::sin(downhill) + place.z() * std::cos(downhill);
    const double depth = 0.005 * (1 + tilt * below + random.uniform(-0.01, 0.01));
    const auto edge = static_cast<std::uint32_t>(polygon.points.size());
    polygon.points.push_back({pose.rotation * place + pose.position, -depth,
                              FeatureId::of({Owner::A, edge}, {Owner::B, edge})});
  }
  return polygon;
}

}  // namespace contactscope::test
