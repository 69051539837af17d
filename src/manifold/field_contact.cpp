#include "manifold/field_contact.h"

#include <queue>

#include "query/gjk.h"

namespace contactscope {
namespace {

/// A piece in the lattice's frame, cells.
struct Core {
  std::array<Vec3d, 3> corners;
  int count;
  FeatureRef feature;
  Aabb<double> box;

  SupportSet<double> set() const { return {corners.data(), count, nullptr}; }
};

Core core_of(const PlacedField& field, const FieldPiece& piece) {
  Core core{{}, piece.count, piece.feature, {}};
  for (int k = 0; k < piece.count; ++k) {
    at(core.corners, k) = field.in_lattice(at(piece.corners, k));
    core.box.include(at(core.corners, k));
  }
  return core;
}

double distance_of(const Aabb<double>& a, const Aabb<double>& b) {
  return (a.lower - b.upper).cwiseMax(b.lower - a.upper).cwiseMax(0.0).norm();
}

/// Lengths in cells.
class GapSearch {
 public:
  GapSearch(const DistanceField& field, double best) : field_(field), best_(best) {}

  void look_at(const Core& core) {
    if (const auto& round = field_.core())
      offer(core, {round->points.data(), 2, nullptr}, round->radius);
    else
      look_at(core, *field_.surface());
  }
  double best() const { return best_; }
  /// Feature of the best; null if nothing is nearer than the limit.
  const FeatureRef* feature() const { return core_ ? &core_->feature : nullptr; }
  const Vec3d& on_core() const { return on_core_; }
  const Vec3d& outward() const { return outward_; }

 private:
  void offer(const Core& core, const SupportSet<double>& other, double radius) {
    const GjkResult<double> nearest = gjk<double>(core.set(), other, Pose<double>{});
    const double distance = std::max(nearest.distance - radius, 0.0);
    if (!(distance < best_)) return;
    best_ = distance;
    core_ = core;
    on_core_ = nearest.on_a;
    outward_ = -nearest.normal;
  }

  void look_at(const Core& core, const Mesh<double>& surface) {
    const AabbTree<double>& tree = surface.tree;
    using Waiting = std::pair<double, int>;  // distance of the box, node
    std::array<Waiting, kMaxAabbTreeDepth + 1> stack;
    int height = 0;
    at(stack, height++) = {distance_of(core.box, tree.bounds()), 0};
    while (height > 0) {
      const auto [near, index] = at(stack, --height);
      if (near >= best_) continue;
      const AabbTree<double>::Node& node = at(tree.nodes, index);
      if (node.leaf()) {
        for (int k = node.next; k < node.next + node.count; ++k) {
          if (!(distance_of(core.box, at(tree.boxes, k)) < best_)) continue;
          const int triangle = at(tree.triangles, k);
          const std::array<Vec3d, 3> corners = {surface.corner(triangle, 0),
                                                surface.corner(triangle, 1),
                                                surface.corner(triangle, 2)};
          offer(core, {corners.data(), 3, nullptr}, 0);
        }
        continue;
      }
      Waiting left{0, index + 1}, right{0, tree.right_of(index)};
      for (Waiting* child : {&left, &right})
        child->first = distance_of(core.box, at(tree.nodes, child->second).box);
      at(stack, height++) = std::max(left, right);
      at(stack, height++) = std::min(left, right);
    }
  }

  const DistanceField& field_;
  double best_;
  std::optional<Core> core_;
  Vec3d on_core_ = Vec3d::Zero(), outward_ = Vec3d::UnitY();
};

/// After so many cuts the nearest piece counts as a touch: enough, if only a part is at the margin.
constexpr int kMaxCuts = 1 << 14;
/// Enough to settle the deepest touch, except where the shapes lie flat on each other.
constexpr int kMaxDeepeningCuts = 1 << 11;
/// Maximum length of a record: pictures cannot distinguish more points.
constexpr std::size_t kMaxProbes = 4096;

/// A subdivided part of a piece. Its path identifies it: two bits per cut.
struct Part {
  std::array<Vec3d, 3> corners;
  int count;
  FeatureRef feature;
  std::uint32_t path = 0;

