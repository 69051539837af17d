#include <algorithm>
#include <cmath>
#include <limits>

#include "core/at.h"
#include "manifold/recorder.h"
#include "query/tolerance.h"
#include "reduce/polygon_area.h"

/// Margins of the pipeline's choices: the smallest change of the compared quantities that would
/// change a choice. Computed from the stages' measurements, only when recording.
namespace contactscope {
namespace {

/// Maximum number of points for trying all subsets to find the second best.
constexpr std::size_t kMaxPoints = 8;

/// "points 0 2 4".
std::string spell_points(const std::vector<int>& points) {
  std::string text = points.size() == 1 ? "point" : "points";
  for (const int point : points) text += " " + std::to_string(point);
  return text;
}

/// The deciding measure of a candidate at a step of a reducer: more is better. A chosen point has
/// measures against all edges; the least of them decided.
double worth(const trace::Choice& choice, int point) {
  double least = std::numeric_limits<double>::infinity();
  for (const trace::Measure& measure : choice.measures)
    if (measure.point == point) least = std::min(least, measure.value);
  if (choice.rule == "outside" || choice.rule == "distance") return -least;
  return choice.rule == "triangle" ? std::abs(least) : least;
}

}  // namespace

/// A later face must beat an earlier one by more than the tie.
template <class S>
void Recorder<S>::face_decision(const char* stage, const FaceSeparations<S>& all, int count,
                                int took, S tie) {
  S margin = std::numeric_limits<S>::infinity();
  int over = -1;
  for (int face = 0; face < count; ++face) {
    const S ahead = all.separation(took) - all.separation(face) + (face < took ? -tie : tie);
    if (face != took && ahead < margin) margin = ahead, over = face;
  }
  if (over < 0) return;
  decide(stage, "face " + std::to_string(took), "face " + std::to_string(over)).margin =
      static_cast<double>(margin);
}

/// As choose() in sat.cpp: faces of A unless another axis is ahead by more than the preference,
/// then those of B, then edges.
template <class S>
void Recorder<S>::axis_decisions(const HullPair<S>& pair, const FaceSeparations<S>& faces_a,
                                 const FaceSeparations<S>& faces_b, const SatResult<S>& axes,
                                 const CollideOptions& options) {
  if (!stages_.decisions) return;
  face_decision("face_a", faces_a, pair.a.normals.count(), axes.face_a.face, axes.tie);
  if (axes.queries_run > 1)
    face_decision("face_b", faces_b, pair.b.normals.count(), axes.face_b.face, axes.tie);
  const S margin = static_cast<S>(options.margin);
  if (axes.status == SatStatus::Separated) {
    decide("contact", "separated", "touching").margin =
        static_cast<double>(axes.separation(axes.chosen) - margin);
    return;
  }
  decide("contact", "touching", "separated").margin =
      static_cast<double>(margin - axes.separation(axes.deepest));
  EdgeQuery<S> edge = axes.edge;
  if (edge.edge_a < 0)
    edge = query_edges(pair, faces_a, -std::numeric_limits<S>::infinity(), axes.tie);
  const S of_a = axes.face_a.separation, of_b = axes.face_b.separation;
  const S of_edge = edge.edge_a < 0
                        ? -std::numeric_limits<S>::infinity()
                        : edge.separation - edge_handicap(pair.scale, options.preference);
  const S tolerance = options.preference == Preference::Relative
                          ? preference_tolerance(axes.separation(axes.deepest), pair.min_radius)
                          : S(0);
  AxisKind over = AxisKind::FaceA;
  S ahead = S(0);
  if (axes.chosen == AxisKind::FaceA) {
    over = of_b >= of_edge ? AxisKind::FaceB : AxisKind::EdgeEdge;
    ahead = of_a + tolerance - std::max(of_b, of_edge);
  } else if (axes.chosen == AxisKind::FaceB) {
    const S before = std::max(of_b, of_edge) - tolerance - of_a;
    const S after = of_b + tolerance - of_edge;
    over = before <= after ? AxisKind::FaceA : AxisKind::EdgeEdge;
    ahead = std::min(before, after);
  } else {
    over = of_a >= of_b ? AxisKind::FaceA : AxisKind::FaceB;
    ahead = of_edge - tolerance - std::max(of_a, of_b);
  }
  if (std::isfinite(ahead))
    decide("axis", to_string(axes.chosen), to_string(over)).margin = static_cast<double>(ahead);
}

template <class S>
void Recorder<S>::reduction_decisions(const trace::Reduction& reduction, const Vec3d& normal,
                                      double depth_tie) {
  if (!stages_.decisions || reduction.points.size() == reduction.kept.size()) return;
  for (std::size_t step = 0; step < reduction.choices.size() && step < reduction.kept.size();
       ++step) {
    const trace::Choice& choice = reduction.choices[step];
    const int took = reduction.kept[step];
    int over = -1;
    double next = -std::numeric_limits<double>::infinity();
    for (const trace::Measure& measure : choice.measures) {
      const double value = worth(choice, measure.point);
      if (measure.point != took && value > next) next = value, over = measure.point;
    }
    if (over < 0) continue;
    trace::Decision& record =
        decide("point " + std::to_string(step), "point " + std::to_string(took),
               "point " + std::to_string(over));
    const bool is_area =
        choice.rule == "outside" || choice.rule == "triangle" || choice.rule == "equally_deep";
    (is_area ? record.margin_area : record.margin) = worth(choice, took) - next;
  }
  const std::string& method = reduction.method;
  const std::size_t count = reduction.points.size(), kept = reduction.kept.size();
  if (!method.starts_with("optimal") || count > kMaxPoints || kept < 3) return;
  // All other subsets of this size; except for "optimal" they need one of the deepest points.
  const auto depth = [&](int point) { return at(reduction.points, point).separation; };
  double deep = depth(0);
  for (int point = 1; point < count_of(reduction.points); ++point)
    deep = std::min(deep, depth(point));
  const auto is_deep = [&](int point) { return depth(point) <= deep + depth_tie; };
  std::vector<int> took = reduction.kept, over;
  std::ranges::sort(took);
  double next = -1;
  std::vector<bool> is_in(count, false);
  std::fill_n(is_in.begin(), kept, true);
  do {
    std::vector<int> subset;
    std::vector<Vec3d> places;
    for (std::size_t i = 0; i < count; ++i) {
      if (!is_in[i]) continue;
      subset.push_back(static_cast<int>(i));
      places.push_back(reduction.points[i].position);
    }
    if (subset == took || (method != "optimal" && std::ranges::none_of(subset, is_deep))) continue;
    const double area = convex_area(places, normal);
    if (area > next) next = area, over = subset;
  } while (std::prev_permutation(is_in.begin(), is_in.end()));
  if (over.empty()) return;
  decide("points", spell_points(took), spell_points(over)).margin_area = reduction.area - next;
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                              \
  template void Recorder<S>::face_decision(const char*, const FaceSeparations<S>&, int, int, S); \
  template void Recorder<S>::axis_decisions(const HullPair<S>&, const FaceSeparations<S>&,       \
                                            const FaceSeparations<S>&, const SatResult<S>&,      \
                                            const CollideOptions&);                              \
  template void Recorder<S>::reduction_decisions(const trace::Reduction&, const Vec3d&, double);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
