#pragma once

#include <toml++/toml.h>

#include "scenario/scenario.h"

/// Typed access to a TOML file, with line and column in every error, and the readers of each table
/// of a scenario file. All functions throw InputError if the file has something else than
/// requested; messages name the key, the value found and the remedy.
namespace contactscope::scenario_file {

// toml_reader.cpp

using Keys = std::vector<std::string_view>;

/// One value of the file. `name` appears in messages: "half_extents" or "vertices[3]". Its type and
/// limits are those of its key (key_table()). Refers to the document and the file's name.
class Value {
 public:
  Value(const std::string& file, const toml::node& node, std::string name, const Key* key = nullptr)
      : file_(&file), node_(&node), name_(std::move(name)), key_(key) {}

  const std::string& name() const { return name_; }
  int line() const { return static_cast<int>(node_->source().begin.line); }
  bool is_table() const { return node_->is_table(); }
  bool is_array() const { return node_->is_array(); }
  bool is_string() const { return node_->is_string(); }

  /// Throws InputError at this value; the message becomes one printable line of limited length.
  [[noreturn]] void fail(const std::string& message) const;

  /// A finite number within the limits of the key, including integers.
  double number() const;
  /// That many such numbers.
  std::vector<double> numbers(std::size_t count) const;
  Vec3d vector3() const;
  /// Within the limits of the key; or from `low` to `high`, inclusive.
  int integer() const;
  int integer(int low, int high) const;
  bool boolean() const;
  /// One of the words of the key, if it has some.
  std::string string() const;
  std::string non_empty_string() const;
  /// A string that is one of `choices`; `kind` describes them in messages.
  std::string one_of(const Keys& choices, const std::string& kind) const;
  /// The position of such a string among the words of the key.
  int word() const;
  std::vector<Value> array() const;
  std::vector<Value> array_of_tables() const;
  /// This, which must be a table with the keys of these tables; rejects the first other key.
  Value table(const Keys& tables) const;
  /// This as a table with the keys of these tables among others.
  Value among(const Keys& tables) const;
  /// The value of a key of this table. Empty if the key is missing or this is not a table.
  std::optional<Value> find(std::string_view key) const;
  /// Sets `target` if the file has the key. An enumerator has the position of its word.
  template <class Target> void read(std::string_view key, Target& target) const {
    if (const std::optional<Value> value = find(key)) value->get(target);
  }
  /// The same with a reader.
  template <class Target, class Reader>
  void read(std::string_view key, Target& target, const Reader& reader) const {
    if (const std::optional<Value> value = find(key)) target = std::invoke(reader, *value);
  }
  /// Throws at the table if the key is missing, with the example of the key.
  Value require(std::string_view key) const;
  /// Throws at the second of these keys if the table has both.
  void not_both(std::string_view one, std::string_view other) const;
  /// The named values of a table, in file order.
  std::vector<Value> members() const;

 private:
  void get(bool& target) const { target = boolean(); }
  void get(int& target) const { target = integer(); }
  void get(double& target) const { target = number(); }
  void get(std::string& target) const { target = string(); }
  void get(Vec3d& target) const { target = vector3(); }
  template <class Target> void get(std::optional<Target>& target) const { get(target.emplace()); }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void get(Enum& target) const { target = static_cast<Enum>(word()); }

  /// Throws: this value has the wrong type; `wanted` describes the right one.
  [[noreturn]] void wrong_type(const std::string& wanted) const;
  void require_one(const std::string& text, const Keys& choices, const std::string& kind) const;
  /// The message for an unknown key of this table.
  std::string unknown(std::string_view key, const toml::node& value, const Keys& known) const;
  /// A part of this value, with the limits of its key.
  Value part(const toml::node& node, std::string name) const {
    return Value(*file_, node, std::move(name), key_);
  }

