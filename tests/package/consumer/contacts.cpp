// A crate on the ground: its contacts reduced to four, a trace and a picture.
#include <contactscope/collide.h>
#include <contactscope/reduce.h>
#include <contactscope/render.h>
#include <contactscope/trace.h>
#include <contactscope/version.h>

#include <cstdio>

int main() {
  const contactscope::Collider ground = contactscope::Plane{};
  const contactscope::Collider crate = contactscope::Box{{0.5, 0.4, 0.5}};
  contactscope::CollideOptions options;
  options.reducer = "none";
  options.record = true;
  options.name_a = "ground";
  options.name_b = "crate";
  const contactscope::Contacts contacts = collide(ground, {}, crate, {{0, 0.38, 0}, {}}, options);
  std::printf("contactscope %s: %s, %.3f m\n", contactscope::version(), to_string(contacts.status),
              contacts.separation);
  for (const contactscope::Manifold& manifold : contacts.manifolds) {
    std::printf("%s\n", to_string(manifold).c_str());
    contactscope::ReduceOptions three;
    three.max_points = 3;
    for (const int kept : reduce(manifold, "area", three))
      std::printf("kept %s\n", manifold.points[static_cast<std::size_t>(kept)].id.c_str());
  }

  write_trace("crate.jsonl", contacts.trace);
  const contactscope::Trace trace = contactscope::read_trace("crate.jsonl");
  try {
    write_png("crate.png", render(trace, 0));
  } catch (const contactscope::RenderError& error) {
    std::printf("no picture: %s\n", error.what());
  }
}
