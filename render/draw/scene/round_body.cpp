#include "draw/scene/visibility.h"

#include "draw/scene/palette.h"
#include "draw/scene/points.h"

namespace contactscope::draw {
namespace {

constexpr double kPi = std::numbers::pi;
// A chord of the outline deviates from its circle by 0.05% of the radius: a tenth of a pixel on a
// sphere half as high as the picture.
constexpr int kOutlineSteps = 96, kSmallOutlineSteps = 32;
// Share of the radius: points this near to a shadow's border are visible, like the outline's
// chords.
constexpr double kBorder = 1.2e-3, kSmallBorder = 0.011;
constexpr int kLongitudes = 48, kSmallLongitudes = 16;
constexpr double kLatitudeStep = 7.5 * kPi / 180, kSmallLatitudeStep = 24 * kPi / 180;

// The unit normals with n . towards >= least.
struct NormalCap {
  Vec3d towards;  // unit
  double least;

  double operator()(const Vec3d& normal) const { return normal.dot(towards) - least; }

  std::vector<Vec3d> border() const {
    const Vec3d u = any_perpendicular(towards), v = towards.cross(u);
    const double across = std::sqrt(std::max(0.0, 1 - least * least));
    static const std::vector<Vec2d> small = circle(kSmallOutlineSteps);
    return mapped(small, [&](const Vec2d& at) -> Vec3d {
      return least * towards + across * (at.x() * u + at.y() * v);
    });
  }
};

// On the outline the normal is perpendicular to the view ray: n . towards = offset.
struct Tangency {
  Vec3d towards;
  double offset;

