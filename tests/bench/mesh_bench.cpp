// Two spheres of 9,680 triangles in each other, float, milliseconds: "crossing" in a circle,
// "concentric" crossing all over. "build" makes both trees; "vertices" moves those of b and "refit"
// fits its boxes around them, both of which are a part of "query". "deforming" is a frame of
// crossing spheres of which a is twisted to and fro, by at most one radian: its tree is brought up
// to date, and then comes the query.
#include <benchmark/benchmark.h>

#include <cmath>
#include <string>

#include "query/mesh_overlap.h"
#include "support/sphere_mesh.h"

namespace {

using namespace contactscope;  // NOLINT(google-build-using-namespace): a program of its own

struct Placed {
  Mesh<float> a, b;
  Pose<float> b_in_a;
};

Placed placed(const test::SpherePair& pair) {
  return {mesh_cast<float>(pair.a), mesh_cast<float>(pair.b), pair.b_in_a.cast<float>()};
}

std::vector<Aabb<double>> boxes_of(const Mesh<double>& mesh) {
  return mapped(mesh.triangles, [&](const std::array<int, 3>& triangle) {
    return box_of<double>(mesh.vertices, triangle);
  });
}

/// Turns the vertices of `from` about z, by `angle` radians a metre of height.
void twist(const Mesh<float>& from, float angle, Mesh<float>& to) {
  for (int i = 0; i < count_of(from.vertices); ++i) {
    const Vec3f& v = at(from.vertices, i);
    const float c = std::cos(angle * v.z()), s = std::sin(angle * v.z());
    at(to.vertices, i) = {c * v.x() - s * v.y(), s * v.x() + c * v.y(), v.z()};
  }
}

template <class Pass>
void add(const std::string& name, const Pass& pass) {
  benchmark::RegisterBenchmark(name.c_str(), [run = pass](benchmark::State& state) mutable {
    for (auto _ : state) run(state);
  })->Unit(benchmark::kMillisecond);
}

}  // namespace

int main(int argc, char** argv) {
  const test::SpherePair crossing = test::crossing_spheres();
  const test::SpherePair concentric = test::concentric_spheres();
  add("build", [&](benchmark::State&) {
    benchmark::DoNotOptimize(build_aabb_tree(boxes_of(crossing.a)));
    benchmark::DoNotOptimize(build_aabb_tree(boxes_of(crossing.b)));
  });
  const Placed one = placed(crossing), other = placed(concentric);
  const auto query = [](const Placed& meshes) {
    return [&meshes](benchmark::State& state) {
      const MeshOverlap<float> overlap = mesh_overlap(meshes.a, meshes.b, meshes.b_in_a);
      state.counters["pairs"] = static_cast<double>(overlap.intersections.size());
      state.counters["nodes"] = static_cast<double>(overlap.counts.node_pairs);
      state.counters["leaves"] = static_cast<double>(overlap.counts.leaf_pairs);
      state.counters["triangles"] = static_cast<double>(overlap.counts.triangle_pairs);
    };
  };
  add("crossing/query", query(one));
  add("concentric/query", query(other));
  add("vertices",
      [&](benchmark::State&) { benchmark::DoNotOptimize(vertices_in(one.b, one.b_in_a)); });
  AabbTree<float> tree = one.b.tree;
  add("refit", [&](benchmark::State&) { tree.refit(one.b.vertices, one.b.triangles); });
  for (const TreeUpdate how : {TreeUpdate::Refit, TreeUpdate::Rebuild, TreeUpdate::Auto}) {
    constexpr const char* kNames[] = {"deforming/refit", "deforming/rebuild", "deforming/auto"};
    add(kNames[static_cast<int>(how)],
        [&, how, mesh = one.a, frame = 0, rebuilt = 0,
         cost = one.a.tree.expected_cost()](benchmark::State& state) mutable {
          state.PauseTiming();
          twist(one.a, static_cast<float>(std::sin(0.1 * ++frame)), mesh);
          state.ResumeTiming();
          rebuilt += update_tree(mesh, how, cost) ? 1 : 0;
          benchmark::DoNotOptimize(mesh_overlap(mesh, one.b, one.b_in_a));
          state.counters["rebuilt"] = static_cast<double>(rebuilt) / frame;
        });
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
