#include "adapters/judge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>

#include <gmock/gmock.h>

#include "geometry/hull_builder.h"
#include "lint/linter.h"
#include "support/brute_force_distance.h"
#include "support/surface_oracle.h"

namespace contactscope::test {
namespace {

/// A shape of the trace, in the oracles' form.
struct Form {
  const trace::Shape* shape = nullptr;
  std::optional<Hull<double>> hull{};
  std::shared_ptr<SurfaceOracle> surface{};  // of a hull or mesh, without its margin

  bool is_plane() const { return shape->half_space.has_value(); }
  double radius() const { return shape->radius + shape->margin; }
  bool is_mesh() const { return shape->type == "mesh"; }
};

std::vector<std::array<int, 3>> triangles_of(const trace::Shape& shape) {
  std::vector<std::array<int, 3>> triangles;
  for (const std::vector<int>& face : shape.faces)
    for (std::size_t i = 2; i < face.size(); ++i)
      triangles.push_back({face[0], face[i - 1], face[i]});
  return triangles;
}

Form form_of(const trace::Shape& shape) {
  Form form{&shape};
  if (shape.half_space || shape.type == "sphere" || shape.type == "capsule") return form;
  form.surface = std::make_shared<SurfaceOracle>(shape.vertices, triangles_of(shape));
  if (shape.type != "mesh") form.hull = build_hull(shape.vertices, {.weld_duplicates = true});
  return form;
}

struct Placed {
  Form form;
  Pose<double> pose;

  /// Largest extent along a direction in the world.
  double reach(const Vec3d& direction) const {
    const Vec3d local = pose.inverse_rotate(direction);
    double most = -std::numeric_limits<double>::infinity();
    for (const Vec3d& vertex : form.shape->vertices) most = std::max(most, vertex.dot(local));
    return most + direction.dot(pose.position) + form.radius();
  }
  /// Negative inside; never negative for a mesh, which may be open.
  double distance(const Vec3d& point) const {
    const Vec3d local = pose.inverse_transform(point);
    const trace::Shape& shape = *form.shape;
    if (shape.half_space) return shape.half_space->normal.dot(local) - shape.half_space->offset;
    if (form.is_mesh()) return static_cast<double>(form.surface->distance(local));
    if (form.surface)
      return static_cast<double>(form.surface->signed_distance(local)) - shape.margin;
    const Vec3d &from = shape.vertices.front(), along = shape.vertices.back() - from;
    const double squared = along.squaredNorm();
    const double t = squared > 0 ? std::clamp((local - from).dot(along) / squared, 0.0, 1.0) : 0;
    return (local - from - t * along).norm() - shape.radius;
  }
  /// The shape without its radius or margin.
  Features core() const {
    if (form.hull) return features_of(*form.hull, pose);
    const std::vector<Vec3d>& vertices = form.shape->vertices;
    if (vertices.size() == 1) return features_of_point(vertices[0], pose);
    return features_of_segment(vertices.front(), vertices.back(), pose);
  }
  std::vector<Vec3d> face_normals() const {
    std::vector<Vec3d> normals;
    for (int f = 0; form.hull && f < form.hull->face_count(); ++f)
      normals.push_back(pose.rotate(form.hull->planes[static_cast<std::size_t>(f)].normal));
    return normals;
  }
  std::vector<Vec3d> edges() const {
    std::vector<Vec3d> directions;
    const trace::Shape& shape = *form.shape;
    for (const std::array<int, 2>& edge : shape.edges)
      directions.push_back(pose.rotate(shape.vertices[static_cast<std::size_t>(edge[1])] -
                                       shape.vertices[static_cast<std::size_t>(edge[0])]));
    return directions;
  }
};

/// Separation along a normal from a to b; negative in overlap. A plane has only one normal.
double gap_along(const Placed& a, const Placed& b, const Vec3d& normal) {
  if (b.form.is_plane()) return gap_along(b, a, -normal);
  if (!a.form.is_plane()) return -b.reach(-normal) - a.reach(normal);
  const trace::HalfSpace& half_space = *a.form.shape->half_space;
  const Vec3d up = a.pose.rotate(half_space.normal);
  return -b.reach(-up) - up.dot(a.pose.position) - half_space.offset;
}

/// The largest separation along any direction: the distance, or minus the least overlap.
double best_gap(const Placed& a, const Placed& b) {
  if (a.form.is_plane() || b.form.is_plane()) return gap_along(a, b, Vec3d::UnitX());
  const Features core_a = a.core(), core_b = b.core();
  const BruteForceDistance cores = brute_force_distance(core_a, core_b);
  const double radii = a.form.radius() + b.form.radius();
  if (cores.distance > 1e-9L) return static_cast<double>(cores.distance) - radii;
  std::vector<Vec3d> axes = a.face_normals();
  for (const Vec3d& normal : b.face_normals()) axes.push_back(-normal);
  const std::size_t faces = axes.size();
  for (const Vec3d& one : a.edges())
    for (const Vec3d& other : b.edges())
      if (const Vec3d axis = one.cross(other); axis.norm() > 1e-9 * one.norm() * other.norm())
        axes.push_back(axis.normalized());
  double best = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < axes.size(); ++i) {
    best = std::max(best, gap_along(a, b, axes[i]));
    if (i >= faces) best = std::max(best, gap_along(a, b, -axes[i]));
  }
  return best;
}

class PairJudge {
 public:
  PairJudge(const Placed& a, const Placed& b, Claims& claims) : a_(a), b_(b), claims_(claims) {}

