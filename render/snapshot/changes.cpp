#include "snapshot/changes.h"

#include <fnmatch.h>

#include "image/png.h"
#include "snapshot/check.h"
#include "snapshot/meshes.h"

namespace contactscope::snapshot {

using trace::Kind;

double Tolerance::of(Kind kind, double value) const {
  if (kind == Kind::Exact) return 0;
  if (kind == Kind::Length || kind == Kind::Position) return length;
  if (kind == Kind::Area) return area;
  if (kind == Kind::Direction || kind == Kind::Rotation) return relative;
  if (kind == Kind::Ratio) return relative * std::abs(value);
  return relative * magnitudes[static_cast<std::size_t>(kind)];
}

bool same(double expected, double actual, double tolerance) {
  return std::abs(actual - expected) <= tolerance;
}
bool same(const Vec3d& expected, const Vec3d& actual, double tolerance) {
  return same(expected.x(), actual.x(), tolerance) && same(expected.y(), actual.y(), tolerance) &&
         same(expected.z(), actual.z(), tolerance);
}

namespace {

/// True if a number is within tolerance; settles it. Exact values are not settled: -0.0 equals 0.0
/// but is written differently.
template <class T> bool settle(Kind kind, const T& expected, T& actual, double tolerance) {
  if (!same(expected, actual, tolerance)) return false;
  if (kind != Kind::Exact) actual = expected;
  return true;
}

const std::vector<Vec3d>& points_of(const std::vector<Vec3d>& points) { return points; }
std::vector<Vec3d> points_of(const trace::Simplex& simplex) {
  std::vector<Vec3d> all;
  for (const trace::SimplexVertex& vertex : simplex) all.insert(all.end(), {vertex.a, vertex.b});
  return all;
}

}  // namespace

void Changes::add(const Wording& field, const std::string& change) {
  const std::string record = field.words + change;
  const std::string comma = text_.empty() ? "" : ", ";
  text_ = field.is_first ? record + comma + text_ : text_ + comma + record;
  has_more_ = has_more_ || !field.is_last;
  what_.push_back({field.kind, field.words});
}

bool Changes::both_there(const Wording& field, bool expected, bool actual) {
  if (expected && !actual) add(field, "gone");
  if (!expected && actual) add(field, "added");
  return expected && actual;
}

void Changes::count(const std::string& plural, std::size_t expected, std::size_t actual) {
  if (expected == actual) return;
  add({}, "number of " + plural + " " +
              spell_change(static_cast<int>(expected), static_cast<int>(actual)));
}

void Changes::compare(const Wording& field, double expected, double& actual) {
  if (!settle(field.kind, expected, actual, tolerance_.of(field.kind, expected)))
    add(field, spell_change(expected, actual));
}
void Changes::compare(const Wording& field, bool expected, bool& actual) {
  if (expected != actual)
    add(field, std::string(field.states[expected]) + " -> " + field.states[actual]);
}
void Changes::compare(const Wording& field, const Vec3d& expected, Vec3d& actual) {
  if (settle(field.kind, expected, actual, tolerance_.of(field.kind, expected.norm()))) return;
  if (field.kind == Kind::Position) {
    add(field, spell_move(expected, actual));
  } else if (field.kind == Kind::Direction) {
    add(field, spell_turn(expected, actual));
  } else {
    add(field, spell_vector(expected) + " -> " + spell_vector(actual));
  }
}
void Changes::compare(const Wording& field, const Quatd& expected, Quatd& actual) {
  const double sign = expected.dot(actual) < 0 ? -1 : 1;
  for (int i = 0; i < 4; ++i) {
    if (same(expected.coeffs()[i], sign * actual.coeffs()[i], tolerance_.relative)) continue;
    const Quatd turn = actual * expected.conjugate();
    const double angle = 2 * std::atan2(turn.vec().norm(), std::abs(turn.w()));
    return add(field, "turned by " + spell_angle(angle));
  }
  actual = expected;
}
template <class End>
requires std::same_as<End, Vec3d> || std::same_as<End, double>
void Changes::compare(const Wording& field, const std::array<End, 2>& expected,
                      std::array<End, 2>& actual) {
  const bool is_line = std::same_as<End, Vec3d>;
  Wording end = field;
  end.words = (is_line ? "first point of the " : "lower end of the ") + field.words;
  compare(end, expected[0], actual[0]);
  end.words = (is_line ? "second point of the " : "upper end of the ") + field.words;
  compare(end, expected[1], actual[1]);
}
template void Changes::compare(const Wording&, const std::array<Vec3d, 2>&, std::array<Vec3d, 2>&);
template void Changes::compare(const Wording&, const std::array<double, 2>&,
                               std::array<double, 2>&);

bool Changes::same_length(const Wording& field, std::size_t expected, std::size_t actual) {
  if (expected != actual)
    add({}, std::to_string(expected) + " -> " + std::to_string(actual) + " " +
                field.words.substr(0, field.words.size() - 1) + "s");
  return expected == actual;
}
void Changes::compare(const Wording& field, const std::vector<double>& expected,
                      std::vector<double>& actual) {
  if (!same_length(field, expected.size(), actual.size())) return;
  std::size_t first = 0, changed = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (settle(field.kind, expected[i], actual[i], tolerance_.of(field.kind, expected[i])))
      continue;
    if (changed++ == 0) first = i;
  }
  if (changed == 0) return;
  const std::string more = changed > 1 ? ", " + std::to_string(changed - 1) + " more" : "";
  add(field, std::to_string(first) + " " + spell_change(expected[first], actual[first]) + more);
}

