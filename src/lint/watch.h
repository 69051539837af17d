#pragma once

#include <memory>
#include <vector>

#include "lint/claims.h"
#include "lint/linter.h"

namespace contactscope::lint {

/// One kind of question to a trace: sees each frame once, and tells at the end.
class Watch {
 public:
  virtual ~Watch() = default;
  /// frames.now is there; its neighbours are where the trace has the frame before and the one after.
  virtual void see(const Solids& solids, const Moments& frames) = 0;
  virtual void report(std::vector<Finding>& findings) = 0;
};

/// claims_watch.cpp: points, normals and separations against the shapes, and what they would be right under.
std::unique_ptr<Watch> watch_claims(const trace::Header& header, const LintOptions& options);
/// overlaps.cpp: shapes that overlap, and no contact is told.
std::unique_ptr<Watch> watch_overlaps();
/// ids.cpp: names of points that change while nothing moves.
std::unique_ptr<Watch> watch_ids();
/// rotations.cpp: quaternions with w last that pass for half turns.
std::unique_ptr<Watch> watch_rotations();
/// motion.cpp: what falls, and what rests, against gravity, weights and the axis that is up.
std::unique_ptr<Watch> watch_motion(const trace::Header& header);

/// records.cpp: pairs that stand there twice, or have no points; times that do not rise.
std::unique_ptr<Watch> watch_records();
/// friction.cpp: across the normal, bounded by the normal impulse, against what slides.
std::unique_ptr<Watch> watch_friction();
/// velocities.cpp: against how far bodies get.
std::unique_ptr<Watch> watch_velocities();
/// windings.cpp: meshes that are met from behind.
std::unique_ptr<Watch> watch_windings();

/// "0.0213": metres as findings tell them.
std::string metres(double length);
/// "[0, 1, 0]".
std::string spelled(const Vec3d& vector);

}  // namespace contactscope::lint
