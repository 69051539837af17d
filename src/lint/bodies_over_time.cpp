#include "core/spell.h"
#include "lint/watch.h"
#include "trace/find.h"

namespace contactscope::lint {
namespace {

/// Relative to its size: a smaller displacement within a step is no jump.
constexpr double kLeap = 0.02, kStir = 1e-3, kLongStep = 0.5;
/// A displacement is a jump if it is this many times the others.
constexpr double kTimes = 10, kFaster = 4;

class BodiesWatch final : public Watch {
 public:
  explicit BodiesWatch(const trace::Header& header)
      : up_(header.up == "z" ? Vec3d::UnitZ() : Vec3d::UnitY()) {}

  void see(const Solids& solids, const Moments& frames) override {
    if (frames.before == nullptr) last_.clear(), last_turn_.clear(), jumped_.clear();
    for (Peak* const peak : {&overlap_, &impulse_}) peak->see(*frames.now);
    std::map<std::string, Vec3d> moved;
    std::map<std::string, double> turns;
    std::set<std::string> jumped;
    double fastest = fastest_;
    const double lowest = lowest_contact(*frames.now);
    for (const auto& [name, pose] : frames.now->poses) {
      const std::optional<Placed> now = place(solids, frames.now, name, {});
      if (!now || now->solid->is_plane()) continue;
      // It has left the world, and falls forever.
      if (up_.dot(now->middle()) < lowest - now->size()) continue;
      const std::optional<Placed> before = place(solids, frames.before, name, {});
      const std::optional<Placed> after = place(solids, frames.after, name, {});
      if (before && !jumped_.contains(name)) {
        moved[name] = now->middle() - before->middle();
        turns[name] = turned(*before, *now);
      }
      if (!before || !after) continue;
      if (is_jump(solids, frames, name, *before, *now, *after))
        jumped.insert(name);
      else if (!jumped_.contains(name))
        see_flight(solids, frames, name, *before, *now, *after, fastest);
    }
    if (flights_.count == 0) fastest_ = fastest;
    last_ = std::move(moved);
    last_turn_ = std::move(turns);
    jumped_ = std::move(jumped);
  }

  void report(std::vector<Finding>& findings) override {
    jumps_.report(
        findings, "a body is elsewhere for a frame",
        "the frames before and after have it in the same place: check which step's pose is "
        "written, and interpolated poses");
    auto flights = mapped(flights_.pairs, [](const auto& pair) { return pair.second; });
    std::ranges::stable_sort(flights, {}, [&](const OfPair& one) {
      return std::pair(one.frame, one.a != flights_.first.a);
    });
    auto names = mapped(flights, [](const OfPair& one) { return "'" + one.a + "'"; });
    if (names.size() > kNamed)
      names[kNamed] = counted(names.size() - kNamed, "other"), names.resize(kNamed + 1);
    flights_.report(
        findings, (names.size() == 1 ? "a body flies off: " : "bodies fly off: ") + listed(names),
        ("look at the contacts of frame " + std::to_string(flights_.first.frame) +
         " and those before: deep overlaps that are pushed out within a step, wrong masses or "
         "inertias, or bodies that start in one another")
            .c_str());
  }

 private:
  static constexpr std::size_t kNamed = 5;

  /// The height of the lowest contact; without contacts less than all.
  double lowest_contact(const trace::Frame& frame) const {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    double lowest = kInfinity;
    for (const trace::Pair& pair : frame.pairs)
      for (const trace::Manifold& manifold : pair.manifolds)
        for (const trace::Point& point : manifold.points)
          lowest = std::min(lowest, up_.dot(point.position));
    return lowest < kInfinity ? lowest : -kInfinity;
  }

  /// The largest value of all pairs up to two frames ago, and in the frame before.
  struct Peak {
    double (*of)(const trace::Pair&);
    const char *before, *after;  // around its value
    double most = 0, last = 0, now = 0;

    void see(const trace::Frame& frame) {
      most = std::max(most, last), last = now, now = 0;
      for (const trace::Pair& pair : frame.pairs) now = std::max(now, of(pair));
    }
    /// `link`, the largest value and, of several frames, its frame, for a body whose contacts in some
    /// of these exceed all earlier ones; else empty.
    std::string text_for(const Solids& solids, std::initializer_list<const trace::Frame*> in,
                         const std::string& name, const std::string& link) const {
      constexpr double kMore = 1.25;
      double peak = kMore * most;
      std::string text;
      for (const trace::Frame* frame : in)
        for (const trace::Pair& pair : frame->pairs) {
          const bool is_a = solids.body_of(pair.a) == solids.body_of(name);
          if ((!is_a && solids.body_of(pair.b) != solids.body_of(name)) || of(pair) <= peak)
            continue;
          peak = of(pair);
          text = link + before + shown(peak) + after + " '" + (is_a ? pair.b : pair.a) + "'";
          if (in.size() > 1) text += " in frame " + std::to_string(frame->frame);
        }
      return text;
    }
  };

