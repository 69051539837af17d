#pragma once

#include <string>
#include <vector>

#include "draw/scene/drawing.h"
#include "draw/scene/quantity.h"
#include "trace/trace.h"

/// Texts and colours for pairs that answer a query instead of computing a manifold.
namespace contactscope::draw {

enum class AnswerKind {
  No,
  Yes,
  FalsePositive,  // bounds overlap, shapes do not
  Missed,         // shapes overlap, bounds do not
};

constexpr bool is_wrong(AnswerKind kind) {
  return kind == AnswerKind::FalsePositive || kind == AnswerKind::Missed;
}

/// Answer of a pair with a query: do the shapes, or their bounds, overlap or touch?
AnswerKind answer_kind(const trace::Pair& pair);

/// One colour for each answer, used in all drawings.
Color answer_color(AnswerKind kind);

/// "do the oriented boxes overlap, touching included?"
std::string spell_question(const trace::Query& query);

/// "yes, though the shapes are 12.0 cm apart: a false positive"
std::string spell_answer(const trace::Pair& pair, const LengthUnit& unit = {});

/// "yes", "no, falsely".
std::string spell_answer_kind(AnswerKind kind);

/// Label of a pair with a query of bounds, followed by the answer: "spheres: yes, falsely".
std::string label_with_answer(const trace::Pair& pair);

/// "A's y", "A's x × B's z", "middle to middle". For axis-aligned boxes "x", an axis of the world.
std::string spell_axis(const trace::Query& query, const trace::TestedAxis& axis);

/// Corners of a box or six points of a ball, for fitting the view to it.
std::vector<Vec3d> extent_points(const trace::Volume& volume);

}  // namespace contactscope::draw
