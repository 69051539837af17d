#include "dynamics/solver.h"
#include "geometry/hull_builder.h"
#include "geometry/mesh_seams.h"
#include "geometry/primitives.h"
#include "study/random_cases.h"
#include "study/study.h"

namespace contactscope {
namespace {

constexpr double kTile = 0.1;         // metres, edge of a tile of the floors
constexpr double kRunLength = 2;      // metres that a shape slides, about the middle of the runway
constexpr double kRunway = 3;         // metres, half of its length
constexpr double kRunwaySide = 1;     // metres, half of its width
constexpr double kWideWeld = 1.5e-4;  // of 3 m: wider than two cracks of 0.1 mm
constexpr float kGhostFrame = 1.0F / 60;
constexpr std::array<double, 4> kGhostSpeeds = {1, 3, 6, 12};  // m/s

using Floor = std::vector<Shape<double>>;

/// With the seams between its parts.
Floor joined(Floor floor) {
  std::vector<PlacedSurface> parts;
  for (Shape<double>& part : floor) parts.push_back({&part, Pose<double>()});
  join_seams(parts);
  return floor;
}

/// A mesh of rectangles that share no vertex. Each is given by its corners in x and z, low and high.
class Tiles {
 public:
  void add(double low_x, double low_z, double high_x, double high_z) {
    const int first = count_of(vertices_);
    for (const auto& [x, z] :
         {std::pair(low_x, low_z), {low_x, high_z}, {high_x, high_z}, {high_x, low_z}})
      vertices_.emplace_back(x, 0, z);
    triangles_.push_back({first, first + 1, first + 2});
    triangles_.push_back({first, first + 2, first + 3});
  }

  /// With each vertex off by up to `crack` metres in each direction.
  Mesh<double> mesh(double crack = 0) && {
    std::mt19937_64 engine = case_engine(1, 0, crack, 0);
    for (Vec3d& vertex : vertices_)
      for (double& coordinate : vertex) coordinate += uniform(engine, -crack, crack);
    return build_mesh(std::move(vertices_), std::move(triangles_));
  }