  static double turned(const Placed& from, const Placed& to) {
    return to.pose.rotation.angularDistance(from.pose.rotation) * to.size();
  }

  /// Out and back within two steps, without speed before.
  bool is_jump(const Solids& solids, const Moments& frames, const std::string& name,
               const Placed& before, const Placed& now, const Placed& after) {
    ++jumps_.of;
    const auto speed = last_.find(name);
    const double out = (now.middle() - before.middle()).norm() + turned(before, now);
    const double rest = (after.middle() - before.middle()).norm() + turned(before, after) +
                        (speed == last_.end() ? 0.0 : speed->second.norm() + last_turn_[name]);
    // Nothing that moves comes back to the very same place.
    const double least = rest > 0 ? kLeap : kStir;
    if (out < least * now.size() || out < kTimes * rest) return false;
    Mark mark{frames.now->frame, frames.now->line, name, ""};
    mark.path = {before.middle(), now.middle()};
    jumps_.wrong_at(mark, frames, 0, [&] {
      return std::pair("it is " + metres((now.middle() - before.middle()).norm()) +
                           " from its place in the frame before",
                       "in the frame after, it is " +
                           metres((after.middle() - before.middle()).norm()) + " from there");
    });
    for (const trace::Pair& pair : frames.now->pairs)
      if (solids.body_of(pair.a) == solids.body_of(name) ||
          solids.body_of(pair.b) == solids.body_of(name))
        frames.explained->try_emplace(&pair, Explained::ButForSigns);
    return true;
  }

  /// Much faster than anything before, and than itself, unless others fly off already. At rest there
  /// is nothing to compare with: the first body that moves is shot on purpose.
  void see_flight(const Solids& solids, const Moments& frames, const std::string& name,
                  const Placed& before, const Placed& now, const Placed& after, double& fastest) {
    ++flights_.of;
    if (flights_.pairs.contains({name, ""})) return;
    const double step = (after.middle() - now.middle()).norm();
    const double last = (now.middle() - before.middle()).norm();
    if (!(fastest_ > 0 && step > kLongStep * now.size() && step > kFaster * fastest_ &&
          (step > kTimes * last || flights_.count > 0))) {
      fastest = std::max(fastest, step);
      return;
    }
    const auto why = [&](std::initializer_list<const trace::Frame*> in, const char* link) {
      return overlap_.text_for(solids, in, name, link) + impulse_.text_for(solids, in, name, link);
    };
    // The frame that shows the cause, or else what happened.
    const std::string cause = why({frames.before, frames.now}, ", after");
    const trace::Frame& shown = cause.empty() ? *frames.after : *frames.now;
    Mark mark{shown.frame, shown.line, name, ""};
    mark.path = {now.middle(), after.middle()};
    flights_.wrong_at(mark, frames, 0, [&] {
      const std::string most = ", and no body by more than " + metres(fastest_) + " before";
      return cause.empty()
                 ? std::pair("it has moved by " + metres(step) + " since the frame before" +
                                 why({frames.after}, ", and now has"),
                             "in the step before that it moved by " + metres(last) + most)
                 : std::pair("it moves by " + metres(step) + " in the next step" + cause,
                             "it moves by " + metres(last) + most);
    });
  }

  Vec3d up_;
  std::map<std::string, Vec3d> last_;        // displacements to this frame
  std::map<std::string, double> last_turn_;  // metres at the rim
  double fastest_ = 0;            // metres within a step, of any body, until one flies off
  std::set<std::string> jumped_;  // bodies that were elsewhere in the frame before
  Peak overlap_{&trace::overlap_of, " an overlap of ", " m with"};
  Peak impulse_{&trace::impulse_of, " an impulse of ", " N s from"};
  Tally jumps_{"poses_jump", "poses"}, flights_{"bodies_fly_off", "poses"};
};

}  // namespace

std::unique_ptr<Watch> watch_bodies_over_time(const trace::Header& header) {
  return std::make_unique<BodiesWatch>(header);
}

}  // namespace contactscope::lint
