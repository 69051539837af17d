#include "package/contactscope/collide.h"
#include "geometry/hull_builder.h"
#include "geometry/primitives.h"
#include "manifold/dispatch.h"
#include "package/contactscope/reduce.h"
#include "package/facts.h"

namespace contactscope::package {
namespace {

constexpr PenetrationMethod kPenetrations[] = {PenetrationMethod::Sat, PenetrationMethod::Epa,
                                               PenetrationMethod::Mpr, PenetrationMethod::Sampling};

PenetrationMethod penetration_named(const std::string& name) {
  std::vector<std::string_view> known;
  for (const PenetrationMethod method : kPenetrations) {
    known.emplace_back(contactscope::to_string(method));
    if (known.back() == name) return method;
  }
  refuse("penetration method", name, known);
}

/// Null for "none".
const ReducerInfo* reducer_named(const std::string& name) {
  const ReducerInfo* const found = find_reducer(name);
  if (found == nullptr && name != "none")
    refuse("reducer", name, mapped(contactscope::reducers(), [](const ReducerInfo& info) {
             return std::string_view(info.name);
           }));
  return found;
}

contactscope::CollideOptions inside(const CollideOptions& options) {
  if (options.max_points < 1) throw std::invalid_argument("max_points is less than 1");
  if (!(options.margin >= 0) || !std::isfinite(options.margin))
    throw std::invalid_argument("the margin is negative or not finite; give metres, or 0");
  if (options.name_a.empty() || options.name_b.empty() || options.name_a == options.name_b)
    throw std::invalid_argument("name_a and name_b must be two different names");
  contactscope::CollideOptions all;
  all.margin = options.margin;
  all.penetration = penetration_named(options.penetration);
  all.reducer = reducer_named(options.reducer);
  all.reduction.max_points = options.max_points;
  return all;
}

bool is_placed(const contactscope::Pose<double>& pose) {
  return pose.position.allFinite() && pose.rotation.coeffs().allFinite() &&
         pose.rotation.norm() > 0;
}

contactscope::trace::Trace one_frame(const CollideOptions& options, const Collider& a,
                                     const contactscope::Pose<double>& pose_a, const Collider& b,
                                     const contactscope::Pose<double>& pose_b,
                                     contactscope::trace::Pair pair) {
  contactscope::trace::Trace trace;
  contactscope::trace::Header& header = trace.header;
  header.scenario = TraceInfo{}.scenario;
  header.scalar = name_of(options.scalar);
  header.up = "y";
  header.frames = 1;
  header.shapes = {traced(options.name_a, a, options.scalar),
                   traced(options.name_b, b, options.scalar)};
  contactscope::trace::Frame& frame = trace.frames.emplace_back();
  frame.poses = {{options.name_a, pose_a}, {options.name_b, pose_b}};
  frame.pairs.push_back(std::move(pair));
  return trace;
}

template <class S>
Contacts collide_in(const Collider& a, const contactscope::Pose<double>& pose_a, const Collider& b,
                    const contactscope::Pose<double>& pose_b, const CollideOptions& options) {
  const contactscope::Pose<S> rounded_a = pose_a.cast<S>(), rounded_b = pose_b.cast<S>();
  contactscope::trace::Pair pair;
  pair.a = options.name_a;
  pair.b = options.name_b;
  Manifolds<S> manifolds;
  contactscope::collide<S>(shape_in<S>(a.built()), rounded_a, shape_in<S>(b.built()), rounded_b,
                           inside(options), manifolds, nullptr, options.record ? &pair : nullptr);
  Contacts contacts;
  contactscope::trace::Pair recorded;
  record_manifolds<S>(manifolds, recorded);
  contacts.manifolds =
      mapped(recorded.manifolds, [](const auto& manifold) { return to_outside(manifold); });
  if (!manifolds.empty()) contacts.status = ContactStatus::Touching;
  contacts.separation = separation_of(contacts.manifolds);
  if (options.record) {
    if (manifolds.empty()) contacts.separation = pair.separation;
    contacts.trace = trace_of(one_frame(options, a, rounded_a.template cast<double>(), b,
                                        rounded_b.template cast<double>(), std::move(pair)));
  }
  return contacts;
}

template <class S>
std::vector<int> kept_in(const Manifold& manifold, const ReducerInfo* reducer,
                         const ReduceOptions& options) {
  std::vector<contactscope::ContactPoint<S>> points;
  for (const ContactPoint& point : manifold.points) {
    // Ids are opaque here. Reducers that use ids get no points of an earlier frame.
    const FeatureRef number = vertex_ref(Owner::A, count_of(points));
    points.push_back({to_inside(point.position).cast<S>(), static_cast<S>(point.separation),
                      FeatureId::of(number, number)});
  }
  contactscope::ReduceOptions inside;
  inside.max_points = options.max_points;
  inside.seed = options.seed;
  const contactscope::Vec3<S> normal = to_inside(manifold.normal).cast<S>();
  const KeptIndices kept =
      contactscope::reduce<S>(reducer, contactscope::ContactPoints<S>(points), normal, inside);
  return {kept.begin(), kept.end()};
}

void require_length(double length, const char* what) {
  if (!(length > 0) || !std::isfinite(length))
    throw ShapeError(std::string(what) + " is " + std::to_string(length) +
                     "; give metres, more than 0");
}

void require_finite(const Vec3& place, const char* what) {
  if (!to_inside(place).allFinite())
    throw ShapeError(std::string(what) + " has a coordinate that is not finite; give metres");
}

std::vector<Vec3d> places(const std::vector<Vec3>& vertices) {
  return mapped(vertices, [](const Vec3& vertex) { return to_inside(vertex); });
}

void require_indices(const auto& polygons, std::size_t vertices, const char* what) {
  for (const auto& polygon : polygons)
    for (const int index : polygon)
      if (index < 0 || static_cast<std::size_t>(index) >= vertices)
        throw ShapeError(std::string(what) + " uses vertex " + std::to_string(index) + " of " +
                         std::to_string(vertices) + "; indices start at 0");
}

using Inside = contactscope::Shape<double>;

Inside inside(const Sphere& sphere) {
  require_length(sphere.radius, "the radius of a sphere");
  return contactscope::Sphere<double>{sphere.radius};
}

Inside inside(const Capsule& capsule) {
  require_length(capsule.radius, "the radius of a capsule");
  require_finite(capsule.from, "an end of a capsule");
  require_finite(capsule.to, "an end of a capsule");
  return contactscope::Capsule<double>{{to_inside(capsule.from), to_inside(capsule.to)},
                                       capsule.radius};
}

Inside inside(const Box& box) { return make_box(to_inside(box.half_extents)); }

Inside inside(const Hull& hull) {
  for (const Vec3& vertex : hull.vertices) require_finite(vertex, "a vertex of a hull");
  if (hull.faces.empty())
    return build_hull(places(hull.vertices), {.weld_duplicates = true, .for_float = true});
  require_indices(hull.faces, hull.vertices.size(), "a face of a hull");
  return hull_from_polygons(places(hull.vertices), hull.faces);
}

Inside inside(const Plane& plane) {
  const Vec3d normal = to_inside(plane.normal);
  const double length = normal.norm();
  require_length(length, "the length of a plane's normal");
  if (!std::isfinite(plane.offset))
    throw ShapeError("the offset of a plane is not finite; give metres along the normal");
  return HalfSpace<double>{{normal / length, plane.offset}};
}

Inside inside(const Mesh& mesh) {
  require_indices(mesh.triangles, mesh.vertices.size(), "a triangle of a mesh");
  return build_mesh(places(mesh.vertices), mesh.triangles);
}

constexpr const char* kTypes[] = {"sphere", "capsule", "box", "hull", "plane", "mesh"};

}  // namespace

const char* to_string(ContactStatus status) {
  constexpr const char* kNames[] = {"touching", "separated", "no such pair", "not finite"};
  return kNames[static_cast<int>(status)];
}

Contacts collide(const Collider& a, const Pose& pose_a, const Collider& b, const Pose& pose_b,
                 const CollideOptions& options) {
  inside(options);  // validate options even if the shapes are invalid
  Contacts none;
  const contactscope::Pose<double> placed_a = to_inside(pose_a), placed_b = to_inside(pose_b);
  if (!is_placed(placed_a) || !is_placed(placed_b)) {
    none.status = ContactStatus::NotFinite;
    return none;
  }
  if (!can_collide(kind_of(a.built().in_double), kind_of(b.built().in_double))) {
    none.status = ContactStatus::NoSuchPair;
    return none;
  }
  if (options.scalar == Scalar::Float) return collide_in<float>(a, placed_a, b, placed_b, options);
  return collide_in<double>(a, placed_a, b, placed_b, options);
}

std::vector<Reducer> reducers() {
  return mapped(contactscope::reducers(), [](const ReducerInfo& info) {
    return Reducer{info.name, info.summary};
  });
}

std::vector<int> reduce(const Manifold& manifold, const std::string& reducer,
                        const ReduceOptions& options) {
  const ReducerInfo* const found = reducer_named(reducer);
  if (options.max_points < 1) throw std::invalid_argument("max_points is less than 1");
  if (manifold.points.size() > kMaxManifoldPoints)
    throw std::invalid_argument("a manifold has at most " + std::to_string(kMaxManifoldPoints) +
                                " points, this one " + std::to_string(manifold.points.size()));
  if (options.scalar == Scalar::Float) return kept_in<float>(manifold, found, options);
  return kept_in<double>(manifold, found, options);
}

Collider::Collider(const Shape& shape, int) {
  try {
    const Inside built = std::visit([](const auto& kind) { return inside(kind); }, shape);
    built_ = std::make_shared<const Built>(
        Built{built, shape_cast<float>(built), kTypes[shape.index()]});
  } catch (const contactscope::ShapeError& error) {
    throw ShapeError(error.what());
  }
}

}  // namespace contactscope::package
