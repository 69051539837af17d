#include <algorithm>
#include <map>
#include <set>

#include "core/at.h"
#include "lint/own_contacts.h"
#include "lint/watch.h"

namespace contactscope::lint {
namespace {

using Names = std::pair<std::string, std::string>;

Names in_order(const std::string& a, const std::string& b) {
  return a < b ? Names{a, b} : Names{b, a};
}

/// Bounding box of a placed solid, world.
Aabb<double> box_of(const Placed& placed) {
  const Vec3d middle = (placed.solid->lower() + placed.solid->upper()) / 2;
  const Vec3d half = (placed.solid->upper() - placed.solid->lower()) / 2;
  const Vec3d reach = placed.pose.rotation.toRotationMatrix().cwiseAbs() * half;
  const Vec3d center = placed.pose.transform(middle);
  return {center - reach, center + reach};
}

/// Metres of overlap; 0 if there is none or it cannot be computed.
double overlap_of(const Placed& a, const Placed& b) {
  if (const std::optional<Separation> best = best_separation(a, b))
    return std::max(-best->distance, 0.0);
  const std::optional<OwnContacts> own = own_contacts(a, b);
  return own ? std::max(-own->separation, 0.0) : 0;
}

struct Missing {
  int count = 0;
  int line = 0, frame = 0;
  double deepest = 0;
};

class OverlapsWatch final : public Watch {
 public:
  void see(const Solids& solids, const Moments& frames) override {
    std::set<Names> record;
    for (const trace::Pair& pair : frames.now->pairs) {
      const Names names = in_order(pair.a, pair.b);
      record.insert(names);
      if (!pair.manifolds.empty()) with_contacts_.insert(names);
      if (pair.manifolds.empty() && !pair.query && pair.state == "separated" && !pair.degenerate)
        look(solids, frames, names, separation_);
    }
    std::vector<std::pair<Aabb<double>, const std::string*>> boxes;
    for (const trace::Placement& one : frames.now->poses) {
      const std::optional<Placed> placed = place(solids, frames.now, one.first, {});
      if (!placed) continue;
      // A plane's box is infinite.
      const Vec3d all = Vec3d::Constant(std::numeric_limits<double>::infinity());
      boxes.emplace_back(placed->solid->is_plane() ? Aabb<double>{-all, all} : box_of(*placed),
                         &one.first);
    }
    std::ranges::sort(boxes, {}, [](const auto& box) { return box.first.lower.x(); });
    for (std::size_t i = 0; i < boxes.size(); ++i)
      for (std::size_t j = i + 1; j < boxes.size(); ++j) {
        if (boxes[j].first.lower.x() > boxes[i].first.upper.x()) break;
        if (!overlaps(boxes[i].first, boxes[j].first)) continue;
        const Names names = in_order(*boxes[i].second, *boxes[j].second);
        if (!record.contains(names)) look(solids, frames, names, untold_);
      }
  }

  void report(std::vector<Finding>& findings) override {
    for (const Finding& finding : findings)
      if (moves_shapes(finding.cause)) return;
    report_kind("overlap_told_apart", "shapes that overlap are reported as separated",
                "check the test that separates them, and the poses", separation_, findings);
    std::erase_if(untold_, [&](const auto& one) { return !with_contacts_.contains(one.first); });
    report_kind(
        "overlap_without_contact", "shapes overlap without a reported contact",
        "they have contacts in other frames: check the broad phase, and what is left out when "
        "a frame is written",
        untold_, findings);
  }

 private:
  using List = std::map<Names, Missing>;

  static void look(const Solids& solids, const Moments& frames, const Names& names, List& list) {
    const std::optional<Placed> a = place(solids, frames.now, names.first, {});
    const std::optional<Placed> b = place(solids, frames.now, names.second, {});
    if (!a || !b) return;
    const double overlap = overlap_of(*a, *b);
    if (overlap <= 4 * tolerance_of(*a, *b)) return;
    Missing& missing = list[names];
    ++missing.count;
    if (overlap <= missing.deepest) return;
    missing.deepest = overlap;
    missing.line = frames.now->line;
    missing.frame = frames.now->frame;
  }

  static void report_kind(const char* cause, const char* what, const char* remedy, const List& list,
                          std::vector<Finding>& findings) {
    const auto deepest =
        std::ranges::max_element(list, {}, [](const auto& one) { return one.second.deepest; });
    if (deepest == list.end()) return;
    int count = 0;
    for (const auto& one : list) count += one.second.count;
    findings.push_back({cause, what, remedy, count, 0, deepest->second.line, deepest->second.frame,
                        deepest->first.first, deepest->first.second, "no contact",
                        "they overlap by " + metres(deepest->second.deepest) + " m"});
  }

  std::set<Names> with_contacts_;
  List separation_, untold_;
};

}  // namespace

std::unique_ptr<Watch> watch_overlaps() {
  return std::make_unique<OverlapsWatch>();
}

}  // namespace contactscope::lint
