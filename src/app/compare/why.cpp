#include <iostream>

#include "app/cli/narrow.h"
#include "app/compare/engine_runs.h"
#include "draw/scene/pairs.h"

namespace contactscope::app {
namespace {

using draw::spell_length;

/// The decisions that made a pair's contacts, in words: one step for each stage that ran.
class Reasons {
 public:
  explicit Reasons(const trace::Pair& pair) : pair_(pair) {}

  /// Steps in the order of the pipeline, each with its source.
  std::vector<std::string> steps() {
    if (pair_.query) answer();
    if (pair_.cache) coherence();
    if (pair_.gjk) gjk();
    if (pair_.penetration) penetration();
    if (pair_.sat) axes();
    if (pair_.degenerate) degenerate();
    if (pair_.clip) clipping();
    if (pair_.merge) merging();
    if (pair_.reduction) reduction();
    if (pair_.voided) voided();
    return std::move(steps_);
  }

  /// How one contact point came about; `index` counts those of all manifolds from 0.
  std::string point(int index) const {
    const draw::PairPoint any = at(draw::all_points(pair_), index);
    std::string text =
        features(any.point->id) + ", " + draw::spell_separation(any.point->separation, 0);
    if (pair_.clip && any.manifold == &pair_.manifolds.front()) text += origin_of(*any.point);
    if (!pair_.reduction || pair_.reduction->kept.size() == pair_.reduction->points.size())
      return text + "; it was not reduced";
    const auto& all = pair_.reduction->points;
    const auto same = std::ranges::find(all, any.point->id, &trace::Point::id);
    const auto chosen =
        std::ranges::find(pair_.reduction->kept, static_cast<int>(same - all.begin()));
    if (same == all.end() || chosen == pair_.reduction->kept.end()) return text;
    return text + "; kept " +
           choice(static_cast<std::size_t>(chosen - pair_.reduction->kept.begin()));
  }

 private:
  void add(const std::string& text, const char* source) {
    steps_.push_back(text + "\n   (" + source + ")");
  }

  const trace::Decision* decision(const std::string& stage) const {
    const auto found = std::ranges::find(pair_.decisions, stage, &trace::Decision::stage);
    return found == pair_.decisions.end() ? nullptr : &*found;
  }

  /// ", 3.00 mm before face 2"; empty where no margin is recorded.
  std::string ahead(const std::string& stage) const {
    const trace::Decision* const made = decision(stage);
    if (made == nullptr) return {};
    const std::string by = made->margin ? spell_length(*made->margin)
                           : made->margin_area
                               ? draw::spell_area(*made->margin_area)
                               : "a cosine of " + draw::spell_number(*made->margin_cosine, 3);
    return ", " + by + " before " + axis_or(made->over);
  }

  std::string axis_or(const std::string& name) const {
    if (name == "face_a") return "the faces of " + pair_.a;
    if (name == "face_b") return "the faces of " + pair_.b;
    if (name == "edge_edge") return "the edges";
    return name;
  }

  /// "edge 1 of table crosses edge 3 of crate", for an id as in traces.
  std::string features(const std::string& id) const {
    std::string text;
    for (const draw::PairFeature& feature : draw::features_in(id)) {
      const char* const kind = feature.kind == 'v'   ? "corner "
                               : feature.kind == 'e' ? "edge "
                                                     : "face ";
      text += (text.empty() ? "" : " and ") + (kind + std::to_string(feature.index)) + " of " +
              (feature.of_a ? pair_.a : pair_.b);
    }
    return text.empty() ? "a point without an id" : text;
  }

  void answer() {
    const trace::Query& query = *pair_.query;
    std::string text = "Query: " + draw::spell_question(query) + " " + draw::spell_answer(pair_);
    if (!query.walk.empty())
      text += ". V-Clip compared " + counted(count_of(query.walk), "pair") + " of features, last " +
              features(query.walk.back().features);
    add(text, "survey, Capability map");
  }

  void coherence() {
    const trace::Cache& cache = *pair_.cache;
    const std::string what =
        cache.kind == "features" ? "The last frame's features" : "The last frame's separating axis";
    add(what + (cache.hit ? " gave the result, and nothing else was tested"
                          : " did not hold, and everything was tested"),
        "Gregorius 2015, Hull vs Hull: Temporal Coherence");
  }

  void gjk() {
    const trace::Gjk& gjk = *pair_.gjk;
    add("GJK ended after " + counted(gjk.iterations, "step") + ": the cores " +
            (gjk.status == "separated" ? "are " + spell_length(gjk.distance) + " apart"
                                       : "share a point (" + gjk.status + ")"),
        "Gregorius 2015, GJK Contact Points");
  }

