#include "geometry/quickhull.h"

// Quickhull after Gregorius, "Implementing Quickhull", GDC 2014 (Barber, Dobkin and Huhdanpaa 1996
// with half-edges and the face merging of Lloyd). Steps:
//   1. build the initial tetrahedron; each other point joins the conflict list of the face that it
//      is farthest above, or is inside and dropped;
//   2. take the point with the largest distance above its face (large steps first: few slivers);
//   3. find the faces visible from it, and the horizon around them;
//   4. replace them with a cone of triangles from the horizon to the point;
//   5. merge coplanar and concave faces, see merge_faces.cpp;
//   6. redistribute the points of all removed or changed faces to new or changed faces;
//   7. at the end, split notched faces, see merge_faces.cpp.
// Deviations: a heap selects the faces; points of changed faces are redistributed too, because
// their plane moved; step 7; the tolerance is limited by the thickness; and the result is verified.

#include <queue>
#include <unordered_set>

namespace contactscope::quickhull {
namespace {

/// Index and value of the point with the largest value; the first on a tie.
template <class Value>
std::pair<int, double> farthest(std::span<const Vec3d> points, const Value& value) {
  std::pair<int, double> best{0, value(points[0])};
  for (int i = 1; i < count_of(points); ++i) {
    const double candidate = value(at(points, i));
    if (candidate > best.second) best = {i, candidate};
  }
  return best;
}

/// The faces visible from a point, and their boundary.
struct Horizon {
  std::vector<int> visible;  // faces
  std::vector<int> edges;    // boundary edges of visible faces, counter-clockwise
};

/// The connected faces around `face` that `eye`, above `face`, is above by more than `tolerance`,
/// and the loop of edges around them; `edges` is empty if the visible faces have no boundary, a
/// hole or a pinched vertex: no cone of triangles could then close the hull.
Horizon find_horizon(const Mesh& mesh, int face, int eye, double tolerance) {
  Horizon horizon;
  horizon.visible.push_back(face);
  std::unordered_set<int> seen = {face};
  for (std::size_t i = 0; i < horizon.visible.size(); ++i) {
    for (const int e : mesh.around(horizon.visible[i])) {
      const int across = mesh.neighbour(e);
      if (seen.contains(across) || !(mesh.distance(across, eye) > tolerance)) continue;
      seen.insert(across);
      horizon.visible.push_back(across);
    }
  }

  std::vector<int> boundary;  // unordered
  for (const int visible : horizon.visible)
    for (const int e : mesh.around(visible))
      if (!seen.contains(mesh.neighbour(e))) boundary.push_back(e);
  if (boundary.empty()) return horizon;

  // Walk around: at each target, turn through the visible faces to the next boundary edge.
  std::unordered_set<int> vertices;
  int e = boundary.back();
  do {
    horizon.edges.push_back(e);
    vertices.insert(mesh.edge(e).origin);
    e = mesh.edge(e).next;
    while (seen.contains(mesh.neighbour(e))) e = mesh.edge(mesh.edge(e).twin).next;
  } while (e != boundary.back());
  const bool one_loop = horizon.edges.size() == boundary.size();
  const bool simple = vertices.size() == boundary.size();
  if (!one_loop || !simple) horizon.edges.clear();
  return horizon;
}

class Builder {
 public:
  Builder(std::span<const Vec3d> points, double tolerance) : mesh_(points), tolerance_(tolerance) {}

  void start(const std::array<int, 4>& simplex) {
    const auto [a, b, c, d] = simplex;
    const int base = mesh_.add_triangle(a, b, c);
    const int before = mesh_.edge(base).previous;
    std::vector<int> faces = add_cone({base, before, mesh_.edge(before).previous}, d);
    faces.push_back(mesh_.edge(base).face);
    std::vector<int> others(mesh_.points().size());
    std::iota(others.begin(), others.end(), 0);
    for (const int corner : simplex) std::erase(others, corner);
    deal_out(others, faces);
  }

