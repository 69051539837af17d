#pragma once

#include <algorithm>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <toml++/toml.h>

#include "core/input_error.h"
#include "core/vec3.h"
#include "scenario/nearest_word.h"
#include "scenario/scenario.h"

/// Typed access to a TOML file in which every complaint knows its line and column, and what reads
/// each table of a scenario file. All functions throw InputError when the file says something else
/// than asked for; messages name the key, what was found, and what would be right.
namespace contactscope::scenario_file {

// toml_reader.cpp

using Keys = std::vector<std::string_view>;

/// One value of the file. `name` is what messages call it, "half_extents" or "vertices[3]". Refers
/// to the parsed document and to the file's name, which must outlive it.
class Value {
 public:
  Value(const std::string& file, const toml::node& node, std::string name)
      : file_(&file), node_(&node), name_(std::move(name)) {}

  const std::string& name() const { return name_; }
  int line() const { return static_cast<int>(node_->source().begin.line); }
  bool is_table() const { return node_->is_table(); }
  bool is_array() const { return node_->is_array(); }
  bool is_string() const { return node_->is_string(); }

  /// Throws InputError at this value; the message is made one printable line of bounded length.
  [[noreturn]] void fail(const std::string& message) const;

  /// Finite numbers; integers count. `unit` is for messages: "a number in metres".
  double number(const char* unit = nullptr) const;
  double positive(const char* unit = nullptr) const;
  double not_negative(const char* unit = nullptr) const;
  std::vector<double> numbers(std::size_t count) const;
  Vec3d vector3() const;
  /// From `low` to `high`, inclusive.
  int integer(int low, int high) const;
  bool boolean() const;
  std::string string() const;
  std::string non_empty_string() const;
  /// A string that is one of `choices`; `kind` names what they are, for messages.
  std::string one_of(const Keys& choices, const char* kind) const;
  std::vector<Value> array() const;
  /// An array of tables, as [[name]] makes it.
  std::vector<Value> array_of_tables() const;
  /// This, which must be a table; refuses the first key in the file that is not in `keys`.
  const Value& table(const Keys& keys) const;
  /// The value of a key of this table. Nothing when the key is missing or this is no table.
  std::optional<Value> find(std::string_view key) const;
  /// Sets `target` to what `reader` makes of a key's value, where the file has the key.
  template <class Target, class Reader>
  void read(std::string_view key, Target& target, const Reader& reader) const {
    if (const std::optional<Value> value = find(key)) target = std::invoke(reader, *value);
  }
  /// A missing key is an error at the table; `example` shows how to write it.
  Value require(std::string_view key, const std::string& example) const;
  /// The names in a table of named tables and the values that they name, in file order.
  std::vector<Value> members() const;

 private:
  /// Throws: this value is of the wrong type, `wanted` is what would be right.
  [[noreturn]] void wrong_type(const std::string& wanted) const;