  void penetration() {
    const trace::Penetration& found = *pair_.penetration;
    add(draw::in_words(found.method) + " " + found.status + " after " +
            counted(found.iterations, "step") + ", overlap " + spell_length(found.depth) +
            (found.fallback.empty() ? "" : "; " + draw::in_words(found.fallback) + " replaced it"),
        "Gregorius 2015, GJK Deep Contact");
  }

  void axes() {
    const trace::Sat& sat = *pair_.sat;
    std::string text = "Separation along the best axis:";
    const auto of_faces = [&](const std::optional<trace::FaceAxis>& axis, const std::string& shape,
                              const char* stage) {
      if (!axis) return;
      text += "\n     face " + std::to_string(axis->face) + " of " + shape + ", " +
              spell_length(axis->separation) + ahead(stage);
    };
    of_faces(sat.face_a, pair_.a, "face_a");
    of_faces(sat.face_b, pair_.b, "face_b");
    if (sat.edge)
      text += "\n     edge " + std::to_string(sat.edge->a) + " of " + pair_.a + " and edge " +
              std::to_string(sat.edge->b) + " of " + pair_.b + ", " +
              spell_length(sat.edge->separation);
    text += "\n   Taken: " + axis_or(sat.chosen) + ahead("axis");
    if (sat.preference == "relative")
      text +=
          ". Faces are preferred, those of " + pair_.a + " first, where they are nearly as deep";
    add(text, "Gregorius 2015, Hull vs Hull: The Separating Axis Test, Feature Flip-Flop");
  }

  void degenerate() {
    add("The geometry has no normal (" + pair_.degenerate->geometry +
            "): " + (pair_.degenerate->answer == "skip" ? "no contact was made" : "one was chosen"),
        "Gregorius 2015, Capsule vs Capsule: Degenerate Case");
  }

  void clipping() {
    const trace::Clip& clip = *pair_.clip;
    std::string text = "Face " + std::to_string(clip.incident.face) + " of " + clip.incident.shape +
                       " is turned against face " + std::to_string(clip.reference.face) + " of " +
                       clip.reference.shape + " the most" + ahead("incident_face") + ". Its " +
                       counted(count_of(clip.incident.polygon), "corner") + " become";
    for (const trace::ClipStep& step : clip.steps)
      text += (&step == &clip.steps.front() ? " " : ", ") + std::to_string(step.polygon.size());
    text += " at " + counted(count_of(clip.steps), "side plane");
    std::map<std::string, int> dropped;
    for (const trace::DroppedPoint& point : clip.dropped) ++dropped[point.reason];
    for (const auto& [reason, count] : dropped)
      text += "; " + std::to_string(count) + " dropped, " + reason;
    add(text, "Gregorius 2015, Hull vs Hull: Face Contact Clipping");
  }

  void merging() {
    std::string text = "Contacts of triangles were merged by their normals:";
    for (const trace::MergedManifold& merged : pair_.merge->manifolds)
      text += "\n     " + counted(merged.points, "point") + " of " +
              counted(count_of(merged.triangles), "triangle") + " became one manifold";
    add(text, "Gregorius 2015, Examples: Mesh Contact");
  }

  /// " first, ...": the reason for the k-th kept point.
  std::string choice(std::size_t k) const {
    constexpr const char* kOrdinals[] = {"first", "second", "third", "fourth"};
    const trace::Reduction& reduction = *pair_.reduction;
    std::string text = k < 4 ? kOrdinals[k] : "as number " + std::to_string(k + 1);
    if (k >= reduction.choices.size()) return "together with the others" + ahead("points");
    static const std::map<std::string_view, const char*> kRules = {
        {"support", "farthest along a fixed direction"},
        {"deepest", "deepest"},
        {"equally_deep", "largest area among the deepest"},
        {"farthest", "farthest from the first"},
        {"triangle", "largest triangle with the first two"},
        {"outside", "adds the largest area"},
        {"distance", "farthest outside of an edge"}};
    const auto rule = kRules.find(reduction.choices[k].rule);
    text +=
        ", " + (rule == kRules.end() ? draw::in_words(reduction.choices[k].rule) : rule->second);
    return text + ahead("point " + std::to_string(k));
  }

