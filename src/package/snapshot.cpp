#include "package/contactscope/snapshot.h"
#include "core/convex_polygon.h"
#include "image/png.h"
#include "package/facts.h"
#include "snapshot/compare_trace.h"
#include "snapshot/meshes.h"
#include "snapshot/store.h"
#include "snapshot/verdict.h"

namespace contactscope::package {
namespace {

constexpr const char* kA = "a";
constexpr const char* kB = "b";
constexpr double kBall = 0.05;       // metres: the shapes of a single point have no known size
constexpr double kThickness = 0.05;  // of a capsule, relative to the distance of its ends

contactscope::trace::Shape plane_of(const contactscope::trace::Manifold* manifold) {
  contactscope::trace::Shape shape;
  shape.name = kA;
  shape.type = "plane";
  shape.half_space = contactscope::trace::HalfSpace{};
  if (manifold == nullptr || !(manifold->normal.norm() > 0)) return shape;
  Vec3d middle = Vec3d::Zero();
  for (const contactscope::trace::Point& point : manifold->points) middle += point.position;
  middle /= static_cast<double>(manifold->points.size());
  const Vec3d normal = manifold->normal.normalized();
  shape.half_space = contactscope::trace::HalfSpace{normal, normal.dot(middle)};
  return shape;
}

contactscope::trace::Shape outline_of(const std::vector<Vec3d>& places, const Vec3d& normal) {
  contactscope::trace::Shape shape;
  shape.name = kB;
  for (const int corner : convex_outline(project(places, normal)))
    shape.vertices.push_back(at(places, corner));
  for (const Vec3d& vertex : shape.vertices)
    shape.center_of_mass += vertex / static_cast<double>(shape.vertices.size());
  const int corners = count_of(shape.vertices);
  if (corners == 1) {
    shape.type = "sphere";
    shape.radius = kBall;
  } else if (corners == 2) {
    shape.type = "capsule";
    shape.radius = kThickness * (shape.vertices[1] - shape.vertices[0]).norm();
    shape.edges = {{0, 1}};
  } else {
    shape.type = "hull";
    shape.faces.resize(2);
    for (int i = 0; i < corners; ++i) {
      shape.faces[0].push_back(i);
      shape.faces[1].push_back(corners - 1 - i);
    }
    contactscope::trace::Shape::edges_from_faces(shape);
  }
  return shape;
}

/// A trace of one frame with these manifolds and stand-ins for unknown shapes, to be drawn. "a" is
/// the plane of the first manifold through the mean of its points. "b" is the outline of all points
/// on that plane; for two points a thin capsule, for one a small ball.
contactscope::trace::Trace with_stand_ins(const std::vector<Manifold>& manifolds, Scalar scalar) {
  contactscope::trace::Trace trace;
  contactscope::trace::Frame& frame = trace.frames.emplace_back();
  contactscope::trace::Pair& pair = frame.pairs.emplace_back();
  pair.a = kA;
  pair.b = kB;
  std::vector<Vec3d> places;
  for (const Manifold& manifold : manifolds) {
    if (manifold.points.empty()) continue;
    pair.manifolds.push_back(to_inside(manifold));
    for (const ContactPoint& point : manifold.points) places.push_back(to_inside(point.position));
  }
  contactscope::trace::Header& header = trace.header;
  header.scenario = TraceInfo{}.scenario;
  header.source = "Contacts alone; the shapes are stand-ins";
  header.scalar = name_of(scalar);
  header.up = "y";
  header.frames = 1;
  header.shapes.push_back(plane_of(pair.manifolds.empty() ? nullptr : &pair.manifolds.front()));
  if (places.empty()) places.push_back(Vec3d::Zero());
  header.shapes.push_back(outline_of(places, header.shapes.front().half_space->normal));
  frame.poses = {{kA, {}}, {kB, {}}};
  const std::string& type = header.shapes.back().type;
  pair.kind = "plane-" + type;
  pair.state = pair.manifolds.empty() ? "separated" : "touching";
  pair.separation = separation_of(manifolds);
  return trace;
}

namespace fs = std::filesystem;
using Facts = contactscope::trace::Trace;

std::string given_or(const std::string& option, const char* variable, const char* otherwise) {
  if (!option.empty()) return option;
  const char* const value = std::getenv(variable);
  return value != nullptr && *value != '\0' ? value : otherwise;
}

bool is_set(const char* variable) {
  return snapshot::is_ci(std::getenv(variable));  // "1" or "true"
}

/// The first frame that a sentence mentions, else the first frame.
std::optional<std::size_t> recorded_frame(const std::string& name, const Facts& facts,
                                          const std::vector<std::string>& sentences) {
  for (std::size_t i = 0; i < facts.frames.size(); ++i) {
    const std::string start = name + " frame " + std::to_string(facts.frames[i].frame);
    for (const std::string& sentence : sentences)
      if (sentence.starts_with(start + ",") || sentence.starts_with(start + ":")) return i;
  }
  return facts.frames.empty() ? std::nullopt : std::optional<std::size_t>(0);
}

/// Pictures of one frame as stored and now, with one camera if the shapes are the same.
std::array<Image, 2> both_drawn(const Facts& expected, std::size_t i, const Facts& actual,
                                std::size_t j) {
  std::array<Image, 2> drawn;
  const bool same_shapes = contactscope::trace::to_json_line(expected.header) ==
                           contactscope::trace::to_json_line(actual.header);
  if (same_shapes) {
    draw_frames(expected.header, expected.frames, {expected.frames[i], actual.frames[j]}, {0, 1},
                {}, [&](std::size_t k, Image image) { drawn[k] = std::move(image); });
    return drawn;
  }
  draw_frames(expected.header, expected.frames, expected.frames, {i}, {},
              [&](std::size_t, Image image) { drawn[0] = std::move(image); });
  draw_frames(actual.header, actual.frames, actual.frames, {j}, {},
              [&](std::size_t, Image image) { drawn[1] = std::move(image); });
  return drawn;
}

/// Draws the differences; returns where the pictures are, or why there are none.
std::string pictures_of(const std::string& name, const Facts& expected, const Facts& actual,
                        const std::vector<std::string>& sentences, const fs::path& out) {
  const auto i = recorded_frame(name, expected, sentences),
             j = recorded_frame(name, actual, sentences);
  if (!i || !j) return "no pictures: one of the traces has no frame";
  try {
    const std::array<Image, 2> drawn = both_drawn(expected, *i, actual, *j);
    const fs::path stem =
        snapshot::picture_path(out / "check", {name, std::nullopt, actual.frames[*j].frame})
            .replace_extension();
    fs::create_directories(stem.parent_path());
    const auto write = [&](const char* ending, const Image& image) {
      const std::string path = fs::absolute(stem.string() + ending).lexically_normal().string();
      contactscope::write_png(path, image);
      return path;
    };
    write(".expected.png", drawn[0]);
    write(".actual.png", drawn[1]);
    return "see " + write(".difference.png", difference_image(drawn[0], drawn[1])) +
           ", with .expected.png and .actual.png next to it";
  } catch (const RenderError& error) {
    return std::string("no pictures: ") + error.what();
  }
}

/// Compares `actual` with the stored facts. Stand-ins take the form of the stored ones.
Comparison compare(Facts actual, const std::string& name, const SnapshotOptions& options,
                   bool has_stand_ins) {
  const fs::path folder = given_or(options.folder, "CONTACTSCOPE_SNAPSHOTS", "snapshots");
  const fs::path stored = snapshot::trace_path(folder, name);
  const std::string file = fs::absolute(stored).lexically_normal().string();
  const bool wanted = options.update.value_or(is_set("CONTACTSCOPE_UPDATE"));
  const bool update = wanted && !is_set("CI");
  actual.header.scenario = name;
  const std::string how = wanted
                              ? "CI is set, so nothing is written; unset it and run the test again"
                              : "run the test once with CONTACTSCOPE_UPDATE=1";
  const auto write = [&](const std::string& message) -> Comparison {
    try {
      snapshot::write_stored_trace(folder, stored, snapshot::to_json_lines(actual));
    } catch (const std::domain_error& error) {
      return {false, name + ": not stored, because a number is not finite: " + error.what()};
    }
    return {true, message};
  };
  const std::optional<std::string> text = snapshot::read_stored_trace(folder, name);
  if (!text) {
    if (update) return write(name + ": wrote " + file + "; review it and commit it");
    return {false, name + ": no snapshot at " + file + "; " + how +
                       ", review the file and commit it; $CONTACTSCOPE_SNAPSHOTS names "
                       "another folder"};
  }
  Facts expected;
  try {
    expected = parse_trace(*text, stored.string()).facts().trace;
  } catch (const InputError& error) {
    if (!update) throw;
    return write(std::string(error.what()) + "\nrewrote " + file);
  }
  Facts compared = actual;
  if (has_stand_ins) compared.header = expected.header;
  const std::vector<std::string> sentences =
      snapshot::compare_with_stored(*text, stored.string(), compared).sentences;
  if (sentences.empty()) return {true, {}};
  if (update) return write(separated(sentences, "\n") + "\nrewrote " + file);
  std::string message = separated(sentences, "\n");
  if (options.pictures)
    message += "\n" + pictures_of(name, expected, compared, sentences,
                                  given_or(options.out, "CONTACTSCOPE_OUT", "out"));
  return {false, message + "\nif this is right, " + how + ": it rewrites " + file};
}

struct Nearest {
  int expected = -1, actual = -1;
  double distance = 0;
};

/// NaN counts as infinitely far.
double distance_of(const Vec3d& one, const Vec3d& other) {
  const double distance = (one - other).norm();
  return std::isnan(distance) ? std::numeric_limits<double>::infinity() : distance;
}

/// Pairs points greedily by distance, so that a moved point does not take another's partner.
std::vector<Nearest> paired_off(const std::vector<Vec3d>& expected,
                                const std::vector<Vec3d>& actual) {
  std::vector<Nearest> all;
  for (int i = 0; i < count_of(expected); ++i)
    for (int j = 0; j < count_of(actual); ++j)
      all.push_back({i, j, distance_of(at(expected, i), at(actual, j))});
  std::ranges::stable_sort(all, {}, &Nearest::distance);
  std::vector<Nearest> pairs;
  for (const Nearest& one : all) {
    const auto is_taken = [&](const Nearest& other) {
      return other.expected == one.expected || other.actual == one.actual;
    };
    if (std::ranges::none_of(pairs, is_taken)) pairs.push_back(one);
  }
  std::ranges::sort(pairs, {}, &Nearest::expected);
  return pairs;
}

bool is_near(const Vec3d& one, const Vec3d& other, double tolerance) {
  return ((one - other).array().abs() <= tolerance).all();  // false of nan
}

}  // namespace

Comparison compare_with_snapshot(const Trace& trace, const std::string& name,
                                 const SnapshotOptions& options) {
  return compare(trace.facts().trace, name, options, false);
}

Comparison compare_with_snapshot(const std::vector<Manifold>& manifolds, const std::string& name,
                                 const SnapshotOptions& options) {
  return compare(with_stand_ins(manifolds, options.scalar), name, options, true);
}

Comparison compare_with_snapshot(const Manifold& manifold, const std::string& name,
                                 const SnapshotOptions& options) {
  return compare_with_snapshot(std::vector<Manifold>{manifold}, name, options);
}

Comparison compare_with_snapshot(const Contacts& contacts, const std::string& name,
                                 const SnapshotOptions& options) {
  if (contacts.trace.frame_count() > 0) return compare_with_snapshot(contacts.trace, name, options);
  return compare_with_snapshot(contacts.manifolds, name, options);
}

Comparison compare_manifold(const Manifold& manifold, const Vec3& normal, double depth,
                            const std::vector<Vec3>& points, double tolerance) {
  std::vector<std::string> wrong;
  const Vec3d expected_normal = to_inside(normal), actual_normal = to_inside(manifold.normal);
  if (!is_near(expected_normal, actual_normal, tolerance))
    wrong.push_back("normal " + snapshot::spell_turn(expected_normal, actual_normal) + ": " +
                    snapshot::spell_vector(actual_normal) + " instead of " +
                    snapshot::spell_vector(expected_normal));
  const double deep = -separation_of(manifold);
  if (!manifold.points.empty() && !(std::abs(deep - depth) <= tolerance))
    wrong.push_back("depth " + snapshot::spell_length(deep) + " instead of " +
                    snapshot::spell_length(depth));
  if (manifold.points.size() != points.size())
    wrong.push_back(counted(manifold.points.size(), "point") + " instead of " +
                    std::to_string(points.size()));
  const std::vector<Vec3d> expected =
      mapped(points, [](const Vec3& point) { return to_inside(point); });
  const std::vector<Vec3d> actual =
      mapped(manifold.points, [](const ContactPoint& point) { return to_inside(point.position); });
  std::vector<bool> is_met(expected.size()), is_used(actual.size());
  for (const Nearest& pair : paired_off(expected, actual)) {
    is_met[static_cast<std::size_t>(pair.expected)] = true;
    is_used[static_cast<std::size_t>(pair.actual)] = true;
    const Vec3d &from = at(expected, pair.expected), &to = at(actual, pair.actual);
    if (!is_near(from, to, tolerance))
      wrong.push_back("point " + snapshot::spell_vector(from) + " " +
                      snapshot::spell_move(from, to));
  }
  for (std::size_t i = 0; i < is_met.size(); ++i)
    if (!is_met[i]) wrong.push_back("no point at " + snapshot::spell_vector(expected[i]));
  for (std::size_t i = 0; i < is_used.size(); ++i)
    if (!is_used[i]) wrong.push_back("an extra point at " + snapshot::spell_vector(actual[i]));
  return {wrong.empty(), separated(wrong, "; ")};
}

}  // namespace contactscope::package