  /// Merges faces coplanar within `merging`, unless that leaves an edge steeper than `steepest`.
  void grow(double merging, double steepest) {
    while (!queue_.empty() && !mesh_.broken()) {
      const auto [distance, minus_face, eye] = queue_.top();
      queue_.pop();
      const int face = -minus_face;
      if (!mesh_.face(face).gone && mesh_.face(face).farthest == eye) add_point(eye, face);
    }
    if (!mesh_.broken()) merge_all(mesh_, tolerance_);
    if (!mesh_.broken() && merging > tolerance_) merge_all(mesh_, merging, steepest);
    if (!mesh_.broken()) split_notched_faces(mesh_, merging);
  }

  const Mesh& mesh() const { return mesh_; }

 private:
  void add_point(int eye, int face) {
    const Horizon horizon = find_horizon(mesh_, face, eye, tolerance_);
    if (horizon.edges.empty()) {
      mesh_.give_up();
      return;
    }
    const auto twin = [&](int e) { return mesh_.edge(e).twin; };
    const std::vector<int> fresh = add_cone(mapped(horizon.edges, twin), eye);
    for (const int seen : horizon.visible) mesh_.face(seen).gone = true;
    std::vector<int> touched = horizon.visible;
    touched.insert(touched.end(), fresh.begin(), fresh.end());
    merge_cone(mesh_, fresh, tolerance_, touched);
    std::vector<int> orphans;
    std::vector<int> homes;
    for (const int i : touched) {
      Face& changed = mesh_.face(i);
      orphans.insert(orphans.end(), changed.conflicts.begin(), changed.conflicts.end());
      changed.conflicts.clear();
      changed.farthest = -1;
      if (!changed.gone) homes.push_back(i);
    }
    std::erase(orphans, eye);
    deal_out(orphans, homes);
  }

  /// Adds triangles between `apex` and the rim of a hole. `rim` has the edges of the faces around
  /// the hole, in the order of the triangles: each edge starts where the next one ends.
  std::vector<int> add_cone(const std::vector<int>& rim, int apex) {
    const std::vector<int> insides = mapped(rim, [&](int outside) {
      const int from = mesh_.edge(mesh_.edge(outside).next).origin;
      const int inside = mesh_.add_triangle(from, mesh_.edge(outside).origin, apex);
      mesh_.sew(inside, outside);
      return inside;
    });
    int last = insides.back();
    for (const int inside : insides) {
      mesh_.sew(mesh_.edge(inside).previous, mesh_.edge(last).next);
      last = inside;
    }
    return mapped(insides, [&](int inside) { return mesh_.edge(inside).face; });
  }

  /// Assigns each point to the face that it is farthest above; points above none are inside.
  void deal_out(const std::vector<int>& points, const std::vector<int>& faces) {
    for (const int point : points) {
      int best = -1;
      double best_distance = tolerance_;
      for (const int face : faces) {
        const double distance = mesh_.distance(face, point);
        if (distance > best_distance) {
          best = face;
          best_distance = distance;
        }
      }
      if (best < 0) continue;
      Face& home = mesh_.face(best);
      home.conflicts.push_back(point);
      if (home.farthest < 0 || best_distance > home.farthest_distance) {
        home.farthest = point;
        home.farthest_distance = best_distance;
      }
    }
    for (const int face : faces) {
      const Face& home = mesh_.face(face);
      if (home.farthest >= 0) queue_.push({home.farthest_distance, -face, home.farthest});
    }
  }

  using Entry = std::tuple<double, int, int>;  // distance, negated face index (older first), point

