#pragma once

#include <string>
#include <vector>

#include "draw/staging.h"

namespace contactscope::draw::crate_sample {

inline trace::Shape cuboid(const std::string& name, const Vec3d& h) {
  trace::Shape shape;
  shape.name = name;
  shape.type = "box";
  for (int i = 0; i < 8; ++i) {
    shape.vertices.emplace_back(i & 1 ? h.x() : -h.x(), i & 2 ? h.y() : -h.y(),
                                i & 4 ? h.z() : -h.z());
  }
  shape.faces = {{1, 3, 7, 5}, {0, 4, 6, 2}, {2, 6, 7, 3},
                 {0, 1, 5, 4}, {4, 5, 7, 6}, {0, 2, 3, 1}};
  return shape;
}

/// A crate of 1 m, 2 mm deep in a slab, with two of its later four points.
struct CrateOnSlab {
  trace::Header header;
  std::vector<trace::Frame> frames;
  View view;

  CrateOnSlab() {
    header.title = "A crate on a slab";
    header.source = "none";
    header.up = "y";
    header.frames = 1;
    header.shapes = {cuboid("slab", {1, 0.2, 1}), cuboid("crate", {0.5, 0.5, 0.5})};
    trace::Frame frame;
    Pose<double> slab, crate;
    slab.position = {0, -0.2, 0};
    crate.position = {0, 0.498, 0};
    frame.poses = {{"slab", slab}, {"crate", crate}};
    trace::Pair pair;
    pair.a = "slab";
    pair.b = "crate";
    pair.kind = "hull-hull";
    pair.state = "touching";
    trace::Manifold manifold;
    manifold.normal = Vec3d::UnitY();
    manifold.axis = "closest_points";
    for (const double x : {-0.5, 0.5}) {
      manifold.points.push_back({{x, 0, 0.5}, -0.002, x < 0 ? "b:v4" : "b:v5"});
    }
    pair.manifolds = {manifold};
    frame.pairs = {pair};
    frames = {frame};
  }

  trace::Pair& pair() { return frames[0].pairs[0]; }
  trace::Manifold& manifold() { return pair().manifolds[0]; }

  void persist() {
    trace::Incremental& incremental = pair().incremental.emplace();
    incremental.margin_a = 0.05;
    incremental.margin_b = 0.1;
    const auto add = [&](const Vec3d& at, const char* state, const char* reason, int age) {
      trace::PersistentPoint point;
      point.point.position = at;
      point.point.on_a = at + Vec3d(0.01, 0, 0);
      point.point.on_b = at - Vec3d(0.01, 0, 0);
      point.state = state;
      point.reason = reason;
      point.age = age;
      incremental.points.push_back(point);
    };
    add({-0.5, 0, 0.5}, "persisted", "", 7);
    add({0.5, 0, 0.5}, "new", "", 0);
    add({0.5, 0, -0.5}, "broken", "slid", 3);
  }

  void balance(const char* verdict) {
    trace::Stability& stability = pair().stability.emplace();
    stability.shape = "crate";
    stability.center_of_mass = {0, 0.498, 0};
    stability.projection = {0, 0, 0};
    stability.verdict = verdict;
    if (verdict == std::string("stable")) {
      stability.support = {{-0.5, 0, -0.25}, {0.5, 0, -0.25}, {0.5, 0, 0.5}, {-0.5, 0, 0.5}};
      stability.margin = 0.25;
    } else {
      stability.support = {{-0.5, 0, 0.5}, {0.5, 0, 0.5}};
      stability.margin = -0.5;
      stability.axis = {Vec3d(-0.5, 0, 0.5), Vec3d(0.5, 0, 0.5)};
    }
  }

  void solve(double newton_seconds) {
    trace::Solver& solver = frames[0].solver.emplace();
    trace::Body body;
    body.name = "crate";
    body.center_of_mass = {0, 0.498, 0};
    body.velocity = {0.5, 0, 0};
    body.angular_velocity = {0, 0.5, 0};
    body.kinetic_energy = 0.125;
    solver.bodies = {body};
    for (trace::Point& point : manifold().points) {
      point.impulse =
          trace::Impulse{newton_seconds, {-0.25 * newton_seconds, 0, 0}, 0.75 * newton_seconds};
    }
  }

  Staging staged(int width = 1280, int height = 720) const {
    return stage(header, frames, view, width, height);
  }
  Sketch sketch() const { return sketch_frame(staged(), frames[0]); }
};

inline std::vector<std::string> texts(const Drawing& drawing) {
  std::vector<std::string> result;
  for (const Primitive& primitive : drawing.primitives) {
    if (const Text* text = std::get_if<Text>(&primitive)) result.push_back(text->text);
  }
  return result;
}

inline bool same(const Color& a, const Color& b) { return a.r == b.r && a.g == b.g && a.b == b.b; }

}  // namespace contactscope::draw::crate_sample
