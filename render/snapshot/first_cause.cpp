#include "snapshot/first_cause.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "snapshot/finding.h"

namespace contactscope::snapshot {
namespace {

const trace::Pair* find_pair(const trace::Frame* frame, const std::string& subject) {
  if (frame == nullptr) return nullptr;
  const auto found = std::ranges::find_if(
      frame->pairs, [&](const trace::Pair& pair) { return key_of(pair) == subject; });
  return found == frame->pairs.end() ? nullptr : &*found;
}

/// "face_a" in words.
std::string spell_axis(const std::string& axis) {
  if (axis == "face_a") return "face a";
  if (axis == "face_b") return "face b";
  return axis == "edge_edge" ? "an edge pair" : axis.empty() ? "none" : axis;
}

std::optional<double> separation_along(const trace::Sat& sat, const std::string& axis) {
  if (axis == "face_a" && sat.face_a) return sat.face_a->separation;
  if (axis == "face_b" && sat.face_b) return sat.face_b->separation;
  if (axis == "edge_edge" && sat.edge) return sat.edge->separation;
  return {};
}

/// The test took another axis: both with their numbers, and by how much one was nearer.
std::string spell_decision(const trace::Sat& before, const trace::Sat& now) {
  std::string text = "the separating axis test now takes " + spell_axis(now.chosen) +
                     " instead of " + spell_axis(before.chosen);
  const auto taken = separation_along(now, now.chosen), left = separation_along(now, before.chosen);
  if (!taken || !left) return text;
  const auto [a, b] = spell_both(*taken * 1e3, *left * 1e3);
  text += ": separation " + a + " mm against " + b + " mm";
  const double between = std::abs(*taken - *left);
  return text + (between > 0 ? ", " + spell_length(between) + " between them" : ", a tie");
}

std::string spell_cause(const FrameDifferences& frame, const Difference& first) {
  const trace::Pair* const before = find_pair(frame.expected, first.subject);
  const trace::Pair* const now = find_pair(frame.actual, first.subject);
  if (first.stage == Stage::Decision && before && now && before->sat && now->sat &&
      before->sat->chosen != now->sat->chosen)
    return spell_decision(*before->sat, *now->sat);
  return first.text;
}

/// What follows, as things that people count.
struct Thing {
  const char* one;
  const char* many;
};
std::optional<Thing> thing_of(const Difference& difference) {
  switch (difference.stage) {
    case Stage::Setup:
      return Thing{"setting", "settings"};
    case Stage::Motion:
      return Thing{"pose", "poses"};
    case Stage::BroadPhase:
      return Thing{"fact of the broad phase", "facts of the broad phase"};
    case Stage::Pairs:
      return Thing{"pair", "pairs"};
    case Stage::Cache:
      return Thing{"cache entry", "cache entries"};
    case Stage::Candidates:
      return Thing{"fact of the tree", "facts of the tree"};
    case Stage::Axes:
      return Thing{"axis query", "axis queries"};
    case Stage::Decision:
      return Thing{"chosen axis", "chosen axes"};
    case Stage::Faces:
      return difference.text.starts_with("reference") ? Thing{"reference face", "reference faces"}
                                                      : Thing{"incident face", "incident faces"};
    case Stage::Clipping:
      return Thing{"clip step", "clip steps"};
    case Stage::Reduction:
      return Thing{"fact of the reduction", "facts of the reduction"};
    case Stage::Manifold:
      return Thing{"normal or axis", "normals or axes"};
    case Stage::Points:
      return difference.text.starts_with("persistent")
                 ? Thing{"persistent point", "persistent points"}
                 : Thing{"point", "points"};
    case Stage::Solver:
      return Thing{"fact of the solver", "facts of the solver"};
    case Stage::Ids:      // counted beside the points
    case Stage::Answers:  // mostly repeats what a point says
    case Stage::Sums:
    case Stage::Words:
    case Stage::Frames:
      break;
  }
  return {};
}

bool has_id(const Difference& difference) {
  return std::ranges::any_of(difference.what, [](const Changes::What& what) {
    return what.kind == trace::Kind::Exact && what.words == "id ";
  });
}
bool has_impulse(const Difference& difference) {
  return std::ranges::any_of(
      difference.what, [](const Changes::What& what) { return what.kind == trace::Kind::Impulse; });
}

int count_points(const FrameDifferences& frame, const std::string& subject) {
  const trace::Pair* const pair = find_pair(frame.actual, subject);
  int count = 0;
  if (pair != nullptr)
    for (const trace::Manifold& manifold : pair->manifolds)
      count += static_cast<int>(manifold.points.size());
  return count;
}

/// "; so the reference face, 4 clip steps and 3 of 4 ids changed": of what the cause is of, or of the whole
/// frame where that is no pair.
std::string spell_effects(const FrameDifferences& frame, const Difference& first) {
  struct Effect {
    Stage stage;
    Thing thing;
    int count = 0;
    int of = 0;
  };
  std::vector<Effect> effects;
  const auto add = [&](Stage stage, Thing thing, int of = 0) {
    const auto found = std::ranges::find_if(
        effects, [&](const Effect& effect) { return std::string(effect.thing.one) == thing.one; });
    if (found == effects.end())
      effects.push_back({stage, thing, 1, of});
    else
      ++found->count;
  };
  const bool is_pair = find_pair(frame.actual, first.subject) != nullptr;
  const int points = is_pair ? count_points(frame, first.subject) : 0;
  for (const Difference& difference : frame.differences) {
    if (is_pair && difference.subject != first.subject) continue;
    if (&difference != &first && difference.stage >= first.stage) {
      if (const auto thing = thing_of(difference)) add(difference.stage, *thing);
    }
    if (has_id(difference) && first.stage < Stage::Ids) add(Stage::Ids, {"id", "ids"}, points);
    if (has_impulse(difference) && first.stage < Stage::Solver)
      add(Stage::Solver, {"impulse", "impulses"}, points);
  }
  std::ranges::stable_sort(effects, {}, &Effect::stage);
  std::string text;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    const auto& [stage, thing, count, of] = effects[i];
    text += i == 0 ? "" : i + 1 == effects.size() ? " and " : ", ";
    if (of >= count && of > 1)
      text += std::to_string(count) + " of " + std::to_string(of) + " " + thing.many;
    else
      text += count == 1 && (stage == Stage::Faces || stage == Stage::Decision)
                  ? std::string("the ") + thing.one
                  : counted(count, thing.one, thing.many);
  }
  return text.empty() ? text : "; so " + text + " changed";
}

/// Names of stages, values and what came or went, but no number, no name of a shape.
std::string signature_of(const Difference& first) {
  std::string text = std::to_string(static_cast<int>(first.stage));
  std::set<std::string> words;
  for (const Changes::What& what : first.what) words.insert(what.words);
  for (const std::string& word : words) text += ", " + word;
  if (first.what.empty()) text += ", " + first.text.substr(first.text.rfind(' ') + 1);
  return text;
}

}  // namespace