  void reduction() {
    const trace::Reduction& reduction = *pair_.reduction;
    if (reduction.kept.size() == reduction.points.size()) return;
    std::string text = counted(count_of(reduction.points), "point") + " to " +
                       std::to_string(reduction.kept.size()) + " by " + reduction.method;
    if (reduction.best_area > 0)
      text += ", with " + draw::spell_share(reduction.area / reduction.best_area) +
              " of the largest area";
    text += ":";
    if (reduction.choices.empty())
      text += "\n     points " +
              listed(mapped(reduction.kept, [](int i) { return std::to_string(i); })) +
              ", chosen together" + ahead("points");
    for (std::size_t k = 0; k < reduction.choices.size() && k < reduction.kept.size(); ++k)
      text += "\n     point " + std::to_string(reduction.kept[k]) + " " + choice(k);
    add(text, "Gregorius 2015, Contact Point Reduction");
  }

  void voided() {
    add("A contact with " + pair_.voided->shape + " was left out: " + pair_.voided->reason,
        "Gregorius 2015, Collision Shapes: Triangle Mesh");
  }

  /// ", made by side plane 2": the first step of clipping after which the point is a corner.
  std::string origin_of(const trace::Point& point) const {
    const trace::Clip& clip = *pair_.clip;
    const Vec3d& normal = clip.reference.normal;
    const auto is_in = [&](const trace::Polygon& polygon) {
      return std::ranges::any_of(polygon, [&](const Vec3d& corner) {
        const Vec3d offset = corner - point.position;
        return (offset - normal.dot(offset) * normal).norm() < 1e-6 * corner.norm() + 1e-9;
      });
    };
    if (is_in(clip.incident.polygon)) return ", a corner of the incident face";
    for (std::size_t k = 0; k < clip.steps.size(); ++k)
      if (is_in(clip.steps[k].polygon)) return ", made by side plane " + std::to_string(k + 1);
    return {};
  }

  const trace::Pair& pair_;
  std::vector<std::string> steps_;
};

/// The frames of a scenario with every decision, or those of a trace.
trace::Trace frames_of(const Options& options) {
  const std::string& path = options.scenarios.front();
  if (is_trace_file(path)) return load_trace(path);
  const std::vector<Scenario> scenarios = load_scenarios(options);
  if (scenarios.size() != 1) throw UsageError("why takes one scenario or trace");
  trace::Stages stages;
  stages.decisions = true;
  return run_frames(scenarios.front(), options.selected(scenarios.front().frames), stages);
}

ExitCode run_why(const Options& options) {
  const trace::Trace run = frames_of(options);
  const auto is_chosen = chosen_pair(run.header, options);
  const trace::Frame* frame = nullptr;
  const trace::Pair* pair = nullptr;
  // The first frame in which the pair touches, else the first in which it is.
  for (const bool touches : {true, false})
    for (const trace::Frame& one : run.frames)
      for (const trace::Pair& each : one.pairs)
        if (pair == nullptr && is_chosen(each) &&
            (!options.frames || options.frames->names(one.frame)) &&
            (!touches || !each.manifolds.empty()))
          frame = &one, pair = &each;
  if (pair == nullptr) {
    std::vector<int> others;
    for (const trace::Frame& one : run.frames)
      if (std::ranges::any_of(one.pairs, is_chosen)) others.push_back(one.frame);
    throw UsageError(others.empty() ? "no frame has this pair"
                                    : "none of --frames has this pair, which is in frames " +
                                          snapshot::spell_numbers(others));
  }
  const int count = count_of(draw::all_points(*pair));
  std::cout << "Frame " << frame->frame << ", " << pair->a << " and " << pair->b << ": "
            << draw::spell_state(draw::state_of(*pair, 0)) << ", "
            << draw::spell_separation(pair->separation, 0) << ", " << counted(count, "point")
            << '\n';
  Reasons reasons(*pair);
  const std::vector<std::string> steps = reasons.steps();
  for (std::size_t i = 0; i < steps.size(); ++i) std::cout << i + 1 << ". " << steps[i] << '\n';
  if (steps.empty()) std::cout << "The trace has no stages of this pair\n";
  for (int i = 0; i < count; ++i)
    if (!options.point || *options.point == i)
      std::cout << "Point " << i << ": " << reasons.point(i) << '\n';
  if (options.point && *options.point >= count)
    throw UsageError("--point is " + std::to_string(*options.point) + "; the pair has " +
                     counted(count, "point") + ", from 0");
  return ExitCode::Same;
}

}  // namespace

Verb why_verb() {
  return {"why", "Say in words why a pair has the contacts that it has", &run_why};
}

}  // namespace contactscope::app
