#include "draw/scene/points.h"
#include "draw/scene/scene.h"

namespace contactscope::draw {
namespace {

/// Angle of a strip's polygons around an edge: so small that their common edges are drawn faintly.
constexpr double kTurn = std::numbers::pi / 8;

/// Cosine between the middle of a cap and its corners above which the cap is drawn flat.
constexpr double kNarrow = 0.95;

class Rounding {
 public:
  explicit Rounding(const trace::Shape& shape) : shape_(shape), result_(shape) {
    result_.margin = 0;
    result_.vertices.clear();
    result_.edges.clear();
    result_.faces.clear();
  }

  trace::Shape made() {
    for (const std::vector<int>& face : shape_.faces) {
      std::vector<Vec3d> corners;
      for (const int v : face) corners.push_back(at(shape_.vertices, v));
      normals_.push_back(newell_normal(corners).normalized());
    }
    for (int f = 0; f < count_of(shape_.faces); ++f) {
      const std::vector<int>& face = at(shape_.faces, f);
      std::vector<int> moved;
      for (std::size_t i = 0; i < face.size(); ++i) {
        moved.push_back(corner(f, face[i]));
        face_of_edge_[{face[i], face[(i + 1) % face.size()]}] = f;
      }
      result_.faces.push_back(moved);
    }
    for (const auto& [edge, face] : face_of_edge_) {
      const auto twin = face_of_edge_.find({edge.second, edge.first});
      if (twin != face_of_edge_.end() && face < twin->second)
        add_strip(edge.first, edge.second, face, twin->second);
    }
    for (const auto& [vertex, border] : borders_) add_cap(vertex, border);
    trace::Shape::edges_from_faces(result_);
    return std::move(result_);
  }

 private:
  int add(int vertex, const Vec3d& normal) {
    result_.vertices.push_back(at(shape_.vertices, vertex) + shape_.margin * normal);
    return count_of(result_.vertices) - 1;
  }
  /// Corner of a face after it is moved outwards.
  int corner(int face, int vertex) {
    const auto [entry, is_new] = corners_.try_emplace({face, vertex}, 0);
    if (is_new) entry->second = add(vertex, at(normals_, face));
    return entry->second;
  }

  /// Adds the strip around the edge from v to w in its `left` face (seen counter-clockwise).
  void add_strip(int v, int w, int left, int right) {
    const Vec3d& normal = at(normals_, left);
    const Vec3d along = at(shape_.vertices, w) - at(shape_.vertices, v);
    const Vec3d out = along.cross(normal).normalized();
    const Vec3d& other = at(normals_, right);
    const double angle = std::atan2(std::abs(other.dot(out)), other.dot(normal));
    const int steps = std::max(1, static_cast<int>(std::ceil(angle / kTurn)));
    int at_v = corner(left, v), at_w = corner(left, w);
    for (int i = 1; i <= steps; ++i) {
      const double turn = angle * i / steps;
      const Vec3d between = std::cos(turn) * normal + std::sin(turn) * out;
      const int next_v = i == steps ? corner(right, v) : add(v, between);
      const int next_w = i == steps ? corner(right, w) : add(w, between);
      result_.faces.push_back({at_w, at_v, next_v, next_w});
      borders_[v][next_v] = at_v;
      borders_[w][at_w] = next_w;
      at_v = next_v;
      at_w = next_w;
    }
  }

  /// Closes the hole between the strips around a vertex: triangles about a middle on the round
  /// surface. A nearly flat cap is one polygon: the normals of its thin triangles would be noise.
  void add_cap(int vertex, const std::map<int, int>& border) {
    std::vector<int> polygon = {border.begin()->first};
    // Faces of a trace need not fit together. Such a cap is left out.
    for (auto next = border.find(border.begin()->second);
         next != border.begin() && polygon.size() < border.size();
         next = border.find(next->second)) {
      if (next == border.end()) return;
      polygon.push_back(next->first);
    }
    if (polygon.size() < 3) return;
    const Vec3d& center = at(shape_.vertices, vertex);
    Vec3d sum = Vec3d::Zero();
    for (const int corner : polygon) sum += at(result_.vertices, corner) - center;
    const Vec3d out = sum.normalized();
    const bool is_narrow = std::ranges::any_of(polygon, [&](int corner) {
      return out.dot(at(result_.vertices, corner) - center) > kNarrow * shape_.margin;
    });
    if (is_narrow) {
      result_.faces.push_back(polygon);
      return;
    }
    const int middle = add(vertex, out);
    for (std::size_t i = 0; i < polygon.size(); ++i)
      result_.faces.push_back({middle, polygon[i], polygon[(i + 1) % polygon.size()]});
  }

  const trace::Shape& shape_;
  trace::Shape result_;
  std::vector<Vec3d> normals_;
  std::map<std::pair<int, int>, int> face_of_edge_;  // key: ends of the edge, in the face's order
  std::map<std::pair<int, int>, int> corners_;       // key: face and vertex
  std::map<int, std::map<int, int>> borders_;  // caps: corner to next corner, counter-clockwise
};

}  // namespace

trace::Shape rounded(const trace::Shape& shape) { return Rounding(shape).made(); }

}  // namespace contactscope::draw
