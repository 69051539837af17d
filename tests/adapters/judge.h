#pragma once

#include <map>
#include <string>
#include <utility>

#include "trace/json.h"

/// What a recorded trace claims, worked out again from its shapes and poses alone: by support points, features
/// against features, and triangle by triangle in extended precision. No engine has a part in it, and no code of
/// the pipeline either.
namespace contactscope::test {

/// The worst of a pair over all frames, metres.
struct Claims {
  int frames = 0, points = 0, with_impulse = 0;
  double deepest = 0;  // separation
  double normal = 0;   // how far from unit
  double surface = 0;  // `on_a` and `on_b` off the surfaces that they are claimed to be on
  double off_a = 0;    // `position` off the surface of a
  double off_b = 0;
  double middle = 0;  // without these: `position` off the shapes, by more than its separation
  double sides = 0;   // the separation against the way from `on_a` to `on_b` along the normal
  /// The deepest point against the overlap along the normal; of other normals of the pair, how much deeper than
  /// that overlap a point is. Of convex shapes and planes, and of a ball on a mesh against its distance.
  double along = 0;
  /// How much deeper the overlap is along the normal than along the best one: a normal that points the wrong way
  /// has the extent of both shapes. Of convex shapes and planes.
  double best = 0;
};

using PairNames = std::pair<std::string, std::string>;
std::map<PairNames, Claims> judge(const trace::Trace& trace);

/// What an engine promises, metres.
struct Promise {
  double surface = 0, along = 0, best = 0;
};
/// Fails for each pair that breaks it but for those listed, and for one of those that does not; and where there are no
/// pairs. Normals are held to be unit within 1e-5. The linter must say as much as `told`, by its names of causes.
void expect_right(const trace::Trace& trace, const Promise& promise,
                  const std::vector<PairNames>& known_faults = {},
                  const std::vector<std::string>& told = {});

/// How many lines of a file of this folder are there for the recorder: they name it, or the library.
int lines_for_the_recorder(const std::string& sample);

/// How far each body is from Newton's second law, frame for frame: the change of its momentum against its weight
/// and the impulses of all of its contacts, as a share of its weight over the step. The worst frame.
std::map<std::string, double> momentum_errors(const trace::Trace& trace, const Vec3d& gravity);

/// The sum of what contacts give a body in a frame, newton seconds.
Vec3d impulse_on(const trace::Trace& trace, const trace::Frame& frame, const std::string& body);

/// The same trace with the poses of the frame after: what a recorder writes that takes them too late.
trace::Trace with_late_poses(trace::Trace trace);
/// The same trace with all normals turned round.
trace::Trace with_turned_normals(trace::Trace trace);

}  // namespace contactscope::test
