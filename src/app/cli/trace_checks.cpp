#include "app/cli/trace_file.h"

#include <unordered_set>

#include "app/cli/table.h"
#include "geometry/hull_builder.h"
#include "snapshot/store.h"

namespace contactscope::app {
namespace {

using Wrong = TraceChecks::Wrong;

// For unit lengths: accepts numbers written with three digits.
constexpr double kUnitTolerance = 2e-3;

bool is_unit(double length) {
  return std::abs(length - 1) <= kUnitTolerance;  // false of nan
}

void require(bool is_right, const std::string& otherwise) {
  if (!is_right) throw Wrong{otherwise};
}
/// For frequent checks: builds the message only on failure.
template <std::invocable Words> void require(bool is_right, const Words& otherwise) {
  if (!is_right) throw Wrong{otherwise()};
}

/// A text that is one of the words of its key.
template <class Place>
void require_word(const Key& key, const std::string& text, const Place& place) {
  const std::string wrong = not_among(key.words, text);
  require(wrong.empty(), [&] { return place() + " " + wrong; });
}

/// Faces of a convex shape listed clockwise have all other vertices in front of them.
void check_winding(const trace::Shape& shape) {
  if (shape.type == "mesh" || shape.type == "sdf" || shape.radius > 0) return;
  double size = 0;
  for (const Vec3d& vertex : shape.vertices)
    size = std::max(size, (vertex - shape.vertices.front()).norm());
  std::vector<int> wrong;
  for (int f = 0; f < count_of(shape.faces); ++f) {
    const std::vector<Vec3d> corners =
        mapped(at(shape.faces, f), [&](int vertex) { return at(shape.vertices, vertex); });
    const Vec3d normal = newell_normal(corners);
    const double length = normal.norm();
    if (!(length > 0)) continue;
    double above = 0, below = 0;
    for (const Vec3d& vertex : shape.vertices) {
      const double height = normal.dot(vertex - corners.front()) / length;
      above = std::max(above, height);
      below = std::max(below, -height);
    }
    constexpr double kFlat = 1e-3;  // relative to the size: closer vertices count as coplanar
    if (above > kFlat * size && below <= kFlat * size) wrong.push_back(f);
  }
  if (wrong.empty()) return;
  const bool all = wrong.size() == shape.faces.size();
  throw Wrong{
      "shape '" + shape.name + "': " +
      (all ? std::string("all faces are") : "face " + std::to_string(wrong.front()) + " is") +
      " wound inside out; list the vertices of a face counter-clockwise as seen from outside"};
}

/// Names and texts are printed to terminals, shells and pictures.
void require_plain(const char* what, const std::string& text) {
  if (const std::string wrong = not_plain(text); !wrong.empty())
    throw Wrong{std::string(what) + " has " + wrong + "; write plain text on one line"};
}

void check_shape(const trace::Shape& shape) {
  const std::string name = "shape '" + shape.name + "'";
  if (shape.half_space) {
    require(is_unit(shape.half_space->normal.norm()),
            name + ": the 'normal' of 'half_space' must have length 1");
  } else {
    require(!shape.vertices.empty(),
            name +
                " has no 'vertices'; a sphere has its centre, a capsule the ends of its segment, a "
                "plane 'half_space' instead");
  }
  require(!(shape.radius < 0), name + ": 'radius' is negative; give metres, or leave it out");
  for (const std::vector<int>& face : shape.faces)
    require(face.size() >= 3, name + " has a face of fewer than three vertices; leave it out");
  check_winding(shape);
}

/// Gives a convex shape without faces those of its hull, which may leave some vertices inside.
void give_faces(trace::Shape& shape) {
  const bool is_round = shape.type == "sphere" || shape.type == "capsule" || shape.radius > 0;
  if (!shape.faces.empty() || is_round || shape.half_space || shape.vertices.empty()) return;
  if (shape.type == "mesh" || shape.type == "sdf")
    throw Wrong{"shape '" + shape.name + "' is a " + shape.type +
                " without 'faces'; give its triangles, three vertex indices each"};
  try {
    const Hull<double> hull =
        build_hull(shape.vertices, {.weld_duplicates = true, .allow_flat = true});
    const auto index_of = [&](const Vec3d& vertex) {
      return static_cast<int>(std::ranges::find(shape.vertices, vertex) - shape.vertices.begin());
    };
    for (int f = 0; f < hull.face_count(); ++f) {
      std::vector<int>& face = shape.faces.emplace_back();
      for (const int corner : face_vertices(hull, f))
        face.push_back(index_of(at(hull.vertices, corner)));
    }
  } catch (const ShapeError& error) {
    throw Wrong{"shape '" + shape.name +
                "' has no 'faces', and none can be made of its 'vertices': " + error.what()};
  }
  if (shape.edges.empty()) trace::Shape::edges_from_faces(shape);
}

/// True if a shape is repeated unchanged, with its faces or without generated ones.
bool is_same(const trace::Shape& known, const trace::Shape& again) {
  const auto plane = [](const trace::Shape& shape) {
    return shape.half_space.value_or(trace::HalfSpace{});
  };
  return known.type == again.type && known.vertices == again.vertices &&
         (again.faces.empty() || known.faces == again.faces) && known.radius == again.radius &&
         known.margin == again.margin && known.body == again.body &&
         known.half_space.has_value() == again.half_space.has_value() &&
         plane(known) == plane(again);
}

/// "hull-mesh": two kinds of shapes.
bool is_kind(const std::string& kind) {
  const std::size_t dash = kind.find('-');
  const auto is_shape = [](const std::string& word) {
    return std::ranges::any_of(std::array{"sphere", "capsule", "hull", "mesh", "plane", "sdf"},
                               [&](const char* known) { return word == known; });
  };
  return dash != std::string::npos && is_shape(kind.substr(0, dash)) &&
         is_shape(kind.substr(dash + 1));
}

}  // namespace

TraceChecks::TraceChecks(trace::Header& header, const std::string& place,
                         std::vector<std::string> problems)
    : header_(header) {
  // A key or shape with a problem is not checked further: its values may be missing.
  const auto is_named = [known = problems](const std::string& key) {
    return std::ranges::any_of(known, [&](const std::string& problem) {
      return std::ranges::any_of(std::string_view("'.["), [&](char end) {
        return problem.find("'" + key + end) != std::string::npos;
      });
    });
  };
  const auto expect = [&](bool is_right, const std::string& otherwise) {
    if (!is_right) problems.push_back(printable(otherwise));
  };
  const auto each = [&](const auto& check) {
    try {
      check();
    } catch (const Wrong& wrong) {
      problems.push_back(printable(wrong.text));
    }
  };
  try {
    snapshot::scenario_folder("", header.scenario);
  } catch (const std::invalid_argument&) {
    expect(is_named("scenario"), "'scenario' is '" + header.scenario +
                                     "'; write it as GROUP/IDEA, which is where its pictures go");
  }
  for (const auto& [key, text] :
       {std::pair("'scenario'", &header.scenario), std::pair("'title'", &header.title),
        std::pair("'source'", &header.source), std::pair("'engine'", &header.engine)})
    each([&, &name = key, &written = text] { require_plain(name, *written); });
  const std::optional<trace::ImpulseConvention>& impulses = header.impulses;
  if (impulses && !is_named("impulses")) {
    expect(impulses->unit == "N s" || impulses->unit == "N",
           "'impulses.unit' is '" + impulses->unit + "'; it may be 'N s', or 'N' of forces");
    expect(impulses->on == "b" || impulses->on == "a",
           "'impulses.on' is '" + impulses->on + "'; it may be 'a' or 'b'");
    expect(impulses->unit != "N" || (impulses->step > 0 && std::isfinite(impulses->step)),
           "'impulses.unit' is 'N', and 'impulses.step' is missing: forces need the seconds of a "
           "step, such as 0.0166667");
  }
  std::vector<trace::Shape> shapes = std::move(header.shapes);
  header.shapes.clear();
  for (trace::Shape& shape : shapes)
    if (!is_named("shapes." + shape.name)) each([&] { add(std::move(shape)); });
  if (!problems.empty()) throw Wrong{trace::in_lines(problems, place)};
}

void TraceChecks::add(trace::Shape shape) {
  require_plain("the name of a shape", shape.name);
  give_faces(shape);
  check_shape(shape);
  const bool is_new = places_.emplace(shape.name, header_.shapes.size()).second;
  require(is_new, "there are two shapes '" + shape.name +
                      "'; give each a name of its own, also where one body takes another form");
  header_.shapes.push_back(std::move(shape));
}

void TraceChecks::shapes(trace::Frame& frame) {
  // Some writers repeat all shapes in each frame.
  std::erase_if(frame.shapes, [&](const trace::Shape& shape) {
    const auto known = places_.find(shape.name);
    return known != places_.end() && is_same(header_.shapes[known->second], shape);
  });
  for (trace::Shape& shape : frame.shapes) {
    add(shape);
    shape = header_.shapes.back();  // with generated faces
  }
}

void TraceChecks::frame(trace::Frame& frame) {
  shapes(frame);
  require(!header_.shapes.empty(),
          "there is no shape yet, here or in the header; name in 'shapes' what there is");
  facts(frame);
  require(header_.frames == 0 || frame.frame < header_.frames,
          "'frame' is " + std::to_string(frame.frame) + ", and the header says that there are " +
              std::to_string(header_.frames) + " 'frames'; correct it, or leave it out there");
  last_ = frame.frame;
}

template <class Place>
const trace::Shape& TraceChecks::named(const std::string& name, const Place& place) const {
  const auto found = places_.find(name);
  if (found != places_.end()) return header_.shapes[found->second];
  const std::string near = nearest(name, names_in(header_.shapes));
  throw Wrong{place() + ": the header has no shape '" + name + "'" +
              (near.empty() ? "; add it there, or to 'shapes' of this frame"
                            : "; did you mean '" + near + "'?")};
}

void TraceChecks::pair(std::size_t index, const trace::Pair& pair) const {
  const auto place = [&](const std::string& key) {
    return "pairs[" + std::to_string(index) + "]" + key;
  };
  const trace::Shape& a = named(pair.a, [&] { return place(".a"); });
  const trace::Shape& b = named(pair.b, [&] { return place(".b"); });
  require_plain("the label of a pair", pair.label);
  require(&a != &b, [&] { return place(": 'a' and 'b' are the same shape; a pair needs two"); });
  static const Key &state = *trace::fact_key("Pair", "state"),
                   &axis = *trace::fact_key("Manifold", "axis");
  require_word(state, pair.state, [&] { return place(".state"); });
  require(is_kind(pair.kind), [&] {
    return place(".kind is '") + pair.kind +
           "'; it is two of 'sphere', 'capsule', 'hull', 'mesh', 'plane' and "
           "'sdf' with a dash between them, or may be left out";
  });
  for (std::size_t i = 0; i < pair.manifolds.size(); ++i) {
    const trace::Manifold& manifold = pair.manifolds[i];
    const auto one = [&] { return place(".manifolds[") + std::to_string(i) + "]"; };
    if (!manifold.axis.empty()) require_word(axis, manifold.axis, [&] { return one() + ".axis"; });
    const double length = manifold.normal.norm();
    require(is_unit(length), [&] {
      return one() + ".normal has length " + printed("%.4g", length) +
             "; it must be 1, and point from a to b";
    });
    require(!manifold.points.empty(),
            [&] { return one() + " has no points; leave out manifolds that have none"; });
  }
  const auto check_index = [&](const char* key, const std::string& name, int index_there, auto list,
                               const char* entries, int least = 0) {
    const int count = count_of(named(name, [&] { return place(key); }).*list);
    require(index_there >= least && index_there < count, [&] {
      return place(key) + " is " + std::to_string(index_there) + ", but '" + name + "' has " +
             std::to_string(count) + " " + entries + "; the first is 0";
    });
  };
  const auto check_face = [&](const char* key, const std::string& name, int face, int least = 0) {
    check_index(key, name, face, &trace::Shape::faces, "faces", least);
  };
  if (pair.clip) {  // -1: no face
    check_face(".clip.reference.face", pair.clip->reference.shape, pair.clip->reference.face, -1);
    check_face(".clip.incident.face", pair.clip->incident.shape, pair.clip->incident.face, -1);
  }
  if (pair.sat && pair.sat->face_a) check_face(".sat.face_a.face", pair.a, pair.sat->face_a->face);
  if (pair.sat && pair.sat->face_b) check_face(".sat.face_b.face", pair.b, pair.sat->face_b->face);
  if (pair.sat && pair.sat->edge) {
    check_index(".sat.edge.a", pair.a, pair.sat->edge->a, &trace::Shape::edges, "edges");
    check_index(".sat.edge.b", pair.b, pair.sat->edge->b, &trace::Shape::edges, "edges");
  }
  if (!pair.tree) return;
  for (const int candidate : pair.tree->candidates)
    check_face(".tree.candidates", pair.tree->shape, candidate);
  named(pair.tree->shape, [&] { return place(".tree.shape"); });
}

void TraceChecks::facts(const trace::Frame& frame) const {
  require(frame.frame > last_, [&] {
    return "'frame' is " + std::to_string(frame.frame) +
           "; frames count from 0, in rising order, each once";
  });
  std::unordered_set<std::string_view> placed;
  for (const auto& [name, pose] : frame.poses) {
    placed.insert(name);
    named(name, [] { return std::string("poses"); });
    const double length = pose.rotation.norm();
    require(is_unit(length), [&, &shape = name] {
      return "poses." + shape + ": 'quat_wxyz' has length " + printed("%.4g", length) +
             "; it must be 1";
    });
  }
  for (const trace::Deformed& now : frame.deformed) {
    const std::size_t count =
        named(now.name, [] { return std::string("deformed"); }).vertices.size();
    require(now.vertices.size() == count, [&] {
      return "deformed." + now.name + " has " + std::to_string(now.vertices.size()) +
             " 'vertices', and the header's shape " + std::to_string(count) +
             "; give each of them its place in this frame";
    });
  }
  for (const trace::FieldSlice& slice : frame.field_slices) {
    require(slice.columns > 0 && slice.rows() * slice.columns == count_of(slice.distances), [&] {
      return "field_slices." + slice.name + " has " + std::to_string(slice.distances.size()) +
             " 'distances', which is no number of rows of " + std::to_string(slice.columns) +
             " 'columns'; give each row all of its values";
    });
  }
  for (std::size_t i = 0; i < frame.pairs.size(); ++i) {
    const trace::Pair& one = frame.pairs[i];
    pair(i, one);
    for (const auto& [key, name] : {std::pair(".a", &one.a), std::pair(".b", &one.b)})
      require(placed.contains(*name), [&, &which = key, &shape = name] {
        return "pairs[" + std::to_string(i) + "]" + which + " is '" + *shape +
               "', which has no pose in this frame; a shape that is there has its 'position' and "
               "'quat_wxyz' in 'poses'";
      });
  }
}

}  // namespace contactscope::app
