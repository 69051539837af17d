#include "draw/scene/clipped_segment.h"

namespace contactscope::draw {
namespace {

constexpr double kAlongTheNormal = 0.999;  // cosine: the face that made the contact

}  // namespace

bool ClippedSegment::cuts(std::size_t side) const {
  const double border = sides[side].dot(face[side]);
  const double most = std::max(sides[side].dot(axis_from), sides[side].dot(axis_to));
  return most > border + 1e-6 * (axis_to - axis_from).norm();
}

std::optional<FaceOfRound> face_of_round(const Scene& scene, const trace::Pair& pair) {
  if (pair.clip || pair.manifolds.size() != 1) return std::nullopt;
  const trace::Manifold& manifold = pair.manifolds.front();
  // A core on a vertex or edge has coinciding closest points; the normal is of a chosen face.
  const bool chosen = pair.degenerate && manifold.axis == "closest_points";
  const PlacedShape* shape_a = scene.find(pair.a);
  const bool of_a = manifold.axis == "face_a" ||
                    (chosen && shape_a != nullptr && !shape_a->traced().faces.empty());
  if (!of_a && !chosen && manifold.axis != "face_b") return std::nullopt;
  const PlacedShape* hull = scene.find(of_a ? pair.a : pair.b);
  const PlacedShape* round = scene.find(of_a ? pair.b : pair.a);
  if (hull == nullptr || round == nullptr || hull->is_mesh() || hull->traced().faces.empty())
    return std::nullopt;
  if (!(round->traced().radius > 0)) return std::nullopt;
  FaceOfRound result{round, {}, of_a ? manifold.normal : Vec3d(-manifold.normal)};
  double best = kAlongTheNormal;
  for (int f = 0; f < count_of(hull->traced().faces); ++f) {
    const double cosine = hull->normal(f).dot(result.normal);
    if (cosine <= best) continue;
    best = cosine;
    result.polygon = hull->polygon(f);
  }
  if (result.polygon.empty()) return std::nullopt;
  return result;
}

std::optional<ClippedSegment> clipped_segment(const Scene& scene, const trace::Pair& pair) {
  const std::optional<FaceOfRound> found = face_of_round(scene, pair);
  if (!found || found->round->vertices.size() != 2) return std::nullopt;
  ClippedSegment result;
  result.face = found->polygon;
  result.normal = found->normal;

  // Sutherland and Hodgman 1974, for a segment.
  result.axis_from = found->round->vertices[0];
  result.axis_to = found->round->vertices[1];
  const Vec3d offset = result.axis_to - result.axis_from;
  double begin = 0, end = 1;
  for (std::size_t i = 0; i < result.face.size(); ++i) {
    const Vec3d edge = result.face[(i + 1) % result.face.size()] - result.face[i];
    const Vec3d outward = edge.cross(result.normal).normalized();
    result.sides.push_back(outward);
    const double before = outward.dot(result.axis_from - result.face[i]),
                 grows = outward.dot(offset);
    if (std::abs(grows) < 1e-12 * offset.norm()) {
      if (before > 0) return std::nullopt;
      continue;
    }
    const double at = -before / grows;
    if (grows > 0)
      end = std::min(end, at);
    else
      begin = std::max(begin, at);
  }
  if (begin >= end) return std::nullopt;
  result.from = result.axis_from + begin * offset;
  result.to = result.axis_from + end * offset;
  return result;
}

}  // namespace contactscope::draw
