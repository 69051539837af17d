#pragma once

#include "snapshot/finding.h"
#include "trace/minkowski.h"

namespace contactscope::snapshot {

// Quantities of reports are spelled in suitable units, with few digits.

/// "1.3 mm", "12.4 um", "1.25 m": three significant digits, no sign.
std::string spell_length(double metres);

/// "(0.7, 0, -0.71)": three significant digits each.
std::string spell_vector(const Vec3d& vector);

/// "0 3 5 6".
std::string spell_list(std::span<const int> numbers);

/// "3" or "3 to 9, 12": increasing numbers, with runs collapsed.
std::string spell_numbers(std::span<const int> numbers);

/// Two values with enough decimals to show two digits of their difference: "-0.0050", "-0.0037".
std::array<std::string, 2> spell_both(double a, double b);
/// Likewise, "-0.0050 -> -0.0037".
std::string spell_change(double expected, double actual);
std::string spell_change(const std::string& expected, const std::string& actual);
std::string spell_change(int expected, int actual);
std::string spell_change(std::span<const int> expected, std::span<const int> actual);

/// "moved 1.3 mm along x" or "moved 0.2 m along (0.7, 0, -0.71)"; the points must differ.
std::string spell_move(const Vec3d& expected, const Vec3d& actual);

/// "flipped" or "turned by 3.2 degrees"; the directions must differ.
std::string spell_turn(const Vec3d& expected, const Vec3d& actual);

/// "3.2 degrees": two significant digits.
std::string spell_angle(double radians);

/// Largest difference of two numbers of one trace that count as equal.
struct Tolerance {
  double length = 0;    // metres
  double relative = 0;  // of a component of a unit vector or quaternion, and of a magnitude
  double area = 0;      // square metres
  /// Approximate largest impulse, velocity, spin and energy, as the scale of such quantities: by
  /// Kind, in the trace's units; 0 for other kinds.
  std::array<double, trace::kKinds> magnitudes{};

  double& magnitude(trace::Kind kind) { return magnitudes[static_cast<std::size_t>(kind)]; }
  /// For a value of this kind.
  double of(trace::Kind kind, double value) const;
};

/// Equal within the tolerance; never if one is NaN.
bool same(double expected, double actual, double tolerance);
bool same(const Vec3d& expected, const Vec3d& actual, double tolerance);

/// A field in a sentence.
struct Wording {
  std::string words;  // empty, or with a trailing space
  trace::Kind kind = trace::Kind::Exact;
  std::array<const char*, 2> states{};  // names of false and true
  bool is_first = false;
  bool is_last = false;
};

/// Collects the changes of one object as part of a sentence: "sat face_a: face 1 -> 3, separation
/// -0.0050 -> -0.0037". Names, indices and texts compare exactly, numbers within the tolerance of
/// their kind. Numbers within tolerance are settled: the actual one is set to the expected one.
/// Bytes that still differ afterwards are either reported or not compared.
class Changes {
 public:
  Changes(std::string subject, const Tolerance& tolerance)
      : subject_(std::move(subject)), tolerance_(tolerance) {}

  void compare(const Wording& field, double expected, double& actual);
  void compare(const Wording& field, bool expected, bool& actual);
  void compare(const Wording& field, const Vec3d& expected, Vec3d& actual);
  /// q and -q are the same rotation.
  void compare(const Wording& field, const Quatd& expected, Quatd& actual);
  /// End points of a line, or an interval.
  template <class End>
  requires std::same_as<End, Vec3d> || std::same_as<End, double>
  void compare(const Wording& field, const std::array<End, 2>& expected,
               std::array<End, 2>& actual);
  /// "120 -> 100 distances" or "distance 7 0.5 -> 0.6, 2 more".
  void compare(const Wording& field, const std::vector<double>& expected,
               std::vector<double>& actual);
  /// An index, a name or a list of indices: "3 -> 4".
  template <class T>
  requires requires(const T& value) { spell_change(value, value); }
  void compare(const Wording& field, const T& expected, T& actual) {
    if (expected != actual) add(field, spell_change(expected, actual));
  }
  /// "5 -> 4 vertices" or "vertex 3 moved 1.3 mm along x, 2 more moved". A vertex of a simplex is
  /// two points.
  template <class Points>
  requires std::same_as<Points, std::vector<Vec3d>> || std::same_as<Points, trace::Simplex>
  void compare(const Wording& field, const Points& expected, Points& actual);
  /// "20 -> 24 faces" or, for the first that differs, "face 7 (0 1 3) -> (0 3 1)".
  template <class Face>
  requires std::same_as<typename Face::value_type, int>
  void compare(const Wording& field, const std::vector<Face>& expected, std::vector<Face>& actual);
  template <class T>
  void compare(const Wording& field, const std::optional<T>& expected, std::optional<T>& actual) {
    if (both_there(field, expected.has_value(), actual.has_value()))
      compare(field, *expected, *actual);
  }
  /// Adds "axis gone" or "axis added" if only one exists; true if both exist.
  bool both_there(const Wording& field, bool expected, bool actual);
  /// Adds "number of steps 3 -> 4" if the counts differ.
  void count(const std::string& plural, std::size_t expected, std::size_t actual);

  /// A kind of value that changed. Exact ones have words: "id " for the id of a point.
  struct What {
    trace::Kind kind = trace::Kind::Exact;
    std::string words{};
  };
  const std::vector<What>& what() const { return what_; }

  /// Part of a sentence; empty if nothing changed.
  std::string text() const { return text_.empty() ? std::string() : subject_ + text_; }
  /// All changes are of fields that are reported last.
  bool is_last() const { return !has_more_; }

 private:
  void add(const Wording& field, const std::string& change);
  /// Adds "120 -> 100 distances" unless the lengths are equal.
  bool same_length(const Wording& field, std::size_t expected, std::size_t actual);

  std::string subject_;
  Tolerance tolerance_;
  std::string text_;
  std::vector<What> what_;
  bool has_more_ = false;
};

/// Matches a finding against a pattern: its key, with or without the word of the compared
/// baseline, a folder above it ("hull", "hull/face_contact"), or either with wildcards * and ?.
bool names(const std::string& pattern, const Finding& finding);

/// A pattern that matches only this key: wildcards and a leading option dash are escaped with a
/// backslash.
std::string pattern_of(const std::string& key);

/// How a candidate is stored.
struct Acceptance {
  std::string word{};  // "osmesa": next to the stored file, as frame_0012.osmesa.png
  std::string note{};  // for a word that starts with "bad_": text of frame_0012.bad_31.txt
};

/// Stores the candidate of a finding like `check --update`, without a run, and removes obsolete
/// files. With a word that starts with "bad_", the candidate becomes known bad and still fails.
/// Returns why it refused, else an empty text: the files changed since the report, or there is
/// nothing to store. `report` has findings.json. Throws std::filesystem::filesystem_error.
std::string accept(const std::filesystem::path& report, const std::filesystem::path& snapshots,
                   Finding& finding, const Acceptance& how = {});

}  // namespace contactscope::snapshot
