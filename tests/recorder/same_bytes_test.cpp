// The same calls of the recorders in C, Python and JavaScript give the same file.

#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>

#include "recorder/contactscope.h"
#include "scripts.h"
#include "support/random_geometry.h"

namespace contactscope {
namespace {

/// A value as Python and as JavaScript read it.
struct Value {
  std::string py, js;
};

Value both(const std::string& text) { return {text, text}; }
Value value(double number) {
  if (std::isnan(number)) return {"float('nan')", "NaN"};
  if (std::isinf(number))
    return number > 0 ? Value{"float('inf')", "Infinity"} : Value{"-float('inf')", "-Infinity"};
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", number);
  return both(text);
}
Value value(int number) { return both(std::to_string(number)); }
Value value(bool is) { return is ? Value{"True", "true"} : Value{"False", "false"}; }
Value value(const char* text) {
  if (text == nullptr) return {"None", "null"};
  return both(nlohmann::json(text).dump(-1, ' ', true));
}
Value value(const Value& text) { return text; }
/// A tuple, and a vector of an engine.
Value value(const Vec3d& v) {
  const Value x = value(v.x()), y = value(v.y()), z = value(v.z());
  return {"(" + x.py + "," + y.py + "," + z.py + ")",
          "{x:" + x.js + ",y:" + y.js + ",z:" + z.js + "}"};
}
template <class Items> Value list(const Items& items) {
  Value text = both("[");
  for (const auto& item : items) {
    const Value one = value(item);
    text.py += one.py + ",";
    text.js += one.js + ",";
  }
  return {text.py + "]", text.js + "]"};
}

/// "begin_frame" as "beginFrame".
std::string camel_case(std::string_view name) {
  std::string text;
  for (std::size_t i = 0; i < name.size(); ++i)
    text += name[i] == '_' ? static_cast<char>(std::toupper(name[++i])) : name[i];
  return text;
}

/// A random recording: calls of the C functions, and scripts of the same calls.
class SameRecordings {
 public:
  SameRecordings(std::uint64_t seed, const std::filesystem::path& folder) : random_(seed) {
    cs_settings settings{};
    settings.doubles = random_.chance(0.7);
    settings.z_up = random_.chance(0.5);
    settings.poses_at = random_.index(3);
    settings.force_step = random_.chance(0.3) ? random_.uniform(1e-3, 0.1) : 0;
    settings.friction_on_a = random_.chance(0.3);
    const char* const moments[] = {"contacts", "before_step", "after_step"};
    const std::string name = std::to_string(seed);
    r_ = cs_start((folder / (name + ".c")).c_str(), "mine/stack", "My \"engine\"", nullptr,
                  &settings);
    const Value doubles = value(settings.doubles == 1), z_up = value(settings.z_up == 1),
                poses_at = value(moments[settings.poses_at]),
                force_step = value(settings.force_step),
                friction_on_a = value(settings.friction_on_a == 1);
    script_.py = "r = Recorder('" + name +
                 ".py', 'mine/stack', 'My \"engine\"', doubles=" + doubles.py +
                 ", z_up=" + z_up.py + ", poses_at=" + poses_at.py +
                 ", force_step=" + force_step.py + ", friction_on_a=" + friction_on_a.py + ")\n";
    script_.js = "r = new Recorder('" + name + ".mjs', 'mine/stack', {engine: 'My \"engine\"', " +
                 "doubles: " + doubles.js + ", zUp: " + z_up.js + ", posesAt: " + poses_at.js +
                 ", forceStep: " + force_step.js + ", frictionOnA: " + friction_on_a.js + "});\n";
    for (int i = 0; i < 6; ++i) add_shape();
    for (int frame = 0; frame < 4; ++frame) record_frame(frame);
    cs_stop(r_);
    call("stop");
  }

  const Value& script() const { return script_; }

 private:
  /// Adds a call to the scripts.
  template <class... Arguments> void call(const char* name, const Arguments&... arguments) {
    Value line{std::string("r.") + name + "(", "r." + camel_case(name) + "("};
    for (const Value& one : std::vector<Value>{value(arguments)...}) {
      line.py += one.py + ",";
      line.js += one.js + ",";
    }
    script_.py += line.py + ")\n";
    script_.js += line.js + ");\n";
  }

  /// A number of any size, sometimes round, zero or not a number.
  double number() {
    const double sign = random_.chance(0.5) ? 1 : -1;
    switch (random_.index(8)) {
      case 0:
        return 0;
      case 1:
        return sign * random_.index(2000) / 64.0;
      case 2:
        return sign * std::pow(10.0, random_.index(24) - 12);
      case 3:
        return random_.chance(0.05) ? std::nan("") : sign * random_.decade(-300, 300);
      default:
        return sign * random_.decade(-12, 11);
    }
  }
  Vec3d vector() {
    const double x = number(), y = number();
    return {x, y, number()};
  }
  std::array<double, 4> rotation() {
    const Quatd q = random_.rotation();
    return {q.w(), q.x(), q.y(), q.z()};
  }

