#include "versus/rollout.h"

#include "lint/claims.h"
#include "trace/find.h"

namespace contactscope::versus {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A shape in a frame, with its bounding box.
struct Boxed {
  std::string name;
  bool is_body = false;
  lint::Placed placed{};
  Aabb<double> box{};
};

Aabb<double> box_of(const lint::Placed& placed) {
  Aabb<double> box;
  for (int axis = 0; axis < 3; ++axis) {
    box.lower[axis] = -placed.extent(-Vec3d::Unit(axis));
    box.upper[axis] = placed.extent(Vec3d::Unit(axis));
  }
  return box;
}

struct Motion {
  Vec3d velocity = Vec3d::Zero(), angular_velocity = Vec3d::Zero();
};

/// The constant velocities of the centre of mass between two poses.
Motion between(const RolloutBody& body, const Pose<double>& from, const Pose<double>& to,
               double seconds) {
  Motion motion;
  if (!(seconds > 0)) return motion;
  motion.velocity = (to.transform(body.center) - from.transform(body.center)) / seconds;
  Quatd turn = to.rotation * from.rotation.conjugate();
  if (turn.w() < 0) turn.coeffs() = -turn.coeffs();
  const Eigen::AngleAxisd about(turn.normalized());
  motion.angular_velocity = about.angle() / seconds * about.axis();
  return motion;
}

double kinetic_energy(const RolloutBody& body, const Pose<double>& pose, const Motion& motion) {
  const Vec3d spin = pose.inverse_rotate(motion.angular_velocity);
  return 0.5 * body.mass * motion.velocity.squaredNorm() + 0.5 * spin.dot(body.inertia * spin);
}

/// Number of supporting points: active ones, with an impulse if impulses are reported.
int acting_points(const trace::Frame& frame) {
  int acting = 0, with_impulse = 0, pushing = 0;
  for (const trace::Pair& pair : frame.pairs)
    for (const trace::Point& point : joined(pair.manifolds, &trace::Manifold::points)) {
      acting += point.active;
      with_impulse += point.impulse.has_value();
      pushing += point.active && point.impulse && point.impulse->normal > 0;
    }
  return with_impulse > 0 ? pushing : acting;
}

constexpr double kInside = 0.25;  // relative to the thinner shape
constexpr int kLooks = 8;         // while a body moves by the thinner one's thickness
constexpr int kMaxLooks = 2000;   // per step

/// The motion of a shape between two frames.
struct Path {
  lint::Placed from, to;

