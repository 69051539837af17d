#include "study/closed_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/at.h"

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
