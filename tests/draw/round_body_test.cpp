#include "draw/scene/visibility.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <utility>

#include "core/convex_polygon.h"
#include "draw/scene/palette.h"
#include "support/cases.h"

namespace contactscope::draw {
namespace {

constexpr Rect kView{0, 0, 800, 600};

Camera looking_from(const Vec3d& eye) {
  return Camera::perspective(eye, Vec3d::Zero(), Vec3d::UnitY(), 0.5, kView);
}

Camera flat_from(const Vec3d& eye) {
  return Camera::orthographic(eye, Vec3d::Zero(), Vec3d::UnitY(), 4, kView);
}

const RoundBody kBall{{{0.3, -0.2, 0.1}}, 0.5};
const RoundBody kPill{{{-0.6, 0.1, 0.2}, {0.5, 0.4, -0.3}}, 0.3};
const RoundBody kSmallBall{kBall.core, kBall.radius, true},
    kSmallPill{kPill.core, kPill.radius, true};

// Distance from the core.
double core_distance(const RoundBody& body, const Vec3d& p) {
  const Vec3d& a = body.core.front();
  const Vec3d along = body.core.back() - a;
  const double length = along.squaredNorm();
  const double t = length > 0 ? std::clamp((p - a).dot(along) / length, 0.0, 1.0) : 0;
  return (p - a - t * along).norm();
}

// Smallest distance from the core to the line through `p` along `direction`, by exhaustion.
double nearest_on_ray(const RoundBody& body, const Vec3d& p, const Vec3d& direction) {
  double nearest = 1e9;
  for (int i = -4000; i <= 4000; ++i) {
    nearest = std::min(nearest, core_distance(body, p + 1e-4 * i * direction));
  }
  return nearest;
}

TEST(RoundBody, SlowOutlineIsWhereTheViewRayTouchesTheSurface) {
  for (const RoundBody& body : {kBall, kPill}) {
    for (const Camera& camera : {looking_from({3, 2, 4}), looking_from({-1, 0.5, 1.2}),
                                 looking_from({4, 1.4, -2}), flat_from({1, 2, 3})}) {
      const std::vector<Vec3d> outline = body.outline(camera);
      ASSERT_GE(outline.size(), 90u);
      for (std::size_t i = 0; i < outline.size(); i += 5) {
        const Vec3d& p = outline[i];
        EXPECT_NEAR(core_distance(body, p), body.radius, 1e-12);
        // The ray is nowhere nearer: it touches.
        EXPECT_NEAR(nearest_on_ray(body, p, camera.to_eye(p)), body.radius, 1e-9);
      }
    }
  }
}

TEST(RoundBody, OutlineGoesAroundOnce) {
  for (const RoundBody& body : {kBall, kPill}) {
    const Camera camera = looking_from({3, 2, 4});
    const std::vector<Vec3d> outline = body.outline(camera);
    const Point2 middle = *camera.project(0.5 * (body.core.front() + body.core.back()));
    double turned = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Point2 p = *camera.project(outline[i]);
      const Point2 q = *camera.project(outline[(i + 1) % outline.size()]);
      const double px = p.x - middle.x, py = p.y - middle.y;
      const double qx = q.x - middle.x, qy = q.y - middle.y;
      const double step = std::atan2(px * qy - py * qx, px * qx + py * qy);
      EXPECT_LE(step, 1e-6);  // convex, and in one direction
      turned += step;
    }
    EXPECT_NEAR(turned, -2 * std::acos(-1.0), 1e-6);
  }
}

TEST(RoundBody, ACapsuleSeenEndOnHasACircleForItsOutline) {
  const RoundBody pill{{{0, 0, -1}, {0, 0, 1}}, 0.25};
  for (const Camera& camera : {looking_from({0, 0, 5}), flat_from({0, 0, 5})}) {
    const std::vector<Vec3d> outline = pill.outline(camera);
    ASSERT_FALSE(outline.empty());
    for (const Vec3d& p : outline) {
      EXPECT_NEAR(p.head<2>().norm(), outline.front().head<2>().norm(), 1e-12);
      EXPECT_NEAR(p.z(), outline.front().z(), 1e-12);
    }
  }
}

TEST(RoundBody, AnEyeInsideSeesNothingOfIt) {
  const RoundBody around{{{0, 0, -3}, {0, 0, 3}}, 1};
  const Camera camera = looking_from({0, 0.5, 2});
  EXPECT_TRUE(around.outline(camera).empty());
  EXPECT_TRUE(around.front(camera).empty());
  EXPECT_TRUE(around.shadow(camera).bounds.empty());
}

TEST(RoundBody, FacetsCoverWhatTheOutlineEncloses) {
  const auto area = [](const Camera& camera, const std::vector<Vec3d>& polygon) {
    double twice = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Point2 p = *camera.project(polygon[i]);
      const Point2 q = *camera.project(polygon[(i + 1) % polygon.size()]);
      twice += static_cast<double>(p.x) * q.y - static_cast<double>(p.y) * q.x;
    }
    return 0.5 * std::abs(twice);
  };
  for (const RoundBody& body : {kBall, kPill}) {
    for (const Camera& camera : {looking_from({3, 2, 4}), flat_from({-2, 1, 1})}) {
      double covered = 0;
      for (const RoundBody::Facet& facet : body.front(camera)) {
        for (const Vec3d& p : facet.polygon) {
          EXPECT_NEAR(core_distance(body, p), body.radius, 1e-9);
        }
        covered += area(camera, facet.polygon);
      }
      const double whole = area(camera, body.outline(camera));
      // Overlapping facets would cover more, holes less.
      EXPECT_NEAR(covered, whole, 4e-3 * whole);
    }
  }
}

