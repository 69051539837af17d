#include <cmath>

#include "lint/tally.h"

namespace contactscope::lint {
namespace {

/// An upright shape has the rotation 1, 0, 0, 0. With w last it is written as 0, 0, 0, 1, a half
/// turn about z. Boxes look right then, and only other shapes reveal it.
class RotationsWatch final : public Watch {
 public:
  void see(const Solids& solids, const Moments& frames) override {
    for (const auto& [name, pose] : frames.now->poses) {
      const Solid* const solid = solids.find(name);
      if (solid == nullptr) continue;
      constexpr double kAlmost = 0.999;
      if (std::abs(pose.rotation.w()) > kAlmost) ++upright_;
      ++half_turns_.of;
      if (std::abs(pose.rotation.z()) < kAlmost) continue;
      half_turns_.wrong(frames, name, "", [] {
        return std::pair("'quat_wxyz' is 0, 0, 0, 1: half a turn about z",
                         "with w last it is no rotation, and no shape of the trace has 1, 0, 0, 0");
      });
    }
  }

  void report(std::vector<Finding>& findings) override {
    constexpr int kFewest = 2;
    if (half_turns_.count < kFewest || upright_ > 0 || 2 * half_turns_.count < half_turns_.of)
      return;
    for (const Finding& finding : findings)
      if (finding.cause == half_turns_.cause) return;
    half_turns_.report("quaternions are in the order x, y, z, w",
                       "write w first: the key is 'quat_wxyz'", kFewest, 0.5, findings);
  }

 private:
  int upright_ = 0;
  Tally half_turns_{"quaternions_xyzw"};
};

}  // namespace

std::unique_ptr<Watch> watch_rotations() { return std::make_unique<RotationsWatch>(); }

}  // namespace contactscope::lint
