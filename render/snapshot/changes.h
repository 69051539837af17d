#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/vec3.h"
#include "snapshot/spelling.h"

namespace contactscope::snapshot {

/// How far two numbers of one trace may lie apart and still count as equal.
struct Tolerance {
  double length = 0;     // metres
  double direction = 0;  // for each component of a unit vector or quaternion; relative
  double area = 0;       // square metres
};

/// Equal within the tolerance; never when either is no number.
inline bool same(double expected, double actual, double tolerance) {
  return std::abs(actual - expected) <= tolerance;
}
inline bool same(const Vec3d& expected, const Vec3d& actual, double tolerance) {
  return same(expected.x(), actual.x(), tolerance) && same(expected.y(), actual.y(), tolerance) &&
         same(expected.z(), actual.z(), tolerance);
}

/// Collects what changed of one thing and makes a part of a sentence of it:
/// "sat face_a: face 1 -> 3, separation -0.0050 -> -0.0037". Names, indices and texts compare
/// exactly, numbers within the tolerance.
class Changes {
 public:
  Changes(std::string subject, const Tolerance& tolerance)
      : subject_(std::move(subject)), tolerance_(tolerance) {}

  template <class T>
  void exact(const std::string& name, const T& expected, const T& actual) {
    if (expected != actual) add(name + spell_change(expected, actual));
  }
  void length(const std::string& name, double expected, double actual) {
    if (!same(expected, actual, tolerance_.length)) add(name + spell_change(expected, actual));
  }
  void area(const std::string& name, double expected, double actual) {
    if (!same(expected, actual, tolerance_.area)) add(name + spell_change(expected, actual));
  }
  void direction(const std::string& name, const Vec3d& expected, const Vec3d& actual) {
    if (!same(expected, actual, tolerance_.direction)) add(name + spell_turn(expected, actual));
  }
  void position(const std::string& name, const Vec3d& expected, const Vec3d& actual) {
    if (!same(expected, actual, tolerance_.length)) add(name + spell_move(expected, actual));
  }
  /// Quantities of other kinds, such as impulses: the tolerance is the relative one of directions,
  /// of `scale`, the largest such quantity about.
  void relative(const std::string& name, double expected, double actual, double scale) {
    if (!same(expected, actual, tolerance_.direction * scale))
      add(name + spell_change(expected, actual));
  }
  void relative(const std::string& name, const Vec3d& expected, const Vec3d& actual, double scale) {
    if (!same(expected, actual, tolerance_.direction * scale))
      add(name + spell_vector(expected) + " -> " + spell_vector(actual));
  }
  /// "5 -> 4 vertices", or "vertex 3 moved 1.3 mm along x, 2 more vertices moved".
  void vertices(const std::vector<Vec3d>& expected, const std::vector<Vec3d>& actual);
  void add(const std::string& change) { text_ += (text_.empty() ? "" : ", ") + change; }

  /// Appends the part when anything changed.
  void tell(std::vector<std::string>& parts) const {
    if (!text_.empty()) parts.push_back(subject_ + text_);
  }

 private:
  std::string subject_;
  Tolerance tolerance_;
  std::string text_;
};

}  // namespace contactscope::snapshot