TEST(RoundBody, SlowSmallBodiesHaveTheTonesOfTheirNormals) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  std::array<int, 3> counts{};
  for (const RoundBody& body : {kSmallBall, kSmallPill}) {
    for (const Camera& camera : {looking_from({3, 2, 4}), looking_from({-2, 0.5, 1.2}),
                                 looking_from({0.4, -3, -0.2}), looking_from({0, 3, 0.1})}) {
      const Vec3d light = key_light(camera);
      const std::vector<RoundBody::Facet> tones = body.front(camera);
      for (int i = 0; i < test::cases(1500); ++i) {
        const Vec3d target(coordinate(random), coordinate(random), coordinate(random));
        const Point2 pixel = *camera.project(target);
        // The first point of the ray on the body, by exhaustion, then by bisection.
        const auto on_ray = [&](double t) -> Vec3d {
          return camera.eye() + t * (target - camera.eye());
        };
        double outside = 0, inside = 0;
        while (inside < 2 && core_distance(body, on_ray(inside)) > body.radius)
          outside = std::exchange(inside, inside + 1e-3);
        float painted = 0;  // the tone of the polygon that is painted last
        for (const RoundBody::Facet& tone : tones) {
          bool left = false, right = false;
          for (std::size_t k = 0; k < tone.polygon.size(); ++k) {
            const Point2 p = *camera.project(tone.polygon[k]);
            const Point2 q = *camera.project(tone.polygon[(k + 1) % tone.polygon.size()]);
            const double turn = (q.x - p.x) * (pixel.y - p.y) - (q.y - p.y) * (pixel.x - p.x);
            (turn > 0 ? left : right) = true;
          }
          if (!(left && right)) painted = toned(kWhite, tone.lit).r;
        }
        double nearest = 1e9;
        for (int k = 0; k <= 2000; ++k)
          nearest = std::min(nearest, core_distance(body, on_ray(k / 1000.0)));
        if (std::abs(nearest - body.radius) < 0.02 * body.radius) continue;  // near the outline
        if (inside >= 2) {
          EXPECT_EQ(painted, 0);
          continue;
        }
        for (int k = 0; k < 50; ++k) {
          const double middle = 0.5 * (outside + inside);
          (core_distance(body, on_ray(middle)) > body.radius ? outside : inside) = middle;
        }
        const Vec3d at = on_ray(inside);
        Vec3d normal;
        for (int axis = 0; axis < 3; ++axis) {
          const Vec3d step = 1e-5 * Vec3d::Unit(axis);
          normal[axis] = core_distance(body, at + step) - core_distance(body, at - step);
        }
        const double lit = normal.normalized().dot(light);
        if (std::abs(lit - 0.6) < 0.03 || std::abs(lit - 0.1) < 0.03) continue;
        EXPECT_EQ(painted, toned(kWhite, lit).r) << lit;
        ++counts[static_cast<std::size_t>(lit > 0.6 ? 2 : lit > 0.1 ? 1 : 0)];
      }
    }
  }
  for (const int count : counts) EXPECT_GT(count, 40 / test::kOneIn);
}