  const std::string* file_;
  const toml::node* node_;
  std::string name_;
  const Key* key_;  // null: any type
  Keys tables_{};   // of its keys
};

/// Throws InputError if the text is not TOML.
toml::table parse_document(const std::string& text, const std::string& file);
/// Reads and parses a file of at most the size of a scenario. Throws InputError.
toml::table read_document(const std::string& path);

// placement.cpp: poses and motions, the keys position, rotation and motion

/// Valid lengths in metres. Products of four such lengths (a squared area) keep full float
/// precision, so no stage meets an infinity or zero that is not in the geometry.
inline constexpr double kSmallestLength = 1e-9;
inline constexpr double kLargestLength = 1e9;

/// Three components, not all zero, normalised.
Vec3d read_direction(const Value& value);
/// The keys position and rotation of a table; missing ones come from `otherwise`.
Pose<double> read_pose(const Value& table, const Pose<double>& otherwise);
/// A [shapes.NAME.motion] table of a shape that is not dynamic. `start`: the shape's own pose;
/// `end_time`: of the last frame, seconds, until when it must stay within kLargestLength.
Motion read_motion(const Value& value, const Pose<double>& start, double end_time);

// shapes.cpp, mesh_shape.cpp, placement.cpp

/// Context for reading a shape.
struct Surroundings {
  std::filesystem::path folder;        // base of relative file names
  Scalar scalar;                       // of the pipeline
  std::vector<std::string>& warnings;  // for what is suspicious but not an error
};

/// The [shapes] table, in file order. `end_time`: time of the last frame in seconds.
std::vector<ScenarioShape> read_shapes(const Value& value, const Surroundings& surroundings,
                                       double end_time);
/// The copies of `model` for a `scatter` key, named NAME_1, NAME_2, ..., each with its
/// position and size. `table` is the shape's table.
std::vector<ScenarioShape> scattered(const ScenarioShape& model, const Value& scatter,
                                     const Value& table);
/// A shape of type "mesh": `vertices` with `triangles`, a `file`, or a `grid`.
Shape<double> read_mesh(const Value& table, const Surroundings& surroundings);
/// A shape of type "sdf": source shape and resolution.
Shape<double> read_sdf(const Value& table, const Surroundings& surroundings);
/// An inline shape with a type but no pose: any type except "sdf".
Shape<double> read_plain_shape(const Value& value, const Surroundings& surroundings);
/// The key deform of a motion. `shape` has its geometry; file names are relative to `folder`.
Deformation read_deformation(const Value& value, const ScenarioShape& shape,
                             const std::filesystem::path& folder);
/// [[x, y, z], ..], metres.
std::vector<Vec3d> read_points(const Value& value);
/// Reject points farther than kLargestLength from zero, and shapes smaller than kSmallestLength.
void check_reach(const std::vector<Vec3d>& points, const Value& at);
void check_radius(double radius, const Value& at);
/// The path of the mesh in a `file` key; the file must exist.
std::filesystem::path existing_mesh_file(const Value& value, const std::filesystem::path& folder);

/// The result of `load` for that file.
template <class Load>
auto load_file(const Value& file, const std::filesystem::path& folder, const Load& load) {
  const std::filesystem::path path = existing_mesh_file(file, folder);
  try {
    return load(path.string());
  } catch (const InputError& error) {
    file.fail(std::string("'file' cannot be used: ") + error.what());
  }
}

/// The result of `build`; its failure is an error of the value that describes the shape.
template <class Build> auto build_at(const Value& at, const char* kind, const Build& build) {
  try {
    return build();
  } catch (const ShapeError& error) {
    at.fail(std::string("cannot build a ") + kind + " from '" + at.name() + "': " + error.what());
  }
}

// pairs.cpp

PipelineSettings read_pipeline(const Value& value);
/// [[pairs]]; each starts from `settings` and may override all except the scalar.
std::vector<ScenarioPair> read_pairs(const Value& value, const std::vector<ScenarioShape>& shapes,
                                     const PipelineSettings& settings);
/// The key broad_phase of [world]; empty if missing. Rejected together with [[pairs]].
std::string read_broad_phase(const std::optional<Value>& world, const std::optional<Value>& pairs);
/// All pairs of `shapes` in file order, with `settings`; only pairs with a dynamic shape if there
/// are any. Throws at `where` if there are too many.
std::vector<ScenarioPair> every_pair(const std::vector<ScenarioShape>& shapes,
                                     const PipelineSettings& settings, const Value& where);
/// The first pair of every two types of shapes, to check pairs before a broad phase selects any.
std::vector<ScenarioPair> one_of_each_kind(const std::vector<ScenarioShape>& shapes,
                                           const PipelineSettings& settings, const Value& where);
/// Removes pairs whose query is not supported, such as contacts between planes and meshes, where
/// "separated" would be false. Warns once per two types and suggests another query.
void leave_out_unanswered(Scenario& scenario);
/// Index of the shape with the name in `value`.
int shape_named(const Value& value, const std::vector<ScenarioShape>& shapes);

/// Reads a file of [[patch]] into `scenario`, except its header. `value`: its patches.
void read_patches(const Value& file, const Value& value, Scenario& scenario);

// dynamics_keys.cpp: solver settings

/// Whether a [shapes.NAME.motion] table has dynamic = true.
bool is_dynamic(const Value& motion);
/// Reads such a table. `shape` already has its name, type and geometry.
ScenarioBody read_body(const Value& motion, const ScenarioShape& shape);
/// [world]. Gravity points away from the file's `up` by default.
WorldSettings read_world(const std::optional<Value>& value, const std::string& up);
/// [solver]. Lengths are adjusted to the smallest dynamic one of `shapes`.
SolverSettings read_solver(const std::optional<Value>& value,
                           const std::vector<ScenarioShape>& shapes);
// scenario.cpp

/// A [words] table: texts of pictures, or `names`, with their replacements. Throws InputError for an
/// unknown text, or if a replacement loses its place.
Words read_words_table(const Value& table, const std::vector<std::string_view>& names);

// views.cpp

/// A title with valid placeholders; see view/title.h.
std::string read_title(const Value& value);
/// Rejects title placeholders whose `of` names a pair or shape that does not exist.
void check_title(const Value& value, const Scenario& scenario);

/// [[views]], at least one.
std::vector<View> read_views(const Value& value);
/// [snapshots] of a scenario with `frames` frames. Default: first, middle and last frame.
SnapshotSettings read_snapshots(const std::optional<Value>& value, int frames,
                                const std::vector<View>& views);

// expect.cpp, idle_keys.cpp: called after shapes, pairs, solver and frames have been read

std::vector<Expectation> read_expectations(const Value& value, const Scenario& scenario);
/// Warns, with the line, of each key of [pipeline], [[pairs]], [world] and [solver], and of each
/// shape's friction and restitution, that has no effect in this scene.
void warn_of_idle_keys(const Value& file, Scenario& scenario);

}  // namespace contactscope::scenario_file
