#pragma once

#include <unordered_map>

#include "find/expression.h"
#include "lint/linter.h"
#include "trace/read_trace.h"

namespace contactscope::find {

/// A pair in a frame, and in the frame before. A pair that is not there has no contacts.
struct PairMoment {
  const trace::Pair* now = nullptr;     // never null
  const trace::Pair* before = nullptr;  // null: there is no frame before
  const trace::Frame* frame = nullptr;
  std::size_t manifold = 0;  // of `now`: whose texts and normals count
  double age = kUnknown;     // frames of contact without a break; 0 in the first
  double away = kUnknown;    // frames without contact before that, or up to now
  std::array<const Pose<double>*, 2> poses{}, poses_before{};  // of a and b; null: unknown
};

struct PairQuantity : Quantity {
  Value (*of)(const PairMoment& moment) = nullptr;
};

/// All that an expression about a pair in a frame may name. The first ones follow from the pair alone.
const std::vector<PairQuantity>& pair_quantities();
inline constexpr std::size_t kOfPairAlone = 12;
Value value_of(const PairMoment& moment, const std::string& quantity);

/// The names of an expression about a pair in a frame: those of pair_quantities(), the side
/// "previous", the pair in the frame before, and "lint", the number of findings about it.
const Vocabulary& vocabulary();

/// A pair in a frame for which the expression holds, for one of its manifolds.
struct Hit {
  int frame = 0;
  double time = 0;  // seconds
  std::string a, b, label;
  std::vector<Value> values;  // of the expression's facts, in order
};

/// Finds the pairs for which an expression holds, frame by frame. A pair that left the trace is
/// still tried in the first frame without it. Memory depends on the largest frame and on the number
/// of different pairs.
class Finder {
 public:
  explicit Finder(Expression expression);

  const Expression& expression() const { return expression_; }
  /// The parts of a frame that the expression needs.
  trace::Parts parts() const { return {.poses = wants_poses_ || wants_ids_, .stages = false}; }
  /// Whether points without an id of their engine should have one from trace::name_points().
  bool wants_ids() const { return wants_ids_; }
  bool wants_lint() const { return wants_lint_; }
  /// Before the first frame, if it wants them: all findings of the trace, with every mark. A pair that
  /// one names is tried in that frame, also if it is not there. Returns sentences about those that
  /// it wants and that are below a threshold.
  std::vector<std::string> take(const std::vector<lint::Finding>& findings);
  /// The hits of the next frame, in the order of its pairs.
  std::vector<Hit> next(trace::Frame frame);

 private:
  /// A frame, its pairs and poses by name.
  struct Moment {
    trace::Frame frame;
    std::unordered_map<std::string, const trace::Pair*> pairs;
    std::unordered_map<std::string, const Pose<double>*> poses;
  };
  /// Contact of a pair over the frames, by their place in the trace.
  struct Contact {
    int first = 0;  // of the frames in which it touches without a break
    int last = -1;
    int away = -1;  // frames without contact before that; -1: it had not touched before
  };
  /// Number of findings about a pair in the frame, of this cause or any.
  double findings_about(const trace::Pair& pair, const std::string& cause) const;
  void try_pair(const trace::Pair& now, const trace::Pair* before, const Contact& contact,
                std::vector<Hit>& hits) const;

  Expression expression_;
  bool wants_poses_ = false, wants_ids_ = false, wants_manifolds_ = false, wants_lint_ = false;
  std::optional<Moment> now_, before_;
  int place_ = -1;  // of the frame in the trace
  std::unordered_map<std::string, Contact> contacts_;
  /// Causes by frame and by shapes in order; the first one is empty if a finding names one shape.
  using Named = std::map<std::pair<std::string, std::string>, std::vector<std::string>>;
  std::unordered_map<int, Named> named_;
};

}  // namespace contactscope::find
