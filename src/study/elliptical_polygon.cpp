#include "study/elliptical_polygon.h"

#include <cmath>
#include <numbers>

#include "core/pose.h"
#include "study/uniform.h"

namespace contactscope {
namespace {

Vec3d uniform_vector(std::mt19937_64& engine, double reach) {
  Vec3d v;
  for (int axis = 0; axis < 3; ++axis) v[axis] = uniform(engine, -reach, reach);
  return v;
}

}  // namespace

ContactPolygon elliptical_polygon(std::mt19937_64& engine, int count) {
  const double long_axis = uniform(engine, 0.1, 1);
  const double short_axis = long_axis / std::pow(5.0, uniform(engine, 0, 1));
  const double start = uniform(engine, 0, 2 * std::numbers::pi);
  const double mean_depth = uniform(engine, 0.001, 0.01);
  const double tilt = uniform(engine, 0, 1);
  const double downhill = uniform(engine, 0, 2 * std::numbers::pi);
  const Pose<double> pose{uniform_rotation(engine), uniform_vector(engine, 5)};

  ContactPolygon polygon;
  const Vec3d normal = pose.rotation * Vec3d::UnitZ();
  polygon.normal = normal.cast<float>();
  for (int i = 0; i < count; ++i) {
    const double jitter = uniform(engine, -0.4, 0.4);
    const double angle = start + 2 * std::numbers::pi * (i + jitter) / count;
    const Vec3d local(long_axis * std::cos(angle), short_axis * std::sin(angle), 0);
    const Vec3d world = pose.rotation * local + pose.position;
    const double across =
        (local.x() * std::cos(downhill) + local.y() * std::sin(downhill)) / long_axis;
    const double depth = mean_depth * (1 + tilt * across + uniform(engine, -0.05, 0.05));
    const auto edge = static_cast<std::uint32_t>(i);
    polygon.points.push_back({world.cast<float>(), static_cast<float>(-depth),
                              FeatureId::of({Owner::A, edge}, {Owner::B, edge})});
  }
  return polygon;
}

ContactPolygon neighbouring_frame(const ContactPolygon& polygon, double part,
                                  std::mt19937_64& engine) {
  Vec3d middle = Vec3d::Zero();
  for (const ContactPoint<float>& point : polygon.points) middle += point.position.cast<double>();
  middle /= static_cast<double>(polygon.points.size());
  const Vec3d normal = polygon.normal.cast<double>().normalized();
  ContactPolygon result = polygon;
  for (ContactPoint<float>& point : result.points) {
    const Vec3d arm = point.position.cast<double>() - middle;
    const Vec3d across = normal.cross(arm);
    const double outwards = uniform(engine, -0.7 * part, 0.7 * part);
    const double around = uniform(engine, -0.7 * part, 0.7 * part);
    point.position = Vec3d(middle + (1 + outwards) * arm + around * across).cast<float>();
    point.separation *= static_cast<float>(1 + uniform(engine, -part, part));
  }
  return result;
}

}  // namespace contactscope