TEST(RoundBody, SlowHidesWhatAViewRayMeetsItBefore) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-1.6, 1.6);
  int hidden_count = 0, seen_count = 0;
  for (const RoundBody& body : {kBall, kPill, kSmallBall, kSmallPill}) {
    const Camera camera = looking_from({3, 2, 4});
    const HiddenLines lines(camera, {}, {body.shadow(camera)});
    for (int i = 0; i < 900; ++i) {
      const Vec3d p(coordinate(random), coordinate(random), coordinate(random));
      // By exhaustion along the ray to the eye.
      double nearest = 1e9;
      for (int k = 0; k <= 4000; ++k) {
        const Vec3d on_ray = p + (k / 4000.0) * (camera.eye() - p);
        nearest = std::min(nearest, core_distance(body, on_ray));
      }
      if (std::abs(nearest - body.radius) < 0.02) continue;  // near the outline
      const bool hidden = lines.split(p, p + Vec3d(1e-4, 0, 0)).front().hidden;
      EXPECT_EQ(hidden, nearest < body.radius) << p.transpose();
      (hidden ? hidden_count : seen_count)++;
    }
  }
  EXPECT_GT(hidden_count, 100);
  EXPECT_GT(seen_count, 100);
}

TEST(RoundBody, ItsOwnOutlineIsNotHiddenByIt) {
  for (const RoundBody& body : {kBall, kPill, kSmallBall, kSmallPill}) {
    for (const Camera& camera :
         {looking_from({3, 2, 4}), looking_from({-1, 0.5, 1.2}), flat_from({1, 2, 3})}) {
      const HiddenLines lines(camera, {}, {body.shadow(camera)});
      const std::vector<Vec3d> outline = body.outline(camera);
      for (std::size_t i = 0; i < outline.size(); ++i) {
        for (const Span& span : lines.split(outline[i], outline[(i + 1) % outline.size()])) {
          EXPECT_FALSE(span.hidden);
        }
      }
    }
  }
}

TEST(RoundBody, PowerPlaneGoesThroughTheCircleInWhichSpheresMeet) {
  const RoundBody small{{{0, 0, 0}}, 0.5}, large{{{0.9, 0, 0}}, 0.8};
  const Plane<double> plane = power_plane(small, large);
  // Points at both radii: x^2 + y^2 = 0.25 and (x - 0.9)^2 + y^2 = 0.64.
  const double x = (0.25 - 0.64 + 0.81) / 1.8;
  const double y = std::sqrt(0.25 - x * x);
  EXPECT_NEAR(plane.distance({x, y, 0}), 0, 1e-12);
  EXPECT_NEAR(plane.distance({x, 0, -y}), 0, 1e-12);
  EXPECT_GT(plane.distance({0.9, 0, 0}), 0);
}

TEST(RoundBody, PowerPlaneSeparatesDisjointBodies) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  int separated = 0;
  for (int i = 0; i < 300; ++i) {
    const auto point = [&] {
      return Vec3d(coordinate(random), coordinate(random), coordinate(random));
    };
    const RoundBody a{{point(), point()}, 0.2}, b{{point(), point()}, 0.1};
    double gap = 1e9;
    for (int s = 0; s <= 200; ++s) {
      const Vec3d on_a = a.core[0] + s / 200.0 * (a.core[1] - a.core[0]);
      gap = std::min(gap, core_distance(b, on_a) - 0.3);
    }
    if (gap < 0.02) continue;
    const Plane<double> plane = power_plane(a, b);
    for (const Vec3d& p : a.core) EXPECT_LT(plane.distance(p), -0.2);
    for (const Vec3d& p : b.core) EXPECT_GT(plane.distance(p), 0.1);
    ++separated;
  }
  EXPECT_GT(separated, 50);
}

