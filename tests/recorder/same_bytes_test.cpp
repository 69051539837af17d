// The same calls of the recorders in C and in Python give the same file.

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "recorder/contactscope.h"
#include "support/random_geometry.h"
#include "trace/json.h"

namespace contactscope {
namespace {

/// A number as Python reads it.
std::string py(double value) {
  if (std::isnan(value)) return "float('nan')";
  if (std::isinf(value)) return value > 0 ? "float('inf')" : "-float('inf')";
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}
std::string py(int value) { return std::to_string(value); }
std::string py(bool value) { return value ? "True" : "False"; }
std::string py(const char* text) {
  return text == nullptr ? "None" : nlohmann::json(text).dump(-1, ' ', true);
}
std::string py(const Vec3d& v);
template <class List> std::string py_list(const List& values) {
  std::string text = "[";
  for (const auto& value : values) text += py(value) + ",";
  return text + "]";
}
std::string py(const Vec3d& v) { return py_list(v); }
template <class... Values> std::string call(const std::string& name, const Values&... values) {
  std::string text = "r." + name + "(";
  ((text += (text.back() == '(' ? "" : ", ") + py(values)), ...);
  return text + ")\n";
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A random recording: calls of the C functions, and a Python script of the same calls.
class TwoRecordings {
 public:
  TwoRecordings(std::uint64_t seed, const std::filesystem::path& folder) : random_(seed) {
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
    script_ = "r = Recorder(" + py((folder / (name + ".py")).c_str()) +
              ", 'mine/stack', 'My \"engine\"', doubles=" + py(settings.doubles == 1) +
              ", z_up=" + py(settings.z_up == 1) + ", poses_at=" + py(moments[settings.poses_at]) +
              ", force_step=" + py(settings.force_step) +
              ", friction_on_a=" + py(settings.friction_on_a == 1) + ")\n";
    for (int i = 0; i < 6; ++i) add_shape();
    for (int frame = 0; frame < 4; ++frame) record_frame(frame);
    cs_stop(r_);
    script_ += "r.stop()\n";
  }

  const std::string& script() const { return script_; }

 private:
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
        script_ += call("box", name, one.x(), one.y(), one.z());
        break;
      case 1:
        cs_sphere(r_, name, size);
        script_ += call("sphere", name, size);
        break;
      case 2:
        cs_capsule(r_, name, one.data(), two.data(), size);
        script_ += call("capsule", name, one, two, size);
        break;
      case 3: {
        const std::vector<Vec3d> corners = {one, two, vector(), vector()};
        cs_hull(r_, name, corners[0].data(), 4);
        script_ += "r.hull(" + py(name) + ", " + py_list(corners) + ")\n";
        break;
      }
      case 4:
        cs_cylinder(r_, name, axis, size, other);
        script_ += call("cylinder", name, axis, size, other);
        break;
      case 5:
        cs_cone(r_, name, axis, size, other);
        script_ += call("cone", name, axis, size, other);
        break;
      case 6:
        cs_plane(r_, name, one.data(), size);
        script_ += call("plane", name, one, size);
        break;
      case 7: {
        const std::array heights = {number(), number(), number(), number(), number(), number()};
        cs_height_field(r_, name, heights.data(), 3, 2, size);
        script_ += "r.height_field(" + py(name) + ", [" + py_list(std::span(heights).first(3)) +
                   "," + py_list(std::span(heights).last(3)) + "], " + py(size) + ")\n";
        break;
      }
      default:
        cs_compound(r_, name);
        script_ += call("compound", name);
        if (shapes_ > 0) {
          const int part = random_.index(shapes_);
          const std::array<double, 4> turn = rotation();
          cs_part(r_, shapes_, part, one.data(), turn.data());
          script_ += "r.part(" + py(shapes_) + ", " + py(part) + ", " + py(one) + ", " +
                     py_list(turn) + ")\n";
        }
    }
    if (random_.chance(0.3)) {
      cs_margin(r_, shapes_, size);
      script_ += call("margin", shapes_, size);
    }
    ++shapes_;
  }

  void record_frame(int frame) {
    const double time = frame / 60.0;
    cs_begin_frame(r_, time);
    script_ += call("begin_frame", time);
    if (random_.chance(0.5)) add_shape();
    for (int shape = 0; shape < shapes_; ++shape) {
      if (random_.chance(0.2)) continue;
      const Vec3d place = vector();
      const std::array<double, 4> turn = rotation();
      cs_pose(r_, shape, place.data(), turn.data());
      script_ += "r.pose(" + py(shape) + ", " + py(place) + ", " + py_list(turn) + ")\n";
    }
    for (int i = 0; i < 5; ++i) record_manifold();
    for (int i = 0; i < 2; ++i) {
      const int shape = (frame + i) % shapes_;
      const double mass = number();
      const Vec3d center = vector(), velocity = vector(), spin = vector();
      cs_body(r_, shape, mass, center.data(), velocity.data(), spin.data());
      script_ += call("body", shape, mass, center, velocity, spin);
    }
    if (random_.chance(0.5)) {
      const int iterations = random_.index(50), substeps = random_.index(5);
      const bool warm = random_.chance(0.5);
      cs_solver(r_, iterations, substeps, warm);
      script_ += call("solver", iterations, substeps, warm);
    }
    cs_end_frame(r_);
    script_ += call("end_frame");
  }

