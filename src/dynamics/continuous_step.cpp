#include "dynamics/continuous_step.h"

#include "broadphase/broad_phase.h"
#include "dynamics/solver.h"
#include "geometry/core_hull.h"
#include "manifold/in_double.h"

namespace contactscope {
namespace {

/// Box2D allows the same number of sub-steps per contact and step.
constexpr int kMaxStopsOfAPair = 8;

/// Motion of a body through the rest of the step.
template <class S> struct Path {
  S from = 0;  // fraction of the step
  Sweep<S> rest;
  bool stays = false;  // until the next step, whatever hits it

  Sweep<S> since(S time) const {
    const S part = (time - from) / (S(1) - from);
    Sweep<S> later = rest;
    later.start = rest.at(part);
    later.displacement *= S(1) - part;
    later.turn *= S(1) - part;
    return later;
  }
};

template <class S> bool finite(const Body<S>& body) {
  return body.center.allFinite() && body.rotation.coeffs().allFinite();
}

/// From one pose of a body to another. Chooses the rotation closest to the body's spin, so that
/// turns of more than half a circle per step are kept.
template <class S> Sweep<S> sweep_of_step(const Body<S>& before, const Body<S>& after, S dt) {
  Sweep<S> sweep{before.pose(), before.local_center, after.center - before.center, Vec3<S>::Zero()};
  const Quat<S> by = after.rotation * before.rotation.conjugate();
  const Vec3<S> half = by.w() < S(0) ? Vec3<S>(-by.vec()) : Vec3<S>(by.vec());
  const S sine = half.norm();
  const Vec3<S> spin = dt * after.angular_velocity;
  const S angle = S(2) * std::atan2(sine, std::abs(by.w()));
  const Vec3<S> axis = sine > S(0)         ? Vec3<S>(half / sine)
                       : spin.isZero(S(0)) ? Vec3<S>::UnitX()
                                           : Vec3<S>(spin.normalized());
  constexpr S kWholeTurn = S(6.283185307179586);
  sweep.turn = (angle + kWholeTurn * std::round((spin.dot(axis) - angle) / kWholeTurn)) * axis;
  return sweep;
}

/// The next impact of two bodies, or the time up to which the search proved them separated.
template <class S> struct Meeting {
  int a = 0, b = 0;
  S time = 0;  // fraction of the step
  Vec3<S> normal = Vec3<S>::UnitX();
  Vec3<S> point = Vec3<S>::Zero();
  S lacking = 0;  // metres by which the cores are closer than allowed

  auto key() const { return std::tuple(time, a, b); }
};

template <class S> class Stopper {
 public:
  Stopper(std::vector<Body<S>>& bodies, const std::vector<Body<S>>& before,
          const std::vector<Shape<S>>& shapes, const std::vector<ImpactCore>& cores,
          const ContinuousPairs<S>& pair_of, const SolverSettings& settings, S dt)
      : bodies_(bodies),
        shapes_(shapes),
        cores_(cores),
        pair_of_(pair_of),
        settings_(settled(settings, bodies)),
        dt_(dt) {
    for (int i = 0; i < count_of(bodies); ++i) {
      // Skip bodies whose state is not finite.
      const bool lost = !finite(at(bodies, i)) || !finite(at(before, i));
      paths_.push_back(
          {.from = 0, .rest = lost ? Sweep<S>{} : sweep_of_step(at(before, i), at(bodies, i), dt)});
      boxes_.push_back(lost ? Aabb<float>{} : box_of(i));
    }
  }

  std::vector<ImpactStop<S>> run() {
    look_at_all();
    std::vector<ImpactStop<S>> stops;
    while (!meetings_.empty()) {
      const auto first = std::ranges::min_element(meetings_, {}, &Meeting<S>::key);
      std::vector<int> turned;  // bodies whose motion changes, in order
      stops.push_back(stop(*first, turned));
      const auto turns = [&](int i) { return std::ranges::binary_search(turned, i); };
      std::erase_if(meetings_, [&](const Meeting<S>& one) { return turns(one.a) || turns(one.b); });
      for (const int i : turned)
        for (int other = 0; other < count_of(bodies_); ++other)
          if (other > i || (other != i && !turns(other))) look(i, other);
    }
    for (int i = 0; i < count_of(bodies_); ++i)
      if (at(bodies_, i).dynamic() && at(paths_, i).from > S(0))
        at(bodies_, i).place(at(paths_, i).rest.at(S(1)));
    return stops;
  }

 private:
  void look_at_all() {
    const std::unique_ptr<BroadPhase> phase = make_broad_phase("columns");
    std::vector<int> body_of;
    for (int i = 0; i < count_of(boxes_); ++i) {
      if (at(boxes_, i).empty()) continue;
      phase->add(at(boxes_, i));
      body_of.push_back(i);
    }
    for (const BoxPair& pair : phase->pairs()) look(at(body_of, pair.a), at(body_of, pair.b));
  }

  Aabb<float> box_of(int i) const {
    return swept_world_box(at(shapes_, i), at(paths_, i).rest,
                           settings_.speculative_margin.value_or(0));
  }
  bool moves(int i) const {
    const Sweep<S>& rest = at(paths_, i).rest;
    return !rest.displacement.isZero(S(0)) || !rest.turn.isZero(S(0));
  }

  /// Settings of two bodies in reach, in either order, one of them dynamic; else nullopt.
  std::optional<ContinuousPair<S>> near_pair(int i, int j) const {
    if (!at(bodies_, i).dynamic() && !at(bodies_, j).dynamic()) return std::nullopt;
    if (!overlaps(at(boxes_, i), at(boxes_, j))) return std::nullopt;
    return pair_of_(std::min(i, j), std::max(i, j));
  }

  /// Records the next impact of two bodies, in either order.
  void look(int one, int other) {
    const int a = std::min(one, other), b = std::max(one, other);
    if (!moves(a) && !moves(b)) return;
    if (const auto before = stops_of_.find({a, b});
        before != stops_of_.end() && before->second >= kMaxStopsOfAPair)
      return;
    const auto pair = near_pair(a, b);
    if (!pair || pair->method == ImpactMethod::Speculative) return;
    if (impact_refusal(kind_of(at(shapes_, a)), kind_of(at(shapes_, b)))) return;
    const S since = std::max(at(paths_, a).from, at(paths_, b).from);
    if (!(since < S(1))) return;
    ImpactLimits<double> limits;
    limits.gap = 0.5 * (at(cores_, a).depth + at(cores_, b).depth);
    limits.passes_overlaps = true;
    const auto sweep = [&](int i) { return at(paths_, i).since(since).template cast<double>(); };
    const ImpactResult<double> found =
        impact_of_shapes(at(cores_, a).shape, sweep(a), at(cores_, b).shape, sweep(b), pair->method,
                         limits)
            .result;
    if (found.status != ImpactStatus::Hit && found.status != ImpactStatus::OutOfIterations) return;
    const S time = since + rounded_down<S>(found.time) * (S(1) - since);
    Meeting<S> meeting{.a = a, .b = b, .time = std::min(time, S(1))};
    meeting.normal = found.normal.template cast<S>();
    meeting.point = found.on_a.template cast<S>();
    meeting.lacking = static_cast<S>(lacking_of(found.distance, limits.gap));
    meetings_.push_back(meeting);
  }

  ImpactStop<S> stop(const Meeting<S>& meeting, std::vector<int>& turned) {
    const int a = meeting.a, b = meeting.b;
    const S time = meeting.time;
    const bool for_good = ++stops_of_[{a, b}] >= kMaxStopsOfAPair;
    cut(a, time);
    cut(b, time);
    separate_at_rest(meeting);
    turned = solve_contacts_near(a, b, time);
    for (const int i : turned) {
      const Body<S>& body = at(bodies_, i);
      if (!body.dynamic()) continue;
      cut(i, time);
      Path<S>& path = at(paths_, i);
      path.stays = path.stays || (for_good && (i == a || i == b));
      const S left = path.stays ? S(0) : (S(1) - time) * dt_;
      path.rest.displacement = left * body.velocity;
      path.rest.turn = left * body.angular_velocity;
      at(boxes_, i) = box_of(i);
    }
    return {a, b, time, meeting.normal, meeting.point, for_good};
  }

  /// Restarts a body's path at `time`.
  void cut(int i, S time) {
    Path<S>& path = at(paths_, i);
    if (!at(bodies_, i).dynamic() || !(path.from < time)) return;
    path.rest = path.since(time);
    path.from = time;
  }

  /// Turning cores come nearer with each stop, until rounding makes them overlap and the search
  /// skips them. They may come as near as a quarter of the gap.
  static double lacking_of(double distance, double gap) {
    constexpr double kNearest = 0.25, kMovedTo = 0.5;
    return distance < kNearest * gap ? kMovedTo * gap - distance : 0;
  }
  void separate_at_rest(const Meeting<S>& meeting) {
    const S masses = at(bodies_, meeting.a).inverse_mass + at(bodies_, meeting.b).inverse_mass;
    const Vec3<S> offset = meeting.lacking / masses * meeting.normal;
    at(paths_, meeting.a).rest.start.position -= at(bodies_, meeting.a).inverse_mass * offset;
    at(paths_, meeting.b).rest.start.position += at(bodies_, meeting.b).inverse_mass * offset;
  }

  /// Solves the contacts of both bodies and of all near them at `time` for their velocities.
  /// Returns both and all whose velocity has changed, in order. (A body that is only near must
  /// yield too: with infinite mass it would drive them on at its velocity.)
  std::vector<int> solve_contacts_near(int a, int b, S time) {
    std::vector<int> who{a, b};
    for (int other = 0; other < count_of(bodies_); ++other)
      if (other != a && other != b && (near_pair(a, other) || near_pair(b, other)))
        who.push_back(other);
    std::vector<Body<S>> local;
    for (const int i : who) {
      Body<S> body = at(bodies_, i);
      const Path<S>& path = at(paths_, i);
      body.place(path.from < time ? path.since(time).start : path.rest.start);
      local.push_back(body);
    }
    CollideOptions options;
    options.margin = static_cast<S>(settings_.speculative_margin.value_or(0));
    std::vector<Manifolds<S>> contacts;
    std::vector<PairContacts<S>> pairs;
    contacts.reserve(who.size() * who.size());  // pairs point into it
    for (int i = 0; i < count_of(who); ++i) {
      for (int j = i + 1; j < count_of(who); ++j) {
        const auto pair = near_pair(at(who, i), at(who, j));
        if (!pair) continue;
        // As everywhere, a is the body with the lower index.
        const int one = at(who, i) < at(who, j) ? i : j, two = i + j - one;
        Manifolds<S>& found = contacts.emplace_back();
        collide(at(shapes_, at(who, one)), at(local, one).pose(), at(shapes_, at(who, two)),
                at(local, two).pose(), options, found);
        pairs.push_back({one, two, &found, pair->friction, pair->restitution});
      }
    }
    solve_impact<S>(local, pairs, settings_, dt_);
    std::vector<int> turned;
    for (int i = 0; i < count_of(who); ++i) {
      Body<S>& body = at(bodies_, at(who, i));
      const Body<S>& after = at(local, i);
      if (i < 2 || body.velocity != after.velocity ||
          body.angular_velocity != after.angular_velocity)
        turned.push_back(at(who, i));
      body.velocity = after.velocity;
      body.angular_velocity = after.angular_velocity;
    }
    std::ranges::sort(turned);
    return turned;
  }

  std::vector<Body<S>>& bodies_;
  const std::vector<Shape<S>>& shapes_;
  const std::vector<ImpactCore>& cores_;
  const ContinuousPairs<S>& pair_of_;
  SolverSettings settings_;
  S dt_;
  std::vector<Path<S>> paths_;
  std::vector<Aabb<float>> boxes_;
  std::vector<Meeting<S>> meetings_;
  std::map<std::pair<int, int>, int> stops_of_;
};

/// The shape with its surface moved inward, and the depth that was possible.
ImpactCore core_of(const Shape<double>& shape, double depth) {
  if (const auto* sphere = std::get_if<Sphere<double>>(&shape)) {
    const double moved = std::min(depth, kLargestCoreShare * sphere->radius);
    return {Sphere<double>{sphere->radius - moved}, moved};
  }
  if (const auto* capsule = std::get_if<Capsule<double>>(&shape)) {
    const double moved = std::min(depth, kLargestCoreShare * capsule->radius);
    return {Capsule<double>{capsule->points, capsule->radius - moved}, moved};
  }
  if (const auto* hull = std::get_if<Hull<double>>(&shape)) {
    CoreHull core = core_hull(*hull, depth);
    return {std::move(core.hull), core.margin};
  }
  return {shape, 0};
}

const Shape<double>& widened(const Shape<double>& shape) { return shape; }

/// Casts to double; a field is replaced by its source shape.
Shape<double> widened(const Shape<float>& shape) {
  if (const auto* field = std::get_if<Field<float>>(&shape)) return widened(field->source->shape);
  const auto* mesh = std::get_if<Mesh<float>>(&shape);
  if (mesh == nullptr) return in_double(shape);
  return build_mesh_with_flat_triangles(
      mapped(mesh->vertices, [](const Vec3<float>& v) -> Vec3d { return v.cast<double>(); }),
      mesh->triangles);
}

}  // namespace

template <class S>
std::vector<ImpactCore> impact_cores(const std::vector<Body<S>>& bodies,
                                     const std::vector<Shape<S>>& shapes,
                                     const SolverSettings& settings) {
  // Bodies rest at about the slop, and are stopped at one and a half times that.
  constexpr double kSlops = 3, kMinShare = 0.005;
  const double slop = settled(settings, bodies).slop.value_or(0);
  std::vector<ImpactCore> cores;
  for (int i = 0; i < count_of(bodies); ++i) {
    const Body<S>& body = at(bodies, i);
    if (!body.dynamic()) {
      cores.push_back({widened(at(shapes, i)), 0});
      continue;
    }
    const double thin =
        shortest_edge(static_cast<double>(body.mass), body.inertia.template cast<double>());
    cores.push_back(core_of(widened(at(shapes, i)), std::max(kSlops * slop, kMinShare * thin)));
  }
  return cores;
}

template <class S>
std::vector<ImpactStop<S>> stop_at_impacts(std::vector<Body<S>>& bodies,
                                           const std::vector<Body<S>>& before,
                                           const std::vector<Shape<S>>& shapes,
                                           const std::vector<ImpactCore>& cores,
                                           const ContinuousPairs<S>& pair_of,
                                           const SolverSettings& settings, S dt) {
  return Stopper<S>(bodies, before, shapes, cores, pair_of, settings, dt).run();
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(impact_cores, stop_at_impacts);

}  // namespace contactscope
