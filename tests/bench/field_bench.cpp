// Signed distance fields of a wavy ball of 9,680 triangles, 1 m across, in double, on a lattice of
// the given number of cells:
//   build      milliseconds on one core, minimum of several builds; bytes
//   query      nanoseconds, mean over random points of the ball's box, and over points in the band
//   error      of the distance in the band, in millimetres: median, 99th percentile, maximum
//   exact      share of the points in the band that triangles answer
//   plate      places lost of 8,738 in the middle of a plate of half a cell, worst of eight shifts
//   bounds     number of wrong ones among random queries, mean width in cells in the band
// The same for OpenVDB's level set with a band of three cells, if installed, and the times of both
// builds on two cores, four, ... and all. Arguments: cells (64), queries for the bounds (1000000).
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>

#include "bench/field_judge.h"
#include "bench/field_openvdb.h"
#include "core/workers.h"
#include "field/distance_field.h"
#include "field/thin_plate.h"
#include "support/random_geometry.h"
#include "support/sphere_mesh.h"

namespace {

using namespace contactscope;  // NOLINT(google-build-using-namespace): a program of its own

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::vector<Vec3d> random_points(const Mesh<double>& mesh, int count) {
  test::Random random(1);
  const Aabb<double> box = mesh.tree.bounds();
  std::vector<Vec3d> points;
  for (int i = 0; i < count; ++i)
    points.emplace_back(box.lower + box.extent().cwiseProduct(random.vector(0, 1)));
  return points;
}

template <class Query> double nanoseconds(const std::vector<Vec3d>& points, const Query& query) {
  double best = 1e9, sum = 0;
  for (int round = 0; round < 5; ++round) {
    const auto start = Clock::now();
    for (const Vec3d& point : points) sum += query(point);
    best = std::min(best, seconds_since(start) * 1e9 / count_of(points));
  }
  return sum == 0.123 ? 0 : best;
}

/// `errors` are in metres; prints millimetres.
void print_errors(std::vector<double> errors) {
  std::ranges::sort(errors);
  const auto quantile = [&](double share) {
    return 1e3 * errors[static_cast<std::size_t>(share * static_cast<double>(errors.size() - 1))];
  };
  std::printf("  error %.4f %.4f %.4f mm", quantile(0.5), quantile(0.99), quantile(1));
}

/// Method of answering in cells that the surface crosses.
const char* name_of(const FieldSettings& settings) {
  if (!settings.exact) return "blend";
  return settings.smooth == 0 ? "exact" : "smooth";
}

int most_places_lost(FieldSettings settings) {
  settings.cells = test::kPlateCells;
  int most = 0;
  for (int i = 0; i < 8; ++i) most = std::max(most, test::places_lost(settings, i / 8.0));
  return most;
}

/// The minimum seconds of several builds.
double seconds_to_build(const Mesh<double>& mesh, const FieldSettings& settings,
                        PlacedField& field) {
  double least = 1e9;
  for (int round = 0; round < 5; ++round) {
    const auto start = Clock::now();
    field = build_distance_field(mesh, settings);
    least = std::min(least, seconds_since(start));
  }
  return least;
}

/// Builds of this field and of OpenVDB's take turns, so both see the same state of the machine.
void compare_threads(const Mesh<double>& mesh, FieldSettings settings) {
  const int most = hardware_threads();
  for (int threads = 1;; threads = std::min(2 * threads, most)) {
    settings.threads = threads;
    PlacedField field;
    double own = 1e9, openvdb = std::numeric_limits<double>::infinity();
    for (int round = 0; round < 3; ++round) {
      own = std::min(own, seconds_to_build(mesh, settings, field));
      openvdb = std::min(openvdb, test::seconds_to_build_openvdb(mesh, settings.cells, threads));
    }
    std::printf("%d threads: build %.1f ms", threads, 1e3 * own);
    if (std::isfinite(openvdb)) std::printf(", OpenVDB %.1f ms", 1e3 * openvdb);
    std::printf("\n");
    if (threads == most) return;
  }
}

void measure(const Mesh<double>& mesh, FieldSettings settings, const std::vector<Vec3d>& points) {
  settings.threads = 1;
  PlacedField field;
  const double build = seconds_to_build(mesh, settings, field);
  std::vector<Vec3d> in_band;
  std::vector<double> errors;
  int exact = 0;
  for (const Vec3d& point : points) {
    if (!field.field->in_band(field.in_lattice(point))) continue;
    in_band.push_back(point);
    const FieldSample sample = field.sample(point);
    exact += sample.source == FieldSample::Source::Exact ? 1 : 0;
    errors.push_back(std::abs(sample.distance - field.exact(point).distance));
  }
  const auto distance = [&](const Vec3d& point) { return field.sample(point).distance; };
  std::printf("%-10s %-6s band %d: build %6.1f ms %6.2f MB  query %5.1f ns, in band %5.1f ns",
              to_string(settings.interpolation), name_of(settings), settings.band, 1e3 * build,
              1e-6 * static_cast<double>(field.field->bytes()), nanoseconds(points, distance),
              nanoseconds(in_band, distance));
  print_errors(errors);
  std::printf("  exact %.1f %%  plate %d\n", 100.0 * exact / static_cast<double>(in_band.size()),
              most_places_lost(settings));
}

/// Tests bounds at random points of random cells, with a fixed number of points in each cell. The
/// judge shares no code with the field: it measures the nearest of all triangles.
void judge_bounds(const Mesh<double>& mesh, const FieldSettings& settings, long queries) {
  constexpr long kInCell = 256;
  const PlacedField field = build_distance_field(mesh, settings);
  const Aabb<double> box = mesh.tree.bounds();
  test::FieldJudge judge(mesh);
  test::Random random(2);
  long requested = 0, wrong = 0, in_band = 0;
  double width = 0;
  const auto start = Clock::now();
  while (requested < queries) {
    const Vec3d middle = box.center() + 0.6 * box.extent().cwiseProduct(random.vector(-1, 1));
    const Vec3d corner = field.in_lattice(middle).array().floor();
    const Vec3d first = field.origin + field.cell * corner;
    judge.look_at(first + Vec3d::Constant(0.5 * field.cell), field.cell);
    for (long k = 0; k < kInCell && requested < queries; ++k, ++requested) {
      const Vec3d point = first + field.cell * random.vector(0, 1);
      const FieldBounds bounds = field.bounds(point);
      const double truth = judge.distance(point);
      // The judge rounds too.
      const double rounding = 1e-14 * box.extent().norm();
      wrong += bounds.lower <= truth + rounding && truth - rounding <= bounds.upper ? 0 : 1;
      if (!field.field->in_band(field.in_lattice(point))) continue;
      ++in_band;
      width += (bounds.upper - bounds.lower) / field.cell;
    }
  }
  const double seconds = seconds_since(start);
  const std::vector<Vec3d> points = random_points(mesh, 1000000);
  const double time = nanoseconds(points, [&](const Vec3d& p) { return field.bounds(p).lower; });
  std::printf(
      "bounds, %s: %ld of %ld wrong, %.2f cells wide in the band, %.1f ns; judged in %.0f s\n",
      name_of(settings), wrong, requested, width / static_cast<double>(in_band), time, seconds);
}

}  // namespace

