#include "lint/watch.h"
#include "lint/wrong_pairs.h"

namespace contactscope::lint {
namespace {

constexpr std::array kSizes = {"margin_added", "margin_taken_off", "shape_too_large",
                               "shape_too_small"};
constexpr std::string_view kOthers =
    "overlap_told_apart overlap_without_contact pair_never_reported pairs_twice "
    "pairs_flicker points_twice points_flicker depths_jump normals_jump impulses_flicker "
    "poses_jump bodies_fly_off touching_without_points times_do_not_rise ids_alike "
    "ids_change mesh_inside_out internal_edge friction_along_normal "
    "friction_beyond_normal friction_on_a up_axis world_in_centimetres "
    "world_in_millimetres time_in_milliseconds impulses_on_a impulses_are_forces "
    "impulses_of_a_substep impulses_halved impulses_doubled impulses_unlike_weights "
    "velocities_negated velocities_of_a_step velocities_in_centimetres "
    "velocities_in_millimetres velocities_in_frame_of_body spins_negated "
    "spins_in_degrees spins_of_a_step spins_in_frame_of_body shape large_margin large_tolerance "
    "rounded_edges kept_points torn";

/// Checks the record itself, independent of shapes and poses.
class RecordsWatch final : public Watch {
 public:
  void see(const Solids&, const Moments& frames) override {
    time_.of += frames.before != nullptr;
    if (frames.before != nullptr && !(frames.now->time > frames.before->time))
      time_.wrong(frames, "", "", [] { return std::pair<std::string, std::string>(); });
    std::set<std::array<std::string, 3>> record;
    for (const trace::Pair& pair : frames.now->pairs) {
      ++twice_.of;
      const auto [first, second] = std::minmax(pair.a, pair.b);
      if (!record.insert({first, second, pair.label}).second)
        twice_.wrong(frames, pair.a, pair.b, [&] {
          return std::pair<std::string, std::string>(
              "it is in this frame already", "a pair is in a frame once, with all its manifolds");
        });
      if (pair.state != "touching" || pair.query || pair.overlap || pair.degenerate) continue;
      ++empty_.of;
      if (pair.manifolds.empty())
        empty_.wrong(frames, pair.a, pair.b, [] {
          return std::pair<std::string, std::string>("'state' is 'touching'",
                                                     "it has no contact points");
        });
    }
  }

  void report(std::vector<Finding>& findings) override {
    twice_.report(
        findings, "pairs are reported twice in a frame",
        "leave one out: many engines report a pair in both orders, or once for each body");
    empty_.report(findings, "pairs are 'touching' and have no points",
                  "write their manifolds, or leave 'state' out: it follows from them");
    time_.report(
        findings, "'time' does not increase from frame to frame",
        "write the time of each frame, in seconds: velocities and impulses are compared with it");
  }

 private:
  Tally twice_{"pairs_twice"}, empty_{"touching_without_points"},
      time_{"times_do_not_rise", "frames"};
};

}  // namespace

const Words kUnexplained[kWrongs] = {
    {"separation", "separations do not match the shapes",
     "a separation is measured at the point, along the normal, from the surface of a to that of b; "
     "check the shapes' sizes, and the time of the poses"},
    {"surface", "points are off the surfaces",
     "a point lies on a surface, or between the two; check its frame and unit, and the shapes' "
     "sizes"},
    {"side", "'on_a' or 'on_b' is off its surface",
     "'on_a' is on the surface of a, 'on_b' on that of b, both in the world"},
    {"normal", "normals are not the directions of least overlap",
     "moving b along the normal by the overlap separates the shapes; check the test that chose the "
     "axis"},
    {"deepest", "no point is as deep as the overlap",
     "keep the deepest point: check clipping and reduction"},
};

std::vector<std::string_view> causes() {
  std::vector<std::string_view> names(kSizes.begin(), kSizes.end());
  for (const Mistake& mistake : mistakes()) names.emplace_back(mistake.name);
  for (const Words& words : kUnexplained) names.emplace_back(words.cause);
  for (std::size_t at = 0; at < kOthers.size();) {
    const std::size_t end = std::min(kOthers.find(' ', at), kOthers.size());
    names.push_back(kOthers.substr(at, end - at));
    at = end + 1;
  }
  return names;
}

std::unique_ptr<Watch> watch_records() { return std::make_unique<RecordsWatch>(); }

}  // namespace contactscope::lint
