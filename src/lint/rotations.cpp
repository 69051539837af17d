#include <cmath>

#include "lint/watch.h"

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
      ++poses_;
      if (std::abs(pose.rotation.z()) < kAlmost) continue;
      if (half_turns_++ > 0) continue;
      first_ = {"quaternions_xyzw",
                "quaternions are in the order x, y, z, w",
                "write w first: the key is 'quat_wxyz'",
                0,
                0,
                frames.now->line,
                frames.now->frame,
                name,
                "",
                "'quat_wxyz' is 0, 0, 0, 1: half a turn about z",
                "with w last it is no rotation, and no shape of the trace has 1, 0, 0, 0"};
    }
  }

  void report(std::vector<Finding>& findings) override {
    constexpr int kFewest = 2;
    if (half_turns_ < kFewest || upright_ > 0 || 2 * half_turns_ < poses_) return;
    for (const Finding& finding : findings)
      if (finding.cause == first_.cause) return;
    first_.count = half_turns_;
    first_.of = poses_;
    findings.push_back(first_);
  }

 private:
  int upright_ = 0, half_turns_ = 0, poses_ = 0;
  Finding first_;
};

}  // namespace

std::unique_ptr<Watch> watch_rotations() {
  return std::make_unique<RotationsWatch>();
}

}  // namespace contactscope::lint