TEST(RoundBody, TheNearerOfTwoSpheresIsPaintedLast) {
  const Camera camera = looking_from({0, 0, 6});
  const std::vector<RoundBody> bodies = {RoundBody{{{0, 0, 1}}, 0.6},
                                         RoundBody{{{0.3, 0.1, -1}}, 0.6}};
  std::vector<Surface> surfaces;
  for (int k = 0; k < 2; ++k) {
    for (RoundBody::Facet& facet : bodies[static_cast<std::size_t>(k)].front(camera)) {
      surfaces.push_back({std::move(facet.polygon), {}, k});
    }
  }
  const std::vector<Surface> ordered = depth_ordered(surfaces, camera, bodies);
  ASSERT_EQ(ordered.size(), surfaces.size());
  EXPECT_TRUE(std::ranges::is_sorted(ordered, std::greater{}, &Surface::body));
}

// Distance along a ray (unit direction) to a sphere that is wider by a share of its radius.
std::optional<double> hit(const RoundBody& ball, double wider, const Vec3d& eye,
                          const Vec3d& direction) {
  const double along = (ball.core[0] - eye).dot(direction);
  const double radius = (1 + wider) * ball.radius;
  const double half = radius * radius - (ball.core[0] - eye - along * direction).squaredNorm();
  return half < 0 ? std::nullopt : std::optional(along - std::sqrt(half));
}

TEST(RoundBody, SlowTheNearestOfManyBallsIsPaintedLastInEveryPixel) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1.2, 1.2), radius(0.1, 0.5);
  std::uniform_real_distribution<double> column(250, 550), row(150, 450);
  int compared = 0, overlapping = 0;
  for (int round = 0; round < 12; ++round) {
    const Camera camera = looking_from({1, 2, 6});
    std::vector<RoundBody> balls;
    for (int i = 0; i < 24; ++i)
      balls.push_back({{{any(random), any(random), any(random)}}, radius(random)});
    std::vector<Surface> surfaces;
    for (std::size_t i = 0; i < balls.size(); ++i)
      for (RoundBody::Facet& facet : balls[i].front(camera))
        surfaces.push_back({std::move(facet.polygon), {}, static_cast<int>(i)});
    std::vector<std::pair<std::vector<Point2>, int>> painted;
    for (const Surface& surface : depth_ordered(surfaces, camera, balls))
      painted.emplace_back(project_polygon(camera, surface.polygon), surface.body);
    for (int ray = 0; ray < 300; ++ray) {
      const Vec2d pixel(column(random), row(random));
      const double from_middle = 0.5 * kView.height / std::tan(0.25);
      const Vec3d direction = (from_middle * camera.right().cross(camera.up()) * -1 +
                               (pixel.x() - 400) * camera.right() - (pixel.y() - 300) * camera.up())
                                  .normalized();
      // Rays near an outline, and near where two balls meet, depend on the chords of facets.
      std::vector<std::pair<double, int>> met;
      bool clear = true;
      for (std::size_t i = 0; i < balls.size(); ++i) {
        const auto inner = hit(balls[i], -0.05, camera.eye(), direction);
        clear =
            clear && inner.has_value() == hit(balls[i], 0.05, camera.eye(), direction).has_value();
        if (const auto t = hit(balls[i], 0, camera.eye(), direction))
          met.emplace_back(*t, static_cast<int>(i));
      }
      std::ranges::sort(met);
      if (!clear || (met.size() > 1 && met[1].first - met[0].first < 0.04)) continue;
      int last = -1;
      for (const auto& [seen, body] : painted) {
        int left = 0, right = 0;
        for (std::size_t i = 0; i < seen.size(); ++i) {
          const Vec2d p = flat(seen[i]), q = flat(seen[(i + 1) % seen.size()]);
          (turn(p, q, pixel) > 0 ? left : right) += 1;
        }
        if (!seen.empty() && (left == 0 || right == 0)) last = body;
      }
      EXPECT_EQ(last, met.empty() ? -1 : met[0].second) << round << ": " << pixel.transpose();
      compared += met.size() > 1;
      if (met.size() > 1)
        overlapping +=
            (at(balls, met[0].second).core[0] - at(balls, met[1].second).core[0]).norm() <
            at(balls, met[0].second).radius + at(balls, met[1].second).radius;
    }
  }
  EXPECT_GT(compared, 500);
  EXPECT_GT(overlapping, 100);
}

}  // namespace
}  // namespace contactscope::draw
