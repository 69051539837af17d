#include "study/random_cases.h"

#include "geometry/hull_builder.h"

namespace contactscope {
namespace {

using LongPoint = Vec3<long double>;

LongPoint nearest_on_segment(const LongPoint& p, const LongPoint& from, const LongPoint& to) {
  const LongPoint offset = to - from;
  const long double part = (p - from).dot(offset) / offset.squaredNorm();
  return from + std::clamp(part, 0.0L, 1.0L) * offset;
}

LongPoint nearest_on_triangle(const LongPoint& p, const std::array<LongPoint, 3>& corners) {
  const LongPoint normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  bool above = true;
  LongPoint nearest = corners[0];
  for (int k = 0; k < 3; ++k) {
    const LongPoint &from = at(corners, k), &to = at(corners, (k + 1) % 3);
    above = above && normal.dot((to - from).cross(p - from)) >= 0;
    const LongPoint on_side = nearest_on_segment(p, from, to);
    if ((on_side - p).squaredNorm() < (nearest - p).squaredNorm()) nearest = on_side;
  }
  return above ? LongPoint(p - (p - corners[0]).dot(normal) / normal.squaredNorm() * normal)
               : nearest;
}

/// Half the solid angle of a triangle seen from the origin (van Oosterom, Strackee 1983).
long double half_solid_angle(const LongPoint& a, const LongPoint& b, const LongPoint& c) {
  const long double la = a.norm(), lb = b.norm(), lc = c.norm();
  return std::atan2(a.dot(b.cross(c)),
                    la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

}  // namespace

Quatd uniform_rotation(std::mt19937_64& engine) {
  const double share = uniform(engine, 0, 1);
  const double first = uniform(engine, 0, 2 * std::numbers::pi);
  const double second = uniform(engine, 0, 2 * std::numbers::pi);
  const double a = std::sqrt(1 - share);
  const double b = std::sqrt(share);
  return Quatd(b * std::cos(second), a * std::sin(first), a * std::cos(first),
               b * std::sin(second));
}

Hull<double> ellipsoid_hull(std::mt19937_64& engine, int vertices, double size) {
  const Quatd turn = uniform_rotation(engine);
  Vec3d axes;
  for (int i = 0; i < 3; ++i) axes[i] = size * uniform(engine, 0.5, 1);
  std::vector<Vec3d> points;
  for (int i = 0; i < vertices; ++i)
    points.push_back(turn * Vec3d(axes.cwiseProduct(random_direction(engine))));
  return build_hull(points);
}

std::mt19937_64 case_engine(std::uint64_t seed, int index, double one, double other) {
  const auto step = [](double value) {
    return static_cast<std::uint64_t>(std::llround(1000 * std::log10(value)) + 100000);
  };
  std::seed_seq mixed{seed, static_cast<std::uint64_t>(index), step(one), step(other)};
  return std::mt19937_64(mixed);
}

ContactPolygon elliptical_polygon(std::mt19937_64& engine, int count) {
  const double long_axis = uniform(engine, 0.1, 1);
  const double short_axis = long_axis / std::pow(5.0, uniform(engine, 0, 1));
  const double start = uniform(engine, 0, 2 * std::numbers::pi);
  const double mean_depth = uniform(engine, 0.001, 0.01);
  const double tilt = uniform(engine, 0, 1);
  const double downhill = uniform(engine, 0, 2 * std::numbers::pi);
  Pose<double> pose{uniform_rotation(engine), {}};
  for (int axis = 0; axis < 3; ++axis) pose.position[axis] = uniform(engine, -5, 5);
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

ContactPolygon levelled(const ContactPolygon& polygon, std::mt19937_64& engine) {
  constexpr double kRoundings = 1.5;
  double mean = 0;
  for (const ContactPoint<float>& point : polygon.points)
    mean += static_cast<double>(point.separation) / static_cast<double>(polygon.points.size());
  ContactPolygon result = polygon;
  for (ContactPoint<float>& point : result.points) {
    const double rounding = static_cast<double>(std::numeric_limits<float>::epsilon()) *
                            static_cast<double>(point.position.norm());
    point.separation =
        static_cast<float>(mean + rounding * uniform(engine, -kRoundings, kRoundings));
  }
  return result;
}

OverlappingHulls overlapping_hulls(std::mt19937_64& engine, int vertices) {
  for (;;) {
    OverlappingHulls hulls;
    hulls.size = std::pow(10.0, uniform(engine, -3, 3));
    hulls.a = ellipsoid_hull(engine, vertices, hulls.size);
    hulls.b = ellipsoid_hull(engine, vertices, hulls.size);
    hulls.b_in_a.rotation = uniform_rotation(engine);
    hulls.offset = random_direction(engine);
    hulls.turn_axis = random_direction(engine);
    const Vec3d direction = random_direction(engine);
    const double overlap = hulls.size * uniform(engine, 0.01, 0.1);
    double reach_a = 0, reach_b = 0;
    for (const Vec3d& v : hulls.a.vertices) reach_a = std::max(reach_a, direction.dot(v));
    for (const Vec3d& v : hulls.b.vertices)
      reach_b = std::max(reach_b, -direction.dot(hulls.b_in_a.rotate(v)));
    hulls.b_in_a.position = (reach_a + reach_b - overlap) * direction;
    hulls.deepest = oracle_axis(hulls.a, hulls.b, hulls.b_in_a);
    // Touching is no overlap: in float its result is chance.
    if (hulls.deepest.separation < -1e-3 * hulls.size) return hulls;
  }
}

TruePoint truth_at(const Mesh<double>& mesh, const Vec3d& place) {
  const LongPoint p = place.cast<long double>();
  long double least = std::numeric_limits<long double>::infinity(), angle = 0;
  LongPoint nearest = p;
  for (int triangle = 0; triangle < mesh.triangle_count(); ++triangle) {
    std::array<LongPoint, 3> corners;
    for (int k = 0; k < 3; ++k) at(corners, k) = mesh.corner(triangle, k).cast<long double>();
    const LongPoint found = nearest_on_triangle(p, corners);
    if ((found - p).squaredNorm() < least) {
      least = (found - p).squaredNorm();
      nearest = found;
    }
    angle += half_solid_angle(corners[0] - p, corners[1] - p, corners[2] - p);
  }
  const long double sign = angle > std::numbers::pi_v<long double> ? -1 : 1;
  const long double distance = std::sqrt(least);
  return {place, static_cast<double>(sign * distance),
          LongPoint(sign / distance * (p - nearest)).cast<double>()};
}

Mesh<double> ball_mesh(int meridians, double radius, double waves) {
  const int parallels = meridians / 2;
  std::vector<Vec3d> vertices = {{0, 0, radius}};
  for (int i = 1; i < parallels; ++i) {
    const double polar = std::numbers::pi * i / parallels;
    for (int k = 0; k < meridians; ++k) {
      const double around = 2 * std::numbers::pi * k / meridians;
      const double out = radius * (1 + waves * std::sin(3 * around) * std::sin(2 * polar));
      vertices.emplace_back(out * std::sin(polar) * std::cos(around),
                            out * std::sin(polar) * std::sin(around), out * std::cos(polar));
    }
  }
  vertices.emplace_back(0, 0, -radius);
  const int last = count_of(vertices) - 1;
  std::vector<std::array<int, 3>> triangles;
  for (int k = 0; k < meridians; ++k) {
    const int next = (k + 1) % meridians;
    triangles.push_back({0, 1 + k, 1 + next});
    for (int i = 1; i + 1 < parallels; ++i) {
      const int row = 1 + (i - 1) * meridians, below = row + meridians;
      triangles.push_back({row + k, below + k, below + next});
      triangles.push_back({row + k, below + next, row + next});
    }
    const int row = last - meridians;
    triangles.push_back({last, row + next, row + k});
  }
  return build_mesh(std::move(vertices), std::move(triangles));
}

}  // namespace contactscope
