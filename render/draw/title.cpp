#include "draw/scene/pairs.h"
#include "draw/staging.h"

namespace contactscope::draw {
namespace {

using Words = std::optional<std::string>;
using Pairs = std::vector<const trace::Pair*>;

/// Pairs that a placeholder refers to.
Pairs pairs_of(const TitlePiece& piece, const trace::Frame& frame) {
  Pairs pairs;
  for (const trace::Pair& pair : frame.pairs) {
    const auto has = [&](const std::string& name) { return pair.a == name || pair.b == name; };
    const bool meant = piece.of.empty()         ? true
                       : piece.of_other.empty() ? pair.label == piece.of || has(piece.of)
                                                : has(piece.of) && has(piece.of_other);
    if (meant) pairs.push_back(&pair);
  }
  return pairs;
}

Words spelled_count(std::int64_t count, const TitlePiece& piece) {
  std::string text = spell_count(count);
  if (!piece.many.empty()) text += " " + (count == 1 ? piece.one : piece.many);
  return text;
}

const trace::Pair* first_of(const Pairs& pairs, const auto& holds) {
  const auto found = std::ranges::find_if(pairs, [&](const auto* pair) { return holds(*pair); });
  return found == pairs.end() ? nullptr : *found;
}

/// Number of points before the reduction of a pair.
std::size_t candidates_of(const trace::Pair& pair) {
  if (pair.merge) {
    int merged = 0;
    for (const trace::MergedManifold& one : pair.merge->manifolds) merged += one.points;
    return static_cast<std::size_t>(merged);
  }
  const std::size_t kept = all_points(pair).size();
  return pair.reduction && pair.manifolds.size() < 2 ? std::max(kept, pair.reduction->points.size())
                                                     : kept;
}

std::size_t persistent(const trace::Pair& pair, const char* state) {
  if (!pair.incremental) return 0;
  return static_cast<std::size_t>(
      std::ranges::count(pair.incremental->points, state, &trace::PersistentPoint::state));
}

/// Counts of a pair, which titles sum up.
struct PairCount {
  TitleFact fact;
  std::size_t (*of)(const trace::Pair&);
};
constexpr PairCount kPairCounts[] = {
    {TitleFact::Touching, [](const auto& pair) { return std::size_t{!pair.manifolds.empty()}; }},
    {TitleFact::Kept, [](const auto& pair) { return all_points(pair).size(); }},
    {TitleFact::Candidates, &candidates_of},
    {TitleFact::Dropped,
     [](const auto& pair) { return candidates_of(pair) - all_points(pair).size(); }},
    {TitleFact::Clipped,
     [](const auto& pair) { return pair.clip ? pair.clip->dropped.size() : 0; }},
    {TitleFact::Manifolds, [](const auto& pair) { return pair.manifolds.size(); }},
    {TitleFact::Ids,
     [](const auto& pair) {
       std::set<std::string> ids;
       for (const PairPoint& any : all_points(pair)) ids.insert(any.point->id);
       return ids.size();
     }},
    {TitleFact::New, [](const auto& pair) { return persistent(pair, "new"); }},
    {TitleFact::Persisted, [](const auto& pair) { return persistent(pair, "persisted"); }},
    {TitleFact::Broken, [](const auto& pair) { return persistent(pair, "broken"); }},
    {TitleFact::Ghosts,
     [](const auto& pair) { return pair.impact ? pair.impact->ghosts.size() : 0; }},
    {TitleFact::Triangles,
     [](const auto& pair) { return pair.tree ? pair.tree->candidates.size() : 0; }},
    {TitleFact::Intersections, [](const auto& pair) { return pair.intersections.size(); }},
    {TitleFact::NodePairs, [](const auto& pair) {
       return pair.query && pair.query->trees
                  ? static_cast<std::size_t>(pair.query->trees->node_pairs)
                  : 0;
     }}};

double impulse_of(const Pairs& pairs) {
  double total = 0;
  for (const trace::Pair* pair : pairs) total += trace::impulse_of(*pair);
  return total;
}

// Values for one frame.
struct Filler {
  const Staging& staging;
  const trace::Frame& frame;

