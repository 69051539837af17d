#pragma once

#include <stdexcept>
#include <string>

namespace contactscope {

/// Why no hull could be made. `what()` says the same in words, and what would be right.
enum class HullProblem {
  TooFewPoints,    // fewer than four were given
  NotFinite,       // a coordinate is NaN or infinite, or the extent overflows
  Duplicate,       // two points are equal and welding was not asked for
  TooFewDistinct,  // fewer than four are left after welding
  Coincident,      // all points lie within rounding of one point
  Collinear,       // ... of one line
  Coplanar,        // ... of one plane
  FaceTooLarge,    // a face has more than kMaxFaceVertices vertices
  Unresolved,      // no tolerance gave a hull that is convex within it
  NotClosed,       // polygons that do not bound a solid
  BadDimension,    // a primitive's size is not positive and finite, or its segment count is off
};

/// A hull cannot be made from what was given. Geometry knows no file; whoever reads one catches
/// this and adds the place.
class HullError : public std::runtime_error {
 public:
  HullError(HullProblem problem, const std::string& message)
      : std::runtime_error(message), problem_(problem) {}

  HullProblem problem() const { return problem_; }

 private:
  HullProblem problem_;
};

}  // namespace contactscope
