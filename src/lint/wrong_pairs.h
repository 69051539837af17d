#pragma once

#include <bitset>
#include <unordered_map>

#include "lint/claims.h"
#include "lint/linter.h"

namespace contactscope::lint {

/// Fits all explanations.
inline constexpr std::size_t kMaxExplanations = 512;

/// A pair of a frame with wrong claims, representing all with the same errors.
struct WrongPair {
  int line = 0, frame = 0;
  std::string a, b;
  Problem problem;
  std::string said{}, is{};
  std::optional<Vec3d> at{};      // the point of the problem, world
  std::optional<Vec3d> normal{};  // of the shapes, or the opposite of the record's, world
  double deeper = 0;              // metres of excess overlap if all points agree; else 0
  /// The scale of a, of b, or of both alike, under which all points fit, and the margin of a or of b
  /// as such a scale; 0: there is none.
  std::array<double, 5> scales{};
  static bool is_margin(std::size_t scale) { return scale > 2; }
  /// The shape that a scale is of; none for that of both.
  std::string scaled(std::size_t scale) const { return scale == 2 ? "" : scale % 3 == 0 ? a : b; }
  OfPair place() const { return {a, b, 0, line, frame, said, is}; }
  Mark mark() const { return {frame, line, a, b, at, normal}; }
  double size = 1;  // of the error, relative to the smaller shape
  std::bitset<kMaxExplanations> explained_by{};
  bool gross = false;                          // beyond most of an engine's approximations
  bool severe = false;                         // beyond all of them
  bool beyond = true, grossly_beyond = false;  // likewise for the tolerance that the user gives
  bool record = false;
  bool is_copy = false;        // of another one, for its place; the mark of its own is in `others`
  int times = 1;               // number of pairs
  std::vector<Mark> others{};  // of these, if all are marked
};

/// Pairs whose points are all off by the same amount for 8 frames or more: no approximation.
class SteadyErrors {
 public:
  /// Makes the last of these the first one, as severe.
  void see(WrongPair& wrong);

 private:
  struct Run {
    WrongPair first{};
    int last = 0, times = 0;  // frame, and number of frames
  };
  std::map<std::pair<std::string, std::string>, Run> runs_;
};

/// The finding of wrong claims of a kind that nothing explains (causes.cpp).
struct Words {
  const char *cause, *what, *remedy;
};
extern const Words kUnexplained[kWrongs];

/// Writes what is said and what is measured, from its problem.
void put_in_words(const trace::Pair& pair, WrongPair& wrong);

/// The wrong pairs of a trace of any length: the first few thousand individually, later ones only
/// if they differ, with their count.
class WrongPairs {
 public:
  void add(WrongPair pair, bool is_marked = false);

  int count() const { return count_; }
  /// Number of pairs that are not reported yet.
  int untold() const;
  /// Metres by which the separations of all of these are too deep, if they agree; else 0.
  double common_depth() const;

  auto begin() { return kept_.begin(); }
  auto end() { return kept_.end(); }

 private:
  std::vector<WrongPair> kept_;
  std::unordered_map<std::string, std::size_t> places_;  // indices of kept_ by kind of error
  int count_ = 0;
};

}  // namespace contactscope::lint
