#include <algorithm>
#include <array>
#include <set>

#include "lint/tally.h"

namespace contactscope::lint {
namespace {

/// Checks the record itself, independent of shapes and poses.
class RecordsWatch final : public Watch {
 public:
  void see(const Solids&, const Moments& frames) override {
    see_time(frames);
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
    twice_.report("pairs are reported twice in a frame",
                  "leave one out: many engines report a pair in both orders, or once for each body",
                  1, 0, findings);
    empty_.report("pairs are 'touching' and have no points",
                  "write their manifolds, or leave 'state' out: it follows from them", 1, 0,
                  findings);
    time_.report(
        "'time' does not increase from frame to frame",
        "write the time of each frame, in seconds: velocities and impulses are compared with it", 1,
        0, findings);
  }

 private:
  void see_time(const Moments& frames) {
    if (frames.before == nullptr) return;
    ++time_.of;
    const double before = frames.before->time, now = frames.now->time;
    if (now > before) return;
    time_.wrong(frames, "", "", [] { return std::pair<std::string, std::string>(); });
  }

  Tally twice_{"pairs_twice"}, empty_{"touching_without_points"}, time_{"times_do_not_rise"};
};

}  // namespace

std::unique_ptr<Watch> watch_records() { return std::make_unique<RecordsWatch>(); }

}  // namespace contactscope::lint