  lint::Placed at(double share) const {
    lint::Placed there = from;
    there.pose.position = (1 - share) * from.pose.position + share * to.pose.position;
    there.pose.rotation = from.pose.rotation.slerp(share, to.pose.rotation);
    return there;
  }
  Aabb<double> box() const {
    Aabb<double> both = box_of(from);
    both.include(box_of(to));
    return both;
  }
  Vec3d move() const { return to.pose.position - from.pose.position; }
  /// Shortest side of its box; infinite for a surface.
  double thickness() const {
    const double least = (from.solid->upper() - from.solid->lower()).minCoeff();
    return from.solid->is_convex() && least > 0 ? least : std::numeric_limits<double>::infinity();
  }
};

std::optional<Path> path_of(const lint::Solids& solids, const std::string& name,
                            const trace::Frame& before, const trace::Frame& now) {
  const auto from = lint::place(solids, &before, name, {});
  const auto to = lint::place(solids, &now, name, {});
  if (!from || !to || from->solid->is_plane()) return std::nullopt;
  return Path{*from, *to};
}

bool passes(const Path& body, const Path& other) {
  const double thin = std::min(body.thickness(), other.thickness());
  const double relative_motion = (body.move() - other.move()).norm();
  if (!(relative_motion > body.thickness()) || !overlaps(body.box(), other.box())) return false;
  const auto is_inside = [&](double share) {
    const auto separation = separation_of(body.at(share), other.at(share));
    return separation && separation->distance < -kInside * thin;
  };
  if (is_inside(0) || is_inside(1)) return false;
  const int looks =
      static_cast<int>(std::min<double>(kMaxLooks, std::ceil(kLooks * relative_motion / thin)));
  for (int i = 1; i < looks; ++i)
    if (is_inside(static_cast<double>(i) / looks)) return true;
  return false;
}

/// A body that passed through another shape between two frames.
struct Passing {
  std::string body, other;
};

/// Finds the passings in the step between two frames from shapes and poses alone. Bodies that move
/// by more than their thickness are sampled between the frames, with linear positions and constant
/// rotation. A body has passed if it is inside another by a quarter of the thinner one's thickness
/// in between, but in neither frame. Both frames must have the poses of all shapes.
std::vector<Passing> passings(const lint::Solids& solids, const std::vector<RolloutBody>& bodies,
                              const trace::Frame& before, const trace::Frame& now) {
  std::vector<Passing> found;
  for (const RolloutBody& body : bodies) {
    const std::optional<Path> own = path_of(solids, body.name, before, now);
    // A body at rest next to a bullet is found from the bullet.
    if (!own || own->move().norm() <= own->thickness()) continue;
    for (const trace::Placement& one : now.poses) {
      if (one.first == body.name) continue;
      const std::optional<Path> other = path_of(solids, one.first, before, now);
      if (other && passes(*own, *other)) found.push_back({body.name, one.first});
    }
  }
  return found;
}

class Judge {
 public:
  Judge(const trace::Trace& request, const EngineRun& engine_run)
      : request_(request), engine_run_(engine_run), bodies_(rollout_bodies(request)) {
    score_.name = engine_run.name;
    score_.failure = engine_run.failure;
    score_.resting = static_cast<int>(std::ranges::count(bodies_, true, &RolloutBody::rests));
    for (const trace::Shape& shape : request.header.shapes) solids_.add(shape);
    if (request.header.world) gravity_ = request.header.world->gravity;
    up_ = request.header.up == "z" ? Vec3d::UnitZ() : Vec3d::UnitY();
    if (!gravity_.isZero(0)) up_ = -gravity_.normalized();
  }

  RolloutScore score() {
    std::vector<trace::Frame> record = engine_run_.trace.frames;
    score_.has_velocities =
        std::ranges::all_of(record,
                            [&](const trace::Frame& frame) { return has_velocities(frame); }) &&
        !record.empty();
    std::size_t judged = 0;
    for (trace::Frame& frame : record) {
      if (!complete(frame)) break;
      see(frame);
      before_ = frame;
      ++judged;
    }
    record.resize(judged);
    if (judged > 0) score_.points /= static_cast<double>(judged);
    trace::Trace whole{engine_run_.trace.header, std::move(record)};
    if (judged > 0) score_.findings = lint::lint(whole);
    return score_;
  }

 private:
  bool has_velocities(const trace::Frame& frame) const {
    return frame.solver && std::ranges::all_of(bodies_, [&](const RolloutBody& body) {
             return trace::find_body(frame, body.name) != nullptr;
           });
  }

  /// Adds the poses of the request to a frame; false if the rest of the rollout is worthless.
  bool complete(trace::Frame& frame) {
    const auto requested = std::ranges::find(request_.frames, frame.frame, &trace::Frame::frame);
    const auto lost = [&](const std::string& what) {
      if (score_.failure.empty())
        score_.failure = "frame " + std::to_string(frame.frame) + " " + what;
      return false;
    };
    if (requested == request_.frames.end()) return lost("was not requested");
    frame.time = requested->time;
    for (const auto& [name, pose] : requested->poses) latest_[name] = pose;
    for (const RolloutBody& body : bodies_) {
      const Pose<double>* const pose = trace::find_pose(frame, body.name);
      if (pose == nullptr) return lost("has no pose of '" + body.name + "'");
      if (!pose->position.allFinite() || !pose->rotation.coeffs().allFinite() ||
          !(pose->position.cwiseAbs().maxCoeff() < kFarAway))
        return lost("has an invalid pose of '" + body.name + "'");
    }
    // Scripted shapes have the requested poses, whatever the engine reports.
    std::erase_if(frame.poses, [&](const trace::Placement& one) {
      return std::ranges::count(bodies_, one.first, &RolloutBody::name) == 0;
    });
    for (const auto& [name, pose] : latest_)
      if (trace::find_pose(frame, name) == nullptr) frame.poses.emplace_back(name, pose);
    return true;
  }

