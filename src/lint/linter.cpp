#include "lint/linter.h"

#include "core/spell.h"
#include "lint/balance.h"
#include "lint/watch.h"

namespace contactscope::lint {

std::string shown(double value) { return printed("%.3g", value); }

std::string spelled(const Vec3d& vector) {
  const Vec3d v = vector + Vec3d::Zero();  // without -0
  return "[" + shown(v.x()) + ", " + shown(v.y()) + ", " + shown(v.z()) + "]";
}

bool LintOptions::ignores(const std::string& cause, const std::string& a,
                          const std::string& b) const {
  return std::ranges::any_of(ignored, [&](const Ignored& one) {
    return one.cause == cause && (one.shape.empty() || one.shape == a || one.shape == b);
  });
}

namespace {

struct Cause {
  bool (*is)(const std::string& cause);
  std::vector<std::string> effects;
  /// InMost: in pairs that do not have the effect more often than the cause.
  enum { Anywhere, InPairs, InMost } where = Anywhere;
  /// Of what is left without its example, the share of the cases that is still reported.
  double least = 0;
};
/// Effects are left out when their cause is reported.
const std::vector<Cause>& causes_and_effects() {
  static const std::vector<Cause> all = {
      {[](const std::string& cause) {
         return std::ranges::find(mistakes(), cause, &Mistake::name) != mistakes().end();
       },
       {"depths_jump", "impulses_flicker", "internal_edge"},
       Cause::InPairs},
      {[](const std::string& cause) {
         return moves_shapes(cause) || cause == "shape_too_large" || cause == "shape_too_small";
       },
       {"overlap_told_apart", "overlap_without_contact", "pair_never_reported"}},
      {[](const std::string& cause) { return cause == "shape_too_large"; },
       {"pairs_flicker"},
       Cause::InMost},
      {[](const std::string& cause) { return cause == "pairs_flicker"; },
       {"overlap_without_contact"},
       Cause::InMost},
      {[](const std::string& cause) { return cause == "flipped_normals"; }, {"impulses_on_a"}},
      // MuJoCo starts again when a world has exploded.
      {[](const std::string& cause) { return cause == "bodies_fly_off"; }, {"times_do_not_rise"}},
      {[](const std::string& cause) {
         constexpr std::array kLost = {
             "pairs_flicker",           "points_flicker", "overlap_told_apart",
             "overlap_without_contact", "deepest",        "pair_never_reported"};
         return std::ranges::find(kLost, cause) != kLost.end();
       },
       {"impulses_flicker"},
       Cause::InPairs},
      {[](const std::string& cause) { return cause == "normals_jump" || cause == "depths_jump"; },
       {"separation", "normal", "deepest", "points_flicker"},
       Cause::InMost,
       0.02}};
  return all;
}

using Names = std::pair<std::string, std::string>;

/// Takes occurrences in these pairs away. Returns whether others are left.
bool leaves_others(const std::set<Names>& explained, Finding& finding) {
  const auto is_explained = [&](const auto& one) {
    if (!one.b.empty()) return explained.contains(std::minmax(one.a, one.b));
    return std::ranges::any_of(
        explained, [&](const Names& pair) { return pair.first == one.a || pair.second == one.a; });
  };
  for (const OfPair& one : finding.pairs) finding.count -= is_explained(one) ? one.count : 0;
  std::erase_if(finding.pairs, is_explained);
  std::erase_if(finding.marks, is_explained);
  if (finding.pairs.empty() || finding.count <= 0) return false;
  if (is_explained(finding)) put(finding.pairs.front(), finding);
  return true;
}

/// Leaves out the effects of causes that are reported: of one that explains half of all pairs all of
/// them, of another one those in its pairs.
void erase_effects(const Cause& cause, std::vector<Finding>& all) {
  bool is_wide = false;
  std::map<Names, int> caused;
  for (const Finding& finding : all) {
    if (!is_reported(finding) || !cause.is(finding.cause)) continue;
    is_wide = is_wide || cause.where == Cause::Anywhere || finding.pairs.empty() ||
              2 * finding.count >= finding.of;
    for (const OfPair& one : finding.pairs) caused[std::minmax(one.a, one.b)] += one.count;
  }
  if (!is_wide && caused.empty()) return;
  std::erase_if(all, [&](Finding& finding) {
    if (std::ranges::find(cause.effects, finding.cause) == cause.effects.end()) return false;
    if (is_wide && cause.where != Cause::InMost) return true;
    std::set<Names> explained;
    std::map<Names, int> own;
    for (const OfPair& one : finding.pairs) own[std::minmax(one.a, one.b)] += one.count;
    for (const auto& [names, count] : caused)
      if (cause.where == Cause::InPairs || count >= own[names]) explained.insert(names);
    const OfPair example{finding.a, finding.b};
    if (!leaves_others(explained, finding)) return true;
    const bool is_another = finding.a != example.a || finding.b != example.b;
    // Its example was the worst one.
    if (is_another && finding.count < cause.least * finding.of)
      finding.below = shown(100 * cause.least) + " %";
    return false;
  });
}

/// Mistakes that explain wrong claims come first, effects and unexplained claims late. Engines
/// approximate some kinds of shapes all the time, and are grossly wrong once in thousands of pairs:
/// that comes after things that come and go, and after edges that are touched within a mesh.
int rank_of(const Finding& finding) {
  enum { Mistake, Poses, Flicker, Edges, Rare, Jumps, Impulses, Small, Approximate, Below, Hint };
  constexpr double kPart = 0.5, kMany = 0.05, kFew = 0.002;
  if (!is_reported(finding)) return finding.is_hint ? Hint : Below;
  const auto is = [&](auto... names) { return ((finding.cause == names) || ...); };
  const auto is_above = [&](double share) { return finding.count > share * finding.of; };
  const int severe = is_above(kFew) ? Flicker : Rare;
  if (is("separation", "surface", "side", "normal", "deepest"))
    return finding.is_severe                      ? severe
           : finding.gross > 0 && is_above(kMany) ? Impulses
                                                  : Approximate;
  if (is("overlap_without_contact")) return finding.is_severe ? Rare : Small;
  if (is("pair_never_reported")) return finding.is_severe ? Flicker : Small;
  constexpr double kSmall = 0.01, kLarge = 0.03;
  if (is("margin_added", "margin_taken_off") && (finding.size < kSmall || !is_above(kPart)))
    return finding.size < kLarge ? Small : Edges;
  if (!is_above(kPart) && is("points_twice", "ids_alike", "half_depths", "depths_in_centimetres",
                             "depths_in_millimetres"))
    return Small;
  if (is("impulses_flicker")) return Impulses;
  if (is("normals_jump", "depths_jump")) return Jumps;
  if (is("internal_edge")) return Edges;
  if (is("pairs_flicker", "points_flicker")) return Flicker;
  return is("poses_jump") ? Poses : Mistake;
}

/// The share of the cases times the size of the error.
double grossness(const Finding& finding) {
  return finding.size * (finding.of > 0 ? double(finding.count) / finding.of : 1);
}

void add_hint(const char* cause, const std::string& what, const char* remedy,
              const std::string& shape, std::vector<Finding>& hints) {
  hints.push_back({cause, what, remedy, 1, 0, 1, 0, shape});
  hints.back().is_hint = true;
}

/// Corners and edges are rounded by a margin.
void add_margin_hint(const trace::Shape& shape, std::vector<Finding>& hints) {
  constexpr double kLarge = 0.25;
  if (!(shape.margin > 0) || shape.vertices.empty()) return;
  const double share = shape.margin / (box_around(shape.vertices).extent().minCoeff() / 2);
  if (!(share > kLarge)) return;
  add_hint("large_margin",
           "the margin is " + shown(std::round(100 * share)) +
               " % of the smallest half extent of '" + shape.name + "'",
           "contacts at its corners and edges are off by as much: make the margin smaller",
           shape.name, hints);
}

}  // namespace

struct Linter::State {
  State(const trace::Header& header, const LintOptions& given)
      : options(given), after_step(header.poses_at == "after_step"), balance(header) {
    solids.tolerance = options.tolerance;
    solids.are_of_bullet = header.engine == "Bullet";
    add(header.shapes);
    // These come first: what they explain is no wrong claim.
    if (!options.shapes_are_given) watches.push_back(watch_bodies_over_time(header));
    watches.push_back(watch_contacts_over_time());
    watches.push_back(watch_internal_edges());
    watches.push_back(watch_claims(header, options));
    watches.push_back(watch_overlaps(header));
    if (!options.ids_are_made) watches.push_back(watch_ids());
    watches.push_back(watch_records());
    watches.push_back(watch_friction());
    if (options.shapes_are_given) return;
    watches.push_back(watch_windings());
    watches.push_back(watch_rotations());
    watches.push_back(watch_velocities());
    watches.push_back(watch_motion(header));
  }

