#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/vec3.h"

namespace contactscope::lint {

/// The moment of the poses that contacts are held against.
enum class Moment { OfFrame, FrameBefore, FrameAfter };

/// Which frame vectors are told in.
enum class Frame { World, OfA, OfB };

/// How the four numbers of a rotation are meant. Mirrored: of a world in which that axis has the other sign.
enum class Rotation { Wxyz, Xyzw, Inverse, HalfTheAngle, MirroredX, MirroredY, MirroredZ };

/// How the three numbers of contact points and normals stand to those of poses.
enum class Axes { Same, MirroredX, MirroredY, MirroredZ, YzSwapped, ZUp, YUp };

/// What shapes collided as, where that is not what the trace says.
enum class Form {
  AsReported,
  BoxesHalf,
  BoxesTwice,
  RadiiHalf,
  RadiiTwice,
  CapsulesHalf,
  CapsulesTwice,  // as long
  CapsulesAlongX,
  CapsulesAlongY,
  CapsulesAlongZ,
  OffsetsNegated,
  PlanesTurned,
};

/// One way to read what a trace says. The default is what src/trace/README.md promises; each other value
/// is a mistake that people make.
struct Reading {
  Frame normals = Frame::World;
  bool normals_flipped = false;
  bool separations_negated = false;
  double separation_scale = 1;
  Frame points = Frame::World;
  double point_scale = 1;
  Moment moment = Moment::OfFrame;
  Rotation rotation = Rotation::Wxyz;
  bool at_center_of_mass = false;  // positions are of the centre of mass, not of the shape's origin
  double shape_scale = 1;
  bool sides_swapped = false;  // on_a is on b, and on_b on a
  Axes axes = Axes::Same;
  Form form = Form::AsReported;

  /// Whether it has shapes elsewhere, or otherwise, than the trace says.
  bool moves_shapes() const {
    return moment != Moment::OfFrame || rotation != Rotation::Wxyz || at_center_of_mass ||
           shape_scale != 1 || form != Form::AsReported;
  }

  friend bool operator==(const Reading&, const Reading&) = default;
};

/// A mistake: the reading under which what it led to is right again.
struct Mistake {
  const char* name;    // in JSON: "flipped_normals"
  const char* what;    // "normals point from b to a"
  const char* remedy;  // "negate them; ..."
  void (*apply)(Reading&);
  bool alone = false;  // not looked for beside another one
};

/// All that are known, the likelier ones first.
const std::vector<Mistake>& mistakes();

/// Whether a cause is a mistake that moves shapes, so that where they seem to be says nothing.
bool moves_shapes(const std::string& cause);

/// One mistake, or two of different kinds at once.
struct Explanation {
  std::vector<const Mistake*> made;
  Reading reading;
};

/// What to try on claims that are wrong as they stand: each mistake by itself, then two at a time.
const std::vector<Explanation>& explanations();

}  // namespace contactscope::lint
