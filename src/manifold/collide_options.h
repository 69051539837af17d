#pragma once

#include "core/manifold.h"
#include "reduce/reducer.h"

namespace contactscope {

/// What to do where geometry gives no normal: coincident centres, crossing axes.
enum class Degenerate {
  Fallback,  // a normal that is as good as any other and changes continuously where it can
  Skip,      // no contact
};

/// "fallback", "skip", as scenarios spell it.
constexpr const char* to_string(Degenerate degenerate) {
  return degenerate == Degenerate::Fallback ? "fallback" : "skip";
}

template <class S>
struct CollideOptions {
  S margin = 0;  // metres; points up to this separation are kept
  Preference preference = Preference::Relative;
  Degenerate degenerate = Degenerate::Fallback;
  bool internal_edges = true;  // of meshes: contacts on edges that the surface lacks are mended
  /// Of two hulls that overlap. Meshes and round shapes have ways of their own.
  PenetrationMethod penetration = PenetrationMethod::Sat;
  /// Two shapes between which the table has no order are worked on as if given the other way round.
  bool b_first = false;
  Reducer<S> reducer = nullptr;  // nullptr keeps all points
  ReduceOptions reduction;       // `previous` in the order of the arguments, as results are
};

}  // namespace contactscope
