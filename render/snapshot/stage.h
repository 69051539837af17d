#pragma once

#include "trace/trace.h"

namespace contactscope::snapshot {

/// Stage of the pipeline that decides a fact. Earlier stages cause changes in later ones: a face
/// that is not chosen is not clipped against and has no points.
enum class Stage {
  Setup,   // shapes, settings
  Motion,  // poses, meshes that deform
  BroadPhase,
  Pairs,       // which pairs exist
  Cache,       // queried first in the next frame
  Candidates,  // triangles of a mesh
  Axes,        // depth along each axis; GJK, EPA
  Decision,    // the chosen axis
  Faces,       // reference and incident face
  Clipping,
  Reduction,
  Manifold,  // normal, features in contact
  Points,
  Ids,
  Answers,  // separation of the pair, other queries
  Solver,
  Sums,
  Words,   // title and source
  Frames,  // which frames are stored
};

/// Names of the stages.
inline constexpr std::array<std::string_view, 19> kStages = {
    "setup",    "poses",  "broad phase", "pairs",     "cache",    "candidates", "axes",
    "decision", "faces",  "clipping",    "reduction", "manifold", "points",     "ids",
    "answers",  "solver", "sums",        "words",     "frames"};
inline constexpr std::string_view name_of(Stage stage) {
  return kStages[static_cast<std::size_t>(stage)];
}

/// Stage of the value under a key of a struct T; `within` is the stage of the struct.
template <class T> constexpr Stage stage_of(std::string_view key, Stage within) {
  struct Row {
    std::string_view key;
    Stage stage;
  };
  const auto find = [&](std::initializer_list<Row> rows, Stage otherwise) {
    for (const Row& row : rows)
      if (row.key == key) return row.stage;
    return otherwise;
  };
  if constexpr (std::same_as<T, trace::Header>) return Stage::Setup;
  if constexpr (std::same_as<T, trace::Frame>)
    return find({{"poses", Stage::Motion},
                 {"deformed", Stage::Motion},
                 {"shapes", Stage::Motion},
                 {"field_slices", Stage::Motion},
                 {"broad_phase", Stage::BroadPhase},
                 {"solver", Stage::Solver},
                 {"totals", Stage::Sums}},
                Stage::Pairs);
  if constexpr (std::same_as<T, trace::Pair>)
    return find({{"cache", Stage::Cache},
                 {"tree", Stage::Candidates},
                 {"sat", Stage::Axes},
                 {"gjk", Stage::Axes},
                 {"penetration", Stage::Axes},
                 {"minkowski", Stage::Axes},
                 {"field_probes", Stage::Axes},
                 {"degenerate", Stage::Decision},
                 {"clip", Stage::Clipping},
                 {"reduction", Stage::Reduction},
                 {"manifolds", Stage::Manifold},
                 {"incremental", Stage::Points}},
                Stage::Answers);
  if constexpr (std::same_as<T, trace::Clip>)
    return find({{"reference", Stage::Faces}, {"incident", Stage::Faces}}, within);
  if constexpr (std::same_as<T, trace::Manifold>) return find({{"points", Stage::Points}}, within);
  return within;
}

/// Stage of the changed values of T itself.
template <class T, class Changed> constexpr Stage stage_of_own(Stage within, const Changed& what) {
  if constexpr (std::same_as<T, trace::Header>) {
    const bool are_words = std::ranges::all_of(
        what, [](const auto& one) { return one.words == "title " || one.words == "source "; });
    return are_words ? Stage::Words : Stage::Setup;
  }
  if constexpr (std::same_as<T, trace::Frame>) return Stage::Setup;  // its time
  if constexpr (std::same_as<T, trace::Sat>) return Stage::Decision;
  if constexpr (std::same_as<T, trace::Pair>) return Stage::Answers;
  if constexpr (std::same_as<T, trace::Point>) {
    if (within != Stage::Points) return within;  // points before and after reduction
    Stage first = Stage::Solver;
    for (const auto& one : what) {
      if (one.kind == trace::Kind::Position || one.kind == trace::Kind::Length)
        first = std::min(first, Stage::Points);
      if (one.words == "id ") first = std::min(first, Stage::Ids);
    }
    return first;
  }
  return within;
}

}  // namespace contactscope::snapshot
