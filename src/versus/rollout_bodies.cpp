#include <algorithm>

#include "core/at.h"
#include "lint/claims.h"
#include "lint/own_contacts.h"
#include "versus/rollout.h"

namespace contactscope::versus {
namespace {

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
