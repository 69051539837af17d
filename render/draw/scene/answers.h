#pragma once

#include <string>
#include <vector>

#include "draw/scene/drawing.h"
#include "draw/scene/quantity.h"
#include "trace/trace.h"

/// What pictures say of pairs that were asked something else than their manifold.
namespace contactscope::draw {

enum class AnswerKind {
  No,
  Yes,
  FalsePositive,  // the bounds overlap, and the shapes in them do not
  Missed,         // the shapes overlap, and the test of their bounds says no
};

/// Of a pair with a query: whether it, or its bounds, overlap, or touch where that was asked.
AnswerKind answer_kind(const trace::Pair& pair);

/// The same colour for the same answer wherever it is seen.
Color answer_color(AnswerKind kind);

/// "do the oriented boxes overlap, touching included?"
std::string spell_question(const trace::Query& query);

/// "yes, though the shapes are 12.0 cm apart: a false positive"
std::string spell_answer(const trace::Pair& pair, const LengthUnit& unit = {});

/// Of a pair whose bounds were asked, its label with what they say: "spheres: yes, falsely".
std::string label_with_answer(const trace::Pair& pair);

/// "A's y", "A's x × B's z", "middle to middle"; of axis-aligned boxes "x", an axis of the world.
std::string spell_axis(const trace::Query& query, const trace::TestedAxis& axis);

/// Corners of a box, or six points of a ball: what a picture of it must hold.
std::vector<Vec3d> extent_points(const trace::Volume& volume);

}  // namespace contactscope::draw