  void see(const trace::Frame& frame) {
    score_.time.push_back(frame.time);
    double height = -kInfinity, energy = 0, drift = 0;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const RolloutBody& body = bodies_[i];
      const Pose<double>& pose = *trace::find_pose(frame, body.name);
      const Vec3d center = pose.transform(body.center);
      height = std::max(height, center.dot(up_));
      energy += kinetic_energy(body, pose, motion_of(body, pose, frame)) -
                body.mass * gravity_.dot(center);
      if (!body.rests) continue;
      const Vec3d moved = center - body.start.transform(body.center);
      drift = std::max(drift, moved.norm());
      if (moved.norm() > score_.worst_drift) {
        score_.worst_drift = moved.norm();
        score_.drifted = body.name;
      }
      if (-moved.dot(up_) > body.thickness / 2 && !fallen_[body.name]) {
        fallen_[body.name] = true;
        ++score_.fallen;
        if (!score_.fell_at) score_.fell_at = frame.time, score_.first_fallen = body.name;
      }
    }
    score_.height.push_back(height);
    score_.energy.push_back(energy);
    score_.drift.push_back(drift);
    least_energy_ = std::min(least_energy_, energy);
    score_.energy_gained = std::max(score_.energy_gained, energy - least_energy_);
    score_.points += acting_points(frame);
    score_.penetration.push_back(penetration_of(frame));
    if (before_) see_passings(frame);
  }

  void see_passings(const trace::Frame& frame) {
    for (const Passing& one : passings(solids_, bodies_, *before_, frame)) {
      if (score_.passed++ > 0) continue;
      score_.first_passed =
          "frame " + std::to_string(frame.frame) + ", " + one.body + "-" + one.other;
    }
  }

  Motion motion_of(const RolloutBody& body, const Pose<double>& pose,
                   const trace::Frame& frame) const {
    if (score_.has_velocities) {
      const trace::Body& record = *trace::find_body(frame, body.name);
      return {record.velocity, record.angular_velocity};
    }
    if (!before_ || frame.frame == request_.frames.front().frame)
      return {body.velocity, body.angular_velocity};
    return between(body, *trace::find_pose(*before_, body.name), pose, frame.time - before_->time);
  }

  double penetration_of(const trace::Frame& frame) {
    std::vector<Boxed> shapes;
    for (const trace::Placement& one : frame.poses) {
      const bool is_body = std::ranges::count(bodies_, one.first, &RolloutBody::name) > 0;
      if (const auto placed = lint::place(solids_, &frame, one.first, {}))
        shapes.push_back({one.first, is_body, *placed, box_of(*placed)});
    }
    double deepest = 0;
    for (std::size_t i = 0; i < shapes.size(); ++i)
      for (std::size_t k = i + 1; k < shapes.size(); ++k) {
        const Boxed &a = shapes[i], &b = shapes[k];
        if ((!a.is_body && !b.is_body) || !overlaps(a.box, b.box)) continue;
        const auto separation = separation_of(a.placed, b.placed);
        if (!separation && score_.unknown.empty()) score_.unknown = a.name + "-" + b.name;
        const double depth = -separation.value_or(lint::Separation{}).distance;
        deepest = std::max(deepest, depth);
        if (depth <= score_.worst_penetration) continue;
        score_.worst_penetration = depth;
        score_.worst_place = "frame " + std::to_string(frame.frame) + ", " + a.name + "-" + b.name;
      }
    return deepest;
  }