int main(int argc, char** argv) {
  const int cells = argc > 1 ? std::atoi(argv[1]) : 64;
  const long queries = argc > 2 ? std::atol(argv[2]) : 1000000;
  const Mesh<double> mesh = test::built(test::sphere_mesh(0.5, 88, 55, 0.1));
  std::printf("%d triangles, %d cells\n", mesh.triangle_count(), cells);
  const std::vector<Vec3d> points = random_points(mesh, 1000000);
  for (const auto interpolation : {FieldInterpolation::Trilinear, FieldInterpolation::Cubic}) {
    FieldSettings settings{.cells = cells, .interpolation = interpolation, .smooth = kSmoothPart};
    measure(mesh, settings, points);
    settings.smooth = 0;
    measure(mesh, settings, points);
    settings.exact = false;
    measure(mesh, settings, points);
  }
  measure(mesh, {.cells = cells, .band = 1, .smooth = kSmoothPart}, points);
  measure(mesh, {.cells = cells, .band = 0, .smooth = kSmoothPart}, points);
  test::measure_openvdb(mesh, cells, points);
  compare_threads(
      mesh,
      {.cells = cells, .interpolation = FieldInterpolation::Trilinear, .smooth = kSmoothPart});
  // Half of the queries are in the band, where the surface's cells know the distance.
  judge_bounds(mesh, {.cells = cells, .exact = false}, queries / 2);
  judge_bounds(mesh, {.cells = cells, .smooth = kSmoothPart}, queries - queries / 2);
  return 0;
}
