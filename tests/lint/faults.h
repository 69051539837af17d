#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lint/linter.h"

/// Faults of engines and of recorders, each seeded into some frames of a correct trace.
namespace contactscope::lint {

using trace::Trace;

/// Two bodies at rest on one another.
struct Target {
  std::string a, b;
  std::string body;  // the one of them that moves
};

struct Fault {
  const char* name;
  std::vector<std::string> causes;  // one of them is to be named first
  std::function<void(trace::Frame&, const Target&)> seed;
  /// Constant faults are seeded into every frame; the others consist in a change.
  std::vector<std::string> always{};  // the causes in that case; empty: every second frame
};

enum class Often { Always, Rarely, Once };

const std::vector<Fault>& faults();

/// Seeds a fault. Rarely: 1 frame in 30.
void seed(Trace& trace, const Fault& fault, const Target& target, Often often);

/// Pairs with a manifold of several points in all frames that move least.
std::vector<Target> targets(const Trace& trace, std::size_t count);

}  // namespace contactscope::lint