  Tangency(const Camera& camera, const Vec3d& core, double radius)
      : towards(camera.is_perspective() ? Vec3d(camera.eye() - core) : camera.to_eye(core)),
        offset(camera.is_perspective() ? radius : 0) {}
  double front(const Vec3d& normal) const { return normal.dot(towards) - offset; }
  /// The normals in front.
  NormalCap cap() const {
    const double distance = towards.norm();
    return {towards / distance, offset / distance};
  }
};

Vec3d cut_between(const Vec3d& p, const Vec3d& q, double at_p, double at_q) {
  return zero_between(p, q, at_p, at_q).normalized();
}

// From pole to pole, so that no tone border is between two of them.
std::vector<double> latitudes_of(double step) {
  std::vector<double> latitudes = {0};
  const auto reach = [&](double angle) {
    const double from = latitudes.back();
    const int steps = std::max(1, static_cast<int>(std::ceil((angle - from) / step)));
    for (int i = 1; i <= steps; ++i) latitudes.push_back(from + (angle - from) * i / steps);
  };
  for (const double border : kToneBorders) reach(std::acos(border));
  reach(kPi);
  return latitudes;
}

// The sphere of directions about a pole, latitude by latitude.
std::vector<Vec3d> directions_around(const Vec3d& pole, const std::vector<double>& latitudes,
                                     int longitudes) {
  const Vec3d u = any_perpendicular(pole);
  const Vec3d v = pole.cross(u);
  const std::vector<Vec2d> around = circle(longitudes);
  std::vector<Vec3d> all;
  for (const double latitude : latitudes) {
    const double along = std::cos(latitude), across = std::sin(latitude);
    for (const Vec2d& at : around)
      all.push_back(latitude == 0 ? pole
                    : latitude == latitudes.back()
                        ? Vec3d(-pole)
                        : Vec3d(along * pole + across * at.x() * u + across * at.y() * v));
  }
  return all;
}

struct Patch {
  std::vector<Vec3d> normals;
  double lit = 0;
};

/// All bodies of a picture have the same.
const std::vector<Patch>& patches_around(const Vec3d& light) {
  thread_local Vec3d known(Vec3d::Zero());
  thread_local std::vector<Patch> patches;
  if (known == light) return patches;
  known = light;
  patches.clear();
  const std::vector<double> latitudes = latitudes_of(kLatitudeStep);
  const std::vector<Vec3d> directions = directions_around(light, latitudes, kLongitudes);
  constexpr std::size_t count = kLongitudes;
  for (std::size_t i = 0; i + 1 < latitudes.size(); ++i) {
    for (std::size_t j = 0; j < count; ++j) {
      const auto at = [&](std::size_t latitude, std::size_t longitude) {
        return directions[latitude * count + longitude % count];
      };
      Patch patch{{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)},
                  std::cos(0.5 * (latitudes[i] + latitudes[i + 1]))};
      if (i == 0) patch.normals.erase(patch.normals.begin());
      if (i + 2 == latitudes.size()) patch.normals.erase(patch.normals.begin() + 1);
      patches.push_back(std::move(patch));
    }
  }
  return patches;
}

Vec3d nearest_in(const std::vector<Vec3d>& core, const Vec3d& to) {
  const Vec3d along = core.back() - core.front();
  const double length = along.squaredNorm();
  if (length == 0) return core.front();
  return core.front() + std::clamp((to - core.front()).dot(along) / length, 0.0, 1.0) * along;
}

bool contains_eye(const RoundBody& body, const Camera& camera) {
  return camera.is_perspective() &&
         (camera.eye() - nearest_in(body.core, camera.eye())).norm() <= body.radius;
}

/// Corners of a rectangle on the screen that holds the body; nothing if a part may be behind the eye.
std::vector<Point2> corners_around(const RoundBody& body, const Camera& camera) {
  constexpr double kWider = 1.2;  // a ball in perspective is an ellipse, off the middle
  std::vector<Point2> corners;
  for (const Vec3d& core : body.core) {
    const Vec3d near = core + body.radius * camera.to_eye(core).normalized();
    const std::optional<Point2> middle = camera.project(core);
    if (!middle || !camera.project(near)) return {};
    const double reach = kWider * body.radius * camera.pixels_per_metre(near);
    corners.push_back(pixel(middle->x - reach, middle->y - reach));
    corners.push_back(pixel(middle->x + reach, middle->y + reach));
  }
  return corners;
}

// A point of the outline, and the surface's normal there.
struct OutlinePoint {
  Vec3d at, normal;
};

std::vector<OutlinePoint> outline_of(const RoundBody& body, const Camera& camera) {
  std::vector<OutlinePoint> outline;
  if (contains_eye(body, camera)) return outline;
  for (const Vec3d& core : body.core) {
    const bool first = &core == &body.core.front();
    const Vec3d outwards = core - (first ? body.core.back() : body.core.front());
    const NormalCap front = Tangency(camera, core, body.radius).cap();
    if (front.least >= 1) continue;  // next to the eye, which sees another part only
    // The normals that are perpendicular to a view ray form a circle about the direction to the
    // eye. This end has those that point outwards from the segment.
    const Vec3d& axis = front.towards;
    const double height = front.least;
    const double across = std::sqrt(1 - height * height);
    const Vec3d u = any_perpendicular(axis);
    const Vec3d v = axis.cross(u);
    const double constant = height * outwards.dot(axis);
    const double cosine = across * outwards.dot(u), sine = across * outwards.dot(v);
    const double swing = std::hypot(cosine, sine);
    double from = 0, to = 2 * kPi;
    const bool whole = swing <= std::abs(constant);
    if (whole) {
      if (constant < 0 || (constant == 0 && !first)) continue;
    } else {
      const double middle = std::atan2(sine, cosine);
      const double half = std::acos(-constant / swing);
      from = middle - half;
      to = middle + half;
    }
    const int around = body.small ? kSmallOutlineSteps : kOutlineSteps;
    const int steps = std::max(2, static_cast<int>(std::ceil(around * (to - from) / (2 * kPi))));
    for (int i = 0; i < (whole ? steps : steps + 1); ++i) {
      const double angle = from + (to - from) * i / steps;
      const Vec3d normal = height * axis + across * (std::cos(angle) * u + std::sin(angle) * v);
      outline.push_back({core + body.radius * normal, normal});
    }
  }
  return outline;
}

// Each part of a body, seen, is convex for each tone, because the light is on the eye's side: the
// balls behind a capsule's cylinder, the cylinder, and the half of a ball in front of it.
std::vector<RoundBody::Facet> tones_of(const RoundBody& body, const Camera& camera) {
  const Vec3d along = body.core.back() - body.core.front();
  const bool is_capsule = along.squaredNorm() > 0;
  const bool back_is_near = is_capsule && camera.faces(body.core.back(), along);
  const Vec3d& near = back_is_near ? body.core.back() : body.core.front();
  const Vec3d& far = back_is_near ? body.core.front() : body.core.back();
  const NormalCap lit[] = {{key_light(camera), -1},  // of all tones
                           {key_light(camera), kToneBorders[1]},
                           {key_light(camera), kToneBorders[0]}};
  const NormalCap half{is_capsule ? Vec3d((near - far).normalized()) : Vec3d::UnitX(), 0};
  const auto front = [&](const Vec3d& core) { return Tangency(camera, core, body.radius).cap(); };
  std::vector<RoundBody::Facet> tones;
  // The part around some of the core's ends whose normals are in all caps: it is the hull of the
  // `borders` of the first caps.
  const auto add = [&](std::initializer_list<Vec3d> cores, std::span<const NormalCap> caps,
                       std::size_t borders, double tone) {
    std::vector<Vec3d> points;
    std::vector<Vec2d> seen;
    for (std::size_t i = 0; i < borders; ++i) {
      if (std::abs(caps[i].least) >= 1) continue;
      std::vector<Vec3d> normals = caps[i].border();
      for (std::size_t j = 0; j < caps.size(); ++j)
        if (j != i) normals = clipped(normals, caps[j], cut_between);
      for (const Vec3d& core : cores)
        for (const Vec3d& normal : normals)
          if (const auto place = camera.project(core + body.radius * normal)) {
            points.push_back(core + body.radius * normal);
            seen.push_back(flat(*place));
          }
    }
    std::vector<Vec3d> polygon;
    for (const int corner : convex_outline(seen)) polygon.push_back(at(points, corner));
    if (polygon.size() >= 3) tones.push_back({std::move(polygon), tone + 1e-9});
  };
  const bool near_is_in_front = camera.faces(near, near - far);
  for (const NormalCap& cap : lit) add({far}, std::array{front(far), cap}, 2, cap.least);
  if (!is_capsule) return tones;
  for (const NormalCap& cap : lit)
    if (!near_is_in_front) add({near}, std::array{front(near), cap}, 2, cap.least);
  for (const NormalCap& cap : lit)
    add({far, near}, std::array{half, front(far), cap}, 1, cap.least);
  for (const NormalCap& cap : lit)
    if (near_is_in_front) add({near}, std::array{front(near), cap, half}, 3, cap.least);
  return tones;
}

}  // namespace

