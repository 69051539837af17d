#include "peers/rollout.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <iostream>
#include <map>

#include "lint/claims.h"
#include "trace/find.h"
#include "trace/json.h"

namespace contactscope::peers {
namespace {

Pose<double> inverse(const Pose<double>& pose) {
  const Quatd back = pose.rotation.conjugate();
  return {back, -(back * pose.position)};
}

Hull<double> moved(Hull<double> hull, const Pose<double>& by) {
  for (Vec3d& vertex : hull.vertices) vertex = by.transform(vertex);
  for (Plane<double>& plane : hull.planes) {
    plane.normal = by.rotate(plane.normal);
    plane.offset += plane.normal.dot(by.position);
  }
  hull.centroid = by.transform(hull.centroid);
  lay_out(hull);
  return hull;
}

/// Axes about which a body turns without wobbling, the shape's if possible, and the moments.
Quatd principal_axes(const Eigen::Matrix3d& inertia, Vec3d& moments) {
  constexpr double kRounding = 1e-9;
  moments = inertia.diagonal();
  Eigen::Matrix3d next_to = inertia;
  next_to.diagonal().setZero();
  if (next_to.cwiseAbs().maxCoeff() <= kRounding * moments.maxCoeff()) return Quatd::Identity();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(inertia);
  Eigen::Matrix3d axes = solver.eigenvectors();
  if (axes.determinant() < 0) axes.col(0) = -axes.col(0);
  moments = solver.eigenvalues();
  return Quatd(axes);
}

/// Puts a capsule along the engine's axis, about its middle; one without length becomes a ball.
void lay_along(const Vec3d& axis, Piece& piece) {
  const auto* const capsule = std::get_if<Capsule<double>>(&piece.shape);
  if (capsule == nullptr) return;
  const double half = capsule_length(*capsule) / 2, radius = capsule->radius;
  piece.in_shape.position = 0.5 * (capsule->points[0] + capsule->points[1]);
  if (half > 0) {
    piece.in_shape = capsule_frame(*capsule, axis);
    piece.shape = Capsule<double>{{Vec3d(-half * axis), Vec3d(half * axis)}, radius};
  } else {
    piece.shape = Sphere<double>{radius};
  }
}

/// Sets the mass of a dynamic piece and turns its frame to the principal axes.
void fill(const trace::Body& body, const Pose<double>& pose, Piece& piece) {
  if (std::holds_alternative<HalfSpace<double>>(piece.shape) ||
      std::holds_alternative<std::shared_ptr<const Mesh<double>>>(piece.shape))
    throw NotStepped("no body is a mesh or a plane here: '" + piece.name + "'");
  if (body.inertia.size() != 3)
    throw NotStepped("body '" + body.name + "' has no 'inertia' of three rows");
  Eigen::Matrix3d inertia;
  for (int row = 0; row < 3; ++row) inertia.row(row) = at(body.inertia, row).transpose();
  piece.is_dynamic = true;
  piece.mass = body.mass;
  piece.start.velocity = body.velocity;
  piece.start.angular_velocity = body.angular_velocity;
  if (auto* hull = std::get_if<Hull<double>>(&piece.shape)) {
    piece.in_shape.position = pose.inverse_transform(body.center_of_mass);
    piece.in_shape.rotation = principal_axes(inertia, piece.moments);
    *hull = moved(std::move(*hull), inverse(piece.in_shape));
    return;
  }
  const Eigen::Matrix3d turn = piece.in_shape.rotation.toRotationMatrix();  // of a capsule
  piece.moments = (turn.transpose() * inertia * turn).diagonal();
}

/// The pieces of a request, in the order of its shapes.
std::vector<Piece> pieces_of(const trace::Trace& request, const Vec3d& capsule_axis) {
  if (!request.header.world || request.frames.empty() || !request.frames.front().solver)
    throw NotStepped("the request has no 'world', or no 'solver' with bodies in its first frame");
  const trace::Frame& start = request.frames.front();
  lint::Solids solids;
  std::vector<Piece> pieces;
  for (const trace::Shape& shape : request.header.shapes) {
    solids.add(shape);
    const auto placed = lint::place(solids, &start, shape.name, {});
    if (!placed)
      throw NotStepped("shape '" + shape.name + "' bounds nothing, or is not there at the start");
    Piece& piece = pieces.emplace_back();
    piece.name = shape.name;
    piece.shape = shape_of(placed->solid->shape());
    piece.friction = shape.friction.value_or(0);
    piece.restitution = shape.restitution.value_or(0);
    piece.is_scripted =
        request.frames.size() > 1 && trace::find_pose(request.frames[1], shape.name) != nullptr;
    lay_along(capsule_axis, piece);
    const auto body = std::ranges::find(start.solver->bodies, shape.name, &trace::Body::name);
    if (body != start.solver->bodies.end()) fill(*body, placed->pose, piece);
    piece.start.pose = compose(placed->pose, piece.in_shape);
  }
  return pieces;
}

/// Motion of a scripted piece from one pose to the next.
BodyMotion going(const Pose<double>& from, const Pose<double>& to, double seconds) {
  BodyMotion motion{from};
  motion.velocity = (to.position - from.position) / seconds;
  Quatd turn = to.rotation * from.rotation.conjugate();
  if (turn.w() < 0) turn.coeffs() = -turn.coeffs();
  const Eigen::AngleAxisd about(turn.normalized());
  motion.angular_velocity = about.angle() / seconds * about.axis();
  return motion;
}

class Rollout {
 public:
  Rollout(const RolloutEngine& engine, trace::Trace request)
      : request_(std::move(request)),
        pieces_(pieces_of(request_, engine.capsule_axis)),
        step_(request_.header.world->time_step),
        world_(engine.make(pieces_, request_.header.world->gravity, step_)) {
    request_.header.engine = engine.name;
    request_.header.version = engine.version;
    request_.header.poses_at = "before_step";
    for (const trace::Shape& shape : request_.header.shapes)
      kinds_[shape.name] = trace::kind_of(shape);
  }

