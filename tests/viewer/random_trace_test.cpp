#include <gtest/gtest.h>

#include <algorithm>

#include "support/cases.h"
#include "support/random_geometry.h"
#include "trace/json.h"
#include "viewer/in_chromium.h"

namespace contactscope::viewer {
namespace {

/// Stages with values of all kinds.
void add_stages(trace::Pair& pair, test::Random& random) {
  trace::Reduction& reduction = pair.reduction.emplace();
  reduction.method = random.chance(0.5) ? "optimal" : "four";
  for (const trace::Manifold& manifold : pair.manifolds) reduction.points = manifold.points;
  for (int i = random.index(3); i > 0; --i)
    reduction.points.push_back(
        {random.vector(-2, 2), random.uniform(-0.1, 0.1), "b:v" + std::to_string(i)});
  for (int i = random.index(4); i > 0 && !reduction.points.empty(); --i)
    reduction.kept.push_back(random.index(static_cast<int>(reduction.points.size())));
  reduction.area = random.decade(-9, 9);
  if (random.chance(0.5)) {
    trace::Cache& cache = pair.cache.emplace();
    cache.hit = random.chance(0.5);
    cache.kind = "features";
    if (cache.hit) cache.normal = random.unit_vector();
  }
  if (random.chance(0.3)) return;
  trace::Clip& clip = pair.clip.emplace();
  clip.reference = {"slab", random.index(6), random.unit_vector(), {}};
  for (int i = random.index(6); i >= 0; --i) clip.reference.polygon.push_back(random.vector(-9, 9));
  clip.steps = {{random.unit_vector(), random.uniform(-1, 1), clip.reference.polygon}};
  clip.dropped = {{random.vector(-1, 1), "above the reference face"}};
}

/// Three bodies that come and go, with any number of manifolds, points, ids and stages.
CrateOnSlab random_scene(test::Random& random) {
  CrateOnSlab scene;
  scene.header.shapes.push_back(draw::crate_sample::cuboid("beam", {3, 0.5, 0.5}));
  const std::vector<std::string> names{"slab", "crate", "beam"};
  trace::Frame last = scene.frames[0];
  scene.frames.clear();
  for (int i = 0; i < 40; ++i) {
    trace::Frame& frame = scene.frames.emplace_back();
    frame.frame = i;
    frame.time = 0.01 * i;
    for (const std::string& name : names)
      if (random.chance(0.9)) frame.poses.emplace_back(name, random.pose(random.decade(-4, 4)));
    for (int a = 0; a < 3; ++a) {
      if (random.chance(0.2)) continue;
      trace::Pair& pair = frame.pairs.emplace_back();
      pair.a = at(names, a);
      pair.b = at(names, (a + 1) % 3);
      pair.kind = "hull-hull";
      pair.state = random.chance(0.5) ? "touching" : "separated";
      pair.separation = random.decade(-9, 3);
      const bool is_steady = random.chance(0.5);
      for (const trace::Pair& before : last.pairs)
        if (is_steady && before.a == pair.a) pair = before;
      if (is_steady && !pair.manifolds.empty()) {
        for (trace::Point& point : pair.manifolds[0].points)
          point.position += random.vector(-1e-3, 1e-3);
        continue;
      }
      pair.manifolds.clear();
      for (int m = random.index(3); m > 0; --m) {
        trace::Manifold& manifold = pair.manifolds.emplace_back();
        manifold.normal = random.unit_vector();
        manifold.axis = random.chance(0.5) ? "face_a" : "edge_edge";
        if (random.chance(0.3)) manifold.triangle = random.index(100000);
        for (int n = random.index(5); n >= 0; --n) {
          trace::Point& point = manifold.points.emplace_back();
          point.position = random.vector(-1, 1) * random.decade(-4, 4);
          point.separation = random.uniform(-1, 1) * random.decade(-9, 3);
          point.id = random.chance(0.2) ? "" : "a:f" + std::to_string(random.index(40));
          if (random.chance(0.7))
            point.impulse = trace::Impulse{.normal = random.chance(0.1) ? 0 : random.decade(-9, 9),
                                           .friction = random.vector(-1, 1)};
        }
      }
      add_stages(pair, random);
    }
    last = frame;
  }
  scene.header.frames = 40;
  return scene;
}

/// A JSON value of the page, and that of the trace. `name`: the key of the value.
void expect_near(const json& shown, const json& said, const std::string& name) {
  if (said.is_object()) {
    for (const auto& [key, value] : said.items())
      if (!value.is_null()) expect_near(shown.value(key, json()), value, key);
    for (const auto& [key, value] : shown.items())
      EXPECT_TRUE(value.is_null() || said.contains(key)) << key;
    return;
  }
  if (said.is_array()) {
    ASSERT_EQ(shown.size(), said.size()) << name;
    const bool is_vector =
        said.size() == 3 && said[0].is_number() && name != "friction" && name != "kept";
    for (std::size_t i = 0; i < said.size(); ++i) {
      if (is_vector) {
        EXPECT_NEAR(shown[i].get<double>(), said[i].get<double>(),
                    name == "normal" ? kUnitError : kPlaceError)
            << name;
      } else {
        expect_near(shown[i], said[i], "");
      }
    }
  } else if (said.is_number_float()) {
    ASSERT_TRUE(shown.is_number()) << name;
    EXPECT_NEAR(shown.get<double>(), said.get<double>(), fine(said.get<double>())) << name;
  } else {
    EXPECT_EQ(shown, said) << name;
  }
}

TEST_F(InChromium, UnpacksWhatTheTraceOfARandomSceneSays) {
  for (int seed = 1; seed <= test::cases(3); ++seed) {
    test::Random random(static_cast<std::uint64_t>(seed));
    const CrateOnSlab scene = random_scene(random);
    const json page = result(R"(
      const { data, stagesOf, state, layers, go } = contactscope, list = (first, end, of) => Array.from({ length: end - first }, (_, i) => of(first + i)), { contacts, manifolds, points, texts } = data;
      const record = r => ({ pair: data.pairs[contacts.pair[r]], touching: contacts.state[r], separation: contacts.separation[r], stages: stagesOf(r),
        manifolds: list(contacts.manifolds[r], contacts.manifolds[r + 1], m => ({ normal: [...manifolds.normal.slice(3 * m, 3 * m + 3)], axis: texts[manifolds.axis[m]], triangle: manifolds.triangle[m],
          points: list(manifolds.first[m], manifolds.first[m + 1], i => ({ position: [...points.position.slice(3 * i, 3 * i + 3)], separation: points.separation[i], id: texts[points.id[i]], impulse: points.impulse[i], friction: points.friction[i] })) })) });
      // Each layer alone, in all frames: the number of marks.
      const marks = Object.fromEntries(data.layers.map(({ name }) => {
        state.on = new Set([name]);
        return [name, data.frames.reduce((sum, _, frame) => {
          go(frame);
          return sum + layers.lines.rows + layers.dots.rows + layers.fills.rows;
        }, 0)];
      }));
      return { marks, frames: data.frames.map((_, frame) => ({ poses: data.shapes.map((_, body) => data.poseOf[3 * frame + body]).map(i => i < 0 ? null : [...data.pose.slice(7 * i, 7 * i + 7)]),
        pairs: list(contacts.first[frame], contacts.first[frame + 1], record) })) };)",
                             scene, seed < 3);
    ASSERT_FALSE(page.contains("error")) << page["error"];
    for (const char* layer :
         {"reference_face", "side_planes", "clip_polygons", "dropped", "candidates", "reduced",
          "normals", "contacts", "impulses", "center_of_mass"})
      EXPECT_GT(page["marks"].value(layer, 0), 0) << layer;
    ASSERT_EQ(page["frames"].size(), scene.frames.size());
    for (std::size_t f = 0; f < scene.frames.size(); ++f) {
      const trace::Frame& frame = scene.frames[f];
      const json& shown = page["frames"][f];
      const json said = json::parse(trace::to_json_line(frame));
      for (std::size_t body = 0; body < 3; ++body) {
        const json& pose = shown["poses"][body];
        const auto known = std::ranges::find(frame.poses, scene.header.shapes[body].name,
                                             [](const auto& one) { return one.first; });
        ASSERT_EQ(pose.is_null(), known == frame.poses.end());
        if (pose.is_null()) continue;
        const Vec3d at(pose[0].get<double>(), pose[1].get<double>(), pose[2].get<double>());
        const Vec3d& said_at = known->second.position;
        EXPECT_LE((at - said_at).lpNorm<Eigen::Infinity>(), kQuantum);
        const Quatd turned(pose[3].get<double>(), pose[4].get<double>(), pose[5].get<double>(),
                           pose[6].get<double>());
        EXPECT_LT(known->second.rotation.angularDistance(turned.normalized()), 4e-4);
      }
      ASSERT_EQ(shown["pairs"].size(), frame.pairs.size());
      for (std::size_t i = 0; i < frame.pairs.size(); ++i) {
        const trace::Pair& pair = frame.pairs[i];
        const json& one = shown["pairs"][i];
        EXPECT_EQ(scene.header.shapes[one["pair"][0].get<std::size_t>()].name, pair.a);
        EXPECT_EQ(one["touching"], int(pair.state == "touching"));
        expect_near(one["separation"], pair.separation, "separation");
        ASSERT_EQ(one["manifolds"].size(), pair.manifolds.size());
        for (std::size_t m = 0; m < pair.manifolds.size(); ++m) {
          const trace::Manifold& manifold = pair.manifolds[m];
          const json &shown_one = one["manifolds"][m], &said_one = said["pairs"][i]["manifolds"][m];
          expect_near(shown_one["normal"], said_one["normal"], "normal");
          EXPECT_EQ(shown_one["axis"], manifold.axis);
          EXPECT_EQ(shown_one["triangle"], manifold.triangle.value_or(-1));
          ASSERT_EQ(shown_one["points"].size(), manifold.points.size());
          for (std::size_t p = 0; p < manifold.points.size(); ++p) {
            const trace::Point& point = manifold.points[p];
            const json& dot = shown_one["points"][p];
            expect_near(dot["position"], said_one["points"][p]["position"], "position");
            expect_near(dot["separation"], point.separation, "separation");
            EXPECT_EQ(dot["id"], point.id);
            ASSERT_EQ(dot["impulse"].is_null(), !point.impulse.has_value());
            if (!point.impulse) continue;
            EXPECT_NEAR(dot["impulse"].get<double>(), point.impulse->normal,
                        point.impulse->normal / 1024);
            EXPECT_NEAR(dot["friction"].get<double>(), point.impulse->friction.norm(),
                        point.impulse->friction.norm() / 1024);
          }
        }
        json stages = said["pairs"][i];
        for (const char* key : {"a", "b", "label", "kind", "state", "separation", "manifolds"})
          stages.erase(key);
        expect_near(one["stages"], stages, "");
      }
    }
  }
}

}  // namespace
}  // namespace contactscope::viewer
