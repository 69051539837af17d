// Two spheres of 9,680 triangles that intersect, float, milliseconds: "crossing" in a circle,
// "concentric" everywhere. "build" makes both trees; "vertices" moves those of b, and "refit" fits
// its boxes around them; both are part of "query". "deforming" is a frame of crossing spheres in
// which a is twisted back and forth by at most one radian: it updates a's tree and then queries.
// "moving" is a query in each frame, with b moved by the given metres. In "beside" the spheres
// nearly touch; "nested" is a sphere in a sphere 3 cm away.
#include <benchmark/benchmark.h>

#include <cmath>
#include <string>

#include "query/mesh_query_cost.h"
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

/// Twists the vertices of `from` about z, by `angle` radians per metre of height.
void twist(const Mesh<float>& from, float angle, Mesh<float>& to) {
  for (int i = 0; i < count_of(from.vertices); ++i) {
    const Vec3f& v = at(from.vertices, i);
    const float c = std::cos(angle * v.z()), s = std::sin(angle * v.z());
    at(to.vertices, i) = {c * v.x() - s * v.y(), s * v.x() + c * v.y(), v.z()};
  }
}

template <class Pass> void add(const std::string& name, const Pass& pass) {
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
  // A shell in a shell, 3 cm away all around: many triangles are near, and none touch.
  const Placed nested =
      placed({crossing.a, test::built(test::sphere_mesh(0.97, 88, 55, 0)), crossing.b_in_a});
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
        [&, how, mesh = one.a, frame = 0, rebuilt = 0, cost = one.a.tree.expected_cost(),
         queries = MeshQueryCost(),
         verdict = MeshQueryCost::Verdict::Unknown](benchmark::State& state) mutable {
          state.PauseTiming();
          twist(one.a, static_cast<float>(std::sin(0.1 * ++frame)), mesh);
          state.ResumeTiming();
          if (update_tree(mesh, MeshQueryCost::update_after(verdict, how), cost)) {
            ++rebuilt;
            queries.restart();
          }
          verdict = queries.judge(mesh_overlap(mesh, one.b, one.b_in_a).counts);
          state.counters["rebuilt"] = static_cast<double>(rebuilt) / frame;
        });
  }
  // b moves by `step` per frame, back and forth along a line.
  const auto moving = [&](const std::string& name, const Placed& meshes, const Vec3f& from,
                          float step) {
    for (const bool coherent : {false, true}) {
      add(name + (coherent ? "/coherent" : "/from_roots"),
          [&meshes, from, step, coherent, front = MeshFront(), frame = 0,
           nodes = 0.0](benchmark::State& state) mutable {
            const float offset = step * static_cast<float>(std::abs(frame++ % 64 - 32));
            Pose<float> pose = meshes.b_in_a;
            pose.position = from + offset * Vec3f(0.6F, 0.8F, 0);
            const MeshOverlap<float> overlap =
                mesh_overlap(meshes.a, meshes.b, pose, nullptr, coherent ? &front : nullptr);
            nodes += static_cast<double>(overlap.counts.node_pairs);
            state.counters["nodes"] = nodes / frame;
            state.counters["front"] = static_cast<double>(front.pairs.size());
          });
    }
  };
  for (const float step : {0.0F, 1e-4F, 1e-3F, 1e-2F}) {
    const std::string by = "moving/" + std::to_string(step) + "/";
    moving(by + "crossing", one, one.b_in_a.position, step);
    moving(by + "concentric", other, other.b_in_a.position, step);
    moving(by + "beside", one, Vec3f::Constant(1.1561F), step);
    moving(by + "nested", nested, Vec3f::Zero(), step);
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