FirstCause first_cause(const std::string& scenario, const std::vector<FrameDifferences>& frames) {
  // A title, or which frames are stored, is nobody's cause while anything else differs.
  const FrameDifferences* frame = &frames.front();
  const Difference* first = &frame->differences.front();
  for (const FrameDifferences& one : frames) {
    const auto least = std::ranges::min_element(one.differences, {}, &Difference::stage);
    if (first->stage < Stage::Words && frame->frame != one.frame) break;
    if (least->stage >= first->stage) continue;
    frame = &one;
    first = &*least;
  }
  FirstCause cause;
  cause.sentence = scenario;
  if (frame->frame >= 0) cause.sentence += " frame " + std::to_string(frame->frame);
  if (!first->subject.empty()) cause.sentence += ", " + first->subject;
  cause.sentence += ": " + spell_cause(*frame, *first) + spell_effects(*frame, *first);
  std::set<std::string> pairs;
  for (const Difference& difference : frame->differences)
    if (find_pair(frame->actual, difference.subject)) pairs.insert(difference.subject);
  if (pairs.size() > 1)
    cause.sentence += "; " + counted(static_cast<int>(pairs.size()), "pair") + " differ in it";
  std::vector<int> others;
  for (const FrameDifferences& one : frames)
    if (one.frame >= 0 && one.frame != frame->frame) others.push_back(one.frame);
  if (!others.empty())
    cause.sentence +=
        std::string("; also frame") + (others.size() > 1 ? "s " : " ") + spell_numbers(others);
  cause.signature = signature_of(*first);
  return cause;
}

}  // namespace contactscope::snapshot