 private:
  std::vector<Vec3d> vertices_;
  std::vector<std::array<int, 3>> triangles_;
};

/// Tiles from `begin` to `end` along x; those of every other row are shifted by `shift` tiles.
Tiles rows_of(double begin, double end, double shift = 0) {
  Tiles tiles;
  const int rows = static_cast<int>(std::round(2 * kRunwaySide / kTile));
  for (int row = 0; row < rows; ++row) {
    const double z = -kRunwaySide + row * kTile;
    double from = begin;
    for (int i = 1; from < end; ++i) {
      const double to = std::min(end, begin + (i - (row % 2 == 1 ? shift : 0)) * kTile);
      if (end - to < 0.01 * kTile) {
        tiles.add(from, z, end, z + kTile);
        break;
      }
      tiles.add(from, z, to, z + kTile);
      from = to;
    }
  }
  return tiles;
}

struct GhostFloor {
  const char* name;
  Floor (*make)();
};

/// All are flat at height 0: nothing may happen to what slides over them without friction.
constexpr GhostFloor kGhostFloors[] = {
    {"half-space",
     [] {
       return Floor{HalfSpace<double>{{Vec3d::UnitY(), 0}}};
     }},
    {"one mesh", [] { return Floor{rows_of(-kRunway, kRunway).mesh()}; }},
    {"boxes",
     [] {
       Floor floor;
       for (double x = -kRunway; x < kRunway; x += 0.5) {
         std::vector<Vec3d> corners;
         for (const double side_x : {x, x + 0.5})
           for (const double y : {-0.5, 0.0})
             for (const double z : {-kRunwaySide, kRunwaySide}) corners.emplace_back(side_x, y, z);
         floor.emplace_back(build_hull(corners));
       }
       return floor;
     }},
    {"cracks of 1 nm", [] { return Floor{rows_of(-kRunway, kRunway).mesh(1e-9)}; }},
    {"cracks of 1 µm", [] { return Floor{rows_of(-kRunway, kRunway).mesh(1e-6)}; }},
    {"cracks of 0.1 mm", [] { return Floor{rows_of(-kRunway, kRunway).mesh(1e-4)}; }},
    {"cracks of 0.1 mm, welded",
     [] {
       Mesh<double> floor = rows_of(-kRunway, kRunway).mesh(1e-4);
       weld(floor, kWideWeld);
       return Floor{std::move(floor)};
     }},
    {"T-junctions", [] { return Floor{rows_of(-kRunway, kRunway, 0.5).mesh()}; }},
    {"two meshes",
     [] {
       return Floor{rows_of(-kRunway, 0.033).mesh(), rows_of(0.033, kRunway).mesh()};
     }},
};

struct GhostSlider {
  const char* name;
  Shape<double> shape;
  double height;  // metres, of its centre above the floor
};

std::vector<GhostSlider> ghost_sliders() {
  const Capsule<double> lying{{Vec3d(0, 0, -0.2), Vec3d(0, 0, 0.2)}, 0.1};
  const Vec3d half(0.3, 0.15, 0.2);
  return {{"sphere", Sphere<double>{0.2}, 0.2},
          {"box", make_box(half), half.y()},
          {"lying capsule", lying, 0.1},
          {"cylinder", make_cylinder(0.2, 0.15, 24), 0.15}};
}

struct Slide {
  double thrown = 0;  // metres above the start, at most
  double slowed = 0;  // share of the speed that is lost
};

Slide slide(const Floor& floor, const GhostSlider& slider, double speed) {
  World<float> world;
  std::vector<Shape<float>> shapes;
  const double turn = 0.1;  // radians about the vertical: no edge is parallel to one of the floor
  const Pose<double> start{Quatd(Eigen::AngleAxisd(turn, Vec3d::UnitY())),
                           Vec3d(-0.5 * kRunLength, slider.height, 0.013)};
  shapes.push_back(shape_cast<float>(slider.shape));
  world.bodies.push_back(
      dynamic_body<float>(start.cast<float>(), with_mass(*mass_properties(slider.shape), 1)));
  Body<float>& body = world.bodies.front();
  body.velocity.x() = static_cast<float>(speed);
  for (const Shape<double>& part : floor) {
    shapes.push_back(shape_cast<float>(part));
    world.bodies.push_back(static_body<float>({}));
    WorldPair<float>& pair = world.pairs.emplace_back();
    pair.b = count_of(world.bodies) - 1;
    pair.friction = 0;
  }
  const float height = world.bodies.front().center.y();
  std::vector<Manifolds<float>> contacts;
  Slide result;
  const int frames = static_cast<int>(std::ceil(kRunLength / speed * 60));
  for (int frame = 0; frame < frames; ++frame) {
    step(world, shapes, SolverSettings{}, kGhostFrame, contacts);
    const Body<float>& now = world.bodies.front();
    result.thrown = std::max(result.thrown, static_cast<double>(now.center.y() - height));
    result.slowed = std::max(result.slowed, 1 - static_cast<double>(now.velocity.x()) / speed);
  }
  return result;
}

}  // namespace

/// Shapes that slide 2 m over flat floors without friction, at 60 steps a second: how far a floor
/// throws them up, and how much it slows them. Right is nothing. Floors are meshes of 10 cm tiles,
/// with and without shared vertices, and bodies that share a face plane (ghost collisions).
std::vector<trace::Study> study_ghosts(const StudyOptions& options, const StudyProgress& progress) {
  std::vector<trace::Study> results = results_of(
      "ghost", "float", "m/s", "sliding without friction, 2 m, 60 steps a second",
      {{"thrown", "How high flat floors throw what slides over them", "height", "m", 1e-5},
       {"slowed", "How much flat floors slow what slides over them", "share of the speed", "",
        1e-6}},
      trace::StudyForm::Curves);
  const std::vector<GhostSlider> sliders = ghost_sliders();
  const StudyStep report =
      counted(progress, count_of(sliders) * static_cast<int>(std::size(kGhostFloors)));
  for (const GhostSlider& slider : sliders) {
    const StudyLines lines(results, kGhostFloors, slider.name, "m/s");
    for (std::size_t i = 0; i < std::size(kGhostFloors); ++i) {
      report(slider.name + std::string(" on ") + kGhostFloors[i].name);
      const Floor floor = joined(kGhostFloors[i].make());
      for (const double speed : kGhostSpeeds) {
        Measurement measured(2, 1);
        measured.times.measure(options.repetitions.value_or(1), 1, [&](int) {
          const Slide found = slide(floor, slider, speed);
          measured.errors[0] = measured.errors[1] = {};
          measured.errors[0].add(found.thrown);
          measured.errors[1].add(found.slowed);
          return found.thrown;
        });
        lines.add(i, speed, measured);
      }
    }
  }
  return results;
}

}  // namespace contactscope
