#include "lint/claims.h"

#include "trace/find.h"

namespace contactscope::lint {
namespace {

/// Relative to the smaller shape's size. Engines round, weld, and keep points while bodies move.
constexpr double kTolerance = 2e-3;
/// Coordinates are mostly single precision: a few roundings of the largest one.
constexpr double kRounding = 1e-6;
/// Overlap along a normal may exceed the least overlap by this share: engines prefer faces (Catto
/// 2007, "Feature Flip-Flop") and keep a normal while a body turns.
constexpr double kNormalShare = 0.1, kNormalTolerances = 4;
/// Cosine: within two degrees of the best normal a normal counts as equal to it, even if a long
/// plate has much more overlap along it.
constexpr double kSameNormal = 0.9994;
/// Tolerance of separated points, as a share: they serve the next step and are measured roughly.
constexpr double kSpeculativeShare = 0.25;
/// Likewise for 'on_a' and 'on_b' of a point.
constexpr double kSideTolerances = 4;

Quat<double> read(const Quat<double>& record, const Rotation& how) {
  if (how == kHalfTheAngle) {
    const Quat<double> turn =
        record.w() < 0 ? Quat<double>(-record.coeffs()) : record;  // the same rotation
    return Quat<double>(1 + turn.w(), turn.x(), turn.y(), turn.z()).normalized();
  }
  const std::array recorded = {record.w(), record.x(), record.y(), record.z()};
  const auto part = [&](int i) { return i < 0 ? -at(recorded, -i - 1) : at(recorded, i - 1); };
  return {part(how[0]), part(how[1]), part(how[2]), part(how[3])};
}

Vec3d read(const Vec3d& record, const Axes& axes) {
  const auto part = [&](int i) { return i < 0 ? -record[-i - 1] : record[i - 1]; };
  return {part(axes[0]), part(axes[1]), part(axes[2])};
}

Vec3d in_world(Frame frame, const Placed& a, const Placed& b, const Vec3d& point) {
  if (frame == Frame::World) return point;
  return (frame == Frame::OfA ? a : b).pose.transform(point);
}
Vec3d turned_to_world(Frame frame, const Placed& a, const Placed& b, const Vec3d& direction) {
  if (frame == Frame::World) return direction;
  return (frame == Frame::OfA ? a : b).pose.rotate(direction);
}

/// Collects wrong claims and keeps the worst: of the first kind in Wrong, the largest error.
class WorstProblem {
 public:
  explicit WorstProblem(Verdict& verdict) : verdict_(verdict) {}

  /// The allowed error is so many tolerances and `more`, at least `least`; nan is beyond it.
  bool is_off(double off, double tolerances, double more, double least) const {
    return !(off <= std::max(tolerances * verdict_.tolerance + more, least));
  }
  void claim(const Problem& problem, double off, double tolerances, double more = 0,
             double least = 0) {
    ++verdict_.claims;
    if (!is_off(off, tolerances, more, least)) return;
    ++verdict_.wrong;
    verdict_.beyond += !(off <= std::max(tolerances * verdict_.allowed + more, least));
    const bool is_first = !verdict_.worst || problem.kind < verdict_.worst->kind;
    const bool is_farther =
        !is_first && problem.kind == verdict_.worst->kind && off > verdict_.farthest;
    if (!is_first && !is_farther) return;
    verdict_.worst = problem;
    verdict_.farthest = off;
  }

