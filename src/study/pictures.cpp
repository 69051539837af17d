#include "core/spell.h"
#include "study/picture.h"

namespace contactscope {
namespace {

using namespace record;
using trace::kShare, trace::StudyForm;

const std::vector<Kept> kAll{};

const std::vector<Kept> kReducers = {{"optimal_deepest", "best four with the deepest"},
                                     {"area_deepest", "greedy with the deepest"},
                                     {"optimal", "best four by area alone"},
                                     {"coherent", "near the last frame's choice"},
                                     {"area", "greedy, by area"},
                                     {"bullet", "Bullet", kQuiet},
                                     {"ode", "ODE", kQuiet},
                                     {"physx", "PhysX", kQuiet},
                                     {"box3d", "Box3D", kQuiet},
                                     {"jolt", "Jolt", kQuiet},
                                     {"mjx", "MJX", kQuiet}};
// The others drop the deepest point to gain area.
const std::vector<Kept> kWithDeepest = {kReducers[0], kReducers[1], kReducers[5], kReducers[6],
                                        kReducers[7]};
const PictureOptions kOfEight{.at = 8, .only_at = true};
const PictureOptions kLostArea{
    .at = 8, .only_at = true, .drop_resolution = true, .error = "share of the area that is lost"};

const std::vector<Kept> kDepthMethods = {
    {"double, SAT", "separating axis test"}, {"double, EPA by tolerance", "EPA"},
    {"double, MPR by tolerance", "MPR"},     {"double, sampling", "sampling, 8192 directions"},
    {"Bullet, EPA", "Bullet, EPA", kQuiet},  {"Bullet, SAT", "Bullet, SAT", kQuiet},
    {"libccd, EPA", "libccd, EPA", kQuiet},  {"libccd, MPR", "libccd, MPR", kQuiet}};
// libccd 2.1 splits the nearest face alone (expandPolytope), not all that the new point sees.
constexpr const char* kPenetration =
    "Two hulls of 32 vertices, from kissing to concentric. GJK and V-Clip find no depth. Grey: "
    "other "
    "libraries; the polytope of libccd's EPA does not stay convex";
const std::vector<Kept> kPrecisions = {{"float, separating axis test", "float"},
                                       {"double, separating axis test", "double"}};
const std::vector<Kept> kGains = {{"without tolerances", "without tolerances", false, 1},
                                  {"with tolerances", "with tolerances", false, 2},
                                  {"tolerance", "tolerance: rounding", kQuiet},
                                  {"cap", "cap of 256 steps", kQuiet}};
const std::vector<Kept> kBoxPaths = {{"by the path of any hulls", "as a general hull"},
                                     {"by the path of boxes", "with code of its own"}};
const std::vector<Kept> kVolumes = {{"axis-aligned boxes (AABBs)", "AABB, 24 bytes a node"},
                                    {"oriented boxes (OBBs)", "OBB, 60 bytes a node"},
                                    {"k-DOPs (k = 18 planes)", "18-DOP, 72 bytes a node"}};
const std::vector<Kept> kAxisTimes = {
    {"float, all pairs of edges", "all faces and pairs of edges tested"}, kPrecisions[0]};
const std::vector<Kept> kContactTimes = {
    {"float, contact", "contact from scratch"},
    {"float, the same with a cache", "with the last frame's features"}};

// Double looks the same at smaller thresholds.
const std::vector<Kept> kThresholdTests = {{"float", "float"}, {"float, guarded", kGuarded}};
const std::vector<Kept> kBounds = {{"sphere", "bounding sphere"},
                                   {"AABB", "axis-aligned box"},
                                   {"OBB, six axes", "oriented box, six face normals"},
                                   {"OBB, fifteen axes", "oriented box, fifteen axes"}};

const std::vector<Kept> kBroadPhases = {
    {"brute_force", "brute force"}, {"grid", "grid"},          {"sweep_and_prune", "sweep & prune"},
    {"octree", "octree"},           {"tree", "tree of boxes"}, {"columns", "sweep in columns"}};
const std::vector<Kept> kFromNothing = {{"from nothing", "Made from nothing in each step"}};

const std::vector<Kept> kTrees = {
    {"rebuild", "always rebuilt"}, {"refit", "only refitted"}, {"auto", "rebuilt where needed"}};
const std::vector<Kept> kOverRebuilt = {
    {"rebuild", "always rebuilt", kQuiet}, kTrees[1], kTrees[2]};

const std::vector<Kept> kTriangleTests = {
    {"float", "float"},
    {"float, epsilon 1e-6 m", "float with an epsilon of 1 µm"},
    {"double", "double"},
    {"exact", "exact"}};
// Conservative advancement is as accurate in twice the time, and eight samples miss most fast hits.
const std::vector<Kept> kImpacts = {{"time of impact", "search for the time of impact"},
                                    {"64 samples", "64 samples of the step"}};

const std::vector<Kept> kStops = {
    {"discrete", "tested at ends of steps"},
    {"speculative margin of 2 cm", "with a speculative margin of 2 cm"},
    {"swept bounding sphere", "swept bounding sphere"},
    {"conservative advancement", "conservative advancement"},
    {"time of impact", "time of impact"}};
const std::vector<Kept> kBulletPanels = {
    {"spheres, a wall of 1 cm", "Spheres of 10 cm"},
    {"boxes, a wall of 1 cm", "Boxes of about 8 cm"},
    {"spinning rods, a wall of 1 cm", "Spinning rods of 62 cm"}};

const std::vector<Kept> kDrawnFloors = {{"one mesh", "one mesh"},
                                        {"T-junctions", "T-junctions"},
                                        {"cracks of 1 µm", "cracks of 1 µm"},
                                        {"cracks of 0.1 mm", "cracks of 0.1 mm"},
                                        {"cracks of 0.1 mm, welded", "cracks of 0.1 mm, welded"},
                                        {"two meshes", "two meshes, tile next to tile"},
                                        {"boxes", "boxes next to each other"}};

const std::vector<Kept> kGhostSliders = {{"sphere", "Sphere of 40 cm"},
                                         {"box", "Box of 60 cm by 30 cm by 40 cm"},
                                         {"lying capsule", "Capsule of 20 cm by 60 cm, lying"},
                                         {"cylinder", "Cylinder of 24 sides, standing"}};

const std::vector<Kept> kFields = {
    {"trilinear", "trilinear"},
    {"cubic", "cubic"},
    {"trilinear with exact cells", "trilinear, exact cells"},
    {"cubic with exact cells where needed", "cubic, some cells exact"},
    {"cubic with exact cells", "cubic, exact cells"},
    {"OpenVDB*", "OpenVDB, trilinear"}};
// The others lie between these.
const std::vector<Kept> kMarkedFields = {
    kFields[0], kFields[1], kFields[4], {"OpenVDB*", "OpenVDB, trilinear", kQuiet}};
const std::vector<Kept> kDepths = {{"0.01 cells deep", "1/100 of a cell deep"},
                                   {"0.1 cells deep", "1/10 of a cell deep"},
                                   {"1 cell deep", "one cell deep"}};
const std::vector<Kept> kByCells = {{"by cells", ""}};
constexpr const char* kMarkers =
    "Fields of 64 cells along the longest side, asked within 2 cm of the surface of a ball 1 m "
    "wide. Exact cells ask their triangles";

// Tables contain the ones without warm starting.
const std::vector<Kept> kSolvers = {{"soft, warm", "soft contacts"},
                                    {"projection, warm", "projection"},
                                    {"baumgarte, warm", "Baumgarte"}};
const std::vector<Kept> kMaps = {{"baumgarte, warm: 16 sweeps", "Baumgarte"},
                                 {"projection, warm: 8 + 8", "Projection"},
                                 {"soft, warm: 4 × (2 + 2)", "Soft contacts"},
                                 {"baumgarte, cold: 16 sweeps", "Baumgarte, no warm starting"},
                                 {"projection, cold: 8 + 8", "Projection, no warm starting"},
                                 {"soft, cold: 4 × (2 + 2)", "Soft contacts, no warm starting"}};
const std::vector<Kept> kWarmMaps(kMaps.begin(), kMaps.begin() + 3);
const std::pair<std::string, std::string> kNumbersOfStacks = {";", "; seed"};
const PictureOptions kStacks{.failed = "fell", .left_out = kNumbersOfStacks};

// Compared with the geometry before rounding; tables contain the loss by arithmetic alone.
const std::vector<Kept> kUnrounded = {{"float, unrounded", "float", false, 0},
                                      {"double, unrounded", "double", false, 1}};
const std::vector<Kept> kUnroundedMaps = {{"float, unrounded", "Float"},
                                          {"double, unrounded", "Double"}};

/// The share that the first method of the row loses, and the quiet ones.
std::string result_of_reducers(Picture& plot, const std::string& best) {
  std::vector<std::pair<double, std::string>> engines;
  for (const Kept& method : plot.row.methods)
    if (method.quiet) engines.emplace_back(plot.error(method.from), method.to);
  std::ranges::stable_sort(engines, {}, &std::pair<double, std::string>::first);
  const auto lost = [&](const trace::StudySeries& line) {
    return percent(error_at(line, plot.row.options.at));
  };
  const Kept& first = plot.row.methods.front();
  const std::string own = lost(series_of(plot.drawn, first.to));
  plot.mark_with_name(first.from, own);
  for (trace::StudySeries& line : plot.lines)
    if (!line.method.empty()) line.method += ": " + lost(line);
  return best + own + " of the area, the choices of " +
         listed(mapped(engines, &std::pair<double, std::string>::second)) + " " +
         percent(engines.front().first) + " to " + percent(engines.back().first);
}

std::string result_of_ghosts(Picture& plot) {
  plot.join_equal();
  const double within = largest_error(
      plot.measured, {"one mesh", "cracks of 1 µm", "T-junctions", "two meshes", "boxes"});
  const double cracked = largest_error(plot.measured, {"cracks of 0.1 mm"});
  return "Flat floors of meshes and boxes throw nothing higher than " + length(within) +
         ", with cracks of 0.1 mm up to " + length(cracked) + ", or " +
         length(largest_error(plot.measured, {"cracks of 0.1 mm, welded"})) + " if welded";
}

/// The least change of a pose that gives other points, spelled, with words around it.
std::string least_change(Picture& plot, const std::string& before, std::string spell(double),
                         const std::string& after = {}) {
  trace::StudySeries* pair = nullptr;
  trace::StudyPoint* least = nullptr;
  for (trace::StudySeries& line : plot.lines)
    for (trace::StudyPoint& point : line.points)
      if (point.error && (least == nullptr || *point.error < *least->error))
        pair = &line, least = &point;
  if (least == nullptr) return {};
  least->mark = spell(*least->error);
  const bool is_one_scenario = std::ranges::all_of(
      plot.lines, [&](const trace::StudySeries& line) { return line.panel == pair->panel; });
  return "At the least " + before + least->mark + after + " gives " + pair->method +
         " other points, in frame " + count(least->parameter) +
         (is_one_scenario ? "" : " of " + pair->panel);
}

PictureRow row(const char* study, const char* measure, const std::vector<Kept>& methods,
               const std::vector<Kept>& panels, const char* parameter, const char* unit,
               const char* shown, const PictureOptions& options = {},
               std::string result(Picture&) = nullptr) {
  return {study, measure, methods, panels, parameter, unit, shown, options, result};
}

PictureRow flips(const std::string& measure, const std::string& unit, const PictureOptions& options,
                 std::string result(Picture&)) {
  const std::string shown = "Up: {error} of the second shape after which a pair has other points" +
                            unit + ". Crosses: nothing changes it";
  return {"flip_distance", measure, kAll, kAll, "", "", shown, options, result};
}

/// Every plot that is not drawn as it was measured.
const std::vector<PictureRow>& picture_rows() {
  static const std::vector<PictureRow> rows = {
      row("reducers", "area", kWithDeepest, kAll, "", kShare,
          "All keep the deepest of eight points and three more. Grey: as engines choose.",
          kLostArea,
          [](Picture& plot) {
            return result_of_reducers(plot, "The best four points with the deepest lose ");
          }),
      row("reducers", "flat", kReducers, kAll, "", kShare,
          "Four points kept of eight that are equally deep. Grey: as engines choose.", kLostArea,
          [](Picture& plot) {
            return result_of_reducers(plot,
                                      "Where all points are equally deep, the default loses ");
          }),
      row("reducers", "", kReducers, kAll, "", "",
          "Four points kept of eight. Grey: as engines choose.", kOfEight),
      row("penetration", "depth", kDepthMethods, kAll, "", "",
          kPenetration,
          {.at = 6, .only_at = true, .left_out = {"; efforts", ""}},
          &result_of_depths),
      row("penetration", "normal", kDepthMethods, kAll, "", "",
          kPenetration,
          {.at = 6, .only_at = true, .left_out = {"; efforts", ""}}),
      row("hull_precision", "depth", kPrecisions, kAll, "", "",
          "The separating axis test of hulls of 32 vertices that overlap by 1 to 10 % of their size; "
          "deeper pairs take longer",
          {.at = 32, .only_at = true}, &result_of_precision),
      row("distance", "pairs", kAll, kAll, "", "",
          "Up: microseconds of a call, mean of separated hulls. All pairs: of vertices, edges and faces",
          {.at = 128, .drop_worst = true}, &result_of_pairs),
      row("distance", "gains", kGains, kAll, "", "",
          "Up: improvement by a step / size of the pair. Two drums, nearly face to face",
          {.failed = "such pairs reach the cap"}, &result_of_gains),
      row("hull_precision", "time", kContactTimes, kAll, "vertices of each hull", trace::kMicroseconds,
          "Time of a contact in float. Gregorius expects an order of magnitude from the last frame's "
          "features",
          {.at = 64, .drop_worst = true, .form = StudyForm::Curves},
          [](Picture& plot) {
            const double scratch = plot.error("float, contact"),
                         kept = plot.error("float, the same with a cache");
            plot.mark("float, the same with a cache", number(kept) + " µs");
            plot.mark("float, contact", number(scratch) + " µs");
            trace::StudySeries tenth{"as expected, ten times as fast", {}};
            for (const trace::StudyPoint& point : plot.lines.at(0).points)
              tenth.points.push_back({point.parameter, *point.error / 10, {}, {}});
            tenth.quiet = true;
            plot.lines.push_back(tenth);
            return "With the last frame's features a contact of hulls of 64 vertices is " +
                   number(scratch / kept) + " times as fast, not ten times";
          }),
      row("hull_precision", "axes", kAxisTimes, kAll, "vertices of each hull", trace::kTimes,
          "Up: time of the separating axis test, over that of hulls of 8 vertices. In float",
          {.at = 64, .drop_worst = true, .form = StudyForm::Curves}, &result_of_axes),
      row("box_path", "time", kBoxPaths, kAll, "", "",
          "Time of a contact of two boxes, the upper one tilted by 10 degrees",
          {.at = 10, .only_at = true}, &result_of_box_path),
      row("bounding_trees", "tests", kVolumes, kAll, "", "",
          "Each node of a tree bounds its triangles: by a box along the axes, an oriented box, or 18 planes. Two balls of 2,208 triangles, one 30 mm inside the other",
          {.at = 30, .only_at = true, .left_out = {"two", ""}}, &result_of_trees),
      row("overlap", "false_positives", kBounds, kAll, "length of the boxes / their width", kShare,
          "Up: of the pairs that a bound lets through, the share that is apart. Rods: 10 times as "
          "long as wide",
          {.at = 10, .form = StudyForm::Curves},
          [](Picture& plot) {
            const std::string boxes = plot.share("AABB"),
                              oriented = plot.share("OBB, fifteen axes");
            plot.mark("AABB", "rods: " + boxes);
            return boxes + " of the rods that axis-aligned boxes let through are apart; " +
                   (oriented == "0 %" ? "fifteen axes let none of them through"
                                      : "of those of fifteen axes " + oriented);
          }),
      row("overlap", "threshold", kThresholdTests, kAll,
          "threshold: edges at an angle with a smaller sine give no axis", "",
          "Up: the deepest overlap that is called apart, the widest gap that is called an overlap, "
          "mm",
          {.drop_resolution = true, .scale = 1000}, &result_of_thresholds),
      row("overlap", "boxes", kAll, kAll, "overlap of the boxes, % of the shortest side", kShare,
          "Up: share of the pairs whose depth is off by 5 % or more. Sides of 0.4 to 2 m, random "
          "rotations",
          {.at = 20, .form = StudyForm::Curves, .failed = "no contact"},
          [](Picture& plot) {
            const char* const all = "all corners and edges";
            const double slower = plot.point(all).nanoseconds.min /
                                  plot.point("separating axis test").nanoseconds.min;
            return "All corners and edges: a wrong depth for " + plot.mark(all, plot.share(all)) +
                   " of boxes a fifth deep, and " + number(slower) +
                   " times the time of the separating axis test";
          }),
      row("overlap", "wrong", kThresholdTests, kAll,
          "threshold: edges at an angle with a smaller sine give no axis", kShare, "",
          {.drop_resolution = true}, &result_of_thresholds),
      row("broad_phase", "time", kBroadPhases, kFromNothing, "boxes", "",
          "Up: milliseconds to find all pairs of boxes that overlap, median of the steps", {},
          &result_of_broad_phases),
      row("broad_phase", "", kBroadPhases, kFromNothing, "boxes", "", ""),
      row("mesh_mesh", "time", kTrees, kAll, "frame", trace::kSum, "", {}, &result_of_updates),
      row("mesh_mesh", "cost", kOverRebuilt, {{"node pairs compared", ""}}, "frame", trace::kTimes,
          "Up: node pairs that a query compares, over those with a tree that is rebuilt in each "
          "frame",
          {}, &result_of_refitting),
      row("mesh_mesh", "motion", {{"coherent", ""}}, kAll, "µm that a ball moves in a frame",
          kShare,
          "Up: time of a query that begins where the last frame's ended, of the time of one from "
          "the roots",
          {}, &result_of_coherence),
      // An epsilon only fits one size; tables contain the others.
      row("triangle_triangle", "wrong", kTriangleTests, {{"triangles of 1 m", ""}},
          "units in the last place off the plane", kShare,
          "Up: share of wrong answers to whether two triangles of 1 m share a point",
          {.drop_resolution = true}, &result_near_plane),
      row("triangle_triangle", "last_bits", kAll,
          {{"float", "Float"}, {"double", "Double"}, {"exact", "Exact"}}, "", "",
          "Colour: the answer for a triangle, a corner of which is moved by its last bits; on the "
          "diagonal it touches the plane, above it crosses",
          {}, &result_of_last_bits),
      row("phase", "features", kAll,
          {{"preference none", "No preference"}, {"preference relative", "Faces preferred"}}, "", "",
          "Colour: what makes the contact of a cube whose lower edge is 30 mm deep in another's face, at 12 degrees to its edge",
          {}, &result_of_phase),
      // Hulls without rotation have the same errors in less time.
      row("time_of_impact", "error",
          {kImpacts[0], {"64 samples", "64 samples of the step", false, 1}}, {{"rotating", ""}},
          "metres that a hull goes in the step", "",
          "Up: mean error of the time of impact, in % of the step, of hulls that turn by up to 2 "
          "rad.",
          {.at = 10, .drop_worst = true, .scale = 100, .form = StudyForm::Curves},
          &result_of_impacts),
      row("time_of_impact", "missed", kImpacts, {{"rotating", ""}},
          "metres that a hull goes in the step", kShare, ""),

      // For passing, boxes and rods look the same.
      row("tunnelling", "passed", kStops, {{"spheres, a wall of 1 cm", ""}}, "m/s", kShare,
          "Up: share of spheres 10 cm wide that pass, at 60 steps a second. A sphere found in the "
          "wall with its middle beyond is pushed out there: it has passed",
          {.at = 10}, &result_of_bullets),
      row("tunnelling", "early", kStops, kBulletPanels, "m/s", "", ""),

      row("ghost", "thrown", kDrawnFloors, kGhostSliders, "m/s", "", "",
          {.at = 12, .drop_resolution = true, .error = "height, on floors that are all flat"},
          &result_of_ghosts),

      row("distance_field", "distance", kMarkedFields, kByCells, "cells", "µm", kMarkers,
          {.at = 64, .only_at = true, .scale = 1e6, .left_out = {", by band", ", seed"}},
          &result_of_fields),
      row("distance_field", "normal", kMarkedFields, kByCells, "cells", "", kMarkers,
          {.at = 64, .only_at = true, .left_out = {", by band", ", seed"}}),
      row("distance_field", "build", kFields, kByCells, "cells along the longest side", "",
          "Up: milliseconds to build, on one thread", {.at = 128}, &result_of_building),
      row("distance_field", "memory", kFields, kByCells, "cells along the longest side", "",
          "Up: megabytes"),
      row("distance_field", "missed", {{"sampled", "at points: "}}, kDepths,
          "cells from point to point", kShare,
          "A cube overlaps a ball, whose distance field is asked at points of the cube's faces; "
          "conservative: faces are halved until a bound decides. Up: share missed",
          {.at = 1}, &result_of_points),
      row("distance_field", "plate", kFields, {{"a plate beside a wall", ""}},
          "thickness of the plate, cells", kShare,
          "Up: share of a plate's middle that a field calls outside. Exact cells ask their "
          "triangles",
          {.at = 0.25}, &result_of_plate),

      row("manifold_stability", "queries",
          {{"GJK", "GJK suffices"}, {"EPA", "the cores overlap, and EPA finds the depth"}}, kAll,
          "metres that a box falls", kShare, "Up: share of the frames with a contact", {.at = 1},
          [](Picture& plot) {
            const auto time = [&](const char* method) {
              return number(plot.point(method).nanoseconds.min / 1000) + " µs";
            };
            return "A box that falls a metre needs the depth of cores in " +
                   plot.mark("EPA", plot.share("EPA")) + " of the frames: EPA takes " +
                   time("EPA") + ", GJK " + time("GJK");
          }),
      row("solver", "jitter", kSolvers, {{"More sub-steps, an iteration each", ""}},
          "sub-steps of a frame, an iteration each", "",
          "Up: mean speed of the fastest box in the third second, mm/s",
          {.at = 8,
           .drop_worst = true,
           .scale = 1000,
           .form = StudyForm::Curves,
           .left_out = kNumbersOfStacks},
          &result_of_jitter),
      row("solver", "max_points", {kSolvers[0]}, kAll, "microseconds of a frame", "",
          "Catto expects a drastic gain. A stack of six boxes, by the number of points that each "
          "contact keeps",
          {.drop_worst = true, .scale = 1000, .left_out = kNumbersOfStacks},
          &result_of_max_points),
      row("solver", "energy", kAll, kAll, "", "",
          "Up: energy gained, of that at the start; the worst of twenty scenes", {},
          &result_of_energy),
      row("solver", "map", kAll, kWarmMaps, "mass of the top / others", kShare,
          "Colour: share of the stacks that fall, at 16 sweeps a frame", kStacks,
          &result_of_ratios),
      row("solver", "drift_map", kAll, kMaps, "mass of the top / others", "",
          "Colour: {error}, at 16 sweeps a frame", kStacks),
      row("solver", "jitter_map", kAll, kMaps, "mass of the top / others", "",
          "Colour: {error}, at 16 sweeps a frame", kStacks),
      row("solver", "", kSolvers, kAll, "", "",
          "Up: mean {error}. Along a line: 1 to 64 sub-steps. Band: the least to the greatest "
          "time.",
          kStacks,
          [](Picture& plot) {
            std::ranges::stable_sort(plot.lines, {}, &trace::StudySeries::panel);
            return std::string();
          }),

      // Errors grow with distance, not with size.
      row("stability", "sweeps", kUnrounded, {{"distance", ""}}, "m from the origin", "",
          "Up: largest error of a contact over the size of its shapes, whose poses float or double "
          "rounds; both axes logarithmic",
          {.at = 1000, .left_out = {";", ""}}, &result_of_distance),
      row("stability", "distance_overlap", kAll, kUnroundedMaps, "distance from the origin, m",
          kShare,
          "Up: overlap / size of the shapes. Colour: share of the contacts that are lost, not "
          "found or off by half of their depth.",
          {}, &result_of_overlaps),

      flips("way", ", mm", {.scale = 1000},
            [](Picture& plot) {
              return least_change(plot, "a way of ", [](double mm) { return length(mm / 1000); });
            }),
      flips("turn", ", rad", {},
            [](Picture& plot) {
              return least_change(plot, "a turn of ",
                                  [](double turn) { return power(turn) + " rad"; });
            }),
      flips("last_places", "", {},
            [](Picture& plot) {
              return least_change(plot, "", &count, " last places of a coordinate");
            }),
  };
  return rows;
}

}  // namespace

trace::Study picture_of(const trace::Study& measured) {
  for (const PictureRow& row : picture_rows())
    if (row.study == measured.study && (row.measure.empty() || row.measure == measured.measure))
      return drawn_by(row, measured);
  return measured;
}

}  // namespace contactscope
