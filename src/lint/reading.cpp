#include "lint/reading.h"

namespace contactscope::lint {
namespace {

constexpr const char* kOneWorld =
    "write points and normals in the axes of the poses: one right-handed world";

constexpr Rotation kXyzw = {4, 1, 2, 3}, kInverse = {1, -2, -3, -4};
constexpr Axes kZUp = {1, 3, -2}, kYUp = {1, -3, 2};
/// The rotation in a world with that axis negated.
void mirror(Rotation& rotation, std::size_t axis) {
  for (std::size_t i = 0; i < 3; ++i) rotation[i + 1] *= i == axis ? 1 : -1;
}

/// Two mistakes can be combined if they concern different things.
bool go_together(const Mistake& one, const Mistake& other) {
  if (one.alone || other.alone) return false;
  Reading first, second;
  one.apply(first);
  other.apply(second);
  const Reading plain;
  const auto separated = [&](auto... members) {
    return ((first.*members == plain.*members || second.*members == plain.*members) && ...);
  };
  return separated(&Reading::normals, &Reading::normals_flipped, &Reading::separations_negated,
                   &Reading::separation_scale, &Reading::points, &Reading::point_scale,
                   &Reading::moment, &Reading::rotation, &Reading::shape_scale);
}

std::vector<Explanation> all_explanations() {
  std::vector<Explanation> all;
  const auto add = [&](const std::vector<const Mistake*>& made) {
    Explanation& explanation = all.emplace_back();
    explanation.made = made;
    for (const Mistake* mistake : made) mistake->apply(explanation.reading);
  };
  const std::vector<Mistake>& known = mistakes();
  for (const Mistake& mistake : known) add({&mistake});
  for (std::size_t i = 0; i < known.size(); ++i)
    for (std::size_t j = i + 1; j < known.size(); ++j)
      if (go_together(known[i], known[j])) add({&known[i], &known[j]});
  return all;
}

Vec3d middle_of(const trace::Shape& shape) {
  Vec3d sum = Vec3d::Zero();
  for (const Vec3d& vertex : shape.vertices) sum += vertex;
  return sum / static_cast<double>(shape.vertices.size());
}

/// Scales about the centre of the vertices.
void scale(trace::Shape& shape, double factor) {
  const Vec3d middle = middle_of(shape);
  for (Vec3d& vertex : shape.vertices) vertex = middle + factor * (vertex - middle);
}

/// The margin is Bullet's default. Boxes and cylinders shrink by it along each of their axes.
void round_edges(trace::Shape& shape) {
  const Vec3d middle = middle_of(shape);
  Vec3d half = Vec3d::Zero();
  for (const Vec3d& vertex : shape.vertices) half = half.cwiseMax((vertex - middle).cwiseAbs());
  const double margin = std::min(0.04, half.minCoeff() / 10);
  for (Vec3d& vertex : shape.vertices) vertex -= margin * (vertex - middle).cwiseQuotient(half);
  shape.margin += margin;
}

void lay_along(trace::Shape& capsule, int axis) {
  const Vec3d middle = middle_of(capsule);
  const Vec3d half = 0.5 * (capsule.vertices[1] - capsule.vertices[0]).norm() * Vec3d::Unit(axis);
  capsule.vertices = {middle - half, middle + half};
}

}  // namespace

const std::vector<Mistake>& mistakes() {
  static const std::vector<Mistake> kMistakes = {
      {"flipped_normals", "normals point from b to a",
       "negate each normal, or swap a and b; Bullet's m_normalWorldOnB, and the normals of ODE, "
       "DART and PhysX, point to the first shape",
       [](Reading& r) { r.normals_flipped = true; }},
      {"positive_depths", "separations have the sign of a depth",
       "negate each separation: it is negative in overlap; ODE and FCL report depths",
       [](Reading& r) { r.separations_negated = true; }},
      {"half_depths", "separations are half of the overlap",
       "double them; if they are measured from the middle of the overlap, add the other half "
       "(MuJoCo before 3.4 reports half of the overlap of two boxes)",
       [](Reading& r) { r.separation_scale = 2; }},
      {"double_depths", "separations are twice the overlap",
       "halve them; maybe the overlap was added for a and for b",
       [](Reading& r) { r.separation_scale = 0.5; }},
      {"poses_of_frame_before", "contacts belong to the poses of the frame before",
       "write the poses at which the contacts were computed, before bodies move, or set "
       "\"poses_at\":\"after_step\" in the header",
       [](Reading& r) { r.moment = Moment::FrameBefore; }},
      {"poses_of_frame_after", "contacts belong to the poses of the frame after",
       "write contacts and the poses at which they were computed into the same frame",
       [](Reading& r) { r.moment = Moment::FrameAfter; }},
      {"quaternions_xyzw", "quaternions are in the order x, y, z, w",
       "write w first: the key is 'quat_wxyz'", [](Reading& r) { r.rotation = kXyzw; }},
      {"inverse_rotations", "rotations are inverted: from the world to the shape",
       "negate x, y and z of each quaternion; maybe a matrix was read by rows instead of columns",
       [](Reading& r) { r.rotation = kInverse; }},
      {"points_in_frame_of_a", "points are in the frame of a",
       "transform each by the pose of a: 'position' is in the world",
       [](Reading& r) { r.points = Frame::OfA; }},
      {"points_in_frame_of_b", "points are in the frame of b",
       "transform each by the pose of b: 'position' is in the world",
       [](Reading& r) { r.points = Frame::OfB; }},
      {"normals_in_frame_of_a", "normals are in the frame of a", "rotate each by the pose of a",
       [](Reading& r) { r.normals = Frame::OfA; }},
      {"normals_in_frame_of_b", "normals are in the frame of b", "rotate each by the pose of b",
       [](Reading& r) { r.normals = Frame::OfB; }},
      {"sides_swapped", "'on_a' is on b, and 'on_b' on a",
       "swap them; maybe the engine has the shapes in the other order",
       [](Reading& r) { r.sides_swapped = true; }},
      {"poses_of_center_of_mass", "positions are centres of mass",
       "write the shape's own origin: the position minus the rotated centre of mass",
       [](Reading& r) { r.at_center_of_mass = true; }},
      {"shapes_half_as_large", "shapes are half the size of those that collided",
       "double their vertices; maybe half extents were used as full extents",
       [](Reading& r) { r.shape_scale = 2; }},
      {"shapes_twice_as_large", "shapes are twice the size of those that collided",
       "halve their vertices; maybe full extents were used as half extents, or a diameter as a "
       "radius",
       [](Reading& r) { r.shape_scale = 0.5; }},
      {"depths_in_centimetres", "separations are in centimetres", "divide them by 100",
       [](Reading& r) { r.separation_scale = 0.01; }},
      {"depths_in_millimetres", "separations are in millimetres", "divide them by 1000",
       [](Reading& r) { r.separation_scale = 0.001; }},
      {"points_in_centimetres", "points are in centimetres", "divide them by 100",
       [](Reading& r) { r.point_scale = 0.01; }},
      {"points_in_millimetres", "points are in millimetres", "divide them by 1000",
       [](Reading& r) { r.point_scale = 0.001; }},
      {"points_in_metres", "points are in metres, and the rest in centimetres",
       "write all lengths in metres", [](Reading& r) { r.point_scale = 100; }},
      {"shapes_in_centimetres", "shapes are in centimetres", "divide their vertices by 100",
       [](Reading& r) { r.shape_scale = 0.01; }},
      {"shapes_in_millimetres", "shapes are in millimetres", "divide their vertices by 1000",
       [](Reading& r) { r.shape_scale = 0.001; }},
      {"shapes_in_metres", "shapes are in metres, and the rest in centimetres",
       "write all lengths in metres", [](Reading& r) { r.shape_scale = 100; }},
      {"boxes_twice_as_large", "boxes are twice the size of those that collided",
       "halve their vertices: full extents were used as half extents",
       [](Reading& r) { r.form = Form::BoxesHalf; }, true},
      {"boxes_half_as_large", "boxes are half the size of those that collided",
       "double their vertices: half extents were used as full extents",
       [](Reading& r) { r.form = Form::BoxesTwice; }, true},
      {"radii_twice_as_large", "radii of spheres and capsules are twice those that collided",
       "halve each 'radius': it may be a diameter", [](Reading& r) { r.form = Form::RadiiHalf; },
       true},
      {"radii_half_as_large", "radii of spheres and capsules are half of those that collided",
       "double each 'radius': it may have been halved like a diameter",
       [](Reading& r) { r.form = Form::RadiiTwice; }, true},
      {"capsules_twice_as_long", "segments of capsules are twice as long as those that collided",
       "a full length was used as a half length: each end is half of it from the middle, without "
       "the cap",
       [](Reading& r) { r.form = Form::CapsulesHalf; }, true},
      {"capsules_half_as_long", "segments of capsules are half as long as those that collided",
       "a half length was used as a full length: each end is that far from the middle, without the "
       "cap",
       [](Reading& r) { r.form = Form::CapsulesTwice; }, true},
      {"capsules_along_x", "capsules collided along x", "write the ends of each segment along x",
       [](Reading& r) { r.form = Form::CapsulesAlongX; }, true},
      {"capsules_along_y", "capsules collided along y", "write the ends of each segment along y",
       [](Reading& r) { r.form = Form::CapsulesAlongY; }, true},
      {"capsules_along_z", "capsules collided along z", "write the ends of each segment along z",
       [](Reading& r) { r.form = Form::CapsulesAlongZ; }, true},
      {"plane_offsets_negated", "offsets of planes have the wrong sign",
       "negate each 'offset': a plane is solid where normal . x <= offset; a x + b y + c z + d = 0 "
       "has the offset -d",
       [](Reading& r) { r.form = Form::OffsetsNegated; }, true},
      {"planes_turned", "normals of planes point into the solid",
       "negate 'normal' and 'offset' of each 'half_space': it is solid where normal . x <= offset",
       [](Reading& r) { r.form = Form::PlanesTurned; }, true},
      {"angles_doubled", "rotation angles are doubled",
       "make each quaternion from the cosine and sine of half the angle",
       [](Reading& r) { r.rotation = kHalfTheAngle; }, true},
      {"rotations_mirrored_x", "rotations belong to a world mirrored in x",
       "if a left-handed world is mirrored in x, negate y and z of each quaternion too",
       [](Reading& r) { mirror(r.rotation, 0); }, true},
      {"rotations_mirrored_y", "rotations belong to a world mirrored in y",
       "if a left-handed world is mirrored in y, negate x and z of each quaternion too",
       [](Reading& r) { mirror(r.rotation, 1); }, true},
      {"rotations_mirrored_z", "rotations belong to a world mirrored in z",
       "if a left-handed world is mirrored in z, negate x and y of each quaternion too",
       [](Reading& r) { mirror(r.rotation, 2); }, true},
      {"contacts_mirrored_x", "contacts are mirrored in x, compared with the poses", kOneWorld,
       [](Reading& r) { r.axes[0] = -1; }, true},
      {"contacts_mirrored_y", "contacts are mirrored in y, compared with the poses", kOneWorld,
       [](Reading& r) { r.axes[1] = -2; }, true},
      {"contacts_mirrored_z", "contacts are mirrored in z, compared with the poses", kOneWorld,
       [](Reading& r) { r.axes[2] = -3; }, true},
      {"contacts_y_z_swapped", "contacts have y and z swapped, compared with the poses", kOneWorld,
       [](Reading& r) { std::swap(r.axes[1], r.axes[2]); }, true},
      {"contacts_z_up", "contacts have z up, and poses have y up", kOneWorld,
       [](Reading& r) { r.axes = kZUp; }, true},
      {"contacts_y_up", "contacts have y up, and poses have z up", kOneWorld,
       [](Reading& r) { r.axes = kYUp; }, true},
  };
  return kMistakes;
}

bool moves_shapes(const std::string& cause) {
  for (const Mistake& mistake : mistakes()) {
    Reading reading;
    mistake.apply(reading);
    if (cause == mistake.name) return reading.moves_shapes();
  }
  return false;
}

const std::vector<Explanation>& explanations() {
  static const std::vector<Explanation> kAll = all_explanations();
  return kAll;
}

bool takes(const trace::Shape& shape, Form form) {
  if (form == Form::AsReported) return false;
  if (form <= Form::BoxesTwice) return shape.type == "box";
  if (form <= Form::RadiiTwice) return shape.radius > 0;
  if (form <= Form::CapsulesAlongZ) return shape.vertices.size() == 2 && shape.radius > 0;
  if (form <= Form::PlanesTurned) return shape.half_space.has_value();
  return shape.type == "box" || shape.type == "cylinder";
}

trace::Shape reformed(trace::Shape shape, Form form) {
  using enum Form;
  if (form == BoxesHalf || form == CapsulesHalf) scale(shape, 0.5);
  if (form == BoxesTwice || form == CapsulesTwice) scale(shape, 2);
  if (form == RadiiHalf) shape.radius /= 2;
  if (form == RadiiTwice) shape.radius *= 2;
  if (form >= CapsulesAlongX && form <= CapsulesAlongZ)
    lay_along(shape, int(form) - int(CapsulesAlongX));
  if (form == PlanesTurned) shape.half_space->normal = -shape.half_space->normal;
  if (form == PlanesTurned || form == OffsetsNegated)
    shape.half_space->offset = -shape.half_space->offset;
  if (form == EdgesRounded) round_edges(shape);
  return shape;
}

}  // namespace contactscope::lint
