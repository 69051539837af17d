#include "peers/disagreement.h"

#include <cmath>
#include <sstream>

namespace contactscope::peers {
namespace {

const char* to_string(Aspect aspect) {
  constexpr const char* kNames[] = {"touching", "normal", "depth"};
  return kNames[static_cast<int>(aspect)];
}

void describe(std::ostream& out, const Pose<double>& pose) {
  const Quatd& q = pose.rotation;
  out << "  at " << pose.position.transpose() << ", q (w x y z) " << q.w() << ' ' << q.x() << ' '
      << q.y() << ' ' << q.z() << '\n';
}

void describe(std::ostream& out, const Hull<double>& hull) {
  for (const Vec3d& vertex : hull.vertices) out << "    " << vertex.transpose() << '\n';
}

}  // namespace

Comparison compare(const test::PairCase<double>& pair, const test::BruteForceAxis& truth,
                   const PeerContact& answer, double tolerance) {
  Comparison result{pair, truth, answer, tolerance};
  if (const PeerPoint* deepest = answer.deepest()) {
    result.reported = -deepest->separation;
    result.overlap = -test::separation_along(deepest->normal.normalized(), pair.a, pair.pose_a,
                                             pair.b, pair.pose_b);
  }
  return result;
}

bool Tally::explain(Aspect aspect, const Comparison& comparison) {
  for (const Rule& rule : rules_) {
    if (rule.aspect != aspect || !rule.explains(comparison)) continue;
    ++counts_[rule.name];
    return true;
  }
  std::ostringstream out;
  out.precision(17);
  out << to_string(aspect) << ": depth " << comparison.depth() << ", reported "
      << comparison.reported << " in " << comparison.answer.points.size()
      << " points, overlap along its normal " << comparison.overlap << "\n  A\n";
  describe(out, comparison.pair.a);
  describe(out, comparison.pair.pose_a);
  out << "  B\n";
  describe(out, comparison.pair.b);
  describe(out, comparison.pair.pose_b);
  unexplained_ += out.str();
  return false;
}

void Tally::add(const Comparison& comparison) {
  ++compared_;
  const bool touching = comparison.truth.separation <= 0;
  const bool kiss = std::abs(comparison.truth.separation) <= comparison.tolerance;
  if (comparison.answer.touching() != touching && !kiss) {
    explain(Aspect::Touching, comparison);
    return;
  }
  bool agrees = true;
  if (touching && comparison.answer.touching()) {
    if (comparison.overlap > comparison.depth() + comparison.tolerance) {
      explain(Aspect::Normal, comparison);
      agrees = false;
    }
    if (std::abs(comparison.reported - comparison.overlap) > comparison.tolerance) {
      explain(Aspect::Depth, comparison);
      agrees = false;
    }
  }
  if (agrees) ++agreed_;
}

int Tally::count(const std::string& rule) const {
  const auto found = counts_.find(rule);
  return found == counts_.end() ? 0 : found->second;
}

std::string Tally::summary() const {
  std::ostringstream out;
  out << agreed_ << " of " << compared_ << " agree";
  for (const auto& [rule, count] : counts_) out << "; " << count << " " << rule;
  return out.str();
}

}  // namespace contactscope::peers