  void add_shape() {
    const char* const names[] = {nullptr, "crate", "\"a\\b\"\n\t\x01", "K\xc3\xb6rper", "crate 2"};
    const char* const name = names[random_.index(5)];
    const double size = std::abs(number()), other = std::abs(number());
    const int axis = random_.index(3);
    const Vec3d one = vector(), two = vector();
    switch (random_.index(9)) {
      case 0:
        cs_box(r_, name, one.x(), one.y(), one.z());
        call("box", name, one.x(), one.y(), one.z());
        break;
      case 1:
        cs_sphere(r_, name, size);
        call("sphere", name, size);
        break;
      case 2:
        cs_capsule(r_, name, one.data(), two.data(), size);
        call("capsule", name, one, two, size);
        break;
      case 3: {
        const std::vector<Vec3d> corners = {one, two, vector(), vector()};
        cs_hull(r_, name, corners[0].data(), 4);
        call("hull", name, list(corners));
        break;
      }
      case 4:
        cs_cylinder(r_, name, axis, size, other);
        call("cylinder", name, axis, size, other);
        break;
      case 5:
        cs_cone(r_, name, axis, size, other);
        call("cone", name, axis, size, other);
        break;
      case 6:
        cs_plane(r_, name, one.data(), size);
        call("plane", name, one, size);
        break;
      case 7: {
        const std::array heights = {number(), number(), number(), number(), number(), number()};
        cs_height_field(r_, name, heights.data(), 3, 2, size);
        call("height_field", name,
             list(std::array{list(std::span(heights).first(3)), list(std::span(heights).last(3))}),
             size);
        break;
      }
      default:
        cs_compound(r_, name);
        call("compound", name);
        if (shapes_ > 0) {
          const int part = random_.index(shapes_);
          const std::array<double, 4> turn = rotation();
          cs_part(r_, shapes_, part, one.data(), turn.data());
          call("part", shapes_, part, one, list(turn));
        }
    }
    if (random_.chance(0.3)) {
      cs_margin(r_, shapes_, size);
      call("margin", shapes_, size);
    }
    ++shapes_;
  }

  void record_frame(int frame) {
    const double time = frame / 60.0;
    cs_begin_frame(r_, time);
    call("begin_frame", time);
    if (random_.chance(0.5)) add_shape();
    for (int shape = 0; shape < shapes_; ++shape) {
      if (random_.chance(0.2)) continue;
      const Vec3d place = vector();
      const std::array<double, 4> turn = rotation();
      cs_pose(r_, shape, place.data(), turn.data());
      call("pose", shape, place, list(turn));
    }
    for (int i = 0; i < 5; ++i) record_manifold();
    for (int i = 0; i < 2; ++i) {
      const int shape = (frame + i) % shapes_;
      const double mass = number();
      const Vec3d center = vector(), velocity = vector(), spin = vector();
      cs_body(r_, shape, mass, center.data(), velocity.data(), spin.data());
      call("body", shape, mass, center, velocity, spin);
    }
    if (random_.chance(0.5)) {
      const int iterations = random_.index(50), substeps = random_.index(5);
      const bool warm = random_.chance(0.5);
      cs_solver(r_, iterations, substeps, warm);
      call("solver", iterations, substeps, warm);
    }
    cs_end_frame(r_);
    call("end_frame");
  }

  void record_manifold() {
    const int a = random_.index(shapes_), b = (a + 1 + random_.index(shapes_ - 1)) % shapes_;
    const int triangle = random_.chance(0.3) ? random_.index(100) : -1;
    const Vec3d normal = random_.unit_vector();
    std::vector<cs_point> points;
    std::vector<Value> scripted;
    for (int i = random_.index(4); i >= 0; --i) {
      cs_point point{};
      const Vec3d place = random_.vector(-9, 9), on_a = vector(), on_b = vector(),
                  friction = vector();
      std::copy_n(place.data(), 3, point.position);
      std::copy_n(on_a.data(), 3, point.on_a);
      std::copy_n(on_b.data(), 3, point.on_b);
      std::copy_n(friction.data(), 3, point.friction);
      point.separation = number();
      point.impulse = number();
      point.has_sides = random_.chance(0.5);
      point.has_impulse = random_.chance(0.5);
      point.has_id = random_.chance(0.5);
      point.idle = random_.chance(0.2);
      point.id = random_.chance(0.5) ? ~std::uint64_t{0} : std::uint64_t(random_.index(1000));
      points.push_back(point);
      Value text{"Point(", "{"};
      const auto set = [&](const char* key, const Value& is) {
        text.py += std::string(key) + "=" + is.py + ",";
        text.js += camel_case(key) + ":" + is.js + ",";
      };
      set("position", value(place));
      set("separation", value(point.separation));
      if (point.has_sides) set("on_a", value(on_a)), set("on_b", value(on_b));
      if (point.has_impulse) set("impulse", value(point.impulse)), set("friction", value(friction));
      const std::string id = std::to_string(point.id);
      if (point.has_id) set("id", {id, point.id > 1000 ? id + "n" : id});
      set("idle", value(point.idle == 1));
      scripted.push_back({text.py + ")", text.js + "}"});
    }
    cs_manifold(r_, a, b, normal.data(), triangle, points.data(), static_cast<int>(points.size()));
    call("manifold", a, b, normal, list(scripted), triangle);
  }

  test::Random random_;
  cs_recorder* r_ = nullptr;
  Value script_;
  int shapes_ = 0;
};

TEST_P(Scripts, WriteTheSameBytesAsC) {
  constexpr std::uint64_t kSeeds = 12;
  std::string script = is_python() ? "" : "let r;\n";
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const SameRecordings recordings(seed, folder_.path());
    script += is_python() ? recordings.script().py : recordings.script().js;
  }
  EXPECT_EQ(output_of(script), "");
  std::size_t bytes = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const std::string in_c = read_text(folder_ / (std::to_string(seed) + ".c"));
    ASSERT_EQ(read_text(folder_ / (std::to_string(seed) + GetParam().ending)), in_c)
        << "seed " << seed;
    bytes += in_c.size();
  }
  EXPECT_GT(bytes, 50000u);
}

}  // namespace
}  // namespace contactscope