template <class Face>
requires std::same_as<typename Face::value_type, int>
void Changes::compare(const Wording& field, const std::vector<Face>& expected,
                      std::vector<Face>& actual) {
  if (!same_length(field, expected.size(), actual.size())) return;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (expected[i] == actual[i]) continue;
    return add(field, std::to_string(i) + " (" + spell_list(expected[i]) + ") -> (" +
                          spell_list(actual[i]) + ")");
  }
}
using FaceLists = std::vector<std::vector<int>>;
using Edges = std::vector<std::array<int, 2>>;
using Triangles = std::vector<std::array<int, 3>>;
template void Changes::compare(const Wording&, const FaceLists&, FaceLists&);
template void Changes::compare(const Wording&, const Edges&, Edges&);
template void Changes::compare(const Wording&, const Triangles&, Triangles&);

template <class Points>
requires std::same_as<Points, std::vector<Vec3d>> || std::same_as<Points, trace::Simplex>
void Changes::compare(const Wording& field, const Points& expected, Points& actual) {
  if (expected.size() != actual.size()) {
    return add(field, std::to_string(expected.size()) + " -> " + std::to_string(actual.size()) +
                          " vertices");
  }
  const std::vector<Vec3d>& before = points_of(expected);
  const std::vector<Vec3d>& after = points_of(actual);
  std::size_t moved = 0, farthest = 0;
  double distance = -1;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (same(before[i], after[i], tolerance_.length)) continue;
    ++moved;
    const double d = (after[i] - before[i]).norm();
    // NaN outranks every distance.
    if (d <= distance || std::isnan(distance)) continue;
    distance = d;
    farthest = i;
  }
  if (moved == 0) {
    actual = expected;
    return;
  }
  add(field,
      "vertex " + std::to_string(farthest) + " " + spell_move(before[farthest], after[farthest]));
  if (moved > 1) add({}, std::to_string(moved - 1) + " more moved");
}
template void Changes::compare(const Wording&, const std::vector<Vec3d>&, std::vector<Vec3d>&);
template void Changes::compare(const Wording&, const trace::Simplex&, trace::Simplex&);

namespace fs = std::filesystem;

bool names(const std::string& pattern, const Finding& finding) {
  std::string wanted = pattern;
  while (wanted.size() > 1 && wanted.back() == '/') wanted.pop_back();
  std::string key = finding.key();
  // A candidate compared with frame_0012.osmesa.png is still the picture frame_0012.
  if (const std::size_t dot = key.rfind('.');
      dot != std::string::npos && dot > key.rfind('/') &&
      fnmatch(wanted.c_str(), key.substr(0, dot).c_str(), 0) == 0)
    return true;
  while (true) {
    if (fnmatch(wanted.c_str(), key.c_str(), 0) == 0) return true;
    const std::size_t slash = key.rfind('/');
    if (slash == std::string::npos) return false;
    key.resize(slash);
  }
}

std::string pattern_of(const std::string& key) {
  std::string pattern = key.starts_with('-') ? "\\" : "";
  for (const char c : key) {
    if (std::string_view("*?[\\").find(c) != std::string_view::npos) pattern += '\\';
    pattern += c;
  }
  return pattern;
}

std::string accept(const fs::path& report, const fs::path& snapshots, Finding& finding,
                   const Acceptance& how) {
  if (finding.done != Done::Nothing || finding.review == Review::Accepted)
    return finding.key() + " is done already";
  if (finding.kind == FindingKind::UnreadableScenario)
    return finding.key() + " could not be read; fix the file, and run check again";
  if (finding.file.empty())
    return finding.key() + " is an expectation; fix it in the scenario, or fix the program";
  if (finding.kind == FindingKind::KnownBad && how.word.empty())
    return finding.key() + " matches " + finding.file +
           ", which is known to be bad; if it is right after all, remove that file first";
  const fs::path stored = snapshots / finding.file;
  if (sha256_of_file(stored) != finding.stored_sha256)
    return finding.key() + " is stale: " + stored.generic_string() +
           " changed since the report; run check again";
  if (finding.kind == FindingKind::Orphaned) {
    remove_with_meshes(snapshots, stored);
    finding.done = Done::Removed;
    finding.review = Review::Accepted;
    return {};
  }
  const fs::path candidate = report / finding.candidate;
  if (finding.candidate.empty() || sha256_of_file(candidate) != finding.candidate_sha256)
    return finding.key() + " is stale: its candidate " + candidate.generic_string() +
           " is gone, or changed since the report; run check again";
  fs::path target = stored;
  const bool is_bad = how.word.starts_with("bad_");
  if (!how.word.empty()) {
    const bool is_list = stored == hashes_path(snapshots, finding.scenario);
    if (is_list) return finding.key() + " has only one baseline; accept it without --as";
    if (!finding.is_picture() && !is_bad)
      return finding.key() +
             " is not a picture, and only pictures have a baseline per driver; accept it without "
             "--as";
    const std::string name = stored.filename().string();
    target.replace_filename(name.substr(0, name.find('.')) + "." + how.word +
                            stored.extension().string());
  }
  const bool is_there = fs::exists(target);
  if (finding.is_picture())
    write_stored_picture(target, read_png(candidate.string()));
  else if (target.extension() == ".jsonl")
    write_stored_trace(snapshots, target, *read_text_file(candidate));
  else
    write_text(target, *read_text_file(candidate));
  if (!how.note.empty()) write_text(fs::path(target).replace_extension(".txt"), how.note + "\n");
  finding.review = is_bad ? Review::Rejected : Review::Accepted;
  if (!is_bad) finding.done = is_there ? Done::Updated : Done::Written;
  return {};
}

}  // namespace contactscope::snapshot