  Words operator()(const TitlePiece& piece) const {
    const Pairs pairs = pairs_of(piece, frame);
    const auto count = std::ranges::find(kPairCounts, *piece.fact, &PairCount::fact);
    if (count != std::end(kPairCounts)) {
      std::size_t total = 0;
      for (const trace::Pair* pair : pairs) total += count->of(*pair);
      return spelled_count(static_cast<std::int64_t>(total), piece);
    }
    switch (*piece.fact) {
      case TitleFact::Frame:
        return spelled_count(frame.frame, piece);
      case TitleFact::Time:
        return printed("%.3f s", frame.time);
      case TitleFact::Shapes:
        return spelled_count(count_of(frame.poses), piece);
      case TitleFact::Bodies:
        if (!frame.solver) return {};
        return spelled_count(count_of(frame.solver->bodies), piece);
      case TitleFact::Asleep:
        if (!frame.solver) return {};
        return spelled_count(static_cast<int>(std::ranges::count(
                                 frame.solver->bodies, std::optional(true), &trace::Body::asleep)),
                             piece);
      case TitleFact::Pairs:
        return spelled_count(count_of(pairs), piece);
      case TitleFact::State:
        if (pairs.empty() || pairs.front()->query) return {};
        return spell_state(state_of(*pairs.front(), staging.scales.touching));
      case TitleFact::Overlap:
      case TitleFact::Gap:
        return gap(pairs, *piece.fact == TitleFact::Gap);
      case TitleFact::Area:
      case TitleFact::BestArea:
      case TitleFact::AreaKept:
        return area(pairs, *piece.fact);
      case TitleFact::Axis:
      case TitleFact::Type:
        return features(pairs, *piece.fact == TitleFact::Axis);
      case TitleFact::Iterations: {
        const trace::Pair* pair = first_of(pairs, [](const trace::Pair& each) {
          return each.gjk.has_value() || each.penetration.has_value();
        });
        if (pair == nullptr) return {};
        return spelled_count(
            pair->penetration ? pair->penetration->iterations : pair->gjk->iterations, piece);
      }
      case TitleFact::Stability:
      case TitleFact::Margin: {
        const trace::Pair* pair =
            first_of(pairs, [](const trace::Pair& each) { return each.stability.has_value(); });
        if (pair == nullptr) return {};
        if (*piece.fact == TitleFact::Stability) return spell_balance(balance_of(*pair->stability));
        return spell_margin(std::abs(pair->stability->margin));
      }
      case TitleFact::Impulse:
        return spell_quantity(impulse_of(pairs), "N s", 3, staging.scales.load);
      case TitleFact::Load:
        if (!(staging.scales.step > 0)) return {};
        return spell_quantity(impulse_of(pairs) / staging.scales.step, "N", 3, staging.scales.load);
      case TitleFact::Speed:
      case TitleFact::KineticEnergy:
        return motion(piece);
      case TitleFact::Impact: {
        const trace::Pair* pair = first_of(pairs, [](const trace::Pair& each) {
          return each.impact && each.impact->status == "hit";
        });
        if (pair == nullptr) return {};
        return spell_share(pair->impact->time);
      }
      case TitleFact::Stops:
        if (!frame.solver) return {};
        return spelled_count(count_of(frame.solver->stops), piece);
      case TitleFact::Comparisons:
        if (!frame.broad_phase) return {};
        return spelled_count(frame.broad_phase->comparisons, piece);
      default:
        return {};  // over the sequence
    }
  }

  // The largest overlap, or the smallest gap if nothing overlaps or touches.
  Words gap(const Pairs& pairs, bool gaps) const {
    const trace::Pair* nearest = nullptr;
    double least = 0;
    for (const trace::Pair* pair : pairs) {
      const std::optional<double> separation = separation_of(*pair);
      if (!separation || (nearest != nullptr && *separation >= least)) continue;
      nearest = pair;
      least = *separation;
    }
    if (nearest == nullptr || (gaps ? !(least > 0) : !(least < 0))) return {};
    return spell_length(std::abs(least), noise_of(*staging.header, staging.meshes, frame, *nearest),
                        staging.scales.length);
  }

  static Words area(const Pairs& pairs, TitleFact fact) {
    const trace::Pair* pair =
        first_of(pairs, [](const trace::Pair& one) { return one.reduction.has_value(); });
    if (pair == nullptr) return {};
    const trace::Reduction& reduction = *pair->reduction;
    if (fact == TitleFact::Area) return spell_area(reduction.area);
    if (!(reduction.best_area > 0)) return {};
    if (fact == TitleFact::BestArea) return spell_area(reduction.best_area);
    return spell_share(reduction.area / reduction.best_area);
  }

  static Words features(const Pairs& pairs, bool axis) {
    const trace::Pair* pair =
        first_of(pairs, [](const trace::Pair& each) { return !each.manifolds.empty(); });
    if (pair == nullptr) return {};
    const trace::Manifold& manifold = pair->manifolds.front();
    const std::string& word = axis ? manifold.axis : manifold.type;
    if (word.empty()) return {};
    return axis ? spell_axis(word) : spell_features(word);
  }

