#pragma once

#include "query/penetration.h"
#include "query/sat.h"

namespace contactscope {

/// The features that touch where two hulls overlap along a known normal: the other half of what the
/// separating axis test finds, for methods that give a normal and nothing else.
///
/// The rule. Three candidates: the face of A most parallel to the normal; the face of B most
/// anti-parallel; the pair of edges at both support vertices whose cross product is nearest to the
/// normal. Each is measured as the queries of sat() measure it, by support vertices of the whole
/// other hull, and then sat()'s own preference chooses among them, so that the contact is made by the
/// same code and flickers no more: a face as long as it is nearly as deep as the best candidate.
///
/// So the contact's normal is that of its features, not `normal` itself: a method that stopped short
/// of the true normal is put right by the features next to it. Where all three are deeper than
/// `depth` by more than the preference allows, the features say nothing of that normal, and the
/// result's status is Separated; else it is Touching. Preference None grants a ten-thousandth of
/// the smaller radius then, which is about the error of sampling's normal.
///
/// `queries_run` is 3; the edge query has no pair where all edges are nearly parallel.
template <class S>
SatResult<S> axes_of_normal(const HullPair<S>& pair, const Vec3<S>& normal, S depth,
                            Preference preference);

}  // namespace contactscope
