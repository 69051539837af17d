#pragma once

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "geometry/mesh.h"
#include "manifold/clip.h"
#include "manifold/collide_options.h"
#include "manifold/pair_cache.h"
#include "query/gjk.h"
#include "query/penetration.h"
#include "query/sat.h"
#include "trace/trace.h"

namespace contactscope {

template <class S>
struct CoreQuery;
template <class S>
struct IncrementalStep;
template <class S>
struct PersistentManifold;
struct IncrementalOptions;

/// Writes what each stage decided into a trace::Pair: from A's frame to the world in the pipeline's
/// own scalar, then exactly to double. The record is told in the order in which the pair is worked
/// on; whoever traded the shapes mirrors it, see dispatch.h.
///
/// Stages get a pointer to it, null when nobody watches, and tell what they did as they do it. Its
/// functions are cold: a pipeline that nobody watches pays one untaken branch for each, and a test
/// holds it to the same bits.
template <class S>
class Recorder {
 public:
  /// `pair` must outlive this. It is empty but for its names of the shapes, which are set already,
  /// in the order in which the pair is worked on.
  Recorder(const ToWorld<S>& to_world, const trace::Stages& stages, trace::Pair& pair)
      : to_world_(to_world), stages_(stages), pair_(pair) {}

  /// `faces_a` is what the face query left for A.
  void axes(const HullPair<S>& pair, const FaceSeparations<S>& faces_a, const SatResult<S>& axes,
            Preference preference);
  /// The margins by which faces and the axis were chosen. `faces_b` is looked at where that query ran.
  void axis_decisions(const HullPair<S>& pair, const FaceSeparations<S>& faces_a,
                      const FaceSeparations<S>& faces_b, const SatResult<S>& axes,
                      const CollideOptions& options);
  /// The margin by which the incident face was chosen from the faces about a vertex.
  template <class Placed>
  void incident_decision(const Placed& hull, int support, const Vec3<S>& reference_normal,
                         int incident) {
    if (!stages_.decisions) return;
    S next = std::numeric_limits<S>::infinity();
    int over = -1;
    for (const int edge : hull.hull.around_vertex(support)) {
      const int face = hull.half_edge(edge).face;
      const S along = reference_normal.dot(hull.normal(face));
      if (face != incident && along < next) next = along, over = face;
    }
    if (over < 0) return;
    trace::Decision& told =
        decide("incident_face", "face " + std::to_string(incident), "face " + std::to_string(over));
    told.margin_cosine = static_cast<double>(next - reference_normal.dot(hull.normal(incident)));
  }
  /// What the pair's cache held was tried.
  void cache(const CacheAnswer<S>& answer);
  /// `reference` owns the first face.
  void clip_begins(Owner reference, const ClipFace<S>& reference_face,
                   const ClipFace<S>& incident_face);
  /// A side plane of the reference face and what it left.
  void clip_step(const Plane<S>& side, const ClipPolygon<S>& polygon);
  void dropped(const Vec3<S>& position, const char* reason) {
    if (stages_.clip) pair_.clip->dropped.push_back({point(position), reason});
  }
  /// The face contact is given up for another axis.
  void clip_abandoned() {
    pair_.clip.reset();
    std::erase_if(pair_.decisions, [](const trace::Decision& decision) {
      return decision.stage == "incident_face";
    });
  }
  /// The axis that made the contact, when it is not the one that the test chose.
  void contact_axis(AxisKind kind) {
    if (stages_.sat) pair_.sat->chosen = to_string(kind);
  }
  /// Runs a reducer, and records its choices where the stages ask for them. `points` and `normal` in the world.
  KeptIndices reduce(const ReducerInfo* reducer, ContactPoints<S> points, const Vec3<S>& normal,
                     const ReduceOptions& options);
  /// Where a run of GJK leaves its steps; nullptr where they are not to be recorded.
  GjkRun<S>* gjk_run() { return stages_.gjk ? &gjk_run_ : nullptr; }
  /// The run that was left in gjk_run(), if any; `frame` places what it worked in in A's frame.
  void gjk(const Pose<S>& frame);
  /// Where a penetration method leaves its steps; nullptr where they are not to be recorded.
  PenetrationSteps<S>* penetration_steps() {
    return stages_.penetration ? &penetration_steps_ : nullptr;
  }
  /// What a method found, in A's frame, with the steps that were left in penetration_steps();
  /// `fallback` names the method whose result stands instead, or is nullptr.
  void penetration(PenetrationMethod method, const PenetrationResult<S>& result,
                   const char* fallback);
  /// The Minkowski difference of two hulls, where a view shows it: the pipeline has no need of it.
  void minkowski(const Hull<S>& a, const Hull<S>& b, const Pose<S>& b_in_a);
  /// Queries a mesh's tree with the other shape's box, both in the mesh's frame; returns the
  /// triangles.
  std::vector<int> query_tree(const Mesh<S>& mesh, const Aabb<S>& box);
  /// The geometry had no normal of its own; what was done about it.
  void degenerate(const char* geometry, Degenerate answer) {
    pair_.degenerate = trace::Degenerate{geometry, to_string(answer)};
  }
  /// Of the pair, metres: what stands in the record when no point does.
  void separation(S separation) { pair_.separation = separation; }
  /// Where the search in a distance field leaves the points that it asked, in the field's frame;
  /// nullptr where they are not to be recorded.
  std::vector<trace::FieldProbe>* field_probes() { return stages_.fields ? &probes_ : nullptr; }
  /// The points that were left there; `field_in_a` places the field's frame in A's.
  void field_search(FieldSearch method, const Pose<double>& field_in_a);
  /// What became of every point of an incremental manifold.
  void incremental(const CoreQuery<S>& query, const IncrementalStep<S>& step,
                   const PersistentManifold<S>& persistent, const IncrementalOptions& options);

