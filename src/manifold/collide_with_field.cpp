#include "manifold/collide_pairs.h"
#include "manifold/field_contact.h"
#include "manifold/in_double.h"

// A field can only be sampled at points, so the other shape is represented by points: its vertices,
// and pieces of its faces, its axis or its triangles (field_contact.h). Normals are gradients of
// the field; points with similar normals share a manifold. Against a plane it is the reverse: the
// surface from which the field was built is treated as a hull.

namespace contactscope {
namespace {

/// Normals within 15 degrees of the deepest point's belong to one manifold.
constexpr double kSameDirection = 0.9659;
/// Maximum number of samples along a shape's side, or the field's side, approximately.
constexpr double kMaxPlaces = 16;

/// Pieces of a shape in the field's frame.
struct Pieces {
  std::vector<FieldPiece> pieces;
  double radius = 0;
};

template <class S> class PieceMaker {
 public:
  /// `near`: the part of a mesh to use, in the mesh's frame.
  PieceMaker(const Pose<double>& in_field, const Aabb<S>& near)
      : in_field_(in_field), near_(near) {}

  Pieces of(const Shape<S>& shape) {
    std::visit([&](const auto& kind) { add(kind); }, shape);
    return std::move(made_);
  }

 private:
  Vec3d place(const Vec3<S>& point) const {
    return in_field_.transform(point.template cast<double>());
  }
  void add_vertex(const Vec3<S>& vertex, int index) {
    const Vec3d place_of = place(vertex);
    made_.pieces.push_back({{place_of, place_of, place_of}, 1, vertex_ref(Owner::A, index)});
  }

  void add(const Sphere<S>& sphere) {
    made_.radius = static_cast<double>(sphere.radius);
    add_vertex(Vec3<S>::Zero(), 0);
  }
  void add(const Capsule<S>& capsule) {
    made_.radius = static_cast<double>(capsule.radius);
    for (int end = 0; end < 2; ++end) add_vertex(at(capsule.points, end), end);
    const Vec3d end = place(capsule.points[1]);
    made_.pieces.push_back({{place(capsule.points[0]), end, end}, 2, edge_ref(Owner::A, 0)});
  }
  void add(const Hull<S>& hull) {
    for (int v = 0; v < hull.vertex_count(); ++v) add_vertex(at(hull.vertices, v), v);
    for (int face = 0; face < hull.face_count(); ++face) {
      const std::vector<int> around = face_vertices(hull, face);
      for (int k = 2; k < count_of(around); ++k)
        made_.pieces.push_back(
            {{place(at(hull.vertices, around[0])), place(at(hull.vertices, at(around, k - 1))),
              place(at(hull.vertices, at(around, k)))},
             3,
             face_ref(Owner::A, face * static_cast<int>(kMaxFaceVertices) + k)});
    }
  }
  void add(const Mesh<S>& mesh) {
    std::vector<int> vertices;
    mesh.tree.query(near_, [&](int triangle) {
      std::array<Vec3d, 3> corners;
      for (int k = 0; k < 3; ++k) {
        at(corners, k) = place(mesh.corner(triangle, k));
        vertices.push_back(at(at(mesh.triangles, triangle), k));
      }
      made_.pieces.push_back({corners, 3, face_ref(Owner::A, triangle)});
    });
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (const int vertex : vertices) add_vertex(at(mesh.vertices, vertex), vertex);
  }
  void add(const Field<S>& field) {
    std::visit([&](const auto& kind) { add(kind); }, field.source->shape);
  }
  /// Unreachable: planes are handled separately.
  void add(const HalfSpace<S>&) {}

  const Pose<double>& in_field_;
  const Aabb<S>& near_;
  Pieces made_;
};

Pose<double> inverse(const Pose<double>& pose) { return relative_pose(pose, Pose<double>{}); }

/// The surface's box in metres, grown by `around`, in the frame that the field is placed in.
template <class S>
Aabb<S> field_reach(const PlacedField& field, const Pose<double>& field_in, double around) {
  const Aabb<double>& box = field.field->surface_box();
  Aabb<double> reach;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3d point;
    for (int axis = 0; axis < 3; ++axis)
      point[axis] = (corner >> axis & 1) != 0 ? box.upper[axis] : box.lower[axis];
    reach.include(field_in.transform(field.origin + field.cell * point));
  }
  // Exceeds the loss by rounding to S.
  const Vec3d out = Vec3d::Constant(around + 0.01 * field.cell);
  return Aabb<double>{reach.lower - out, reach.upper + out}.template cast<S>();
}

/// Distance between a shape that the field does not touch and the field's surface, metres. `near`:
/// the pieces that the box around the surface reaches. That is the whole shape unless it is a mesh;
/// other triangles of a mesh may be nearer to the surface.
template <class S>
double gap_of(const Shape<S>& a, const PlacedField& field, const Pose<double>& field_in_a,
              const Pieces& near) {
  constexpr double kNoLimit = std::numeric_limits<double>::infinity();
  const Pose<double> a_in_field = inverse(field_in_a);
  double gap = field_gap(field, near.pieces, kNoLimit).distance;
  if (const auto* mesh = std::get_if<Mesh<S>>(&made_of(a))) {
    if (near.pieces.empty()) {
      const Vec3d corner = a_in_field.transform(mesh->corner(0, 0).template cast<double>());
      const FieldPiece piece{{corner, corner, corner}, 1, {}};
      gap = field_gap(field, std::array{piece}, kNoLimit).distance;
    }
    const Pieces all = PieceMaker<S>(a_in_field, field_reach<S>(field, field_in_a, gap)).of(a);
    gap = field_gap(field, all.pieces, gap).distance;
  }
  return std::max(gap - near.radius, 0.0);
}

template <class S>
FieldTouches touches_of(const Shape<S>& a, const PlacedField& field, const Pose<double>& field_in_a,
                        const CollideOptions& options, double& radius, bool recorded,
                        std::vector<trace::FieldProbe>* probes = nullptr) {
  const Pose<double> a_in_field = inverse(field_in_a);
  const Pieces made =
      PieceMaker<S>(a_in_field, field_reach<S>(field, field_in_a, options.margin)).of(a);
  Aabb<double> box;
  for (const FieldPiece& piece : made.pieces)
    for (int k = 0; k < piece.count; ++k) box.include(at(piece.corners, k));
  radius = made.radius;
  const double side_a = box.empty() ? 0 : box.extent().maxCoeff();
  const double side_b = field.cell * field.field->surface_box().extent().maxCoeff();
  const double spacing = std::max(field.cell, std::min(side_a, side_b) / kMaxPlaces);
  FieldTouches touches = find_touches(
      field, made.pieces, {options.field, made.radius, options.margin, spacing, probes});
  // Only for the record; the distance of separated shapes is not used otherwise.
  if (recorded && touches.found.empty()) touches.least = gap_of(a, field, field_in_a, made);
  return touches;
}

/// Reduces the touches of one direction to a manifold's capacity, vertices first. If there are too
/// many, keeps the irreplaceable ones: the deepest, and the farthest along kDirections directions
/// in the contact plane. Then vertices before points inside faces, each kind evenly spaced.
void fit_manifold(std::vector<FieldTouch>& touches, const Vec3d& outward) {
  constexpr int kDirections = 32;
  const auto is_vertex = [](const FieldTouch& t) { return t.feature.kind == FeatureKind::Vertex; };
  const auto deepest = std::ranges::min_element(touches, {}, &FieldTouch::separation);
  const int deepest_at = static_cast<int>(deepest - touches.begin());
  const int count = count_of(touches);
  std::vector<int> order;  // indices into `touches`
  for (const bool vertices : {true, false})
    for (int i = 0; i < count; ++i)
      if (is_vertex(at(touches, i)) == vertices) order.push_back(i);

  const int room = static_cast<int>(kMaxManifoldPoints);
  if (count > room) {
    std::vector<bool> keep(touches.size(), false);
    int kept = 0;
    const auto keep_it = [&](int i) {
      if (kept == room || at(keep, i)) return;
      at(keep, i) = true;
      ++kept;
    };
    keep_it(deepest_at);
    const Vec3d u = any_perpendicular(outward), v = outward.cross(u);
    for (int d = 0; d < kDirections; ++d) {
      const double angle = 2 * std::numbers::pi * d / kDirections;
      const Vec3d along = std::cos(angle) * u + std::sin(angle) * v;
      keep_it(*std::ranges::max_element(order, {},
                                        [&](int i) { return along.dot(at(touches, i).point); }));
    }
    const int vertex_count = static_cast<int>(std::ranges::count_if(touches, is_vertex));
    const auto keep_evenly = [&](int first, int end) {
      std::vector<int> open;
      for (int k = first; k < end; ++k)
        if (!at(keep, at(order, k))) open.push_back(at(order, k));
      const int fit = std::min(room - kept, count_of(open));
      for (int k = 0; k < fit; ++k)
        keep_it(at(open, static_cast<int>(std::int64_t{k} * count_of(open) / fit)));
    };
    keep_evenly(0, vertex_count);
    keep_evenly(vertex_count, count);
    std::erase_if(order, [&](int i) { return !at(keep, i); });
  }
  touches = mapped(order, [&](int i) { return at(touches, i); });
}

/// Passes the touches to the sink, deepest first, grouped by direction. `in_a`: pose of the field's
/// frame. `flipped`: the field is A's and the points are B's.
template <class S>
void add_manifolds(std::vector<FieldTouch> touches, double radius, const Pose<double>& in_a,
                   bool flipped, ContactSink<S>& sink) {
  std::ranges::stable_sort(touches, {}, &FieldTouch::separation);
  while (!touches.empty()) {
    const Vec3d outward = touches.front().outward;
    std::vector<FieldTouch> rest, same;
    for (const FieldTouch& touch : touches)
      (touch.outward.dot(outward) >= kSameDirection ? same : rest).push_back(touch);
    fit_manifold(same, outward);
    Contact<S> contact;
    contact.axis = AxisKind::ClosestPoints;
    const Vec3d normal = in_a.rotate(outward) * (flipped ? 1.0 : -1.0);
    contact.normal = normal.template cast<S>().normalized();
    for (const FieldTouch& touch : same) {
      // On the field's surface, as points of a face contact are on the reference face.
      const Vec3d on_field = touch.point - (radius + touch.separation) * touch.outward;
      const FeatureRef other = face_ref(Owner::B, 0);
      const FeatureId id = FeatureId::of(touch.feature, other);
      contact.points.push_back({in_a.transform(on_field).template cast<S>(),
                                static_cast<S>(touch.separation), flipped ? id.flipped() : id});
    }
    contact.type = face_contact_type(contact.points.size());
    sink.add(contact);
    touches = std::move(rest);
  }
}

/// A point of the surface from which a field was built, or of its core. The field's frame, metres.
Vec3d any_point_of(const PlacedField& placed) {
  const DistanceField& field = *placed.field;
  return placed.origin +
         placed.cell * (field.core() ? field.core()->points[0] : field.surface()->vertices[0]);
}

/// For a hull around the whole field, whose faces miss it: separates by the face of least depth.
template <class S>
void add_contained(const Hull<S>& hull, const Field<S>& field, const Pose<double>& field_in_a,
                   FieldTouches& touches) {
  const Vec3<S> first =
      field_in_a.transform(any_point_of(PlacedField::of(field))).template cast<S>();
  for (const Plane<S>& plane : hull.planes)
    if (plane.distance(first) > S(0)) return;
  const Pose<double> a_in_field = inverse(field_in_a);
  const Aabb<S> everywhere{Vec3<S>::Constant(-std::numeric_limits<S>::infinity()),
                           Vec3<S>::Constant(std::numeric_limits<S>::infinity())};
  const Pieces pieces = PieceMaker<S>(field_in_a, everywhere).of(field.source->shape);
  double least_depth = std::numeric_limits<double>::infinity();
  FieldTouch best{};
  for (int face = 0; face < hull.face_count(); ++face) {
    const Plane<double> plane = at(hull.planes, face).template cast<double>();
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -lowest;
    Vec3d deepest = Vec3d::Zero();
    for (const FieldPiece& piece : pieces.pieces) {
      if (piece.count > 1) continue;
      const double height = plane.distance(piece.corners[0]) - pieces.radius;
      highest = std::max(highest, height + 2 * pieces.radius);
      if (height < lowest) {
        lowest = height;
        deepest = piece.corners[0] - pieces.radius * plane.normal;
      }
    }
    if (highest > 0) return;  // the field is not inside
    if (-lowest < least_depth) {
      least_depth = -lowest;
      best = {a_in_field.transform(deepest - lowest * plane.normal), lowest,
              a_in_field.rotate(Vec3d(-plane.normal)), face_ref(Owner::A, face)};
    }
  }
  touches = {{best}, best.separation};
}

/// The plane is A. The points of the surface from which the field was built, deepest first.
template <class S>
S collide_plane_field(const HalfSpace<S>& plane, const Field<S>& field, const Pose<double>& b_in_a,
                      const CollideOptions& options, ContactSink<S>& sink) {
  const Aabb<S> everywhere{Vec3<S>::Constant(-std::numeric_limits<S>::infinity()),
                           Vec3<S>::Constant(std::numeric_limits<S>::infinity())};
  const Pieces pieces = PieceMaker<S>(b_in_a, everywhere).of(field.source->shape);
  const Plane<double> ground = plane.plane.template cast<double>();
  FieldTouches touches{{}, std::numeric_limits<double>::infinity()};
  for (const FieldPiece& piece : pieces.pieces) {
    if (piece.count > 1) continue;
    const double separation = ground.distance(piece.corners[0]) - pieces.radius;
    touches.least = std::min(touches.least, separation);
    if (separation <= options.margin)
      touches.found.push_back({piece.corners[0], separation, ground.normal, piece.feature});
  }
  add_manifolds(std::move(touches.found), pieces.radius, {}, true, sink);
  return static_cast<S>(touches.least);
}

}  // namespace