  void write(std::ostream& out) {
    out << trace::to_json_line(request_.header) << std::endl;
    for (std::size_t i = 0; i < request_.frames.size(); ++i) {
      drive(i);
      trace::Frame frame = poses(request_.frames[i]);
      report(world_->step(step_), frame);
      // Flushed per frame, so that frames are not lost if the engine dies in the next step.
      out << trace::to_json_line(frame) << std::endl;
    }
  }

 private:
  void drive(std::size_t frame) {
    for (int i = 0; i < count_of(pieces_); ++i) {
      const Piece& piece = at(pieces_, i);
      if (!piece.is_scripted || piece.is_dynamic) continue;
      const auto pose = [&](std::size_t number) {
        return compose(*trace::find_pose(request_.frames[number], piece.name), piece.in_shape);
      };
      const std::size_t next = std::min(frame + 1, request_.frames.size() - 1);
      world_->drive(i, going(pose(frame), pose(next), step_));
    }
  }

  trace::Frame poses(const trace::Frame& requested) const {
    trace::Frame frame;
    frame.frame = requested.frame;
    frame.time = requested.time;
    frame.solver.emplace().iterations = world_->iterations();
    frame.solver->substeps = 1;
    for (int i = 0; i < count_of(pieces_); ++i) {
      const Piece& piece = at(pieces_, i);
      if (!piece.is_dynamic) {
        const Pose<double>* const record = trace::find_pose(requested, piece.name);
        const Pose<double>* const first = trace::find_pose(request_.frames.front(), piece.name);
        frame.poses.emplace_back(piece.name, record == nullptr ? *first : *record);
        continue;
      }
      const BodyMotion motion = world_->motion(i);
      frame.poses.emplace_back(piece.name, compose(motion.pose, inverse(piece.in_shape)));
      trace::Body& body = frame.solver->bodies.emplace_back();
      body.name = piece.name;
      body.mass = piece.mass;
      body.center_of_mass = motion.pose.position;
      body.velocity = motion.velocity;
      body.angular_velocity = motion.angular_velocity;
    }
    return frame;
  }

  /// Points with the same normal and triangle form a manifold.
  void report(const std::vector<Touch>& touches, trace::Frame& frame) const {
    std::map<std::pair<int, int>, std::vector<trace::Manifold>> found;
    for (const Touch& touch : touches) {
      std::vector<trace::Manifold>& manifolds = found[{touch.a, touch.b}];
      const auto is_same = [&](const trace::Manifold& manifold) {
        return manifold.triangle == touch.triangle &&
               manifold.normal.dot(touch.point.normal) > 1 - 1e-6;
      };
      auto manifold = std::ranges::find_if(manifolds, is_same);
      if (manifold == manifolds.end()) {
        manifold = manifolds.emplace(manifolds.end());
        manifold->normal = touch.point.normal.normalized();
        manifold->triangle = touch.triangle;
      }
      trace::Point& point = manifold->points.emplace_back();
      point.position = touch.point.position;
      point.separation = touch.point.separation;
      point.impulse = touch.impulse;
      point.active = touch.is_active;
    }
    for (auto& [names, manifolds] : found) {
      trace::Pair& pair = frame.pairs.emplace_back();
      pair.a = at(pieces_, names.first).name;
      pair.b = at(pieces_, names.second).name;
      pair.manifolds = std::move(manifolds);
    }
    trace::complete(kinds_, frame);
  }

  trace::Trace request_;
  std::vector<Piece> pieces_;
  double step_;
  trace::Kinds kinds_;
  std::unique_ptr<RolloutWorld> world_;
};

}  // namespace

void roll_out(const RolloutEngine& engine, std::istream& in, std::ostream& out) {
  Rollout(engine, trace::read_trace(in, "standard input")).write(out);
}

}  // namespace contactscope::peers
