#include "manifold/merge_triangles.h"

#include "core/convex_polygon.h"
#include "geometry/box_topology.h"
#include "manifold/collide_pairs.h"
#include "query/tolerance.h"

namespace contactscope {
namespace {

/// The vertex that two undirected edges share; -1 for none.
template <class S> int common_vertex(const Hull<S>& hull, std::uint32_t one, std::uint32_t other) {
  // Those of a box need not be fetched from memory.
  const HalfEdge* const edges = hull.is_box() ? kBox.half_edges.data() : hull.half_edges.data();
  const auto end = [&](std::uint32_t half) { return edges[half].origin; };
  const int from = end(2 * one), to = end(2 * one + 1);
  // No short circuits: which ends meet is random, and branches would be mispredicted.
  const bool at_from = (from == end(2 * other)) | (from == end(2 * other + 1));
  const bool at_to = (to == end(2 * other)) | (to == end(2 * other + 1));
  if (at_from == at_to) return -1;
  return at_from ? from : to;
}

/// The face that looks most along a direction.
template <class S> int facing(const Hull<S>& hull, const Vec3<S>& direction) {
  if (hull.is_box()) {
    int axis = 0;
    direction.cwiseAbs().maxCoeff(&axis);
    return 2 * axis + (direction[axis] < S(0) ? 1 : 0);
  }
  const auto best = std::ranges::max_element(
      hull.planes, {}, [&](const Plane<S>& plane) { return plane.normal.dot(direction); });
  return static_cast<int>(best - hull.planes.begin());
}

/// Points that differ in their id, or are of one triangle; of others the deepest.
template <class S> class DistinctPoints {
 public:
  explicit DistinctPoints(int most)
      : mask_(std::bit_ceil(2 * static_cast<unsigned>(most)) - 1),
        slots_(static_cast<int>(mask_ + 1)),
        points_(most),
        triangles_(most) {
    std::fill_n(slots_.data(), mask_ + 1, -1);
  }

  void add(const ContactPoint<S>& point, int triangle) {
    const auto mix = [](const FeatureRef& ref) {
      return (std::uint64_t{ref.index} * 3 + static_cast<std::uint64_t>(ref.kind)) * 2 +
             static_cast<std::uint64_t>(ref.owner);
    };
    const std::uint64_t key =
        (mix(point.id.first) << 32 ^ mix(point.id.second)) * std::uint64_t{0x9e3779b97f4a7c15};
    for (unsigned slot = static_cast<unsigned>(key >> 32) & mask_;; slot = (slot + 1) & mask_) {
      int& place = slots_[static_cast<int>(slot)];
      if (place < 0) {
        place = count_;
        triangles_[count_] = triangle;
        points_[count_++] = point;
        return;
      }
      ContactPoint<S>& known = points_[place];
      if (known.id != point.id || triangles_[place] == triangle) continue;
      if (point.separation < known.separation) known = point;
      return;
    }
  }

  ContactPoints<S> points() const { return {points_.data(), static_cast<std::size_t>(count_)}; }

 private:
  unsigned mask_;
  int count_ = 0;
  Scratch<int, 128> slots_;  // indices into points_; -1: free
  Scratch<ContactPoint<S>, 64> points_;
  Scratch<int, 64> triangles_;  // the first one of each point
};

/// The corners of the convex hull of points in a plane, within rounding, by quickhull (Barber et al.
/// 1996): no mistake of rounding can lose a corner, because each is the farthest in some direction.
template <class S> class Outline {
 public:
  /// `near`: metres by which rounding may have moved a point.
  Outline(ContactPoints<S> points, const Vec3<S>& normal, S near)
      : count_(count_of(points)), near_(near), places_(count_), corners_(count_) {
    const PlaneFrame<S> plane(points[0].position, normal);
    Vec2<S> middle = Vec2<S>::Zero();
    for (int i = 0; i < count_; ++i) {
      places_[i] = plane.seen(at(points, i).position);
      middle += places_[i];
    }
    middle /= static_cast<S>(count_);
    const int first = farthest_from(middle);
    const int second = farthest_from(places_[first]);
    corners_[corner_count_++] = first;
    if (!((places_[second] - places_[first]).norm() > near)) return;
    corners_[corner_count_++] = second;
    Scratch<int, 64> candidates(count_);
    const std::span<int> all(candidates.data(), points.size());
    std::iota(all.begin(), all.end(), 0);
    add_beyond(first, second, all);
    add_beyond(second, first, all);
    std::sort(corners_.data(), corners_.data() + corner_count_);
  }

  /// Ascending indices.
  std::span<const int> corners() const {
    return {corners_.data(), static_cast<std::size_t>(corner_count_)};
  }

 private:
  int farthest_from(const Vec2<S>& place) const {
    int best = 0;
    S most = S(-1);
    for (int i = 0; i < count_; ++i) {
      const S squared = (places_[i] - place).squaredNorm();
      if (squared > most) most = squared, best = i;
    }
    return best;
  }

  /// Adds the corners to the right of the line between two corners, from among `candidates`, which
  /// it reorders. Of points that are equally far from the line the first along it is a corner.
  void add_beyond(int from, int to, std::span<int> candidates) {
    const Vec2<S> start = places_[from];
    const Vec2<S> along = (places_[to] - start).normalized();
    const auto height = [&](int i) -> S { return cross(places_[i] - start, along); };
    S most = near_;
    const auto end = std::partition(candidates.begin(), candidates.end(), [&](int i) {
      const S here = height(i);
      most = std::max(most, here);
      return here > near_;
    });
    if (end == candidates.begin()) return;
    std::span<int> beyond(candidates.begin(), end);
    S least = std::numeric_limits<S>::infinity();
    for (int& i : beyond) {
      const S place = (places_[i] - start).dot(along);
      if (!(place < least && height(i) >= most - near_)) continue;
      least = place;
      std::swap(i, beyond.front());
    }
    const int best = beyond.front();
    beyond = beyond.subspan(1);
    corners_[corner_count_++] = best;
    add_beyond(from, best, beyond);
    add_beyond(best, to, beyond);
  }

  int count_, corner_count_ = 0;
  S near_;
  Scratch<Vec2<S>, 64> places_;  // in the plane, metres, from the first point
  Scratch<int, 64> corners_;
};

/// Whether one to three points are corners of their Outline, without computing it: seen along the
/// normal each is farther than twice `near` from the others and the line through them.
template <class S> bool are_clear_corners(ContactPoints<S> points, const Vec3<S>& normal, S near) {
  if (points.size() == 1) return true;
  const S clear = S(8) * near;
  const Vec3<S> one = points[1].position - points[0].position;
  if (points.size() == 2) return normal.cross(one).norm() > clear;
  const Vec3<S> other = points[2].position - points[0].position;
  // No side is longer than twice the longer of these two.
  const S longer = std::sqrt(std::max(one.squaredNorm(), other.squaredNorm()));
  return points.size() == 3 && std::abs(normal.dot(one.cross(other))) > clear * longer;
}

/// The largest coordinate, metres.
template <class S> S scale_of(ContactPoints<S> points) {
  S scale = S(0);
  for (const ContactPoint<S>& point : points)
    scale = std::max(scale, point.position.cwiseAbs().maxCoeff());
  return scale;
}

/// Step 4: ascending indices, at most kMaxManifoldPoints.
template <class S> KeptIndices outline_of(ContactPoints<S> points, const Vec3<S>& normal, S near) {
  KeptIndices kept;
  if (are_clear_corners(points, normal, near)) {
    for (int i = 0; i < count_of(points); ++i) kept.push_back(i);
    return kept;
  }
  const Outline<S> outline(points, normal, near);
  // A face has too few vertices for more corners; only a mesh that bends within kFlatEdgeAngle may.
  const std::size_t corners = outline.corners().size();
  const std::size_t count = std::min(corners, kMaxManifoldPoints - 1);
  for (std::size_t i = 0; i < count; ++i) kept.push_back(outline.corners()[i * corners / count]);
  const auto separation = [&](int i) { return at(points, i).separation; };
  const auto found = std::ranges::min_element(points, {}, &ContactPoint<S>::separation);
  const int deepest = static_cast<int>(found - points.begin());
  if (separation(deepest) < separation(*std::ranges::min_element(kept, {}, separation)) - near) {
    kept.push_back(deepest);
    std::inplace_merge(kept.begin(), kept.end() - 1, kept.end());
  }
  return kept;
}

/// A unit impulse at a point: direction, and torque about the middle of the points over the radius.
template <class S> struct PointWrench {
  std::size_t manifold, point;
  Vec3<S> force, torque;
  S distance = std::numeric_limits<S>::infinity();  // squared, from the nearest kept one; -1: kept
};

/// Step 6. Manifolds without points go, also from the record.
template <class S>
void keep_most_different(std::size_t most, Manifolds<S>& manifolds, trace::Merge* record) {
  std::size_t points = 0;
  for (const Manifold<S>& manifold : manifolds) points += manifold.points.size();
  if (points <= most) return;
  Vec3<S> middle = Vec3<S>::Zero();
  std::vector<PointWrench<S>> wrenches;
  wrenches.reserve(points);
  for (std::size_t m = 0; m < manifolds.size(); ++m) {
    for (std::size_t p = 0; p < manifolds[m].points.size(); ++p) {
      wrenches.push_back({m, p, manifolds[m].normal, manifolds[m].points[p].position});
      middle += wrenches.back().torque;
    }
  }
  middle /= static_cast<S>(wrenches.size());
  S radius = S(0);
  for (const PointWrench<S>& one : wrenches)
    radius = std::max(radius, (one.torque - middle).norm());
  for (PointWrench<S>& one : wrenches) {
    const Vec3<S> arm = one.torque - middle;
    one.torque = radius > S(0) ? Vec3<S>(arm.cross(one.force) / radius) : Vec3<S>(Vec3<S>::Zero());
  }
  const auto separation = [&](const PointWrench<S>& one) {
    return manifolds[one.manifold].points[one.point].separation;
  };
  PointWrench<S>* next = &*std::ranges::min_element(wrenches, {}, separation);
  for (std::size_t kept = 1;; ++kept) {
    next->distance = S(-1);
    if (kept == most) break;
    const Vec3<S> force = next->force, torque = next->torque;
    S farthest = S(-1);
    for (PointWrench<S>& one : wrenches) {
      const S squared = (one.force - force).squaredNorm() + (one.torque - torque).squaredNorm();
      one.distance = std::min(one.distance, squared);
      next = one.distance > farthest ? &one : next;
      farthest = std::max(farthest, one.distance);
    }
  }
  for (Manifold<S>& manifold : manifolds) manifold.points.clear();
  // Kept points move to the front, so none is overwritten before it is read.
  for (const PointWrench<S>& one : wrenches) {
    auto& kept = manifolds[one.manifold].points;
    if (one.distance < S(0)) kept.push_back(kept.data()[one.point]);
  }
  for (std::size_t m = manifolds.size(); m-- > 0;) {
    if (!manifolds[m].points.empty()) continue;
    const auto place = static_cast<std::ptrdiff_t>(m);
    manifolds.erase(manifolds.begin() + place);
    if (record != nullptr) record->manifolds.erase(record->manifolds.begin() + place);
  }
}

}  // namespace

// NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): the memory stays uninitialised.
template <class S>
TriangleContacts<S>::TriangleContacts(const Shape<S>& a, const Mesh<S>& b)
    : hull_(std::get_if<Hull<S>>(&a)), b_(b) {
  parts_.reserve(16);
  points_.reserve(64);
}

template <class S> FeatureRef TriangleContacts<S>::in_mesh(const FeatureRef& ref, int t) const {
  const int k = static_cast<int>(ref.index);
  if (ref.owner == Owner::A) return ref;
  if (ref.kind == FeatureKind::Face) return face_ref(Owner::B, b_.region(t));
  if (ref.kind == FeatureKind::Vertex) return vertex_ref(Owner::B, at(at(b_.triangles, t), k));
  const int there = b_.neighbour(t, k);
  if (there < 0 || there > t) return edge_ref(Owner::B, 3 * t + k);
  const auto& back = at(b_.neighbours, there);
  return edge_ref(Owner::B,
                  3 * there + static_cast<int>(std::ranges::find(back, t) - back.begin()));
}

/// Two edges of one shape cross at a vertex of it, on a face of the other.
template <class S> FeatureId TriangleContacts<S>::in_mesh(const FeatureId& id, Part& part) const {
  const auto& [first, second] = id;
  const int t = part.triangle;
  if (first.owner == Owner::B || second.owner == Owner::A) {
    if (hull_ == nullptr || first == second || first.kind != FeatureKind::Edge)
      return FeatureId::of(in_mesh(first, t), in_mesh(second, t));
    if (first.owner == Owner::B) {
      // Edges 1 and 2 meet at vertex 2, 2 and 0 at 0, 0 and 1 at 1.
      const std::uint32_t missing = 3 - first.index - second.index;
      if (part.facing < 0) part.facing = facing(*hull_, part.normal);
      return {face_ref(Owner::A, part.facing),
              in_mesh({Owner::B, FeatureKind::Vertex, (missing + 2) % 3}, t)};
    }
    const int vertex = common_vertex(*hull_, first.index, second.index);
    if (vertex < 0) return id;
    return {vertex_ref(Owner::A, vertex), face_ref(Owner::B, b_.region(t))};
  }
  // A vertex on an edge or a corner within a flat region is on its face.
  if (first.kind == FeatureKind::Vertex && second.kind != FeatureKind::Face) {
    const int k = static_cast<int>(second.index);
    const auto is_within = [&](int edge) {
      const int there = b_.beyond(t, edge);
      return there >= 0 && b_.region(there) == b_.region(t);
    };
    if (is_within(k) && (second.kind == FeatureKind::Edge || is_within((k + 2) % 3)))
      return {first, face_ref(Owner::B, b_.region(t))};
  }
  return {first, in_mesh(second, t)};
}

template <class S> void TriangleContacts<S>::add(const Contact<S>& contact, int triangle) {
  const int begin = count_of(points_);
  // Adding zero makes -0 a 0: the special path of boxes may differ in its sign.
  const Vec3<S> normal = contact.normal.array() + S(0);
  Part& part =
      parts_.emplace_back(Part{normal, contact.axis, contact.type, contact.scale, contact.deepest(),
                               triangle, begin, begin + count_of(contact.points)});
  for (const ContactPoint<S>& point : contact.points)
    points_.push_back({point.position, point.separation, in_mesh(point.id, part)});
}

template <class S> ContactPoints<S> TriangleContacts<S>::points_of(const Part& part) const {
  return ContactPoints<S>(points_).subspan(static_cast<std::size_t>(part.begin),
                                           static_cast<std::size_t>(part.end - part.begin));
}

/// Steps 3 to 5 for a group, the deepest part first.
template <class S>
void TriangleContacts<S>::finish_group(std::span<Part* const> parts, const ToWorld<S>& to_world,
                                       const CollideOptions& options, Manifolds<S>& manifolds,
                                       Recorder<S>* recorder) {
  const Part& lead = *parts.front();
  const bool is_first = manifolds.empty();
  Contact<S> contact;
  contact.axis = lead.axis;
  contact.type = lead.type;
  contact.normal = lead.normal;
  contact.scale = lead.scale;
  if (parts.size() == 1) {
    for (const ContactPoint<S>& point : points_of(lead)) contact.points.push_back(point);
    finish_contact(to_world, options, contact, manifolds.emplace_back(),
                   is_first ? recorder : nullptr);
    if (recorder) [[unlikely]]
      recorder->merged({lead.triangle}, lead.end - lead.begin);
    return;
  }
  int found = 0;
  for (const Part* part : parts) {
    found += part->end - part->begin;
    contact.scale = std::max(contact.scale, part->scale);
  }
  DistinctPoints<S> distinct(found);
  for (const Part* part : parts)
    for (const ContactPoint<S>& point : points_of(*part)) distinct.add(point, part->triangle);
  const ContactPoints<S> all = distinct.points();
  contact.scale = std::max(contact.scale, scale_of(all));
  KeptIndices outline;
  if (options.reducer != nullptr)
    outline = outline_of<S>(all, lead.normal, depth_rounding(contact.scale));
  const std::size_t count = options.reducer != nullptr ? outline.size() : all.size();
  if (count > 1) contact.type = face_contact_type(count);
  for (std::size_t begin = 0; begin < count; begin += kMaxManifoldPoints) {
    const std::size_t end = std::min(count, begin + kMaxManifoldPoints);
    contact.points.clear();
    for (std::size_t i = begin; i < end; ++i)
      contact.points.push_back(outline.empty() ? all[i] : at(all, outline[i]));
    const bool first = is_first && begin == 0;
    finish_contact(to_world, options, contact, manifolds.emplace_back(),
                   first ? recorder : nullptr);
    if (recorder) [[unlikely]] {
      recorder->merged(mapped(parts, &Part::triangle), found);
      if (first) recorder->reduced_outline_of(all, {outline.begin(), outline.end()});
    }
  }
}

template <class S>
void TriangleContacts<S>::merge(const ToWorld<S>& to_world, const CollideOptions& options,
                                Manifolds<S>& manifolds, Recorder<S>* recorder) {
  Scratch<Part*, 128> scratch(2 * count_of(parts_));
  const std::span<Part*> parts(scratch.data(), parts_.size()), group(parts.end(), parts_.size());
  std::ranges::transform(parts_, parts.begin(), [](Part& part) { return &part; });
  std::ranges::sort(parts, [](const Part* one, const Part* other) {
    return std::tie(one->deepest, one->triangle) < std::tie(other->deepest, other->triangle);
  });
  constexpr S kNearest = static_cast<S>(kFlatEdgeAngle);  // as the distance of unit vectors
  for (std::size_t left = parts.size(); left > 0;) {
    const Vec3<S> normal = parts.front()->normal;
    std::size_t near = 0, other = 0;
    for (std::size_t i = 0; i < left; ++i) {
      Part* const part = parts[i];
      const bool is_near = (part->normal - normal).squaredNorm() <= kNearest * kNearest || i == 0;
      group[near] = parts[other] = part;
      near += is_near ? 1 : 0;
      other += is_near ? 0 : 1;
    }
    finish_group(group.first(near), to_world, options, manifolds, recorder);
    left = other;
  }
  if (options.reducer != nullptr)
    keep_most_different(static_cast<std::size_t>(kMergedManifolds * options.reduction.max_points),
                        manifolds, recorder ? recorder->merge_record() : nullptr);
}

template <class S>
void add_to_merge(TriangleContacts<S>& contacts, const Contact<S>& contact, int triangle) {
  contacts.add(contact, triangle);
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(add_to_merge);
template class TriangleContacts<float>;
template class TriangleContacts<double>;

}  // namespace contactscope