  const std::string* file_;
  const toml::node* node_;
  std::string name_;
};

/// Readers of Value::read(): an integer from `low` to `high`, and the enumerator that has the place
/// of a string among `words`.
inline auto integer_in(int low, int high) {
  return [=](const Value& value) { return value.integer(low, high); };
}
template <class Enum>
auto word_of(const Keys& words, const char* kind) {
  return [words, kind](const Value& value) {
    return static_cast<Enum>(std::ranges::find(words, value.one_of(words, kind)) - words.begin());
  };
}

/// Parses TOML; what is no TOML throws InputError.
toml::table parse_document(const std::string& text, const std::string& file);
/// Reads and parses a file, which may be as large as a scenario. Throws InputError.
toml::table read_document(const std::string& path);

// placement.cpp: where shapes stand and how they move, the keys position, rotation and motion

/// Lengths that a file may name, metres. Products of four lengths (a squared area) of this range
/// stay within what a float holds at full precision, so that no stage meets an infinity or a zero
/// that the geometry does not have.
inline constexpr double kSmallestLength = 1e-9;
inline constexpr double kLargestLength = 1e9;

/// A length greater than zero, in metres, from kSmallestLength to kLargestLength.
double read_length(const Value& value);
/// Three coordinates in metres, each at most kLargestLength from zero.
Vec3d read_position(const Value& value);
/// Three components that are not all zero, made unit.
Vec3d read_direction(const Value& value);
/// The keys position and rotation of a table; what is left out is taken from `otherwise`.
Pose<double> read_pose(const Value& table, const Pose<double>& otherwise);
/// The key `key` of a motion, at most 1e9 `unit`; zero when it is missing.
Vec3d read_velocity(const Value& table, const char* key, const char* unit);
/// A [shapes.NAME.motion] table of a shape that is not dynamic. `start` is the shape's own pose;
/// `end_time` the time of the last frame in seconds, until which constant velocities must stay
/// within kLargestLength.
Motion read_motion(const Value& value, const Pose<double>& start, double end_time);

// shapes.cpp, mesh_shape.cpp, sdf_shape.cpp, deform_keys.cpp

/// What a shape is read in.
struct Surroundings {
  std::filesystem::path folder;        // that names of files are relative to
  Scalar scalar;                       // of the pipeline
  std::vector<std::string>& warnings;  // what a reader should know though nothing is wrong
};

/// The [shapes] table, in file order. `end_time` is the time of the last frame in seconds.
std::vector<ScenarioShape> read_shapes(const Value& value, const Surroundings& surroundings,
                                       double end_time);
/// scatter.cpp: the copies of `model` that a `scatter` key asks for, NAME_1, NAME_2 and so on, each
/// with its place and size. `table` is that of the shape.
std::vector<ScenarioShape> scattered(const ScenarioShape& model, const Value& scatter,
                                     const Value& table);
/// A shape of type "mesh": `vertices` with `triangles`, an .obj `file`, or a `grid`. What was left
/// out of it, triangles without an area, is warned of.
Shape<double> read_mesh(const Value& table, const Surroundings& surroundings);
/// A shape of type "sdf": of which shape, and how fine.
Shape<double> read_sdf(const Value& table, const Surroundings& surroundings);
/// A shape written inline, with its type and no place: anything but another "sdf".
Shape<double> read_plain_shape(const Value& value, const Surroundings& surroundings);
/// The key deform of a [shapes.NAME.motion] table. `shape` has its name, type and geometry already;
/// files are relative to `folder`.
Deformation read_deformation(const Value& value, const ScenarioShape& shape,
                             const std::filesystem::path& folder);
/// [[x, y, z], ..], metres.
std::vector<Vec3d> read_points(const Value& value);
/// Refuses points that are farther than kLargestLength from zero, and shapes that are smaller than
/// kSmallestLength: what is within so small a ball cannot be computed with.
void check_reach(const std::vector<Vec3d>& points, const Value& at);
void check_radius(double radius, const Value& at);
/// The path of a Wavefront file that a `file` key names; it must be there.
std::filesystem::path existing_obj_file(const Value& value, const std::filesystem::path& folder);

/// What `load` makes of that file.
template <class Load>
auto load_obj(const Value& file, const std::filesystem::path& folder, const Load& load) {
  const std::filesystem::path path = existing_obj_file(file, folder);
  try {
    return load(path.string());
  } catch (const InputError& error) {
    file.fail(std::string("'file' cannot be used: ") + error.what());
  }
}

/// What `build` makes; a hull or mesh that cannot be made is an error of the value that describes
/// it.
template <class Build>
auto build_at(const Value& at, const char* kind, const Build& build) {
  try {
    return build();
  } catch (const ShapeError& error) {
    at.fail(std::string("cannot build a ") + kind + " from '" + at.name() + "': " + error.what());
  }
}

// pairs.cpp

PipelineSettings read_pipeline(const Value& value);
/// [[pairs]]; each starts from `settings` and may override all of them but the scalar.
std::vector<ScenarioPair> read_pairs(const Value& value, const std::vector<ScenarioShape>& shapes,
                                     const PipelineSettings& settings);
/// The key broad_phase of [world]; empty where there is none. Refused beside [[pairs]].
std::string read_broad_phase(const std::optional<Value>& world, const std::optional<Value>& pairs);
/// Every pair of `shapes` in file order, each with `settings`; where some are dynamic, every pair
/// of which one is. Too many throw, at `where`.
std::vector<ScenarioPair> every_pair(const std::vector<ScenarioShape>& shapes,
                                     const PipelineSettings& settings, const Value& where);
/// The first of these of every two types of shapes: what can be said of the pairs that a broad
/// phase may choose, before it does.
std::vector<ScenarioPair> one_of_each_kind(const std::vector<ScenarioShape>& shapes,
                                           const PipelineSettings& settings, const Value& where);
/// Takes out the pairs that cannot be asked what they are, as planes and meshes make no contacts
/// with each other: where nothing was looked for, "separated" would be a lie. Warns once of each
/// two kinds of them, and says what to ask instead.
void leave_out_unanswered(Scenario& scenario);
/// Index of the shape that `value` names.
int shape_named(const Value& value, const std::vector<ScenarioShape>& shapes);

// patches.cpp

/// What a file of [[patch]] holds beside its `title`, `source` and `tags`, into `scenario`. `value`:
/// its patches.
void read_patches(const Value& file, const Value& value, Scenario& scenario);

// dynamics_keys.cpp: what the solver goes by

/// Whether a [shapes.NAME.motion] table says dynamic = true.
bool is_dynamic(const Value& motion);
/// Such a table. `shape` has its name, type and geometry already.
ScenarioBody read_body(const Value& motion, const ScenarioShape& shape);
/// [world]. `up` is that of the file: what gravity points away from by default.
WorldSettings read_world(const std::optional<Value>& value, const std::string& up);
/// [solver]. Settled by the smallest dynamic one of `shapes`.
SolverSettings read_solver(const std::optional<Value>& value,
                           const std::vector<ScenarioShape>& shapes);
/// A coefficient of Coulomb's friction, 0 to 1000.
double read_friction(const Value& value);
/// A number from 0 to 1, such as the share of a velocity that a bounce gives back.
double read_share(const Value& value);

// views.cpp

/// A title, whose placeholders are known; see core/title.h.
std::string read_title(const Value& value);
/// Refuses what placeholders of a title name, `of` a pair or a shape, where there is none.
void check_title(const Value& value, const Scenario& scenario);

/// [[views]], at least one.
std::vector<View> read_views(const Value& value);
/// [snapshots] of a scenario with `frames` frames; first, middle and last frame where it is
/// missing.
SnapshotSettings read_snapshots(const std::optional<Value>& value, int frames,
                                const std::vector<View>& views);

// expect.cpp, idle_keys.cpp: when shapes, pairs, solver and frames have been read

std::vector<Expectation> read_expectations(const Value& value, const Scenario& scenario);
/// A warning, with its line, for each key of [pipeline], [[pairs]], [world] and [solver], and each
/// shape's friction or restitution, that is written down and changes nothing in this scene: another
/// method goes by it, or the shapes it is of are not there.
void warn_of_idle_keys(const Value& file, Scenario& scenario);

}  // namespace contactscope::scenario_file
