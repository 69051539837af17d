#include "query/mesh_query_cost.h"
#include "study/random_cases.h"
#include "study/study.h"

namespace contactscope {
namespace {

constexpr int kMeridians[] = {8, 16, 32, 64, 128, 256};  // of a sphere; half as many parallels
constexpr int kMeshRepetitions = 7;
constexpr int kDeformingFrames = 50;
constexpr int kDeformingMeridians = 96;
constexpr double kMaxTwist = 5;      // radians per metre, in the last frame
constexpr double kInnerBall = 0.97;  // radius; the other is 1 m
constexpr int kMovingFrames = 40;
constexpr int kMicrometres[] = {10, 100, 1000, 10000, 100000};  // per frame
constexpr double kMilliseconds = 1e-6;

/// Pose in which the two cut each other in a ring.
Pose<float> cutting_pose() {
  const Quatd turn(Eigen::AngleAxisd(0.7, Vec3d(1, 2, 3).normalized()));
  return Pose<double>{turn, {1.1, 0.35, 0.2}}.cast<float>();
}

std::vector<Vec3f> twisted(const std::vector<Vec3f>& vertices, double angle) {
  return mapped(vertices, [angle](const Vec3f& v) -> Vec3f {
    const double turn = angle * v.z(), c = std::cos(turn), s = std::sin(turn);
    return Vec3d(c * v.x() - s * v.y(), s * v.x() + c * v.y(), v.z()).cast<float>();
  });
}

/// Time of `call`.
template <class Call> trace::Nanoseconds timed(int repetitions, const Call& call) {
  PassTimes times;
  times.measure(repetitions, 1, [&](int) { return call(); });
  return times.summary();
}

void add_point(trace::StudySeries& series, double parameter, double value,
               const trace::Nanoseconds& time) {
  series.points.push_back({parameter, value, value, time, 0, 1});
}

/// Build, query and refit over the number of triangles of two balls.
void study_sizes(const StudyOptions& options, const StudyStep& step, trace::Study& times) {
  const int repetitions = options.repetitions.value_or(kMeshRepetitions);
  const char* const kPanel = "two balls that cross in a ring";
  const std::size_t first = times.series.size();
  for (const char* method : {"both trees", "query", "vertices moved, one tree refitted"})
    times.series.push_back({method, {}, kPanel, "triangles of each ball"});
  for (const int meridians : kMeridians) {
    const Mesh<double> made = ball_mesh(meridians);
    const Mesh<float> mesh = mesh_cast<float>(made);
    const double triangles = mesh.triangle_count();
    const trace::Nanoseconds build = timed(repetitions, [&] {
      double nodes = 0;
      for (int tree = 0; tree < 2; ++tree) {
        const auto boxes = mapped(made.triangles, [&](const std::array<int, 3>& triangle) {
          return box_of<double>(made.vertices, triangle);
        });
        nodes += static_cast<double>(build_aabb_tree(boxes).nodes.size());
      }
      return nodes;
    });
    const trace::Nanoseconds query = timed(repetitions, [&] {
      return static_cast<double>(mesh_overlap(mesh, mesh, cutting_pose()).intersections.size());
    });
    AabbTree<float> tree = mesh.tree;
    const trace::Nanoseconds refit = timed(repetitions, [&] {
      const std::vector<Vec3f> moved = vertices_in(mesh, cutting_pose());
      tree.refit(moved, mesh.triangles);
      return static_cast<double>(tree.bounds().lower.x());
    });
    const trace::Nanoseconds* const all[] = {&build, &query, &refit};
    for (std::size_t i = 0; i < 3; ++i)
      add_point(times.series[first + i], triangles, all[i]->min * kMilliseconds, *all[i]);
    step(std::to_string(mesh.triangle_count()) + " triangles");
  }
}

/// One ball is twisted more in each frame, which fails if the methods find different pairs.
void study_deformation(const StudyOptions& options, const StudyStep& step, trace::Study& times,
                       trace::Study& costs) {
  const int frames = options.frames.value_or(kDeformingFrames);
  const int repetitions = std::max(1, options.repetitions.value_or(kMeshRepetitions) / 2);
  const Mesh<float> at_rest = mesh_cast<float>(ball_mesh(kDeformingMeridians));
  struct Method {
    const char* name;
    TreeUpdate how;
  };
  constexpr Method kMethods[] = {
      {"refit", TreeUpdate::Refit}, {"rebuild", TreeUpdate::Rebuild}, {"auto", TreeUpdate::Auto}};
  const std::string balls =
      std::to_string(at_rest.triangle_count()) + " triangles, one ball twisted";
  std::vector<std::size_t> expected;
  for (const Method& method : kMethods) {
    trace::StudySeries frame{method.name, {}, balls, "frames, a tenth of a radian a metre each"};
    trace::StudySeries cost = frame, compared = frame;
    cost.panel = "boxes that a small query is expected to test";
    compared.panel = "node pairs compared";
    cost.parameter = "boxes expected, by frame";
    compared.parameter = "node pairs compared, by frame";
    Mesh<float> mesh = at_rest;
    double cost_when_built = mesh.tree.expected_cost();
    MeshQueryCost query_cost;
    MeshQueryCost::Verdict verdict = MeshQueryCost::Verdict::Unknown;
    for (int k = 1; k <= frames; ++k) {
      mesh.vertices = twisted(at_rest.vertices, kMaxTwist * k / frames);
      const AabbTree<float> before = mesh.tree;
      const double built_before = cost_when_built;
      bool rebuilt = false;
      MeshOverlap<float> found;
      PassTimes spent;
      for (int r = 0; r < repetitions; ++r) {
        mesh.tree = before;
        cost_when_built = built_before;
        spent.measure(1, [&](int) {
          rebuilt =
              update_tree(mesh, MeshQueryCost::update_after(verdict, method.how), cost_when_built);
          found = mesh_overlap(mesh, at_rest, cutting_pose());
          return static_cast<double>(found.counts.node_pairs);
        });
      }
      if (rebuilt) query_cost.restart();
      verdict = query_cost.judge(found.counts);
      const trace::Nanoseconds time = spent.summary();
      add_point(frame, k, time.min * kMilliseconds, time);
      add_point(cost, k, mesh.tree.expected_cost(), time);
      add_point(compared, k, static_cast<double>(found.counts.node_pairs), time);
      if (&method == &kMethods[0])
        expected.push_back(found.intersections.size());
      else if (found.intersections.size() != at(expected, k - 1))
        frame.points.back().failed = 1;
    }
    times.series.push_back(std::move(frame));
    costs.series.push_back(std::move(cost));
    costs.series.push_back(std::move(compared));
    step(std::string("twisted, ") + method.name);
  }
}

/// A ball that moves back and forth, next to or inside another: queries from the roots in each
/// frame, and from where the previous frame's traversal ended. A point fails if they ever differ.
void study_motion(const StudyOptions& options, const StudyStep& step, trace::Study& times,
                  trace::Study& costs) {
  const int repetitions = options.repetitions.value_or(kMeshRepetitions);
  const Mesh<double> made = ball_mesh(kDeformingMeridians);
  std::vector<Vec3d> smaller = made.vertices;
  for (Vec3d& vertex : smaller) vertex *= kInnerBall;
  const Mesh<float> outer = mesh_cast<float>(made);
  const Mesh<float> inner = mesh_cast<float>(build_mesh(std::move(smaller), made.triangles));
  struct Moved {
    const char* name;
    const Mesh<float>& mesh;
    Pose<float> pose;
  };
  const Moved both[] = {{"one ball moves beside the other", outer, cutting_pose()},
                        {"one ball moves in the other", inner, Pose<float>{}}};
  for (const Moved& moved : both) {
    const std::string by = "micrometres a frame, " + std::string(moved.name);
    std::array<trace::StudySeries, 2> frame, compared;
    for (std::size_t coherent = 0; coherent < 2; ++coherent) {
      const char* const name = coherent == 1 ? "coherent" : "from roots";
      frame[coherent] = {name, {}, moved.name, by};
      compared[coherent] = {name, {}, "node pairs compared, " + by, "node pairs compared, " + by};
    }
    for (const int offset : kMicrometres) {
      std::array<PassTimes, 2> spent;
      std::array<std::int64_t, 2> node_pairs{};
      std::array<std::size_t, 2> found{};
      for (int r = 0; r < 2 * repetitions; ++r) {  // in turn, so that slow moments affect both
        const std::size_t coherent = static_cast<std::size_t>(r) % 2;
        MeshFront front;
        node_pairs[coherent] = 0;
        found[coherent] = 0;
        spent[coherent].measure(kMovingFrames, [&](int k) {
          Pose<float> pose = moved.pose;
          pose.position.x() += 1e-6F * static_cast<float>(offset * std::abs(k - kMovingFrames / 2));
          const MeshOverlap<float> overlap =
              mesh_overlap(outer, moved.mesh, pose, nullptr, coherent == 1 ? &front : nullptr);
          node_pairs[coherent] += overlap.counts.node_pairs;
          found[coherent] += overlap.intersections.size();
          return static_cast<double>(overlap.counts.node_pairs);
        });
      }
      for (std::size_t coherent = 0; coherent < 2; ++coherent) {
        const trace::Nanoseconds time = spent[coherent].summary();
        add_point(frame[coherent], offset, time.min * kMilliseconds, time);
        add_point(compared[coherent], offset,
                  static_cast<double>(node_pairs[coherent]) / kMovingFrames, time);
      }
      if (found[0] != found[1]) frame[1].points.back().failed = 1;
    }
    times.series.insert(times.series.end(), frame.begin(), frame.end());
    costs.series.insert(costs.series.end(), compared.begin(), compared.end());
    step(moved.name);
  }
}

}  // namespace

/// Mesh against mesh, three results. "time": building both trees, querying and refitting over the
/// number of triangles; and a frame while one mesh is twisted: its tree refitted, rebuilt, or
/// rebuilt once a query costs 30 % more. "motion": one query per frame while a mesh moves, from the
/// roots or coherent. "cost": for these frames, expected query cost and compared node pairs.
std::vector<trace::Study> study_meshes(const StudyOptions& options, const StudyProgress& progress) {
  std::vector<trace::Study> results = results_of(
      "mesh_mesh", "float", "triangles",
      "the pairs of triangles that a refitted tree finds from its roots",
      {{"time", "Mesh against mesh: time over a deformation, and over size", "milliseconds, least"},
       {"cost", "What a tree costs a query as its mesh is twisted or moves",
        "boxes, or pairs of them"},
       {"motion", "From the roots, or from where the last frame ended: the time of a query",
        "milliseconds, least"}},
      trace::StudyForm::Curves);
  const StudyStep step = counted(progress, static_cast<int>(std::size(kMeridians)) + 5);
  study_deformation(options, step, results[0], results[1]);
  study_sizes(options, step, results[0]);
  study_motion(options, step, results[2], results[1]);
  // Group series by panel.
  std::ranges::stable_sort(results[1].series, {}, &trace::StudySeries::panel);
  return results;
}

}  // namespace contactscope