  void judge(const trace::Pair& pair) {
    ++claims_.frames;
    const bool has_gap = !a_.form.is_mesh() && !b_.form.is_mesh();
    judge_ball_on_mesh(pair, a_, b_, 1);
    judge_ball_on_mesh(pair, b_, a_, -1);
    const double best = has_gap ? best_gap(a_, b_) : 0;
    for (const trace::Manifold& manifold : pair.manifolds) {
      worst(claims_.normal, manifold.normal.norm() - 1);
      double deepest = std::numeric_limits<double>::infinity();
      for (const trace::Point& point : manifold.points) {
        judge(point, manifold.normal);
        deepest = std::min(deepest, point.separation);
      }
      if (!has_gap) continue;
      const double gap = gap_along(a_, b_, manifold.normal);
      worst(claims_.along,
            deepest == pair.separation ? deepest - gap : std::min(0.0, deepest - gap));
      // A plane has only one normal.
      for (const auto& [plane, sign] : {std::pair(&a_, 1.0), std::pair(&b_, -1.0)})
        if (plane->form.is_plane())
          worst(claims_.normal, 1 - sign * manifold.normal.dot(plane->pose.rotate(
                                               plane->form.shape->half_space->normal)));
      if (deepest == pair.separation) worst(claims_.best, best - gap);
    }
    claims_.deepest = std::min(claims_.deepest, pair.separation);
  }

 private:
  static void worst(double& so_far, double error) {
    if (!(std::abs(error) <= so_far)) so_far = std::abs(error);
  }

  /// For a ball with its centre above the mesh, or on its original side: normals point to it.
  void judge_ball_on_mesh(const trace::Pair& pair, const Placed& mesh, const Placed& ball,
                          int sign) {
    if (!mesh.form.is_mesh() || ball.form.shape->type != "sphere") return;
    const Vec3d& middle = ball.pose.position;
    worst(claims_.along, pair.separation - mesh.distance(middle) + ball.form.shape->radius);
    for (const trace::Manifold& manifold : pair.manifolds)
      for (const trace::Point& point : manifold.points)
        if (sign * manifold.normal.dot(middle - point.position) <= 0) claims_.normal = 2;
  }

  void judge(const trace::Point& point, const Vec3d& normal) {
    ++claims_.points;
    if (point.impulse) ++claims_.with_impulse;
    worst(claims_.off_a, a_.distance(point.position));
    worst(claims_.off_b, b_.distance(point.position));
    if (!point.on_a || !point.on_b) {
      for (const Placed* shape : {&a_, &b_})
        worst(claims_.middle, std::max(0.0, std::abs(shape->distance(point.position)) -
                                                std::abs(point.separation)));
      return;
    }
    worst(claims_.surface, a_.distance(*point.on_a));
    worst(claims_.surface, b_.distance(*point.on_b));
    worst(claims_.sides, point.separation - normal.dot(*point.on_b - *point.on_a));
  }

  const Placed& a_;
  const Placed& b_;
  Claims& claims_;
};

const std::string& body_of(const trace::Trace& trace, const std::string& name) {
  const auto shape = std::ranges::find(trace.header.shapes, name, &trace::Shape::name);
  if (shape == trace.header.shapes.end()) throw std::invalid_argument("no shape " + name);
  return shape->body.empty() ? shape->name : shape->body;
}

const trace::Body* find_body(const trace::Frame& frame, const std::string& name) {
  if (!frame.solver) return nullptr;
  const auto body = std::ranges::find(frame.solver->bodies, name, &trace::Body::name);
  return body == frame.solver->bodies.end() ? nullptr : &*body;
}

}  // namespace

std::map<PairNames, Claims> judge(const trace::Trace& trace) {
  std::map<std::string, Form> forms;
  for (const trace::Shape& shape : trace.header.shapes) forms.emplace(shape.name, form_of(shape));
  std::map<PairNames, Claims> claims;
  for (const trace::Frame& frame : trace.frames) {
    const std::map<std::string, Pose<double>> poses(frame.poses.begin(), frame.poses.end());
    for (const trace::Pair& pair : frame.pairs) {
      const Placed a{forms.at(pair.a), poses.at(pair.a)}, b{forms.at(pair.b), poses.at(pair.b)};
      PairJudge(a, b, claims[{pair.a, pair.b}]).judge(pair);
    }
  }
  return claims;
}

