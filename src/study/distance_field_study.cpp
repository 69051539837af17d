#include "manifold/field_contact.h"
#include "study/peers.h"
#include "study/study.h"

namespace contactscope {
namespace {

constexpr int kFieldPoints = 2000;
constexpr int kFieldRepetitions = 9;
constexpr int kFieldMeridians = 100;  // 9,800 triangles
constexpr double kWaves = 0.1;
constexpr double kByTheSurface = 0.02;  // metres
constexpr int kFieldCells[] = {16, 32, 64, 128};
constexpr int kBands[] = {1, 2, 4, 8, 16};
constexpr int kBandCells = 64;
constexpr int kPeerBand = 3;  // cells on each side, as in other libraries

constexpr double kPokes[] = {0.01, 0.1, 1};        // depth of a sphere in a box, in cells
constexpr double kSpacings[] = {0.5, 1, 2, 4, 8};  // distance between points, in cells
constexpr int kSphereCells = 32;
constexpr int kPokeCases = 1000;

constexpr double kThicknesses[] = {0.125, 0.25, 0.5, 0.75, 1, 1.5};  // cells
constexpr int kPlateCells = 16;
constexpr int kPlates = 40;        // per thickness, at random heights
constexpr int kPlatePlaces = 200;  // per plate

struct FieldMethod {
  const char* name;
  FieldInterpolation interpolation;
  bool exact;
  double smooth = 0;