 private:
  trace::Decision& decide(std::string stage, std::string took, std::string over) {
    return pair_.decisions.emplace_back(
        trace::Decision{std::move(stage), std::move(took), std::move(over), {}, {}, {}});
  }
  void face_decision(const char* stage, const FaceSeparations<S>& all, int count, int took, S tie);
  /// Separations that differ by no more than `depth_tie`, metres, are equal.
  void reduction_decisions(const trace::Reduction& reduction, const Vec3d& normal,
                           double depth_tie);
  Vec3d point(const Vec3<S>& in_a) const { return to_world_.point(in_a).template cast<double>(); }
  Vec3d direction(const Vec3<S>& in_a) const {
    return to_world_.direction(in_a).template cast<double>();
  }
  trace::SimplexVertex vertex(const Vec3<S>& a, const Vec3<S>& b) const {
    return {point(a), point(b)};
  }
  trace::Polygon polygon(const ClipPolygon<S>& in_a) const;

  ToWorld<S> to_world_;
  trace::Stages stages_;
  trace::Pair& pair_;
  GjkRun<S> gjk_run_;
  PenetrationSteps<S> penetration_steps_;
  std::vector<trace::FieldProbe> probes_;
};

/// Where GJK and the penetration methods leave their steps, whether or not somebody watches.
template <class S>
GjkRun<S>* gjk_run(Recorder<S>* recorder) {
  return recorder ? recorder->gjk_run() : nullptr;
}
template <class S>
PenetrationSteps<S>* penetration_steps(Recorder<S>* recorder) {
  return recorder ? recorder->penetration_steps() : nullptr;
}

/// Tells that the geometry has no normal of its own, and says whether such a contact is left out.
template <class S>
bool skips_degenerate(const char* geometry, const CollideOptions& options, Recorder<S>* recorder) {
  if (recorder) [[unlikely]]
    recorder->degenerate(geometry, options.degenerate);
  return options.degenerate == Degenerate::Skip;
}

}  // namespace contactscope