std::vector<Vec3d> RoundBody::outline(const Camera& camera) const {
  return mapped(outline_of(*this, camera), &OutlinePoint::at);
}

std::vector<RoundBody::Facet> RoundBody::front(const Camera& camera) const {
  std::vector<Facet> facets;
  if (contains_eye(*this, camera)) return facets;
  if (small) return tones_of(*this, camera);
  const auto add = [&](std::vector<Vec3d> polygon, double lit) {
    if (polygon.size() >= 3) facets.push_back({std::move(polygon), lit});
  };
  const Vec3d along = core.back() - core.front();
  const bool is_capsule = along.squaredNorm() > 0;
  for (const Patch& patch : patches_around(key_light(camera))) {
    std::vector<Vec3d> seam;  // normals perpendicular to a capsule's axis, between its two ends
    for (std::size_t end = 0; end < (is_capsule ? 2u : 1u); ++end) {
      std::vector<Vec3d> normals = patch.normals;
      if (is_capsule) {
        const double sign = end == 0 ? -1 : 1;
        seam.clear();
        normals = clipped(
            normals, [&](const Vec3d& n) { return sign * n.dot(along); },
            [&](const auto&... ends) { return seam.emplace_back(cut_between(ends...)); });
      }
      const Tangency tangency(camera, core[end], radius);
      normals = clipped(
          normals, [&](const Vec3d& n) { return tangency.front(n); }, cut_between);
      for (Vec3d& n : normals) n = core[end] + radius * n;
      add(std::move(normals), patch.lit);
    }
    // A capsule's cylinder is the seam, extruded from end to end.
    if (seam.size() != 2) continue;
    const Tangency tangency(camera, core.front(), radius);
    const double at_first = tangency.front(seam[0]), at_second = tangency.front(seam[1]);
    if (at_first < 0 && at_second < 0) continue;
    if (at_first < 0 || at_second < 0)
      seam[at_first < 0 ? 0 : 1] = cut_between(seam[0], seam[1], at_first, at_second);
    const Vec3d from = radius * seam[0], to = radius * seam[1];
    add({core[0] + from, core[0] + to, core[1] + to, core[1] + from}, patch.lit);
  }
  return facets;
}

