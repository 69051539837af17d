#pragma once

#include <memory>
#include <vector>

#include "lint/claims.h"
#include "lint/linter.h"

namespace contactscope::lint {

/// One kind of check of a trace: sees each frame once and reports at the end.
class Watch {
 public:
  virtual ~Watch() = default;
  /// frames.now is set; its neighbours are set if the trace has the frame before and after.
  virtual void see(const Solids& solids, const Moments& frames) = 0;
  virtual void report(std::vector<Finding>& findings) = 0;
};

/// bodies_over_time.cpp: poses that jump and come back, bodies that fly off.
std::unique_ptr<Watch> watch_bodies_over_time();
/// contacts_over_time.cpp: pairs and points that come and go, separations and normals that jump, all
/// without motion; points reported twice.
std::unique_ptr<Watch> watch_contacts_over_time();
/// claims_watch.cpp: compares points, normals and separations with the shapes, and explains errors.
std::unique_ptr<Watch> watch_claims(const trace::Header& header, const LintOptions& options);
/// overlaps.cpp: overlapping shapes without contacts, also of bodies at rest on one another.
std::unique_ptr<Watch> watch_overlaps(const trace::Header& header);
/// internal_edges.cpp: contacts with edges of a mesh where its surface continues.
std::unique_ptr<Watch> watch_internal_edges();
/// ids.cpp: ids of points that change while nothing moves.
std::unique_ptr<Watch> watch_ids();
/// turned_shapes.cpp: quaternions with w last that look like half turns.
std::unique_ptr<Watch> watch_rotations();
/// motion.cpp: falling and resting bodies compared with gravity, weights and the up axis.
std::unique_ptr<Watch> watch_motion(const trace::Header& header);

/// causes.cpp: duplicate pairs, pairs without points, times that do not increase.
std::unique_ptr<Watch> watch_records();
/// velocities.cpp: friction perpendicular to the normal, bounded by its impulse, against sliding.
std::unique_ptr<Watch> watch_friction();
/// velocities.cpp: compared with displacements.
std::unique_ptr<Watch> watch_velocities();
/// turned_shapes.cpp: meshes that are hit from behind.
std::unique_ptr<Watch> watch_windings();

/// "0.0213": metres as written in findings.
std::string metres(double length);
/// "[0, 1, 0]".
std::string spelled(const Vec3d& vector);

}  // namespace contactscope::lint