void expect_right(const trace::Trace& trace, const Promise& promise,
                  const std::vector<PairNames>& known_faults,
                  const std::vector<std::string>& expected) {
  constexpr double kUnit = 1e-5;
  const std::map<PairNames, Claims> all = judge(trace);
  EXPECT_FALSE(all.empty());
  for (const auto& [names, claims] : all) {
    std::ostringstream text;
    text << names.first << " and " << names.second << ", " << claims.frames << " frames, "
         << claims.points << " points, " << claims.with_impulse << " solved, deepest "
         << claims.deepest << ", points off a " << claims.off_a << ", off b " << claims.off_b
         << ": normal " << claims.normal << ", surface " << claims.surface << ", middle "
         << claims.middle << ", sides " << claims.sides << ", along " << claims.along << ", best "
         << claims.best;
    const bool is_right = claims.normal <= kUnit && claims.surface <= promise.surface &&
                          claims.middle <= promise.surface && claims.sides <= promise.surface &&
                          claims.along <= promise.along && claims.best <= promise.best;
    const bool is_known = std::ranges::find(known_faults, names) != known_faults.end();
    EXPECT_NE(is_right, is_known) << text.str();
    if (std::getenv("CONTACTSCOPE_PRINT_CLAIMS") != nullptr) std::cout << text.str() << "\n";
  }
  std::vector<std::string> causes;
  std::ostringstream findings;
  for (const lint::Finding& finding : lint::lint(trace)) {
    causes.push_back(finding.cause);
    findings << finding.cause << ": " << finding.what << ", " << finding.count << " of "
             << finding.of << "; frame " << finding.frame << ", " << finding.a << " and "
             << finding.b << ": " << finding.said << "; " << finding.is << "\n";
  }
  EXPECT_THAT(causes, testing::UnorderedElementsAreArray(expected)) << findings.str();
  for (const PairNames& known : known_faults)
    EXPECT_TRUE(all.contains(known)) << known.first << " and " << known.second << " never met";
}

int lines_for_the_recorder(const std::string& sample) {
  std::ifstream in(CONTACTSCOPE_SOURCE_DIR "/tests/adapters/" + sample);
  int count = 0;
  for (std::string line; std::getline(in, line);) {
    const bool is_comment = line.starts_with("//");
    for (const char* word : {"contactscope", "CONTACTSCOPE", "recorder", "adapters/"})
      if (!is_comment && line.find(word) != std::string::npos) {
        ++count;
        break;
      }
  }
  return count;
}

Vec3d impulse_on(const trace::Trace& trace, const trace::Frame& frame, const std::string& body) {
  Vec3d sum = Vec3d::Zero();
  for (const trace::Pair& pair : frame.pairs) {
    const int sign = int(body_of(trace, pair.b) == body) - int(body_of(trace, pair.a) == body);
    for (const trace::Manifold& manifold : pair.manifolds)
      for (const trace::Point& point : manifold.points)
        if (point.impulse)
          sum += sign * (point.impulse->normal * manifold.normal + point.impulse->friction);
  }
  return sum;
}

std::map<std::string, double> momentum_errors(const trace::Trace& trace, const Vec3d& gravity) {
  std::map<std::string, double> errors;
  for (std::size_t i = 1; i < trace.frames.size(); ++i) {
    const trace::Frame &before = trace.frames[i - 1], &after = trace.frames[i];
    if (!before.solver) continue;
    const double step = after.time - before.time;
    for (const trace::Body& body : before.solver->bodies) {
      const trace::Body* next = find_body(after, body.name);
      if (next == nullptr) continue;
      const Vec3d change = body.mass * (next->velocity - body.velocity);
      const Vec3d given = impulse_on(trace, before, body.name) + body.mass * step * gravity;
      double& worst = errors[body.name];
      worst = std::max(worst, (change - given).norm() / (body.mass * step * gravity.norm()));
    }
  }
  return errors;
}

trace::Trace with_late_poses(trace::Trace trace) {
  for (std::size_t i = 0; i + 1 < trace.frames.size(); ++i)
    trace.frames[i].poses = trace.frames[i + 1].poses;
  return trace;
}

trace::Trace with_turned_normals(trace::Trace trace) {
  for (trace::Frame& frame : trace.frames)
    for (trace::Pair& pair : frame.pairs)
      for (trace::Manifold& manifold : pair.manifolds) manifold.normal = -manifold.normal;
  return trace;
}

}  // namespace contactscope::test
