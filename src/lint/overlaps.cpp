#include <algorithm>
#include <map>
#include <set>

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

struct Missing {
  int count = 0;
  int line = 0, frame = 0;
  double deepest = 0;

  void add(const Moments& frames, double overlap) {
    ++count;
    if (overlap <= deepest) return;
    deepest = overlap;
    line = frames.now->line;
    frame = frames.now->frame;
  }
};

class OverlapsWatch final : public Watch {
 public:
  explicit OverlapsWatch(const trace::Header& header)
      : up_(header.up == "z" ? Vec3d::UnitZ() : Vec3d::UnitY()) {}

  void see(const Solids& solids, const Moments& frames) override {
    options_ = frames.options;
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
    std::erase_if(resting_, [&](const auto& one) {
      return one.second.count < kResting || with_contacts_.contains(one.first) ||
             deep_.contains(one.first);
    });
    report_kind("pair_never_reported", "a body rests on another, and no contact is reported",
                "check the broad phase, the filter of pairs, and what is left out when a frame is "
                "written; if a joint holds the bodies, ignore this pair",
                resting_, findings);
  }

 private:
  using List = std::map<Names, Missing>;

  /// Frames in which a body rests on another.
  static constexpr int kResting = 10;

  void look(const Solids& solids, const Moments& frames, const Names& names, List& list) {
    const std::optional<Placed> a = place(solids, frames.now, names.first, {});
    const std::optional<Placed> b = place(solids, frames.now, names.second, {});
    if (!a || !b) return;
    const std::optional<Separation> separation = separation_of(*a, *b);
    if (!separation || !(separation->distance < 0)) return;
    const double overlap = -separation->distance;
    if (overlap > 4 * solids.tolerance_of(*a, *b)) {
      deep_.insert(names);
      return list[names].add(frames, overlap);
    }
    // A sleeping body has no contacts, and keeps its pose.
    const auto moves = [&](const std::string& name) {
      const auto before = place(solids, frames.before, name, {});
      const auto now = place(solids, frames.now, name, {});
      return before && (before->pose.position != now->pose.position ||
                        before->pose.rotation.coeffs() != now->pose.rotation.coeffs());
    };
    constexpr double kMinimum = 1e-6, kUpright = 0.5;
    const double reach = a->pose.position.norm() + b->pose.position.norm();
    if (overlap > kMinimum * reach && std::abs(separation->normal.dot(up_)) > kUpright &&
        solids.body_of(names.first) != solids.body_of(names.second) &&
        (moves(names.first) || moves(names.second)))
      resting_[names].add(frames, overlap);
  }

  void report_kind(const char* cause, const char* what, const char* remedy, List& list,
                   std::vector<Finding>& findings) const {
    std::erase_if(list, [&](const auto& one) {
      return options_ != nullptr && options_->ignores(cause, one.first.first, one.first.second);
    });
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
  List separation_, untold_, resting_;
  std::set<Names> deep_;  // pairs without a contact that overlap more than bodies at rest
  const LintOptions* options_ = nullptr;
  Vec3d up_;
};

}  // namespace

std::unique_ptr<Watch> watch_overlaps(const trace::Header& header) {
  return std::make_unique<OverlapsWatch>(header);
}

}  // namespace contactscope::lint