ConvexShadow RoundBody::shadow(const Camera& camera) const {
  ConvexShadow shadow;
  shadow.around = corners_around(*this, camera);
  shadow.depth =
      std::min(camera.to_camera(core.front()).z(), camera.to_camera(core.back()).z()) - radius;
  std::vector<Plane<double>>& planes = shadow.bounds;
  const double border = small ? kSmallBorder : kBorder;
  const auto touching = [&](const Vec3d& normal) {
    planes.push_back({normal, std::max(normal.dot(core.front()), normal.dot(core.back())) +
                                  (1 - border) * radius});
  };
  // The outline first, because most lines are off the body, and there every eighth point first.
  const std::vector<OutlinePoint> outline = outline_of(*this, camera);
  for (std::size_t first = 0; first < 8; ++first)
    for (std::size_t i = first; i < outline.size(); i += 8) touching(outline[i].normal);
  if (planes.empty()) return shadow;
  const int longitudes = small ? kSmallLongitudes : kLongitudes;
  const std::vector<Vec3d> directions =
      directions_around(camera.to_eye(core.front()),
                        latitudes_of(small ? kSmallLatitudeStep : kLatitudeStep), longitudes);
  const auto ring = static_cast<std::size_t>(longitudes);
  for (std::size_t i = ring; i + ring < directions.size(); ++i) {
    const Vec3d& normal = directions[i];
    const Vec3d& farthest =
        normal.dot(core.back()) > normal.dot(core.front()) ? core.back() : core.front();
    if (Tangency(camera, farthest, radius).front(normal) > 0) touching(normal);
  }
  // Many others are in front of it.
  if (planes.size() > outline.size()) std::swap(planes.front(), planes[outline.size()]);
  // What is behind the circles of the outline and within it is behind all planes.
  shadow.sides = std::min(planes.size(), outline.size() + 1);
  for (const Vec3d& end : core) {
    const NormalCap seen = Tangency(camera, end, radius).cap();
    shadow.behind.push_back({seen.towards, seen.towards.dot(end) + radius * (seen.least - border)});
  }
  return shadow;
}

Plane<double> power_plane(const RoundBody& a, const RoundBody& b) {
  // Closest points of the two cores, after Ericson 2005, "Real-Time Collision Detection", 5.1.9, by
  // alternating projections. Two segments need few, and pictures need only pixel precision.
  Vec3d on_a = nearest_in(a.core, 0.5 * (b.core.front() + b.core.back()));
  Vec3d on_b = nearest_in(b.core, on_a);
  for (int i = 0; i < 60; ++i) {
    on_a = nearest_in(a.core, on_b);
    const Vec3d last = std::exchange(on_b, nearest_in(b.core, on_a));
    if (on_b == last) break;
  }
  const double distance = (on_b - on_a).norm();
  Vec3d normal = (on_b - on_a) / distance;
  if (!(distance > 1e-9 * (a.radius + b.radius))) {
    normal = (a.core.back() - a.core.front()).cross(b.core.back() - b.core.front());
    normal = normal.norm() > 0 ? Vec3d(normal.normalized()) : Vec3d::UnitY();
    return {normal, normal.dot(on_a)};
  }
  const double from_a = 0.5 * (distance + (a.radius * a.radius - b.radius * b.radius) / distance);
  return {normal, normal.dot(on_a) + from_a};
}

}  // namespace contactscope::draw
