#include "snapshot/compare_trace.h"

#include "trace/find.h"

namespace contactscope::snapshot {
namespace {

const trace::Pair* find_pair(const trace::Frame* frame, const std::string& subject) {
  if (frame == nullptr) return nullptr;
  const auto found = std::ranges::find_if(
      frame->pairs, [&](const trace::Pair& pair) { return key_of(pair) == subject; });
  return found == frame->pairs.end() ? nullptr : &*found;
}

/// A consequence, as a countable noun.
struct Thing {
  const char* one = nullptr;
  const char* many = nullptr;
};
/// By Stage. Ids are counted with the points; answers mostly repeat facts of the points.
constexpr std::array<Thing, kStages.size()> kThings = {{
    {"setting", "settings"},
    {"pose", "poses"},
    {"fact of the broad phase", "facts of the broad phase"},
    {"pair", "pairs"},
    {"cache entry", "cache entries"},
    {"fact of the tree", "facts of the tree"},
    {"axis query", "axis queries"},
    {"chosen axis", "chosen axes"},
    {},  // faces, below
    {"clip step", "clip steps"},
    {"fact of the reduction", "facts of the reduction"},
    {"normal or axis", "normals or axes"},
    {"point", "points"},
    {},
    {},
    {"fact of the solver", "facts of the solver"},
}};

/// Without a name if it is not counted.
Thing thing_of(const Difference& difference) {
  if (difference.stage == Stage::Faces) {
    const bool is_another = std::ranges::any_of(difference.what, [](const Changes::What& what) {
      return what.words == "face " || what.words == "shape ";
    });
    if (difference.text.starts_with("reference"))
      return is_another ? Thing{"reference face", "reference faces"}
                        : Thing{"position of the reference face", "positions of reference faces"};
    return is_another ? Thing{"incident face", "incident faces"}
                      : Thing{"position of the incident face", "positions of incident faces"};
  }
  if (difference.stage == Stage::Solver && difference.text.find("impulse ") != std::string::npos)
    return {"impulse", "impulses"};
  if (difference.stage == Stage::Points && difference.text.starts_with("persistent"))
    return {"persistent point", "persistent points"};
  return kThings[static_cast<std::size_t>(difference.stage)];
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

/// A choice of the pipeline that differs from the stored trace.
struct Flipped {
  Stage stage = Stage::Decision;
  std::string subject{};  // the pair, "crate-floor"
  /// "the separating axis test now prefers face b: -19.98 mm against -20.01 mm of face a, a tie of 0.03 mm".
  std::string sentence{};

  /// True if the sentence already covers a difference of its pair.
  bool says(const Difference& difference) const {
    if (difference.stage != stage) return false;
    return stage != Stage::Faces || difference.text.starts_with("incident");
  }
};

/// Cause of the counted effects: a difference or a flipped choice.
struct Origin {
  std::string subject;
  Stage stage;
  const Difference* record = nullptr;  // not an effect of itself
  const Flipped* flip = nullptr;       // likewise
};

/// "the reference face, 4 clip steps and 3 of 4 ids changed": effects in the pair of the cause, or
/// in the whole frame if it is not in a pair. Empty without effects.
std::string spell_effects(const FrameDifferences& frame, const Origin& origin) {
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
  const trace::Pair* const pair = find_pair(frame.actual, origin.subject);
  const bool is_pair = pair != nullptr;
  const int points = is_pair ? count_of(joined(pair->manifolds, &trace::Manifold::points)) : 0;
  for (const Difference& difference : frame.differences) {
    if (is_pair && difference.subject != origin.subject) continue;
    const bool is_named =
        &difference == origin.record || (origin.flip && origin.flip->says(difference));
    if (!is_named && difference.stage >= origin.stage) {
      if (const Thing thing = thing_of(difference); thing.one)
        add(difference.stage, thing, thing.one == std::string("impulse") ? points : 0);
    }
    const bool is_kept = difference.stage == Stage::Points || difference.stage == Stage::Ids;
    if (is_kept && has_id(difference) && origin.stage < Stage::Ids)
      add(Stage::Ids, {"id", "ids"}, points);
    if (has_impulse(difference) && difference.stage < Stage::Solver)
      add(Stage::Solver, {"impulse", "impulses"}, points);
  }
  std::ranges::stable_sort(effects, {}, &Effect::stage);
  std::vector<std::string> texts;
  for (const auto& [stage, thing, count, of] : effects) {
    const std::string more = origin.record != nullptr && stage == origin.stage ? "more " : "";
    if (of >= count && of > 1)
      texts.push_back(std::to_string(count) + " of " + std::to_string(of) + " " + thing.many);
    else
      texts.push_back(count == 1 && (stage == Stage::Faces || stage == Stage::Decision)
                          ? std::string("the ") + thing.one
                          : counted(count, more + thing.one, more + thing.many));
  }
  return texts.empty() ? "" : listed(texts) + " changed";
}

/// Two axes tie if their separations differ by less than this fraction of the larger one.
constexpr double kTie = 0.01;

const trace::Decision* find_decision(const std::vector<trace::Decision>& margins,
                                     const std::string& stage) {
  const auto found = std::ranges::find(margins, stage, &trace::Decision::stage);
  return found == margins.end() ? nullptr : &*found;
}

/// A margin as text: "3 um", "0.2 mm^2", "1e-06 of a cosine".
std::string spell_margin(const trace::Decision& decision) {
  if (decision.margin) return spell_length(std::max(*decision.margin, 0.0));
  if (decision.margin_area)
    return printed("%.*g mm^2", 2, std::max(*decision.margin_area, 0.0) * 1e6);
  return printed("%.*g of a cosine", 2, std::max(decision.margin_cosine.value_or(0), 0.0));
}

/// ", with 3 um to spare": the margin of the decision.
std::string to_spare(const trace::Decision* decision) {
  return decision == nullptr ? "" : ", with " + spell_margin(*decision) + " to spare";
}

/// "face_a" as text.
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

/// The test chose another axis: both with their separations and the difference. A preference may
/// overrule the larger separation; its margin is added if it is a different number.
std::string spell_chosen(const trace::Sat& before, const trace::Sat& now,
                         const trace::Decision* margin) {
  std::string text = "the separating axis test now prefers " + spell_axis(now.chosen);
  const auto taken = separation_along(now, now.chosen), left = separation_along(now, before.chosen);
  if (!taken || !left) return text + " to " + spell_axis(before.chosen) + to_spare(margin);
  const double between = std::abs(*taken - *left);
  const auto [a, b] = spell_both(*taken * 1e3, *left * 1e3);
  if (between > 0)
    text += ": " + a + " mm against " + b + " mm of " + spell_axis(before.chosen);
  else
    text +=
        " to " + spell_axis(before.chosen) + ": " + printed("%.*g mm", 4, *taken * 1e3) + " both";
  const bool is_tie = between <= kTie * std::max(std::abs(*taken), std::abs(*left));
  // In mm as the separations, unless that needs many digits.
  const std::string spelled =
      between >= 1e-5 && between < 1 ? printed("%.*g mm", 2, between * 1e3) : spell_length(between);
  if (is_tie)
    text += between > 0 ? ", a tie of " + spelled : ", a tie";
  else
    text += ", " + spelled + " between them";
  constexpr double kSameNumber = 0.05;
  const bool says_more =
      margin && margin->margin && std::abs(*margin->margin - between) > kSameNumber * between;
  if (!says_more) return text;
  const bool is_of_another = margin->over != before.chosen;
  return text + to_spare(margin) + (is_of_another ? " over " + spell_axis(margin->over) : "");
}

std::string face(int number) { return "face " + std::to_string(number); }

/// Points of a reduction, in canonical order.
std::vector<int> sorted(std::vector<int> points) {
  std::ranges::sort(points);
  return points;
}

std::optional<Flipped> find_flipped_points(const trace::Reduction& before,
                                           const trace::Reduction& now,
                                           const std::vector<trace::Decision>& margins) {
  // If the points differ, their indices cannot be compared.
  if (before.points.size() != now.points.size() || before.method != now.method ||
      sorted(before.kept) == sorted(now.kept))
    return {};
  const trace::Decision* margin = find_decision(margins, "points");
  for (std::size_t i = 0; i < std::min(before.kept.size(), now.kept.size()) && !margin; ++i)
    if (before.kept[i] != now.kept[i]) {
      margin = find_decision(margins, "point " + std::to_string(i));
      break;
    }
  return Flipped{Stage::Reduction, "",
                 "the reduction now keeps points " + spell_list(now.kept) + " instead of " +
                     spell_list(before.kept) + to_spare(margin)};
}

/// The first flipped choice of a pair: contact or not, axis, best face of a hull, incident face,
/// points kept by a reducer. `margins` are those of `now`; without them the sentence has no margin.
std::optional<Flipped> find_flipped(const trace::Pair& before, const trace::Pair& now,
                                    const std::vector<trace::Decision>& margins) {
  if (before.state != now.state)
    return Flipped{Stage::Axes, "",
                   "the shapes are now " + now.state + " instead of " + before.state +
                       to_spare(find_decision(margins, "contact"))};
  if (before.sat && now.sat) {
    if (before.sat->chosen != now.sat->chosen)
      return Flipped{Stage::Decision, "",
                     spell_chosen(*before.sat, *now.sat, find_decision(margins, "axis"))};
    const std::string& chosen = now.sat->chosen;
    for (const auto& [name, axis] :
         {std::pair("face_a", &trace::Sat::face_a), std::pair("face_b", &trace::Sat::face_b)}) {
      const auto& old_face = *before.sat.*axis;
      const auto& new_face = *now.sat.*axis;
      if (chosen != name || !old_face || !new_face || old_face->face == new_face->face) continue;
      return Flipped{Stage::Axes, "",
                     "the best " + spell_axis(name) + " is now " + face(new_face->face) +
                         " instead of " + face(old_face->face) +
                         to_spare(find_decision(margins, name))};
    }
  }
  if (before.clip && now.clip && before.clip->reference.shape == now.clip->reference.shape &&
      before.clip->incident.face != now.clip->incident.face)
    return Flipped{Stage::Faces, "",
                   "the incident face is now " + face(now.clip->incident.face) + " instead of " +
                       face(before.clip->incident.face) +
                       to_spare(find_decision(margins, "incident_face"))};
  if (before.reduction && now.reduction)
    return find_flipped_points(*before.reduction, *now.reduction, margins);
  return {};
}

/// The first flipped choice in a frame; of the pair of `first`, if that is a pair.
std::optional<Flipped> flip_in(const FrameDifferences& frame, const Difference& first,
                               const Margins& margins) {
  std::optional<Flipped> earliest;
  if (frame.actual == nullptr) return earliest;
  const bool is_pair = find_pair(frame.actual, first.subject) != nullptr;
  for (const trace::Pair& now : frame.actual->pairs) {
    const std::string subject = key_of(now);
    const trace::Pair* const before = find_pair(frame.expected, subject);
    if (before == nullptr || (is_pair && subject != first.subject)) continue;
    const auto own = margins.find({frame.frame, subject});
    std::optional<Flipped> flip =
        find_flipped(*before, now, own == margins.end() ? now.decisions : own->second);
    if (flip && (!earliest || flip->stage < earliest->stage)) {
      flip->subject = subject;
      earliest = std::move(flip);
    }
  }
  return earliest;
}

/// ": the separating axis test now prefers face b: ..., a tie of 0.03 mm; so 4 clip steps changed".
/// A small move is reported with the choice that it flipped, in this frame or a later one.
std::string spell_chain(const std::vector<FrameDifferences>& frames, const FrameDifferences& frame,
                        const Difference& first, const Margins& margins) {
  const FrameDifferences* at = &frame;
  std::optional<Flipped> flip = flip_in(frame, first, margins);
  if (flip && flip->stage <= first.stage) {
    const std::string effects = spell_effects(frame, {first.subject, flip->stage, &first, &*flip});
    return flip->sentence + (effects.empty() ? "" : "; so " + effects);
  }
  const bool is_of_frames = first.stage >= Stage::Words;
  for (const FrameDifferences& one : frames) {
    if (flip || is_of_frames) break;
    if (one.frame < frame.frame) continue;
    flip = flip_in(one, first, margins);
    at = &one;
  }
  if (!flip) {
    const std::string effects = spell_effects(frame, {first.subject, first.stage, &first});
    return first.text + (effects.empty() ? "" : "; so " + effects);
  }
  std::string text = first.text + "; so ";
  if (flip->subject != first.subject) text += "for " + flip->subject + " ";
  if (at != &frame) text += "in frame " + std::to_string(at->frame) + " ";
  text += flip->sentence;
  const std::string effects = spell_effects(*at, {flip->subject, flip->stage, &first, &*flip});
  return text + (effects.empty() ? "" : "; with it " + effects);
}

/// Names of stages and values, without numbers or shape names.
std::string signature_of(const Difference& first) {
  std::string text = std::to_string(static_cast<int>(first.stage));
  std::set<std::string> words;
  for (const Changes::What& what : first.what) words.insert(what.words);
  for (const std::string& word : words) text += ", " + word;
  if (first.what.empty()) text += ", " + first.text.substr(first.text.rfind(' ') + 1);
  return text;
}

bool is_input(const Difference& first, const FrameDifferences& frame) {
  if (first.stage == Stage::Setup) return true;
  if (first.stage != Stage::Motion || frame.actual == nullptr) return false;
  return frame.frame <= 0 || trace::find_body(*frame.actual, first.subject) == nullptr;
}

}  // namespace

FirstCause first_cause(const std::string& scenario, const std::vector<FrameDifferences>& frames,
                       const Margins& margins) {
  // A title or the list of stored frames is not a cause while anything else differs.
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
  cause.frame = frame->frame;
  cause.first = first;
  cause.chain = spell_chain(frames, *frame, *first, margins);
  cause.sentence += ": " + cause.chain;
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
  cause.is_input = is_input(*first, *frame);
  return cause;
}

}  // namespace contactscope::snapshot
