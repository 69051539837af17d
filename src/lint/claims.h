#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lint/reading.h"
#include "lint/solid.h"
#include "trace/trace.h"

namespace contactscope::lint {

/// What is wrong with a claim of a pair.
enum class Wrong {
  Separation,  // of a point: not how far the surfaces are apart along the normal there
  Surface,     // a point is farther from a surface than its separation
  Side,        // 'on_a' or 'on_b' is not on its surface
  Normal,      // the overlap along it is not the least
  Deepest,     // no point is as deep as the overlap along the normal
};
inline constexpr int kWrongs = 5;

struct Problem {
  Wrong kind = Wrong::Separation;
  int manifold = 0, point = 0;
  double said = 0, is = 0;     // metres
  std::string shape{};         // of Surface and Side
  Vec3d best = Vec3d::Zero();  // of Normal: along which the overlap is least
};

/// A pair's claims held against its shapes.
struct Verdict {
  int claims = 0;  // that could be judged
  int wrong = 0;
  std::optional<Problem> worst{};   // the farthest off, of the kind that comes first
  double farthest = 0;              // how much it is off, metres
  std::vector<double> deeper{};     // of each point: by how much its separation says more overlap
  std::vector<double> separations;  // measured, of the points in the same order
  double tolerance = 0;             // metres
};

/// The shapes of a trace by name. A shape that bounds nothing is left out, and named in `refused`.
class Solids {
 public:
  void add(const trace::Shape& shape);
  /// Meshes that are no longer as they were; undone by the next frame.
  void deform(const std::vector<trace::Deformed>& now);
  /// nullptr: refused, or not there.
  const Solid* find(const std::string& name, Form form = Form::AsReported) const;
  /// The body that a shape is a part of, or is.
  const std::string& body_of(const std::string& name) const;

  std::map<std::string, std::string> refused;  // why, by name

 private:
  std::map<std::string, trace::Shape> shapes_;
  std::map<std::string, Solid> solids_, deformed_;
  mutable std::map<std::pair<std::string, Form>, Solid>
      reformed_;  // made where a reading asks for them
};

/// A frame and its neighbours, nullptr where there is none.
struct Moments {
  const trace::Frame* before = nullptr;
  const trace::Frame* now = nullptr;
  const trace::Frame* after = nullptr;
};

/// Where a frame has a shape, as the reading takes it; empty where there is none.
std::optional<Placed> place(const Solids& solids, const trace::Frame* frame,
                            const std::string& name, const Reading& reading);

/// Every claim of a pair's manifolds under one reading; empty where a shape or its pose is missing.
std::optional<Verdict> judge(const Solids& solids, const Moments& frames, const trace::Pair& pair,
                             const Reading& reading);

/// How far off a claim about two shapes may be, metres: a part of the smaller one, and what single precision
/// leaves uncertain of coordinates as large as theirs.
double tolerance_of(const Placed& a, const Placed& b);

}  // namespace contactscope::lint