template <class S>
S collide_with_field(const Shape<S>& a, const Field<S>& b, const Pose<S>& b_in_a,
                     const CollideOptions& options, ContactSink<S>& sink) {
  const Pose<double> field_in_a = in_double(b_in_a);
  if (const auto* plane = std::get_if<HalfSpace<S>>(&a))
    return collide_plane_field(*plane, b, field_in_a, options, sink);
  double radius = 0;
  const bool conservative = options.field == FieldSearch::Conservative;
  std::vector<trace::FieldProbe>* const probes =
      sink.recorder ? sink.recorder->field_probes() : nullptr;
  const bool recorded = sink.recorder != nullptr;
  FieldTouches touches =
      touches_of(a, PlacedField::of(b), field_in_a, options, radius, recorded, probes);
  if (probes != nullptr) sink.recorder->field_search(options.field, field_in_a);
  // Outside the field, or around it. If around, the touches within the margin do not separate.
  if (conservative && (touches.found.empty() || touches.least > 0)) {
    if (const auto* hull = std::get_if<Hull<S>>(&a)) add_contained(*hull, b, field_in_a, touches);
    const auto* field = std::get_if<Field<S>>(&a);
    const auto is_around = [&] {
      const Vec3d first = field_in_a.transform(any_point_of(PlacedField::of(b)));
      return PlacedField::of(*field).bounds(first).lower < 0;
    };
    if (field != nullptr && (touches.found.empty() || is_around())) {
      // B may be inside A; then the surface of B is inside A's field.
      const Shape<S> other = b;
      const Pose<double> a_in_b = inverse(field_in_a);
      FieldTouches inside =
          touches_of(other, PlacedField::of(*field), a_in_b, options, radius, recorded);
      if (touches.found.empty() || inside.least < 0) {
        add_manifolds(std::move(inside.found), radius, {}, true, sink);
        return static_cast<S>(std::min(touches.least, inside.least));
      }
    }
  }
  const S least = static_cast<S>(touches.least);
  add_manifolds(std::move(touches.found), radius, field_in_a, false, sink);
  return least;
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(collide_with_field);

}  // namespace contactscope
