#pragma once

namespace contactscope {

/// How deep two overlapping hulls are in each other, and along which normal, is found by
/// (Gregorius 2015, "Building Incremental Manifolds (1)"; Catto 2007, "Deep Contact").
enum class PenetrationMethod {
  Sat,       // all axes that can matter: exact
  Epa,       // expanding polytope (van den Bergen 2001)
  Mpr,       // Minkowski portal refinement (Snethen 2008)
  Sampling,  // brute force over directions
};

/// "sat", "epa", "mpr", "sampling", as scenarios and traces spell it.
constexpr const char* to_string(PenetrationMethod method) {
  constexpr const char* kNames[] = {"sat", "epa", "mpr", "sampling"};
  return kNames[static_cast<int>(method)];
}

}  // namespace contactscope