  void add(const std::vector<trace::Shape>& shapes) {
    for (const trace::Shape& shape : shapes) {
      solids.add(shape);
      const Solid* const solid = solids.find(shape.name);
      if (solid != nullptr && !solid->is_plane() && options.tolerance >= solid->size())
        add_hint("large_tolerance",
                 "the tolerance of " + metres(options.tolerance) +
                     " is not less than the size of '" + shape.name + "'",
                 "no error of its contacts can be seen: give a smaller one, as --tolerance 1mm",
                 shape.name, hints);
      if (!options.shapes_are_given) add_margin_hint(shape, hints);
    }
  }

  /// Takes the next frame, null after the last one, and checks the one before it.
  void see(const trace::Frame* next) {
    after = next;
    if (now != nullptr) look();
    before = now;
    now = after;
  }

  void look() {
    solids.deform(now->deformed);
    const auto neighbour = [&](const trace::Frame* frame, int offset) {
      return frame != nullptr && frame->frame == now->frame + offset ? frame : nullptr;
    };
    std::map<const trace::Pair*, Explained> explained;
    const Moments moments{neighbour(before, -1),
                          now,
                          neighbour(after, 1),
                          &options,
                          &explained,
                          &balance,
                          after_step};
    balance.see(solids, moments);
    for (const std::unique_ptr<Watch>& watch : watches) watch->see(solids, moments);
  }