  static constexpr double kFarAway = 1e9;  // metres

  const trace::Trace& request_;
  const EngineRun& engine_run_;
  std::vector<RolloutBody> bodies_;
  lint::Solids solids_;
  Vec3d gravity_ = Vec3d::Zero(), up_ = Vec3d::UnitY();
  std::map<std::string, Pose<double>> latest_;  // of shapes in the request so far
  std::map<std::string, bool> fallen_;
  std::optional<trace::Frame> before_;
  double least_energy_ = kInfinity;
  RolloutScore score_;
};

constexpr double kNear = 0.01;   // relative to the smaller shape: a gap that the first steps close
constexpr double kUpward = 0.1;  // cosine: a wall next to a body does not support it
constexpr double kStill = 1e-6;  // m/s and rad/s

/// Whether `below` supports a body, by their relative position.
bool bears(const lint::Placed& below, const lint::Placed& body, const Vec3d& up) {
  const double near = kNear * std::min(below.size(), body.size());
  if (const std::optional<lint::Separation> best = best_separation(below, body))
    return best->distance < near && best->normal.dot(up) > kUpward;
  // The orientation of a mesh is not considered; test whether it touches the lowered body.
  lint::Placed lowered = body;
  lowered.pose.position -= near * up;
  const auto separation = separation_of(below, lowered);
  return separation && separation->distance < 0;
}

}  // namespace

RolloutScore judge_rollout(const trace::Trace& request, const EngineRun& engine_run) {
  if (!engine_run.refusal.empty()) {
    RolloutScore score;
    score.name = engine_run.name;
    score.refusal = engine_run.refusal;
    return score;
  }
  return Judge(request, engine_run).score();
}

std::vector<RolloutBody> rollout_bodies(const trace::Trace& request) {
  std::vector<RolloutBody> bodies;
  const trace::Frame& start = request.frames.front();
  if (!start.solver || !request.header.world) return bodies;
  lint::Solids solids;
  for (const trace::Shape& shape : request.header.shapes) solids.add(shape);
  for (const trace::Body& record : start.solver->bodies) {
    const std::optional<lint::Placed> placed = lint::place(solids, &start, record.name, {});
    if (!placed) continue;
    RolloutBody& body = bodies.emplace_back();
    body.name = record.name;
    body.mass = record.mass;
    body.start = placed->pose;
    body.center = placed->pose.inverse_transform(record.center_of_mass);
    body.velocity = record.velocity;
    body.angular_velocity = record.angular_velocity;
    body.inertia.setZero();
    for (int row = 0; row < std::min(3, count_of(record.inertia)); ++row)
      body.inertia.row(row) = at(record.inertia, row).transpose();
    body.thickness = (placed->solid->upper() - placed->solid->lower()).minCoeff();
  }
  const Vec3d& gravity = request.header.world->gravity;
  if (gravity.isZero(0)) return bodies;
  const Vec3d up = -gravity.normalized();
  std::vector<std::string> bearing;  // resting shapes; bodies on them are still to be found
  for (const trace::Shape& shape : request.header.shapes)
    if (std::ranges::count(bodies, shape.name, &RolloutBody::name) == 0)
      bearing.push_back(shape.name);
  for (std::size_t next = 0; next < bearing.size(); ++next) {
    const std::optional<lint::Placed> below = lint::place(solids, &start, bearing[next], {});
    if (!below) continue;
    for (RolloutBody& body : bodies) {
      if (body.rests || body.velocity.norm() > kStill || body.angular_velocity.norm() > kStill)
        continue;
      body.rests = bears(*below, *lint::place(solids, &start, body.name, {}), up);
      if (body.rests) bearing.push_back(body.name);
    }
  }
  return bodies;
}

}  // namespace contactscope::versus
