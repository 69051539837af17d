#include "lint/recorded.h"
#include "trace/find.h"

/// Mistakes in units, axes and forms, in impulses and velocities, and in the record itself.
namespace contactscope::lint {
namespace {

Mistaken each_shape(const std::function<void(trace::Shape&)>& change) {
  return [=](Trace& trace) { std::ranges::for_each(trace.header.shapes, change); };
}
Mistaken each_frame(const std::function<void(trace::Frame&)>& change) {
  return [=](Trace& trace) { std::ranges::for_each(trace.frames, change); };
}
Mistaken each_body(const std::function<void(const trace::Frame&, trace::Body&)>& change) {
  return each_frame([=](trace::Frame& frame) {
    for (trace::Body& body : frame.solver->bodies) change(frame, body);
  });
}
Mistaken each_impulse(const std::function<void(const trace::Manifold&, trace::Impulse&)>& change) {
  return [=](Trace& trace) {
    each_manifold(trace, [&](auto&, auto&, trace::Manifold& manifold) {
      for (trace::Point& point : manifold.points)
        if (point.impulse) change(manifold, *point.impulse);
    });
  };
}
/// Changes points and normals.
Mistaken contacts_as(Vec3d (*change)(const Vec3d&)) {
  return [=](Trace& trace) {
    each_manifold(trace, [&](auto&, auto&, trace::Manifold& manifold) {
      manifold.normal = change(manifold.normal);
      for (trace::Point& point : manifold.points) {
        point.position = change(point.position);
        point.impulse.reset();
      }
    });
  };
}
Mistaken scaled(const std::string& type, double factor) {
  return each_shape([=](trace::Shape& shape) {
    if (shape.type != type) return;
    for (Vec3d& vertex : shape.vertices) vertex *= factor;
  });
}

/// Raises the world by half a metre, so that a plane's offset is not 0.
void raise(Trace& trace) {
  for (trace::Shape& shape : trace.header.shapes)
    if (shape.half_space) shape.half_space->offset = 0.5;
  for (trace::Frame& frame : trace.frames)
    for (auto& [name, pose] : frame.poses)
      if (name != trace.header.shapes.front().name) pose.position.y() += 0.5;
  each_point(trace, [](auto&, auto&, trace::Point& point) { point.position.y() += 0.5; });
}

std::vector<Seed> more_seeds() {
  const auto half_space = [](void (*change)(trace::HalfSpace&)) {
    return each_shape([=](trace::Shape& shape) {
      if (shape.half_space) change(*shape.half_space);
    });
  };
  const auto radii = [](double factor) {
    return each_shape([=](trace::Shape& shape) { shape.radius *= factor; });
  };
  return {
      {"whole extents", heap, scaled("box", 2), "boxes_twice_as_large"},
      {"half extents", heap, scaled("box", 0.5), "boxes_half_as_large"},
      {"diameters", heap, radii(2), "radii_twice_as_large"},
      {"half radii", heap, radii(0.5), "radii_half_as_large"},
      {"half lengths", heap, scaled("capsule", 0.5), "capsules_half_as_long"},
      {"whole lengths", heap, scaled("capsule", 2), "capsules_twice_as_long"},
      {"capsules along another axis", heap, each_shape([](trace::Shape& shape) {
         if (shape.type != "capsule") return;
         for (Vec3d& vertex : shape.vertices) vertex = {vertex.z(), vertex.x(), vertex.y()};
       }),
       "capsules_along_x"},
      {"offsets", heap,
       [=](Trace& trace) {
         raise(trace);
         half_space([](trace::HalfSpace& plane) { plane.offset = -plane.offset; })(trace);
       },
       "plane_offsets_negated"},
      {"planes turned", heap, half_space([](trace::HalfSpace& plane) { plane.normal *= -1; }),
       "planes_turned"},
      {"left-handed positions", heap,
       [](Trace& trace) {
         const auto mirrored = [](const Vec3d& v) { return Vec3d(v.x(), v.y(), -v.z()); };
         contacts_as(mirrored)(trace);
         for (trace::Frame& frame : trace.frames)
           for (auto& [name, pose] : frame.poses) pose.position.z() *= -1;
       },
       "rotations_mirrored_z"},
      {"left-handed contacts", heap,
       contacts_as([](const Vec3d& v) { return Vec3d(-v.x(), v.y(), v.z()); }),
       "contacts_mirrored_x"},
      {"swapped axes", heap, contacts_as([](const Vec3d& v) { return Vec3d(v.x(), v.z(), v.y()); }),
       "contacts_y_z_swapped"},
      {"contacts with z up", heap,
       contacts_as([](const Vec3d& v) { return Vec3d(v.x(), -v.z(), v.y()); }), "contacts_z_up"},
      {"inside out", terrain, each_shape([](trace::Shape& shape) {
         if (shape.type != "mesh") return;
         for (std::vector<int>& face : shape.faces) std::ranges::reverse(face);
       }),
       "mesh_inside_out"},
      {"both orders", stack, each_frame([](trace::Frame& frame) {
         const std::vector<trace::Pair> pairs = frame.pairs;
         for (trace::Pair pair : pairs) {
           std::swap(pair.a, pair.b);
           for (trace::Manifold& manifold : pair.manifolds) manifold.normal = -manifold.normal;
           frame.pairs.push_back(pair);
         }
       }),
       "pairs_twice"},
      {"no points", heap, each_frame([](trace::Frame& frame) {
         for (trace::Pair& pair : frame.pairs)
           if (pair.state == "touching") pair.manifolds.clear();
       }),
       "touching_without_points"},
      {"time backward", heap, each_frame([](trace::Frame& frame) { frame.time = -frame.time; }),
       "times_do_not_rise"},
      {"milliseconds of what falls", heap,
       each_frame([](trace::Frame& frame) { frame.time *= 1000; }), "time_in_milliseconds"},
      {"milliseconds of what rests", stack,
       each_frame([](trace::Frame& frame) { frame.time *= 1000; }), "time_in_milliseconds"},
      {"one id", stack,
       [](Trace& trace) {
         each_point(trace, [](auto&, auto&, trace::Point& point) { point.id = "0"; });
       },
       "ids_alike"},
      {"ids that trade places", stack, each_frame([](trace::Frame& frame) {
         for (trace::Pair& pair : frame.pairs) {
           std::vector<trace::Point>& points = pair.manifolds.front().points;
           for (std::size_t i = 0; i < points.size(); ++i)
             points[i].id =
                 std::to_string((i + static_cast<std::size_t>(frame.frame)) % points.size());
         }
       }),
       "ids_change"},
      {"whole impulses as friction", stack,
       each_impulse([](const trace::Manifold& manifold, trace::Impulse& impulse) {
         impulse.friction += impulse.normal * manifold.normal;
       }),
       "friction_along_normal"},
      {"friction as a force", heap,
       each_impulse([](auto&, trace::Impulse& impulse) { impulse.friction *= 60; }),
       "friction_beyond_normal"},
      {"friction on a", heap,
       each_impulse([](auto&, trace::Impulse& impulse) { impulse.friction *= -1; }),
       "friction_on_a"},
      {"inverse masses", stack,
       each_body([](auto&, trace::Body& body) { body.mass = 1 / body.mass; }),
       "impulses_unlike_weights"},
      {"velocities backward", heap,
       each_body([](auto&, trace::Body& body) { body.velocity *= -1; }), "velocities_negated"},
      {"velocities of a step", heap,
       each_body([](auto&, trace::Body& body) { body.velocity /= 60; }), "velocities_of_a_step"},
      {"velocities of the body", heap, each_body([](const trace::Frame& frame, trace::Body& body) {
         body.velocity = trace::find_pose(frame, body.name)->inverse_rotate(body.velocity);
       }),
       "velocities_in_frame_of_body"},
      {"degrees a second", heap,
       each_body([](auto&, trace::Body& body) { body.angular_velocity *= 57.29578; }),
       "spins_in_degrees"},
  };
}

TEST(Lint, SlowEachMistakeOfUnitsAxesAndFormsIsNamed) {
  for (const Seed& seed : more_seeds()) expect_named(seed);
}

/// The contacts of both shapes carry a body of two shapes.
TEST(Lint, ABodyOfSeveralShapesIsWeighedAsAWhole) {
  Trace trace = stack();
  trace::Frame& last = trace.frames.back();
  // The lowest crate becomes two shapes: each has half of its points and all of its poses.
  const std::string name = last.pairs.front().b;
  const auto whole = std::ranges::find(trace.header.shapes, name, &trace::Shape::name);
  ASSERT_NE(whole, trace.header.shapes.end());
  trace::Shape one = *whole, other = *whole;
  one.body = other.body = name;
  one.name = name + "_one";
  other.name = name + "_other";
  *whole = one;
  trace.header.shapes.push_back(other);
  for (trace::Frame& frame : trace.frames) {
    const Pose<double> pose = pose_of(frame, name);
    std::erase_if(frame.poses,
                  [&](const trace::Placement& placed) { return placed.first == name; });
    frame.poses.push_back({one.name, pose});
    frame.poses.push_back({other.name, pose});
    std::vector<trace::Pair> pairs;
    for (trace::Pair& pair : frame.pairs) {
      if (pair.a != name && pair.b != name) {
        pairs.push_back(pair);
        continue;
      }
      for (const std::string& part : {one.name, other.name}) {
        trace::Pair half = pair;
        (half.a == name ? half.a : half.b) = part;
        for (trace::Manifold& manifold : half.manifolds)
          for (trace::Point& point : manifold.points) {
            point.impulse->normal /= 2;
            point.impulse->friction /= 2;
          }
        pairs.push_back(half);
      }
    }
    frame.pairs = pairs;
    std::erase_if(frame.solver->bodies, [&](const trace::Body& body) { return body.name != name; });
  }
  EXPECT_THAT(causes_of(lint(trace)), testing::IsEmpty());
  for (trace::Frame& frame : trace.frames)
    for (trace::Body& body : frame.solver->bodies) body.mass /= 2;
  EXPECT_THAT(causes_of(lint(trace)), testing::ElementsAre("impulses_doubled"));
}

}  // namespace
}  // namespace contactscope::lint