  Vec3d middle() const {
    if (count == 1) return corners[0];
    if (count == 2) return 0.5 * (corners[0] + corners[1]);
    return (corners[0] + corners[1] + corners[2]) / 3;
  }
  /// Minimum (<= 0) on the part of the linear function with this gradient and value 0 at `from`.
  double lowest(const Vec3d& gradient, const Vec3d& from) const {
    double least = 0;
    for (int k = 0; k < count; ++k) least = std::min(least, gradient.dot(at(corners, k) - from));
    return least;
  }
  double reach(const Vec3d& from) const {
    double squared = 0;
    for (int k = 0; k < count; ++k)
      squared = std::max(squared, (at(corners, k) - from).squaredNorm());
    return std::sqrt(squared);
  }
  /// Cuts a segment, or a triangle across its longest side, into two: slivers become compact.
  std::array<Part, 2> cut() const {
    std::array<Part, 2> parts{*this, *this};
    parts[0].path = 2 * path + 1;
    parts[1].path = 2 * path + 2;
    int longest = 0;
    for (int k = 1; k < (count == 3 ? 3 : 1); ++k)
      if (side(k) > side(longest)) longest = k;
    const int next = (longest + 1) % count;
    const Vec3d half = 0.5 * (at(corners, longest) + at(corners, next));
    at(parts[0].corners, next) = half;
    at(parts[1].corners, longest) = half;
    return parts;
  }

 private:
  double side(int k) const { return (at(corners, (k + 1) % count) - at(corners, k)).squaredNorm(); }
};

class Search {
 public:
  Search(const PlacedField& field, const FieldSearchLimits& limits)
      : field_(field), limits_(limits) {
    const Vec3d out = Vec3d::Constant(limits.radius + limits.margin);
    const Aabb<double>& box = field.field->surface_box();
    box_ = {Vec3d(field.origin + field.cell * box.lower - out),
            Vec3d(field.origin + field.cell * box.upper + out)};
  }

  /// Steps 1 and 2.
  void look_through(const FieldPiece& piece) {
    std::vector<Part> open{{piece.corners, piece.count, piece.feature}};
    while (!open.empty()) {
      const Part part = open.back();
      open.pop_back();
      const Vec3d middle = part.middle();
      const double reach = part.reach(middle);
      double bound = 0;
      if (!can_touch(part, middle, reach, bound)) continue;
      if (reach > limits_.spacing) {
        for (const Part& half : part.cut()) open.push_back(half);
        continue;
      }
      look_at(part, middle, reach, bound);
    }
  }

  /// Step 3.
  void decide() {
    none_sampled_ = touches_.found.empty();
    for (int cuts = 0; touches_.found.empty() && !undecided_.empty(); ++cuts) {
      const Part part = undecided_.top().part;
      undecided_.pop();
      const Vec3d middle = part.middle();
      if (part.reach(middle) <= kFieldTolerance * field_.cell || cuts == kMaxCuts) {
        add(touch_at(part, middle, value(middle)));
        return;
      }
      for (const Part& half : part.cut()) {
        const Vec3d of_half = half.middle();
        double bound = 0;
        if (!can_touch(half, of_half, half.reach(of_half), bound)) continue;
        look_at(half, of_half, half.reach(of_half), bound);
      }
    }
  }

  /// Step 4.
  void deepen(std::span<const FieldPiece> pieces) {
    if (touches_.found.empty()) return;
    std::optional<FieldTouch> deepest;
    // Not touches_.least, which may be a bound if step 3 ended at its tolerance.
    double least =
        std::ranges::min_element(touches_.found, {}, &FieldTouch::separation)->separation;
    if (least + limits_.radius > 0 && field_.field->settings().exact) {
      const FieldGap gap = field_gap(field_, pieces, least + limits_.radius);
      const FieldTouch nearest{gap.on_piece, gap.distance - limits_.radius, gap.outward,
                               gap.feature};
      if (nearest.separation < least - DistanceField::kExactSlack * field_.cell) {
        least = nearest.separation;
        deepest = nearest;
      }
      if (gap.distance > 0) {
        if (deepest) replace_by(*deepest);
        return;
      }
      if (deepest) deepest->outward = outward_of(value(gap.on_piece));
    }
    const auto is_less = [&](double bound) {
      return bound < least - kFieldTolerance * field_.cell;
    };
    for (int cuts = 0; !shallow_.empty() && cuts < kMaxDeepeningCuts; ++cuts) {
      const auto [bound, part] = shallow_.top();
      if (!is_less(bound)) break;
      shallow_.pop();
      for (const Part& half : part.cut()) {
        const Vec3d middle = half.middle();
        const FieldSample sample = value(middle);
        const FieldTouch touch = touch_at(half, middle, sample);
        if (touch.separation < least) {
          least = touch.separation;
          deepest = touch;
        }
        const double deeper = slope_bound(half, middle, sample);
        if (is_less(deeper)) shallow_.push({deeper, half});
      }
    }
    if (deepest) replace_by(*deepest);
  }

