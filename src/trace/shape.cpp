#include "trace/shape.h"

#include <algorithm>
#include <set>

namespace contactscope::trace {

void Shape::edges_from_faces(Shape& shape) {
  std::set<std::array<int, 2>> seen;
  for (const std::vector<int>& face : shape.faces)
    for (std::size_t i = 0; i < face.size(); ++i) {
      const int from = face[i];
      const int to = face[(i + 1) % face.size()];
      if (seen.insert({std::min(from, to), std::max(from, to)}).second)
        shape.edges.push_back({from, to});
    }
}

}  // namespace contactscope::trace
