#pragma once

#include <algorithm>
#include <concepts>
#include <string_view>

#include "trace/trace.h"

namespace contactscope::snapshot {

/// Where in the pipeline a fact is decided. What stands first is the cause of what follows: a face
/// that is not chosen is not clipped against, and its points are not there.
enum class Stage {
  Setup,   // shapes, settings
  Motion,  // poses, meshes that deform
  BroadPhase,
  Pairs,       // which there are
  Cache,       // what the frame before is asked first
  Candidates,  // triangles of a mesh
  Axes,        // how deep along each axis; GJK, EPA
  Decision,    // which of them
  Faces,       // reference and incident face
  Clipping,
  Reduction,
  Manifold,  // normal, features that touch
  Points,
  Ids,
  Answers,  // separation of the pair, and what else it was asked
  Solver,
  Sums,
  Words,   // title and source
  Frames,  // which are stored
};

/// Of what stands under a key of a struct T, which itself is of `within`.
template <class T>
constexpr Stage stage_of(std::string_view key, Stage within) {
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

/// Of the values of T itself that changed.
template <class T, class Changed>
constexpr Stage stage_of_own(Stage within, const Changed& what) {
  if constexpr (std::same_as<T, trace::Header>) {
    const bool are_words = std::ranges::all_of(
        what, [](const auto& one) { return one.words == "title " || one.words == "source "; });
    return are_words ? Stage::Words : Stage::Setup;
  }
  if constexpr (std::same_as<T, trace::Frame>) return Stage::Setup;  // its time
  if constexpr (std::same_as<T, trace::Sat>) return Stage::Decision;
  if constexpr (std::same_as<T, trace::Pair>) return Stage::Answers;
  if constexpr (std::same_as<T, trace::Point>) {
    if (within != Stage::Points) return within;  // of the reduction, before and after it
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
