#include "draw/layers/layer.h"
#include "draw/scene/points.h"

/// The pairs that the broad phase passes on: Gregorius 2015, "Anatomy of a Physics Tick"; the
/// survey's Fig. 1.
namespace contactscope::draw {
namespace {

constexpr double kGroundRadii = 2.5;  // of the other shape: a shape so much larger is the ground

constexpr Swatch kCandidatePairSwatch{LegendGroup::Trees, 9, [](auto& pen) {
                                        pen.level_line(3, 19, 3, kBox);
                                        for (const double at : {3.0, 19.0})
                                          pen.disc(pen.at(at), 4, kBox);
                                      }};
constexpr Swatch kNearMissSwatch{LegendGroup::Trees, 10, [](auto& pen) { pen.dashes(3, kBox); }};

Vec3d middle_of(const PlacedShape& shape) {
  return shape.pose.transform(shape.traced().center_of_mass);
}

/// The middle of a shape; of a plane, a mesh or a much larger shape the place that is nearest to the
/// other's middle, on its plane or in its box.
Vec3d end_at(const PlacedShape& shape, const PlacedShape& other) {
  const Vec3d to = middle_of(other);
  if (const auto& plane = shape.traced().half_space) {
    const Vec3d normal = shape.pose.rotate(plane->normal);
    const Vec3d on_plane = shape.pose.transform(Vec3d(plane->offset * plane->normal));
    return to - normal.dot(to - on_plane) * normal;
  }
  if (!shape.is_mesh() && shape.mesh->radius < kGroundRadii * other.mesh->radius)
    return middle_of(shape);
  const Eigen::AlignedBox3d box = box_around(shape.vertices);
  return to.cwiseMax(box.min()).cwiseMin(box.max());
}

void draw_candidate_pair(const Scene& scene, const trace::Pair& pair, Sketch& sketch) {
  const PlacedShape *a = scene.find(pair.a), *b = scene.find(pair.b);
  if (a == nullptr || b == nullptr) return;
  const Vec3d from = end_at(*a, *b), to = end_at(*b, *a);
  const bool missed = scene.shows(Layer::Contacts) && pair.state != "touching";
  sketch.bordered_line(from, to, {3.0f, kBox, missed}, 5.5f);
  for (const Vec3d& end : {from, to}) sketch.mark(MarkKind::Node, end, kBox);
  sketch.explain(missed ? kNearMissSwatch : kCandidatePairSwatch,
                 missed ? "near miss: only the boxes overlap" : "pair for the narrow phase",
                 0.5 * (from + to));
}

}  // namespace

const LayerDrawing kCandidatePairsLayer{.search = draw_candidate_pair};

}  // namespace contactscope::draw