 private:
  Verdict& verdict_;
};

/// A point measured against one of the solids, metres.
struct Measured {
  double off = 0;  // distance from the surface beyond its separation
  std::optional<double> exit;
  double more_by_core = 0;  // for a leaning capsule: exit by core minus `exit`
};

Measured measure(const Placed& solid, const Vec3d& point, const Vec3d& outward, double said) {
  Measured measured;
  measured.exit = solid.exit(point, outward);
  const double distance = solid.distance(point);
  measured.off = std::abs(distance) - std::abs(said);
  const std::optional<double> by_core = solid.exit(point, outward, true);
  if (!measured.exit || !by_core) return measured;
  measured.more_by_core = *by_core - *measured.exit;
  if (distance < 0) measured.off = std::min(measured.off, std::abs(*by_core) - std::abs(said));
  return measured;
}

/// How far the two points of a kept point may slide from each other, metres: Bullet's limit, and in
/// other engines a multiple of the tolerance.
double allowed_slide(const Solids& solids, double tolerance) {
  constexpr double kMaxBetween = 15, kBreakingThreshold = 0.02;
  return std::max(kMaxBetween * tolerance, solids.are_of_bullet ? kBreakingThreshold : 0.0);
}

/// A point that an engine keeps while its bodies slide is between a point of each. If these are on
/// the surfaces, and near each other, what is said of the point is measured at them.
void measure_kept(const Placed& a, const Placed& b, const std::array<Vec3d, 2>& on,
                  const Vec3d& position, const Vec3d& normal, double said, double tolerance,
                  double slide, Measured& of_a, Measured& of_b) {
  const Vec3d between = on[1] - on[0];
  const double along = between.dot(normal);
  if ((2 * position - on[0] - on[1]).norm() > between.norm() + tolerance ||
      (between - along * normal).norm() > slide)
    return;
  Measured at_a = measure(a, on[0], normal, 0), at_b = measure(b, on[1], -normal, 0);
  if (std::max(at_a.off, at_b.off) > tolerance || !at_a.exit || !at_b.exit) return;
  *at_a.exit -= along;  // the two exits are those at one point
  if (std::abs(*at_a.exit + *at_b.exit + said) <= tolerance) of_a = at_a, of_b = at_b;
}

/// Whether an engine has kept all points of a manifold with their normal from the frame before,
/// although the bodies have moved. Their claims held when the points were new.
bool is_kept(const Moments& frames, const trace::Pair& pair, const trace::Manifold& manifold,
             const Placed& a, const Placed& b, double slide) {
  if (frames.before == nullptr || frames.after_step) return false;
  const Pose<double>* const a_then = trace::find_pose(*frames.before, pair.a);
  const Pose<double>* const b_then = trace::find_pose(*frames.before, pair.b);
  if (a_then == nullptr || b_then == nullptr) return false;
  constexpr double kSame = 1e-5;  // relative to sizes and places: float coordinates
  const double same = kSame * (std::min(a.size(), b.size()) + a.pose.position.norm());
  const auto is_same = [&](const trace::Point& point, const trace::Point& then) {
    return then.on_a && then.on_b &&
           (a.pose.inverse_transform(*point.on_a) - a_then->inverse_transform(*then.on_a)).norm() <=
               same &&
           (b.pose.inverse_transform(*point.on_b) - b_then->inverse_transform(*then.on_b)).norm() <=
               same;
  };
  return std::ranges::all_of(manifold.points, [&](const trace::Point& point) {
    if (!point.on_a || !point.on_b) return false;
    const Vec3d between = *point.on_b - *point.on_a;
    if ((between - between.dot(manifold.normal) * manifold.normal).norm() > slide) return false;
    for (const trace::Pair& other : frames.before->pairs) {
      if (other.a != pair.a || other.b != pair.b || other.label != pair.label) continue;
      for (const trace::Manifold& then : other.manifolds)
        if ((then.normal - manifold.normal).norm() <= kSame &&
            std::ranges::any_of(then.points, [&](auto& one) { return is_same(point, one); }))
          return true;
    }
    return false;
  });
}

}  // namespace

bool have_their_size(const Reading& reading, const Verdict& verdict) {
  constexpr double kAbout = 1.25;
  if (reading.separation_scale == 1 && !reading.separations_negated) return true;
  double largest = 0, measured = 0;
  for (std::size_t i = 0; i < verdict.separations.size(); ++i) {
    const double is = std::abs(verdict.separations[i]);
    const double said = std::abs(verdict.separations[i] - verdict.deeper[i]);
    if (said > largest) largest = said, measured = is;
  }
  return largest <= kAbout * measured && measured <= kAbout * largest;
}

void Solids::add(const trace::Shape& shape) {
  try {
    solids_.insert_or_assign(shape.name, Solid(shape));
    shapes_[shape.name] = shape;
  } catch (const ShapeError& error) {
    refused[shape.name] = error.what();
  }
}

void Solids::deform(const std::vector<trace::Deformed>& now) {
  deformed_.clear();
  for (const trace::Deformed& one : now) {
    const auto found = shapes_.find(one.name);
    if (found == shapes_.end()) continue;
    trace::Shape shape = found->second;
    shape.vertices = one.vertices;
    try {
      deformed_.insert_or_assign(one.name, Solid(shape));
    } catch (const ShapeError&) {
      deformed_.erase(one.name);  // degenerate now; the header's shape would be worse than none
    }
  }
}

const Solid* Solids::find(const std::string& name, Form form) const {
  if (form != Form::AsReported) {
    if (const auto known = reformed_.find({name, form}); known != reformed_.end())
      return &known->second;
    const auto record = shapes_.find(name);
    if (record != shapes_.end() && takes(record->second, form))
      return &reformed_.emplace(std::pair(name, form), Solid(reformed(record->second, form)))
                  .first->second;
  }
  if (const auto found = deformed_.find(name); found != deformed_.end()) return &found->second;
  const auto found = solids_.find(name);
  return found == solids_.end() ? nullptr : &found->second;
}

Reading Solids::collided(const std::string& a, const std::string& b) const {
  const auto is_box = [&](auto& name) { return takes(shapes_.at(name), Form::BoxesHalf); };
  Reading reading;
  if (are_of_bullet && !(is_box(a) && is_box(b))) reading.form = Form::EdgesRounded;
  return reading;
}

const std::string& Solids::body_of(const std::string& name) const {
  const auto found = shapes_.find(name);
  return found == shapes_.end() || found->second.body.empty() ? name : found->second.body;
}

double tolerance_of(const Placed& a, const Placed& b) {
  const double reach =
      std::max(a.pose.position.cwiseAbs().maxCoeff(), b.pose.position.cwiseAbs().maxCoeff());
  return kTolerance * std::min(a.size(), b.size()) + kRounding * reach + a.solid->vagueness() +
         b.solid->vagueness();
}

double Solids::tolerance_of(const Placed& a, const Placed& b) const {
  const double own = lint::tolerance_of(a, b);
  return tolerance > 0 ? std::min(tolerance, own) : own;
}

double Solids::allowed_for(const Placed& a, const Placed& b) const {
  return std::max(tolerance, tolerance_of(a, b));
}

std::optional<Placed> place(const Solids& solids, const trace::Frame* frame,
                            const std::string& name, const Reading& reading) {
  const Solid* const solid = solids.find(name, reading.form);
  if (solid == nullptr || frame == nullptr) return std::nullopt;
  const Pose<double>* const record = trace::find_pose(*frame, name);
  if (record == nullptr) return std::nullopt;
  Placed placed{solid, *record, solid->is_plane() ? 1.0 : reading.shape_scale};
  placed.pose.rotation = read(record->rotation, reading.rotation);
  if (reading.at_center_of_mass)
    placed.pose.position -= placed.pose.rotate(solid->center_of_mass());
  return placed;
}

bool stands_still(const Solids& solids, const Moments& frames, const std::string& name) {
  const bool is_last = frames.after == nullptr || frames.after_step;
  const auto from = place(solids, is_last ? frames.before : frames.now, name, {});
  const auto to = place(solids, is_last ? frames.now : frames.after, name, {});
  const trace::Body* const body =
      trace::find_body(is_last ? *frames.now : *frames.after, solids.body_of(name));
  return from && to && from->pose.position == to->pose.position &&
         from->pose.rotation.coeffs() == to->pose.rotation.coeffs() &&
         (body == nullptr || (body->velocity.isZero() && body->angular_velocity.isZero()));
}

std::optional<Verdict> judge(const Solids& solids, const Moments& frames, const trace::Pair& pair,
                             const Reading& reading) {
  const trace::Frame* const frame = reading.moment == Moment::OfFrame       ? frames.now
                                    : reading.moment == Moment::FrameBefore ? frames.before
                                                                            : frames.after;
  const std::optional<Placed> a = place(solids, frame, pair.a, reading);
  const std::optional<Placed> b = place(solids, frame, pair.b, reading);
  if (!a || !b) return std::nullopt;
  std::optional<Separation> best;
  if (reading.shape_scale == 1) best = best_separation(*a, *b);
  Verdict verdict;
  verdict.tolerance = solids.tolerance_of(*a, *b);
  verdict.allowed = solids.allowed_for(*a, *b);
  const double tolerance = verdict.tolerance, slide = allowed_slide(solids, tolerance);
  Reading as_reported;
  as_reported.form = reading.form;  // Bullet's rounded edges
  const bool may_be_kept = reading == as_reported && frame == frames.of_contacts();
  WorstProblem worst(verdict);
  for (int m = 0; m < count_of(pair.manifolds); ++m) {
    const trace::Manifold& manifold = at(pair.manifolds, m);
    const Vec3d recorded_normal = read(manifold.normal, reading.axes);
    Vec3d normal = turned_to_world(reading.normals, *a, *b, recorded_normal).normalized();
    if (reading.normals_flipped) normal = -normal;
    double deepest = std::numeric_limits<double>::infinity();
    for (int p = 0; p < count_of(manifold.points); ++p) {
      const trace::Point& point = at(manifold.points, p);
      const auto to_world = [&](const Vec3d& record) {
        return in_world(reading.points, *a, *b, reading.point_scale * read(record, reading.axes));
      };
      const Vec3d position = to_world(point.position);
      const double said =
          (reading.separations_negated ? -1 : 1) * reading.separation_scale * point.separation;
      deepest = std::min(deepest, said);
      Measured of_a = measure(*a, position, normal, said);
      Measured of_b = measure(*b, position, -normal, said);
      const std::optional<Vec3d>& on_a = reading.sides_swapped ? point.on_b : point.on_a;
      const std::optional<Vec3d>& on_b = reading.sides_swapped ? point.on_a : point.on_b;
      if (on_a && on_b &&
          (std::max(of_a.off, of_b.off) > tolerance ||
           std::abs(of_a.exit.value_or(0) + of_b.exit.value_or(0) + said) > tolerance))
        measure_kept(*a, *b, {to_world(*on_a), to_world(*on_b)}, position, normal, said, tolerance,
                     slide, of_a, of_b);
      const double off = std::max(of_a.off, of_b.off);
      const double speculative = kSpeculativeShare * std::max(said, 0.0);
      worst.claim({Wrong::Surface, m, p, std::abs(said), off + std::abs(said),
                   of_a.off > of_b.off ? pair.a : pair.b},
                  off, 1, speculative);
      if (of_a.exit && of_b.exit && off <= tolerance + speculative) {
        // For a leaning capsule every value between its two measures is right.
        const double most = -*of_a.exit - *of_b.exit;
        const double least = most - of_a.more_by_core - of_b.more_by_core;
        const double is = std::clamp(said, std::min(least, most), std::max(least, most));
        verdict.deeper.push_back(is - said);
        verdict.separations.push_back(is);
        worst.claim({Wrong::Separation, m, p, said, is}, std::abs(is - said), 1, speculative,
                    kNormalShare * std::abs(is));
      } else if (!of_a.exit || !of_b.exit) {  // the normal does not point out of a plane
        const double infinite = -std::numeric_limits<double>::infinity();
        worst.claim({Wrong::Normal,
                     m,
                     p,
                     infinite,
                     best ? best->distance : 0,
                     {},
                     best ? best->normal : Vec3d::Zero()},
                    1, 0);
      }
      const auto on_its_surface = [&](const std::optional<Vec3d>& record, const Placed& solid,
                                      const std::string& name) {
        if (!record) return;
        const double off_surface = std::abs(solid.distance(to_world(*record)));
        worst.claim({Wrong::Side, m, p, 0, off_surface, name}, off_surface, kSideTolerances);
      };
      on_its_surface(on_a, *a, pair.a);
      on_its_surface(on_b, *b, pair.b);
    }
    const bool has_own_normal = !pair.degenerate && !pair.voided && pair.manifolds.size() == 1;
    if (!best || !has_own_normal || manifold.points.empty()) continue;
    const double along = separation_along(*a, *b, normal);
    const bool is_near = normal.dot(best->normal) >= kSameNormal;
    const double off = is_near ? 0 : best->distance - along;
    const auto allowed = [&](double of) { return kNormalShare * std::abs(of); };
    const auto is_off = [&](double by, double of) {
      return worst.is_off(by, kNormalTolerances, 0, allowed(of));
    };
    // For long shapes the deepest overlap along a slightly wrong normal is outside the patch.
    const double depth = is_near ? best->distance : along;
    const bool has_depth = !pair.reduction && std::isfinite(depth);
    if (may_be_kept &&
        (is_off(off, best->distance) || (has_depth && is_off(deepest - depth, depth))) &&
        is_kept(frames, pair, manifold, *a, *b, slide)) {
      ++verdict.kept;
      continue;
    }
    worst.claim({Wrong::Normal, m, 0, along, best->distance, {}, best->normal}, off,
                kNormalTolerances, 0, allowed(best->distance));
    if (has_depth)
      worst.claim({Wrong::Deepest, m, 0, deepest, depth}, deepest - depth, kNormalTolerances, 0,
                  allowed(depth));
  }
  return verdict;
}

double scale_of(const Solids& solids, const Moments& frames, const trace::Pair& pair,
                std::size_t which) {
  const std::optional<Placed> a = place(solids, frames.of_contacts(), pair.a, {});
  const std::optional<Placed> b = place(solids, frames.of_contacts(), pair.b, {});
  if (!a || !b) return 0;
  // The extent is linear as long as the point leaves through the same face, so a few steps do.
  const auto root_of = [](const auto& function, const auto& is_right) {
    for (const double start : {1.0, 1.5, 0.7}) {
      double last = start, at = 0.9 * start, value = function(last);
      for (int step = 0; step < 4; ++step) {
        const double now = function(at), next = at - now * (at - last) / (now - value);
        if (!(next > 0.1 && next < 10)) break;
        last = at, value = now, at = next;
        if (is_right(at)) return at;
      }
    }
    return 0.0;
  };
  const auto with = [&](double scale) {
    std::pair<Placed, Placed> placed(*a, *b);
    for (auto& [one, is_of] : {std::pair(&placed.first, which != 1 && which != 4),
                               std::pair(&placed.second, which % 3 != 0)})
      if (is_of && !one->solid->is_plane())
        (which > 2 ? one->margin : one->scale) = which > 2 ? (scale - 1) * one->size() : scale;
    return placed;
  };
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const trace::Manifold& manifold : pair.manifolds)
    for (const trace::Point& point : manifold.points) {
      const auto missing = [&](double scale) {  // of the overlap at the point
        const auto [scaled_a, scaled_b] = with(scale);
        const auto exit_a = scaled_a.exit(point.position, manifold.normal);
        const auto exit_b = scaled_b.exit(point.position, -manifold.normal);
        return exit_a && exit_b ? -point.separation - *exit_a - *exit_b
                                : std::numeric_limits<double>::infinity();
      };
      const auto is_right = [&](double scale) {
        const auto [scaled_a, scaled_b] = with(scale);
        const double off = std::max(std::abs(scaled_a.distance(point.position)),
                                    std::abs(scaled_b.distance(point.position)));
        const double tolerance = solids.tolerance_of(scaled_a, scaled_b);
        return off <= std::abs(point.separation) + tolerance &&
               std::abs(missing(scale)) <= tolerance / 2;
      };
      const double scale = root_of(missing, is_right);
      if (scale == 0) return 0;
      least = std::min(least, scale), most = std::max(most, scale);
    }
  const double same = kSameScale[which > 2];
  return most <= same * least && std::abs(most - 1) > same - 1 ? (least + most) / 2 : 0;
}

bool moves(const Solids& solids, const Moments& frames, const trace::Pair& pair, double tolerance) {
  const trace::Frame* const other = frames.before != nullptr ? frames.before : frames.after;
  const auto b_in_a = [&](const trace::Frame* frame) {
    const auto a = place(solids, frame, pair.a, {}), b = place(solids, frame, pair.b, {});
    return a && b ? std::optional(relative_pose(a->pose, b->pose).position) : std::nullopt;
  };
  const std::optional<Vec3d> now = b_in_a(frames.now), then = b_in_a(other);
  return now && then && (*now - *then).norm() > tolerance;
}

}  // namespace contactscope::lint
