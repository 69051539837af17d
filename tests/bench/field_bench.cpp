// Signed distance fields of a wavy ball of 9,680 triangles, 1 m across, double; of a lattice of so many
// cells:
//   build      milliseconds, the least of several; bytes
//   query      nanoseconds, the mean of random points of the ball's box, and of points in the band
//   error      of the distance in millimetres: of the points in the band half, 99 % and all are better
//   bounds     wrong ones among random queries, their mean width in cells in the band
// Arguments: cells (64), queries for the bounds (1000000).
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "field/distance_field.h"
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

template <class Query>
double nanoseconds(const std::vector<Vec3d>& points, const Query& query) {
  double best = 1e9, sum = 0;
  for (int round = 0; round < 5; ++round) {
    const auto start = Clock::now();
    for (const Vec3d& point : points) sum += query(point);
    best = std::min(best, seconds_since(start) * 1e9 / count_of(points));
  }
  return sum == 0.123 ? 0 : best;
}

/// In millimetres, of distances given in metres.
void print_errors(std::vector<double> errors) {
  std::ranges::sort(errors);
  const auto quantile = [&](double share) {
    return 1e3 * errors[static_cast<std::size_t>(share * static_cast<double>(errors.size() - 1))];
  };
  std::printf("  error %.4f %.4f %.4f mm", quantile(0.5), quantile(0.99), quantile(1));
}

void measure(const Mesh<double>& mesh, const FieldSettings& settings,
             const std::vector<Vec3d>& points) {
  double build = 1e9;
  PlacedField field;
  for (int round = 0; round < 5; ++round) {
    const auto start = Clock::now();
    field = build_distance_field(mesh, settings);
    build = std::min(build, seconds_since(start));
  }
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
              to_string(settings.interpolation), settings.exact ? "exact" : "", settings.band,
              1e3 * build, 1e-6 * static_cast<double>(field.field->bytes()),
              nanoseconds(points, distance), nanoseconds(in_band, distance));
  print_errors(errors);
  std::printf("  exact %.1f %%\n", 100.0 * exact / static_cast<double>(in_band.size()));
}

void judge_bounds(const Mesh<double>& mesh, int cells, long queries) {
  const PlacedField field = build_distance_field(mesh, {.cells = cells, .exact = false});
  const Aabb<double> box = mesh.tree.bounds();
  test::Random random(2);
  long wrong = 0, in_band = 0;
  double width = 0, time = 0;
  for (long i = 0; i < queries; ++i) {
    const Vec3d point = box.center() + 0.6 * box.extent().cwiseProduct(random.vector(-1, 1));
    const FieldBounds bounds = field.bounds(point);
    const double truth = field.exact(point).distance;
    wrong += bounds.lower <= truth && truth <= bounds.upper ? 0 : 1;
    if (!field.field->in_band(field.in_lattice(point))) continue;
    ++in_band;
    width += (bounds.upper - bounds.lower) / field.cell;
  }
  const std::vector<Vec3d> points = random_points(mesh, 1000000);
  time = nanoseconds(points, [&](const Vec3d& point) { return field.bounds(point).lower; });
  std::printf("bounds: %ld of %ld wrong, %.2f cells wide in the band, %.1f ns\n", wrong, queries,
              width / static_cast<double>(in_band), time);
}

}  // namespace

int main(int argc, char** argv) {
  const int cells = argc > 1 ? std::atoi(argv[1]) : 64;
  const long queries = argc > 2 ? std::atol(argv[2]) : 1000000;
  const Mesh<double> mesh = test::built(test::sphere_mesh(0.5, 88, 55, 0.1));
  std::printf("%d triangles, %d cells\n", mesh.triangle_count(), cells);
  const std::vector<Vec3d> points = random_points(mesh, 1000000);
  for (const auto interpolation : {FieldInterpolation::Trilinear, FieldInterpolation::Cubic}) {
    for (const bool exact : {false, true}) {
      measure(mesh, {.cells = cells, .interpolation = interpolation, .exact = exact}, points);
    }
  }
  measure(mesh, {.cells = cells, .band = 1}, points);
  measure(mesh, {.cells = cells, .band = 0}, points);
  judge_bounds(mesh, cells, queries);
  return 0;
}
