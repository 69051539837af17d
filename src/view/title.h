#pragma once

#include "core/standard.h"

/// Titles that state a result: text with placeholders, filled from the facts of the drawn frame.
///
///   "{kept} of {candidates:point} keep {area_kept} | Nothing touches"
///
/// Alternatives are separated by " | ". The first one whose placeholders all have a value in the
/// frame is shown, else the last one; 0 counts as no value. Placeholders are `{FACT}` and `{FACT of
/// WHO}`: the label of a pair, a shape, or two shapes as `a and b`. `{FACT:point}` adds a noun: "1
/// point", "4 points"; `{FACT:vertex/vertices}` has an irregular plural. `{from 12}` is empty, with
/// a value from frame 12 on. `{{` is a brace.
namespace contactscope {

/// Pipeline stage that records a fact; None: recorded by every run.
enum class TitleStage { None, Clip, Reduction, Search, Stability, Tree, Query };

/// Facts that a placeholder may name. A row has the enumerator, name, stage and description.
// clang-format off
#define CONTACTSCOPE_TITLE_FACTS(ROW)                                                             \
  ROW(Frame, "frame", None, "number of the frame, or step of a story")                            \
  ROW(Time, "time", None, "s")                                                                    \
  ROW(Shapes, "shapes", None, "shapes in the frame")                                              \
  ROW(Bodies, "bodies", None, "bodies that the solver moves")                                     \
  ROW(Asleep, "asleep", None, "those of them that sleep through the step")                        \
  ROW(Pairs, "pairs", None, "pairs that were run")                                                \
  ROW(Touching, "touching", None, "pairs with contact points")                                    \
  ROW(State, "state", None, "touching, within the margin, apart, ..., of the first pair")         \
  ROW(Overlap, "overlap", None, "the largest overlap, of pairs that overlap")                     \
  ROW(Gap, "gap", None, "the smallest gap, where nothing overlaps or touches")                    \
  ROW(Kept, "kept", None, "contact points")                                                       \
  ROW(Candidates, "candidates", Reduction, "points before the reduction")                         \
  ROW(Dropped, "dropped", Reduction, "points that the reduction left out")                        \
  ROW(Clipped, "clipped", Clip, "points that the clipping dropped")                               \
  ROW(Manifolds, "manifolds", None, "manifolds; of a mesh one for each triangle that is touched") \
  ROW(Ids, "ids", None, "different contact ids")                                                  \
  ROW(Area, "area", Reduction, "of the kept points in the contact plane")                         \
  ROW(BestArea, "best_area", Reduction, "the largest that as many points can span")               \
  ROW(AreaKept, "area_kept", Reduction, "per cent of the best area")                              \
  ROW(Axis, "axis", None, "what made the normal, of the first pair that touches")                 \
  ROW(Type, "type", None, "the features that touch, of the first pair that touches")              \
  ROW(Iterations, "iterations", Search, "of EPA, MPR or sampling, else of GJK")                   \
  ROW(Stability, "stability", Stability, "stable, marginal or unstable, of the first pair")       \
  ROW(Margin, "margin", Stability, "of the centre of mass from the border of its support")        \
  ROW(New, "new", None, "points that an incremental manifold got")                                \
  ROW(Persisted, "persisted", None, "points that it kept")                                        \
  ROW(Broken, "broken", None, "points that it dismissed")                                         \
  ROW(Impulse, "impulse", None, "sum of the normal impulses, N s")                                \
  ROW(Load, "load", None, "the same over the step, N")                                            \
  ROW(Speed, "speed", None, "of the fastest body")                                                \
  ROW(KineticEnergy, "kinetic_energy", None, "of all bodies")                                     \
  ROW(Impact, "impact", None, "when the first pair that hits does, per cent of the step")         \
  ROW(Ghosts, "ghosts", None, "speculative points that hold back what would not meet")            \
  ROW(Stops, "stops", None, "stops between this frame and the next")                              \
  ROW(Triangles, "triangles", Tree, "of a mesh, that a query found")                              \
  ROW(Intersections, "intersections", Query, "pairs of triangles that share a point")             \
  ROW(NodePairs, "node_pairs", Query, "of the trees of two meshes, compared")                     \
  ROW(Comparisons, "comparisons", None, "of two boxes, by the broad phase")                       \
  ROW(Hits, "hits", None, "frames of the sequence in which the cache answered")                   \
  ROW(HitRate, "hit_rate", None, "per cent of all frames of the sequence")                        \
  ROW(Frames, "frames", None, "frames of the sequence")                                           \
  ROW(FalsePositives, "false_positives", Query, "frames in which bounds overlap, not shapes")     \
  ROW(DeepestOverlap, "deepest_overlap", None, "the largest overlap of the sequence")
// clang-format on

#define CONTACTSCOPE_TITLE_ENUMERATOR(word, name, stage, what) word,
#define CONTACTSCOPE_TITLE_NAME(word, name, stage, what) std::string_view(name),
#define CONTACTSCOPE_TITLE_STAGE(word, name, stage, what) TitleStage::stage,
enum class TitleFact { CONTACTSCOPE_TITLE_FACTS(CONTACTSCOPE_TITLE_ENUMERATOR) };
inline constexpr std::array kTitleFactNames = {CONTACTSCOPE_TITLE_FACTS(CONTACTSCOPE_TITLE_NAME)};
inline constexpr std::array kTitleFactStages = {CONTACTSCOPE_TITLE_FACTS(CONTACTSCOPE_TITLE_STAGE)};
#undef CONTACTSCOPE_TITLE_ENUMERATOR
#undef CONTACTSCOPE_TITLE_NAME
#undef CONTACTSCOPE_TITLE_STAGE

/// Text, followed by an optional placeholder.
struct TitlePiece {
  std::string text;
  std::optional<TitleFact> fact{};
  std::string of{};           // label of a pair, or a shape; empty: all
  std::string of_other{};     // second of two shapes
  std::string one{}, many{};  // nouns after a number
  int from = 0;               // the alternative is not shown before this frame
};

using TitleAlternative = std::vector<TitlePiece>;
using Title = std::vector<TitleAlternative>;  // without placeholders: one of one piece

struct ParsedTitle {
  Title title;
  std::string problem;  // what is wrong, and what would be right; empty: no problem
};

ParsedTitle parse_title(std::string_view text);

/// Title without a frame: the first alternative without placeholders, else the first with "…".
std::string plain_title(std::string_view text);

}  // namespace contactscope
