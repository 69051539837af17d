#pragma once

#include "geometry/mesh.h"
#include "manifold/clip.h"
#include "manifold/pair_cache.h"
#include "query/penetration.h"
#include "query/v_clip.h"
#include "trace/trace.h"

namespace contactscope {

template <class S> struct CapsuleSat;
template <class S> struct CoreQuery;
template <class S> struct IncrementalStep;
template <class S> struct PersistentManifold;
struct IncrementalOptions;

/// Writes each stage's decisions into a trace::Pair: from A's frame to the world in the pipeline's
/// scalar, then to double. Whoever swapped the shapes mirrors the record, see dispatch.h.
///
/// Stages get a pointer to it, null when not recording. Its functions are cold: without a recorder
/// each costs the pipeline one untaken branch. A test checks that recording changes no bit.
template <class S> class Recorder {
 public:
  /// `pair` must outlive this. It is empty except for the names of the shapes, in processing order.
  Recorder(const ToWorld<S>& to_world, const trace::Stages& stages, trace::Pair& pair)
      : to_world_(to_world), stages_(stages), pair_(pair) {}

  /// `faces_a`: A's separations from the face query.
  void axes(const HullPair<S>& pair, const FaceSeparations<S>& faces_a, const SatResult<S>& axes,
            Preference preference);
  /// The axes of a capsule's segment, between `ends` in the hull's frame, that is in the hull.
  void capsule_axes(const Hull<S>& hull, const Pose<S>& hull_in_a, const Vec3<S> (&ends)[2],
                    const CapsuleSat<S>& axes);
  /// The margins by which faces and the axis were chosen. `faces_b` is read only if that query ran.
  void axis_decisions(const HullPair<S>& pair, const FaceSeparations<S>& faces_a,
                      const FaceSeparations<S>& faces_b, const SatResult<S>& axes,
                      const CollideOptions& options);
  /// The margin by which the incident face was chosen among the faces around a vertex.
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
    trace::Decision& record =
        decide("incident_face", "face " + std::to_string(incident), "face " + std::to_string(over));
    record.margin_cosine = static_cast<double>(next - reference_normal.dot(hull.normal(incident)));
  }
  /// The pair's cache was tried.
  void cache(const CacheAnswer<S>& answer);
  /// `reference` owns the first face.
  void clip_begins(Owner reference, const ClipFace<S>& reference_face,
                   const ClipFace<S>& incident_face);
  /// Clipping by a side plane of the reference face and its result.
  void clip_step(const Plane<S>& side, const ClipPolygon<S>& polygon);
  void dropped(const Vec3<S>& position, const char* reason) {
    if (stages_.clip) pair_.clip->dropped.push_back({point(position), reason});
  }
  /// The face contact is abandoned for another axis.
  void clip_abandoned() {
    pair_.clip.reset();
    std::erase_if(pair_.decisions, [](const trace::Decision& decision) {
      return decision.stage == "incident_face";
    });
  }
  /// The axis that made the contact, if it is not the axis that the test chose.
  void contact_axis(AxisKind kind) {
    if (stages_.sat) pair_.sat->chosen = to_string(kind);
  }
  /// Runs a reducer and records its choices if the stages include them. In the world.
  KeptIndices reduce(const ReducerInfo* reducer, ContactPoints<S> points, const Vec3<S>& normal,
                     const ReduceOptions& options);
  /// Begins the stages of the next triangle of a mesh, which collides as a flat hull. A record has
  /// room for one: `options.recorded_triangle`, or else the deepest, or the nearest.
  void triangle_begins();
  void triangle_ends(int triangle, S separation, bool touches, const CollideOptions& options);
  /// Writes the stages of that triangle, with its number as face, and 3 triangle + k for edge k.
  void triangles_end();
  /// `points` contact points of these triangles of a mesh became the next manifold.
  void merged(std::vector<int> triangles, int points);
  /// The points of the recorded reduction were those of `all` (A's frame) with these indices.
  void reduced_outline_of(ContactPoints<S> all, const std::vector<int>& indices);
  /// Record of merged manifolds; null if they are not recorded.
  trace::Merge* merge_record() { return pair_.merge ? &*pair_.merge : nullptr; }
  /// Record of a run of GJK; null if it is not recorded.
  GjkRun<S>* gjk_run() { return stages_.gjk ? &gjk_run_ : nullptr; }
  /// Writes the run from gjk_run(), if any. `frame` is the pose of its frame in A's.
  void gjk(const Pose<S>& frame);
  /// The pairs of features that V-Clip compared.
  void walk(const Hull<S>& a, const Hull<S>& b, const Pose<S>& b_in_a,
            const std::vector<ComparedFeatures>& pairs);
  /// Record of a penetration method's steps; null if they are not recorded.
  PenetrationSteps<S>* penetration_steps() {
    return stages_.penetration ? &penetration_steps_ : nullptr;
  }
  /// Result of a method, in A's frame, with the steps from penetration_steps(). `fallback` names
  /// the method that replaced the result, or is null.
  void penetration(PenetrationMethod method, const PenetrationResult<S>& result,
                   const char* fallback);
  /// The Minkowski difference of two hulls, for views that show it; the pipeline does not need it.
  void minkowski(const Hull<S>& a, const Hull<S>& b, const Pose<S>& b_in_a);
  /// Queries a mesh's tree with the other shape's box (mesh frame); returns the triangles.
  std::vector<int> query_tree(const Mesh<S>& mesh, const Aabb<S>& box);
  /// The geometry has no normal of its own, and how that was handled.
  void degenerate(const char* geometry, Degenerate answer) {
    pair_.degenerate = trace::Degenerate{geometry, to_string(answer)};
  }
  /// A contact that the surface of a shape does not have; see respect_seams().
  void voided(Owner owner, const char* reason, const Contact<S>& contact);
  /// The pair's separation, metres, for a record without points.
  void separation(S separation) { pair_.separation = separation; }
  /// Record of the points sampled in a distance field, field's frame; null if not recorded.
  std::vector<trace::FieldProbe>* field_probes() { return stages_.fields ? &probes_ : nullptr; }
  /// Writes these points; `field_in_a` is the pose of the field's frame in A's.
  void field_search(FieldSearch method, const Pose<double>& field_in_a);
  /// The fate of every point of an incremental manifold.
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
  struct TriangleStages {
    int triangle = -1;
    bool touches = false;
    S separation = S(0);
    trace::Stage<trace::Sat> sat{};
    trace::Stage<trace::Clip> clip{};
  } of_triangle_;
};

/// Records of GJK and of the penetration methods; null also without a recorder.
template <class S> GjkRun<S>* gjk_run(Recorder<S>* recorder) {
  return recorder ? recorder->gjk_run() : nullptr;
}
template <class S> PenetrationSteps<S>* penetration_steps(Recorder<S>* recorder) {
  return recorder ? recorder->penetration_steps() : nullptr;
}

/// Records that the geometry has no normal of its own; returns whether to skip the contact.
template <class S>
bool skips_degenerate(const char* geometry, const CollideOptions& options, Recorder<S>* recorder) {
  if (recorder) [[unlikely]]
    recorder->degenerate(geometry, options.degenerate);
  return options.degenerate == Degenerate::Skip;
}

}  // namespace contactscope