  Words motion(const TitlePiece& piece) const {
    if (!frame.solver) return {};
    double fastest = 0, energy = 0;
    for (const trace::Body& body : frame.solver->bodies) {
      if (!piece.of.empty() && body.name != piece.of) continue;
      fastest = std::max(fastest, body.velocity.norm());
      energy += body.kinetic_energy;
    }
    return piece.fact == TitleFact::Speed ? spell_quantity(fastest, "m/s")
                                          : spell_quantity(energy, "J");
  }
};

/// "0 points" makes a title fall back to the next alternative; frame 0 does not.
bool is_nothing(const TitlePiece& piece, const std::string& value) {
  return piece.fact != TitleFact::Frame && (value == "0" || value.starts_with("0 "));
}

bool is_of_sequence(TitleFact fact) { return fact >= TitleFact::Hits; }

std::string over_sequence(const TitlePiece& piece, const std::vector<trace::Frame>& frames,
                          const LengthUnit& unit) {
  std::int64_t hits = 0, wrong = 0;
  double deepest = 0;
  for (const trace::Frame& frame : frames) {
    const Pairs pairs = pairs_of(piece, frame);
    hits +=
        first_of(pairs, [](const auto& pair) { return pair.cache && pair.cache->hit; }) != nullptr;
    wrong += first_of(pairs, [](const auto& pair) {
               return pair.query && answer_kind(pair) == AnswerKind::FalsePositive;
             }) != nullptr;
    for (const trace::Pair* pair : pairs)
      deepest = std::max(deepest, -separation_of(*pair).value_or(0));
  }
  if (piece.fact == TitleFact::Hits) return *spelled_count(hits, piece);
  if (piece.fact == TitleFact::HitRate)
    return spell_share(static_cast<double>(hits) / static_cast<double>(frames.size()));
  if (piece.fact == TitleFact::FalsePositives) return *spelled_count(wrong, piece);
  if (piece.fact == TitleFact::DeepestOverlap)
    return deepest > 0 ? spell_length(deepest, 0, unit) : "";
  return *spelled_count(count_of(frames), piece);
}

}  // namespace

StagedTitle stage_title(const std::string& text, const std::vector<trace::Frame>& frames,
                        const LengthUnit& unit) {
  StagedTitle staged;
  ParsedTitle parsed = parse_title(text);
  // Traces of other programs may contain braces that are not placeholders.
  if (!parsed.problem.empty()) parsed.title = {{TitlePiece{.text = text}}};
  staged.title = std::move(parsed.title);
  for (const TitleAlternative& pieces : staged.title) {
    for (const TitlePiece& piece : pieces) {
      if (piece.fact && is_of_sequence(*piece.fact))
        staged.of_sequence.push_back(over_sequence(piece, frames, unit));
    }
  }
  return staged;
}

std::string fill_title(const Staging& staging, const trace::Frame& frame) {
  const StagedTitle& staged = staging.title;
  const Filler fill{staging, frame};
  std::size_t next = 0;  // index of the next placeholder over the sequence
  std::string words;
  for (const TitleAlternative& pieces : staged.title) {
    const bool is_last = &pieces == &staged.title.back();
    bool whole = true;
    words.clear();
    for (const TitlePiece& piece : pieces) {
      words += piece.text;
      if (piece.from > frame.frame) whole = false;
      if (!piece.fact) continue;
      Words value;
      if (is_of_sequence(*piece.fact)) {
        const std::string& record = staged.of_sequence[next++];
        if (!record.empty()) value = record;
      } else if (whole || is_last) {
        value = fill(piece);
      }
      whole = whole && value && (is_last || !is_nothing(piece, *value));
      words += value.value_or("…");
    }
    if (whole) return words;
  }
  return words;
}

void add_stages(const Title& title, trace::Stages& stages) {
  using Needs = std::array<bool trace::Stages::*, 2>;
  constexpr std::array<Needs, 7> kNeeds = {{{},
                                            {&trace::Stages::clip},
                                            {&trace::Stages::reduction},
                                            {&trace::Stages::gjk, &trace::Stages::penetration},
                                            {&trace::Stages::stability},
                                            {&trace::Stages::tree},
                                            {&trace::Stages::query}}};  // of each TitleStage
  for (const TitleAlternative& pieces : title)
    for (const TitlePiece& piece : pieces) {
      if (!piece.fact) continue;
      const TitleStage stage = kTitleFactStages[static_cast<std::size_t>(*piece.fact)];
      for (const auto need : kNeeds[static_cast<std::size_t>(stage)])
        if (need != nullptr) stages.*need = true;
    }
}

}  // namespace contactscope::draw