  LintOptions options;
  bool after_step;
  Solids solids;
  Balance balance;
  std::vector<Finding> hints;
  std::vector<std::unique_ptr<Watch>> watches;
  const trace::Frame *before = nullptr, *now = nullptr, *after = nullptr;
  // These frames, unless the whole trace is in memory.
  std::array<trace::Frame, 3> window;
  std::size_t seen = 0;
};

Linter::Linter(const trace::Header& header, const LintOptions& options)
    : state_(std::make_unique<State>(header, options)) {}
Linter::~Linter() = default;

void Linter::frame(trace::Frame frame) {
  trace::Frame& kept = state_->window[state_->seen++ % state_->window.size()];
  kept = std::move(frame);
  look_at(kept);
}

void Linter::shapes(const std::vector<trace::Shape>& added) { state_->add(added); }

void Linter::look_at(const trace::Frame& frame) {
  shapes(frame.shapes);
  state_->see(&frame);
}

std::vector<Finding> Linter::findings() {
  state_->see(nullptr);
  std::vector<Finding> all = state_->hints;
  for (const std::unique_ptr<Watch>& watch : state_->watches) watch->report(all);
  for (const auto& [name, why] : state_->solids.refused)
    all.push_back({"shape", "shape '" + name + "' bounds nothing, so its contacts cannot be judged",
                   why, 1, 0, 1, 0, name, "", "", ""});
  for (const Cause& cause : causes_and_effects()) erase_effects(cause, all);
  std::erase_if(all, [&](const Finding& finding) {
    return finding.count == 0 ||  // all tolerated
           state_->options.ignores(finding.cause, finding.a, finding.b);
  });
  for (Finding& finding : all) {
    if (state_->options.strict) finding.below.clear();
    if (finding.marks.empty() && finding.line > 0)
      finding.marks.push_back({finding.frame, finding.line, finding.a, finding.b});
    if (finding.frames.empty()) finding.frames = mapped(finding.marks, &Mark::frame);
  }
  std::ranges::stable_sort(all, {}, [](const Finding& finding) {
    const int rank = rank_of(finding);
    return std::pair(rank, rank > 0 && is_reported(finding) ? -grossness(finding) : 0);
  });
  return all;
}

std::vector<Finding> lint(const trace::Trace& trace, const LintOptions& options) {
  Linter linter(trace.header, options);
  for (const trace::Frame& frame : trace.frames) linter.look_at(frame);
  std::vector<Finding> findings = linter.findings();
  std::erase_if(findings, [](const Finding& finding) { return !is_reported(finding); });
  return findings;
}

}  // namespace contactscope::lint