  Mesh mesh_;
  double tolerance_;
  std::priority_queue<Entry> queue_;
};

/// Largest product of points and faces for which every point is checked against every plane: about
/// 10 ms. Larger hulls are only checked at each edge. For a closed surface this is equivalent,
/// except that it cannot find points that were left out by mistake.
constexpr double kFullCheckLimit = 1e7;

bool is_convex(const Mesh& mesh, double slack) {
  const std::vector<int> kept = mesh.faces();
  const std::span<const Vec3d> points = mesh.points();
  const bool full =
      static_cast<double>(kept.size()) * static_cast<double>(points.size()) <= kFullCheckLimit;
  return std::ranges::all_of(kept, [&](int face) {
    const Plane<double>& plane = mesh.face(face).plane;
    bool fits = mesh.face(face).area > 0 && deepest_notch(mesh, face).depth <= slack;
    for (const int e : mesh.around(face)) {
      fits = fits && std::abs(mesh.distance(face, mesh.edge(e).origin)) <= slack;
      for (const int around : mesh.around(mesh.neighbour(e)))
        fits = fits && mesh.distance(face, mesh.edge(around).origin) <= slack;
    }
    const auto above = [&](const Vec3d& point) { return plane.distance(point) > slack; };
    return fits && !(full && std::ranges::any_of(points, above));
  });
}

/// Maximum tolerance as a fraction of the thickness. At the sharp rim of a thin hull, a point one
/// tolerance above the planes can be far away; one that suits the extent would cut the rim back.
constexpr double kPartOfThickness = 1.0 / 100;

/// Rounding error of double arithmetic at coordinates of magnitude 1, as in hull_builder.cpp.
constexpr double kRounding = 9 * std::numeric_limits<double>::epsilon();

/// `growing`: tolerance until all points are added, at most `tolerance`.
Result run(std::span<const Vec3d> points, double growing, double tolerance, double steepest) {
  const Simplex simplex = initial_simplex(points, growing);
  if (simplex.status != Status::Done) return {.status = simplex.status};
  const double most = kPartOfThickness * simplex.thickness;
  Builder builder(points, std::min(growing, most));
  builder.start(simplex.points);
  builder.grow(std::min(tolerance, most), steepest);
  const Mesh& mesh = builder.mesh();
  if (mesh.broken() || !is_convex(mesh, kSlack * std::min(tolerance, most)))
    return {.status = Status::Unresolved};
  Result result{.shortest_edge = std::numeric_limits<double>::infinity()};
  for (const int face : mesh.faces()) {
    result.faces.push_back(mesh.loop(face));
    for (const int e : mesh.around(face)) {
      const double length = (mesh.point(mesh.target(e)) - mesh.point(mesh.edge(e).origin)).norm();
      result.shortest_edge = std::min(result.shortest_edge, length);
      result.steepest_edge =
          std::max(result.steepest_edge, mesh.slope(e, mesh.face(face).plane.normal));
    }
  }
  return result;
}

}  // namespace

Simplex initial_simplex(std::span<const Vec3d> points, double tolerance) {
  Simplex simplex;
  auto& [a, b, c, d] = simplex.points;

  std::vector<int> extremes;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      const auto along_axis = [&](const Vec3d& point) { return sign * point[axis]; };
      extremes.push_back(farthest(points, along_axis).first);
    }
  }
  double longest = -1;
  for (const int one : extremes) {
    for (const int other : extremes) {
      const double length = (at(points, other) - at(points, one)).norm();
      if (length <= longest) continue;
      longest = length;
      a = one;
      b = other;
    }
  }
  if (longest <= tolerance) return {Status::Coincident, simplex.points, 0};

  const Vec3d& origin = at(points, a);
  const Vec3d along = (at(points, b) - origin) / longest;
  double distance = 0;
  std::tie(c, distance) = farthest(points, [&](const Vec3d& point) {
    const Vec3d arm = point - origin;
    return along.cross(arm).norm();
  });
  if (distance <= tolerance) return {Status::Collinear, simplex.points, 0};

  const Vec3d third = at(points, c) - origin;
  const Vec3d normal = along.cross(third).normalized();
  const auto height = [&](const Vec3d& point) -> double { return normal.dot(point - origin); };
  std::tie(d, simplex.thickness) =
      farthest(points, [&](const Vec3d& point) { return std::abs(height(point)); });
  if (simplex.thickness <= tolerance)
    simplex.status = Status::Coplanar;
  else if (height(at(points, d)) > 0)
    std::swap(a, b);  // the fourth must be below the plane of the three
  return simplex;
}

Result run(std::span<const Vec3d> points, double tolerance) {
  return run(points, tolerance, tolerance, 1);
}

Result run_with_near_points(std::span<const Vec3d> points, double tolerance) {
  return run(points, std::min(tolerance, kRounding), tolerance, kSteepest);
}

}  // namespace contactscope::quickhull