  FieldSettings settings() const {
    // Measure a single thread.
    return {.interpolation = interpolation, .exact = exact, .smooth = smooth, .threads = 1};
  }
};
constexpr FieldMethod kFieldMethods[] = {
    {"trilinear", FieldInterpolation::Trilinear, false},
    {"cubic", FieldInterpolation::Cubic, false},
    {"trilinear with exact cells", FieldInterpolation::Trilinear, true},
    {"cubic with exact cells where needed", FieldInterpolation::Cubic, true, kSmoothPart},
    {"cubic with exact cells", FieldInterpolation::Cubic, true},
};

/// `gradient` of any length, `truth` unit.
double degrees_between(const Vec3d& gradient, const Vec3d& truth) {
  const double cosine = gradient.stableNormalized().dot(truth);
  return 180 / std::numbers::pi * std::acos(std::clamp(cosine, -1.0, 1.0));
}

/// Measures: metres, degrees, megabytes, milliseconds to build.
Measurement judge_field(const Mesh<double>& mesh, const std::vector<TruePoint>& points,
                        const FieldSettings& settings, int repetitions) {
  Measurement measured(4, count_of(points));
  PassTimes build;
  PlacedField field;
  build.measure(std::min(repetitions, 3), 1, [&](int) {
    field = build_distance_field(mesh, settings);
    return field.cell;
  });
  for (const TruePoint& point : points) {
    const FieldSample sample = field.sample(point.place);
    measured.errors[0].add(std::abs(sample.distance - point.distance));
    measured.errors[1].add(degrees_between(sample.gradient, point.gradient));
  }
  measured.errors[2].add(1e-6 * static_cast<double>(field.field->bytes()));
  measured.errors[3].add(1e-6 * build.summary().min);
  measured.times.measure(repetitions, count_of(points),
                         [&](int k) { return field.sample(at(points, k).place).distance; });
  return measured;
}

/// Points at most kByTheSurface from the surface, where contacts query.
std::vector<Vec3d> places_by_surface(std::mt19937_64& engine, const Mesh<double>& mesh, int count) {
  std::vector<Vec3d> places;
  for (int i = 0; i < count; ++i) {
    const auto [a, b, c] =
        at(mesh.triangles, std::uniform_int_distribution(0, mesh.triangle_count() - 1)(engine));
    const double u = std::sqrt(uniform(engine, 0, 1)), v = uniform(engine, 0, 1);
    const Vec3d on_surface = (1 - u) * at(mesh.vertices, a) + u * (1 - v) * at(mesh.vertices, b) +
                             u * v * at(mesh.vertices, c);
    const Vec3d away = uniform_rotation(engine) * Vec3d(uniform(engine, 0, kByTheSurface), 0, 0);
    places.push_back(on_surface + away);
  }
  return places;
}

std::vector<Vec3d> places_in_box(std::mt19937_64& engine, const Mesh<double>& mesh, int count) {
  const Aabb<double> box = mesh.tree.bounds();
  std::vector<Vec3d> places;
  for (int i = 0; i < count; ++i) {
    Vec3d part;
    for (int k = 0; k < 3; ++k) part[k] = uniform(engine, 0, 1);
    places.push_back(box.lower + part.cwiseProduct(box.extent()));
  }
  return places;
}

std::vector<TruePoint> truths_at(const Mesh<double>& mesh, const std::vector<Vec3d>& places,
                                 Workers& workers) {
  std::vector<TruePoint> points(places.size());
  workers.for_each(count_of(places),
                   [&](int i, int) { at(points, i) = truth_at(mesh, at(places, i)); });
  return points;
}

/// OpenVDB, if its program is found; only by cells, since it has no distances beyond its band.
void add_field_peer(const StudyOptions& options, const Mesh<double>& mesh,
                    const std::vector<TruePoint>& points, int repetitions,
                    std::vector<trace::Study>& results) {
  const std::vector<Vec3d> places = mapped(points, &TruePoint::place);
  std::vector<PeerField> fields;
  for (const int cells : kFieldCells) {
    std::optional<PeerField> field = run_field_peer(options.peer_folders, "openvdb", mesh, cells,
                                                    kPeerBand, repetitions, places);
    if (!field) return;
    fields.push_back(std::move(*field));
  }
  std::size_t next = 0;
  add_line(results, {fields.front().name, {}, "by cells", "cells along the longest side"},
           kFieldCells, [&](int) {
             const PeerField& field = fields[next++];
             Measurement measured(4, count_of(points));
             for (int i = 0; i < count_of(points); ++i) {
               const TruePoint& point = at(points, i);
               measured.errors[0].add(std::abs(at(field.distances, i) - point.distance));
               measured.errors[1].add(degrees_between(at(field.gradients, i), point.gradient));
             }
             measured.errors[2].add(1e-6 * field.bytes);
             measured.errors[3].add(field.build);
             for (const double time : field.nanoseconds) measured.times.add(time);
             return measured;
           });
}

std::vector<trace::Study> study_field_errors(const StudyOptions& options, const StudyStep& step) {
  const int count = options.cases.value_or(kFieldPoints);
  const int repetitions = options.repetitions.value_or(kFieldRepetitions);
  const Mesh<double> mesh = ball_mesh(kFieldMeridians, 0.5, kWaves);
  std::mt19937_64 engine(options.seed);
  std::vector<TruePoint> near_surface, anywhere;
  {
    Workers workers(options.thread_count());
    near_surface = truths_at(mesh, places_by_surface(engine, mesh, count), workers);
    anywhere = truths_at(mesh, places_in_box(engine, mesh, count), workers);
  }
  std::vector<trace::Study> results = results_of(
      "distance_field", "double", "cells",
      "all triangles in long double, " + std::to_string(count) +
          " points within 2 cm of a wavy ball of " + std::to_string(mesh.triangle_count()) +
          " triangles, 1 m wide, by band in its box" + options.seeded(),
      {{"distance", "Error of a field's distance against the time of a query",
        "error of the distance", "m", 1e-8},
       {"normal", "Error of a field's gradient against the time of a query", "angle to the truth",
        "degrees", 1e-6},
       {"memory", "What a field takes of memory", "megabytes", "", 1e-3},
       {"build", "How long a field takes to build", "milliseconds", "", 1e-3}});
  results[2].form = results[3].form = trace::StudyForm::Curves;
  for (const FieldMethod& method : kFieldMethods) {
    FieldSettings settings = method.settings();
    add_line(results, {method.name, {}, "by cells", "cells along the longest side"}, kFieldCells,
             [&](int cells) {
               settings.cells = cells;
               return judge_field(mesh, near_surface, settings, repetitions);
             });
    step(std::string("cells, ") + method.name);
  }
  add_field_peer(options, mesh, near_surface, repetitions, results);
  for (const FieldMethod& method : kFieldMethods) {
    FieldSettings settings = method.settings();
    settings.cells = kBandCells;
    add_line(results, {method.name, {}, "by band, of 64 cells", "cells on each side"}, kBands,
             [&](int band) {
               settings.band = band;
               return judge_field(mesh, anywhere, settings, repetitions);
             });
    step(std::string("band, ") + method.name);
  }
  // A field has a single size.
  for (const std::size_t of_field : {2U, 3U})
    record::each_point(results[of_field], [](trace::StudyPoint& point) { point.of = 1; });
  return results;
}

/// A cube of 1 m by its corners and by two triangles per face, in the frame of a sphere of radius
/// 0.5 m that is `depth` metres inside it. The depth is exact by construction: the sphere moves in
/// along the line from the cube's nearest point.
std::vector<FieldPiece> cube_poked(std::mt19937_64& engine, double depth) {
  const Vec3d from = uniform_rotation(engine) * Vec3d(uniform(engine, 1, 3), 0, 0);
  const Vec3d nearest = from.cwiseMax(-0.5).cwiseMin(0.5);
  const Vec3d center = nearest + (0.5 - depth) * (from - nearest).normalized();
  const Quatd turn = uniform_rotation(engine);
  std::array<Vec3d, 8> corners;
  for (int i = 0; i < 8; ++i)
    at(corners, i) = turn * (Vec3d((i & 1) - 0.5, (i >> 1 & 1) - 0.5, (i >> 2) - 0.5) - center);
  std::vector<FieldPiece> pieces;
  for (int i = 0; i < 8; ++i) {
    const Vec3d& corner = at(corners, i);
    pieces.push_back({{corner, corner, corner}, 1, vertex_ref(Owner::A, i)});
  }
  for (int axis = 0; axis < 3; ++axis) {
    const int u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3;
    for (const int base : {0, 1 << axis})
      for (const int third : {u, v})
        pieces.push_back({{at(corners, base), at(corners, base + third), at(corners, base + u + v)},
                          3,
                          face_ref(Owner::A, count_of(pieces))});
  }
  return pieces;
}

std::vector<trace::Study> study_missed(const StudyOptions& options, const StudyStep& step) {
  const int count = options.cases.value_or(kPokeCases);
  std::vector<trace::Study> results =
      results_of("distance_field", "double", "cells between points",
                 "how the cases are made" + options.seeded(),
                 {{"missed", "Overlaps that points of the surface miss", "share of the overlaps",
                   "", 0.5 / count}},
                 trace::StudyForm::Curves);
  const PlacedField sphere =
      build_distance_field(Sphere<double>{0.5}, FieldSettings{.cells = kSphereCells});
  for (const double poke : kPokes) {
    std::vector<std::vector<FieldPiece>> cases;
    for (int i = 0; i < count; ++i) {
      std::mt19937_64 engine = case_engine(options.seed, i, poke, 1);
      cases.push_back(cube_poked(engine, poke * sphere.cell));
    }
    std::string depth = std::to_string(poke).substr(0, poke < 0.1 ? 4 : poke < 1 ? 3 : 1);
    const std::string panel = depth + (poke == 1 ? " cell deep" : " cells deep");
    for (const FieldSearch search : {FieldSearch::Sampled, FieldSearch::Conservative}) {
      add_line(results, {to_string(search), {}, panel, panel + ", by cells between points"},
               kSpacings, [&](double spacing) {
                 const FieldSearchLimits limits{.search = search, .spacing = spacing * sphere.cell};
                 Measurement measured(1, count);
                 const auto finds = [&](int i) {
                   return find_touches(sphere, at(cases, i), limits).found.empty() ? 0.0 : 1.0;
                 };
                 for (int i = 0; i < count; ++i) measured.errors[0].add(1 - finds(i));
                 measured.times.measure(count, finds);
                 return measured;
               });
    }
    step("overlaps " + depth + " cells deep");
  }
  finish_share(results[0]);
  return results;
}

/// A wall with a plate, `thickness` metres, whose centre is `height` metres above the wall's.
Mesh<double> wall_with_plate(double thickness, double height) {
  const double low = height - thickness / 2, high = height + thickness / 2;
  const std::array<Vec3d, 8> outline{{{-0.5, -0.5, 0},
                                      {-0.3, -0.5, 0},
                                      {-0.3, low, 0},
                                      {0.5, low, 0},
                                      {0.5, high, 0},
                                      {-0.3, high, 0},
                                      {-0.3, 0.5, 0},
                                      {-0.5, 0.5, 0}}};
  const std::array<std::array<int, 3>, 6> front{
      {{0, 1, 2}, {0, 2, 5}, {0, 5, 7}, {5, 6, 7}, {2, 3, 4}, {2, 4, 5}}};
  std::vector<Vec3d> vertices;
  for (const double z : {0.15, -0.15})
    for (const Vec3d& corner : outline) vertices.emplace_back(corner.x(), corner.y(), z);
  std::vector<std::array<int, 3>> triangles(front.begin(), front.end());
  for (const auto& [a, b, c] : front) triangles.push_back({8 + a, 8 + c, 8 + b});
  for (int i = 0; i < 8; ++i) {
    const int next = (i + 1) % 8;
    triangles.insert(triangles.end(), {{i, 8 + i, 8 + next}, {i, 8 + next, next}});
  }
  return build_mesh(std::move(vertices), std::move(triangles));
}

std::vector<trace::Study> study_plates(const StudyOptions& options, const StudyStep& step) {
  const int plates = std::min(options.cases.value_or(kPlates), kPlates);
  constexpr double kCell = 1.0 / kPlateCells;
  std::vector<trace::Study> results =
      results_of("distance_field", "double", "cells between points",
                 "how the cases are made" + options.seeded(),
                 {{"plate", "What a field loses of a thin plate",
                   "share of its places called outside", "", 0.5 / (kPlates * kPlatePlaces)}},
                 trace::StudyForm::Curves);
  for (const FieldMethod& method : kFieldMethods) {
    add_line(results, {method.name, {}, "a plate beside a wall", "cells thick"}, kThicknesses,
             [&](double thickness) {
               Measurement measured(1, plates * kPlatePlaces);
               std::mt19937_64 engine = case_engine(options.seed, 0, thickness, 2);
               for (int i = 0; i < plates; ++i) {
                 const double height = uniform(engine, -kCell, kCell);
                 FieldSettings settings = method.settings();
                 settings.cells = kPlateCells;
                 const PlacedField field =
                     build_distance_field(wall_with_plate(thickness * kCell, height), settings);
                 std::vector<Vec3d> places;
                 for (int k = 0; k < kPlatePlaces; ++k)
                   places.emplace_back(uniform(engine, -0.2, 0.4), height,
                                       uniform(engine, -0.1, 0.1));
                 const auto lost = [&](int k) {
                   return field.sample(at(places, k)).distance >= 0 ? 1.0 : 0.0;
                 };
                 for (int k = 0; k < kPlatePlaces; ++k) measured.errors[0].add(lost(k));
                 measured.times.measure(kPlatePlaces, lost);
               }
               return measured;
             });
    step(std::string("plates, ") + method.name);
  }
  finish_share(results[0]);
  return results;
}

}  // namespace

/// Signed distance fields. "distance" and "normal": error against query time, near the surface by
/// the number of cells, and everywhere by the width of the narrow band. "memory" and "build": their
/// cost. "missed": share of overlaps of a sphere's field with a cube that a search misses, by its
/// point spacing. "plate": share of points inside a thin plate that a field reports as outside.
std::vector<trace::Study> study_distance_field(const StudyOptions& options,
                                               const StudyProgress& progress) {
  const StudyStep step = counted(progress, 10 + 3 + 5);
  std::vector<trace::Study> results = study_field_errors(options, step);
  for (const auto& study : {study_missed, study_plates})
    std::ranges::move(study(options, step), std::back_inserter(results));
  return results;
}

}  // namespace contactscope
