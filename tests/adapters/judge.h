#pragma once

#include <map>
#include <string>
#include <utility>

#include "trace/json.h"

/// Recomputes the claims of a recorded trace from its shapes and poses, in extended precision: by
/// support points, features against features, and triangles. Uses no engine and no pipeline.
namespace contactscope::test {

/// The worst errors of a pair over all frames, metres.
struct Claims {
  int frames = 0, points = 0, with_impulse = 0;
  double deepest = 0;  // separation
  double normal = 0;   // difference from unit length
  double surface = 0;  // distances of `on_a` and `on_b` from their claimed surfaces
  double off_a = 0;    // distance of `position` from the surface of a
  double off_b = 0;
  double middle = 0;  // without these: distance of `position` from the shapes beyond its separation
  double sides = 0;   // separation minus offset from `on_a` to `on_b` along the normal
  /// The deepest point against the overlap along the normal; for the pair's other normals, depth
  /// beyond that overlap. For convex shapes and planes; for a ball on a mesh, against its distance.
  double along = 0;
  /// Overlap along the normal minus overlap along the best one: a reversed normal gives the extent
  /// of both shapes. For convex shapes and planes.
  double best = 0;
};

using PairNames = std::pair<std::string, std::string>;
std::map<PairNames, Claims> judge(const trace::Trace& trace);

/// Accuracy that an engine promises, metres.
struct Promise {
  double surface = 0, along = 0, best = 0;
};
/// Fails without pairs, for each unlisted pair outside the promise, and for each listed pair inside
/// it. Normals must be unit within 1e-5. The linter must report exactly these names of causes.
void expect_right(const trace::Trace& trace, const Promise& promise,
                  const std::vector<PairNames>& known_faults = {},
                  const std::vector<std::string>& expected = {});

/// Number of lines of a file of this folder that name the recorder or the library.
int lines_for_the_recorder(const std::string& sample);

/// Deviation of each body from Newton's second law: the change of its momentum minus the impulses
/// of its weight and of all its contacts, relative to its weight over the step. The worst frame.
std::map<std::string, double> momentum_errors(const trace::Trace& trace, const Vec3d& gravity);

/// The sum of the contact impulses on a body in a frame, newton seconds.
Vec3d impulse_on(const trace::Trace& trace, const trace::Frame& frame, const std::string& body);

/// The same trace with the poses of the next frame, as a recorder writes if it reads them too late.
trace::Trace with_late_poses(trace::Trace trace);
/// The same trace with all normals reversed.
trace::Trace with_turned_normals(trace::Trace trace);

}  // namespace contactscope::test