  void record_manifold() {
    const int a = random_.index(shapes_), b = (a + 1 + random_.index(shapes_ - 1)) % shapes_;
    const int triangle = random_.chance(0.3) ? random_.index(100) : -1;
    const Vec3d normal = random_.unit_vector();
    std::vector<cs_point> points;
    std::string list;
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
      list += "Point(" + py(place) + ", " + py(point.separation);
      if (point.has_sides) list += ", on_a=" + py(on_a) + ", on_b=" + py(on_b);
      if (point.has_impulse)
        list += ", impulse=" + py(point.impulse) + ", friction=" + py(friction);
      if (point.has_id) list += ", id=" + std::to_string(point.id);
      list += ", idle=" + py(point.idle == 1) + "),";
    }
    cs_manifold(r_, a, b, normal.data(), triangle, points.data(), static_cast<int>(points.size()));
    script_ += "r.manifold(" + py(a) + ", " + py(b) + ", " + py(normal) + ", [" + list + "], " +
               py(triangle) + ")\n";
  }

  test::Random random_;
  cs_recorder* r_ = nullptr;
  std::string script_;
  int shapes_ = 0;
};

class PythonRecorder : public ::testing::Test {
 protected:
  PythonRecorder() {
    if (std::system("python3 -c 'import dataclasses' 2> /dev/null") != 0) return;
    std::filesystem::create_directories(folder_);
    has_python_ = true;
  }
  ~PythonRecorder() override { std::filesystem::remove_all(folder_); }

  /// Runs a script; what it writes.
  std::string output_of(const std::string& script) const {
    const std::filesystem::path file = folder_ / "script.py", said = folder_ / "said";
    std::ofstream(file) << "import sys\nsys.path.insert(0, "
                        << py(CONTACTSCOPE_SOURCE_DIR "/src/recorder")
                        << ")\nfrom contactscope import Point, Recorder\n"
                        << script;
    const std::string command = "python3 -B " + file.string() + " > " + said.string() + " 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << text_of(said);
    return text_of(said);
  }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("python_recorder_" + std::to_string(::getpid()));
  bool has_python_ = false;
};

TEST_F(PythonRecorder, WritesTheSameBytesAsTheOneInC) {
  if (!has_python_) GTEST_SKIP() << "python3 is not installed";
  constexpr std::uint64_t kSeeds = 12;
  std::string script;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed)
    script += TwoRecordings(seed, folder_).script();
  EXPECT_EQ(output_of(script), "");
  std::size_t bytes = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const std::string in_c = text_of(folder_ / (std::to_string(seed) + ".c"));
    ASSERT_EQ(text_of(folder_ / (std::to_string(seed) + ".py")), in_c) << "seed " << seed;
    bytes += in_c.size();
  }
  EXPECT_GT(bytes, 50000u);
}

TEST_F(PythonRecorder, SaysWhatIsWrong) {
  if (!has_python_) GTEST_SKIP() << "python3 is not installed";
  const std::pair<const char*, const char*> cases[] = {
      {"r.pose(ball, (0, 0, 0))", "no frame has begun; call begin_frame(time) first"},
      {"r.begin_frame(0); r.pose(7, (0, 0, 0))", "there is no shape 7; pass the number"},
      {"r.begin_frame(0); r.pose(ball, (0, 0))", "position has 2 numbers, not 3"},
      {"r.begin_frame(0); r.manifold(ball, ball, (0, 1, 0), [])", "a manifold is of two shapes"},
      {"r.begin_frame(0); r.manifold(ball, other, (0, 1, 0), [Point((0, 0, 0), 0, on_a=(0, 0, "
       "0))])",
       "on_a and on_b, or none"},
      {"r.mesh('m', [(0, 0, 0)], [(0, 1, 2)])", "not three indices of its 1 vertices"},
      {"r.cone('c', 3, 1, 1)", "axis 3 is not 0, 1 or 2"},
      {"Recorder('x.jsonl', 'a/b', poses_at='later')", "write 'contacts', 'before_step'"}};
  std::string script;
  for (const auto& [wrong, message] : cases)
    script +=
        std::string("try:\n  with Recorder(") + py((folder_ / "py.jsonl").c_str()) +
        ", 'mine/stack') as r:\n    ball, other = r.sphere('ball', 1), r.sphere('other', 1)\n    " +
        wrong + "\nexcept ValueError as error:\n  print(error)\n";
  std::istringstream said(output_of(script));
  for (const auto& [wrong, message] : cases) {
    std::string line;
    std::getline(said, line);
    EXPECT_NE(line.find(message), std::string::npos) << wrong << ": " << line;
  }
  std::istringstream in(text_of(folder_ / "py.jsonl"));  // what was recorded before is whole
  EXPECT_EQ(trace::read_trace(in, "run.jsonl").header.shapes.size(), 2u);
}

}  // namespace
}  // namespace contactscope