  FieldTouches&& touches() { return std::move(touches_); }

 private:
  struct Undecided {
    double bound;  // of the separation, for all its points
    Part part;
    bool operator<(const Undecided& other) const { return bound > other.bound; }
  };

  /// Lower bound of the separation for all points of a part, by the slope at its middle: the
  /// distance from a convex shape is above its tangent.
  double slope_bound(const Part& part, const Vec3d& middle, const FieldSample& sample) const {
    return sample.distance - limits_.radius + part.lowest(sample.gradient, middle);
  }

  bool conservative() const { return limits_.search == FieldSearch::Conservative; }

  bool can_touch(const Part& part, const Vec3d& middle, double reach, double& bound) {
    if (!conservative()) {
      Aabb<double> box;
      for (int k = 0; k < part.count; ++k) box.include(at(part.corners, k));
      return overlaps(box, box_);
    }
    bound = field_.bounds(middle).lower - reach * (1 + 0x1p-50) - limits_.radius;
    if (bound <= limits_.margin) return true;
    touches_.least = std::min(touches_.least, bound);
    return false;
  }

  /// The exact distance if the field has it and the touch depends on it.
  FieldSample value(const Vec3d& point) const {
    const FieldSample sample = field_.sample(point);
    return conservative() && field_.field->settings().exact &&
                   sample.source != FieldSample::Source::Exact
               ? field_.exact(point)
               : sample;
  }

  /// Adds a touch, or queues the part for more cuts, or neither.
  void look_at(const Part& part, const Vec3d& middle, double reach, double bound) {
    const FieldSample sample = value(middle);
    const double separation = sample.distance - limits_.radius;
    if (limits_.probes != nullptr && limits_.probes->size() < kMaxProbes) [[unlikely]]
      limits_.probes->push_back({middle, separation});
    if (conservative()) {
      const double deeper = slope_bound(part, middle, sample);
      if (deeper < touches_.least) shallow_.push({deeper, part});
    }
    if (separation <= limits_.margin) return add(touch_at(part, middle, sample));
    touches_.least = std::min(touches_.least, separation);
    if (sample.source == FieldSample::Source::Exact)
      bound = std::max(bound, separation - DistanceField::kExactSlack * field_.cell - reach);
    if (reach > 0 && bound <= limits_.margin) undecided_.push({bound, part});
  }

  static Vec3d outward_of(const FieldSample& sample) {
    const double length = sample.gradient.norm();
    return length > 0 ? Vec3d(sample.gradient / length) : Vec3d(Vec3d::UnitY());
  }

  FieldTouch touch_at(const Part& part, const Vec3d& middle, const FieldSample& sample) const {
    FieldTouch touch{middle, sample.distance - limits_.radius, outward_of(sample), part.feature};
    // Ids have room for 2^10 parts of each of four million triangles.
    if (part.path > 0) touch.feature.index = (touch.feature.index << 10U) + 1 + part.path % 1023;
    return touch;
  }

  /// The result of step 3 shows only that there is a touch.
  void replace_by(const FieldTouch& deepest) {
    if (none_sampled_) touches_.found.clear();
    add(deepest);
  }

  void add(const FieldTouch& touch) {
    touches_.found.push_back(touch);
    touches_.least = std::min(touches_.least, touch.separation);
  }

  const PlacedField& field_;
  const FieldSearchLimits& limits_;
  Aabb<double> box_;
  bool none_sampled_ = false;  // step 2 found no touch
  std::priority_queue<Undecided> undecided_;
  std::priority_queue<Undecided> shallow_;  // tested; may be deeper elsewhere than any touch
  FieldTouches touches_{{}, std::numeric_limits<double>::infinity()};
};

}  // namespace

FieldGap field_gap(const PlacedField& field, std::span<const FieldPiece> pieces, double limit) {
  GapSearch search(*field.field, limit * field.per_cell);
  for (const FieldPiece& piece : pieces) search.look_at(core_of(field, piece));
  if (search.feature() == nullptr) return {limit};
  return {search.best() * field.cell, field.origin + field.cell * search.on_core(),
          search.outward(), *search.feature()};
}

FieldTouches find_touches(const PlacedField& field, std::span<const FieldPiece> pieces,
                          const FieldSearchLimits& limits) {
  Search search(field, limits);
  for (const FieldPiece& piece : pieces) search.look_through(piece);
  if (limits.search == FieldSearch::Conservative) {
    search.decide();
    search.deepen(pieces);
  }
  return search.touches();
}

}  // namespace contactscope
