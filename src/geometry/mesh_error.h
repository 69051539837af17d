#pragma once

#include <stdexcept>
#include <string>

namespace contactscope {

/// Why no mesh could be made. `what()` says the same in words, and what would be right.
enum class MeshProblem {
  NoTriangle,    // none was given, or none has an area
  NoSuchVertex,  // a triangle names a vertex that does not exist
  NotFinite,     // a coordinate is NaN or infinite, or the extent overflows
  BadDimension,  // a grid's size or amplitude is off, or it has no cell or too many
};

/// A mesh cannot be made from what was given. Geometry knows no file; whoever reads one catches
/// this and adds the place.
class MeshError : public std::runtime_error {
 public:
  MeshError(MeshProblem problem, const std::string& message)
      : std::runtime_error(message), problem_(problem) {}

  MeshProblem problem() const { return problem_; }

 private:
  MeshProblem problem_;
};

}  // namespace contactscope
