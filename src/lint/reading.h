#pragma once

#include "trace/shape.h"

namespace contactscope::lint {

/// The frame whose poses contacts are compared with.
enum class Moment { OfFrame, FrameBefore, FrameAfter };

/// The frame of reference of vectors.
enum class Frame { World, OfA, OfB };

/// Where each of several numbers is recorded, from 1; negative: with the other sign.
using Axes = std::array<int, 3>;      // of contact points and normals, relative to those of poses
using Rotation = std::array<int, 4>;  // w, x, y, z
inline constexpr Rotation kHalfTheAngle = {};

/// The shapes that collided, if they differ from the trace's.
enum class Form {
  AsReported,
  BoxesHalf,
  BoxesTwice,
  RadiiHalf,
  RadiiTwice,
  CapsulesHalf,
  CapsulesTwice,  // in length
  CapsulesAlongX,
  CapsulesAlongY,
  CapsulesAlongZ,
  OffsetsNegated,
  PlanesTurned,
  EdgesRounded,  // as Bullet's GJK does: boxes and cylinders, by a margin that lies inside
};

/// Whether a form applies to a shape.
bool takes(const trace::Shape& shape, Form form);

/// The shape with the form applied.
trace::Shape reformed(trace::Shape shape, Form form);

/// One interpretation of a trace. The default is the format of src/trace/README.md; every other
/// value is a common mistake.
struct Reading {
  Frame normals = Frame::World;
  bool normals_flipped = false;
  bool separations_negated = false;
  double separation_scale = 1;
  Frame points = Frame::World;
  double point_scale = 1;
  Moment moment = Moment::OfFrame;
  Rotation rotation = {1, 2, 3, 4};
  bool at_center_of_mass = false;  // positions are of the centre of mass, not of the shape's origin
  double shape_scale = 1;
  bool sides_swapped = false;  // on_a is on b, and on_b on a
  Axes axes = {1, 2, 3};
  Form form = Form::AsReported;

  /// Whether shapes or poses differ from the trace's.
  bool moves_shapes() const {
    return moment != Moment::OfFrame || rotation != Reading().rotation || at_center_of_mass ||
           shape_scale != 1 || form != Form::AsReported;
  }

  friend bool operator==(const Reading&, const Reading&) = default;
};

/// A mistake: the reading under which its effects are right.
struct Mistake {
  const char* name;    // in JSON: "flipped_normals"
  const char* what;    // "normals point from b to a"
  const char* remedy;  // "negate them; ..."
  void (*apply)(Reading&);
  bool alone = false;  // not combined with other mistakes
};

/// All known mistakes, the more likely ones first.
const std::vector<Mistake>& mistakes();

/// Whether a cause is a mistake that moves shapes, so that their poses are not reliable.
bool moves_shapes(const std::string& cause);

/// One mistake, or two compatible ones.
struct Explanation {
  std::vector<const Mistake*> made;
  Reading reading;
};

/// Explanations to try on wrong claims: each mistake alone, then pairs of them.
const std::vector<Explanation>& explanations();

}  // namespace contactscope::lint
