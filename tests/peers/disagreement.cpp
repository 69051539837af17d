#include "peers/disagreement.h"

#include <cmath>
#include <sstream>

namespace contactscope::peers {
namespace {

const char* to_string(Aspect aspect) {
  constexpr const char* kNames[] = {"touching", "normal", "depth", "deepest"};
  return kNames[static_cast<int>(aspect)];
}

void describe(std::ostream& out, const Shape<double>& shape, const Pose<double>& pose) {
  const Quatd& q = pose.rotation;
  out << "  " << contactscope::to_string(kind_of(shape)) << " at " << pose.position.transpose()
      << ", q (w x y z) " << q.w() << ' ' << q.x() << ' ' << q.y() << ' ' << q.z() << '\n';
  if (const auto* hull = std::get_if<Hull<double>>(&shape)) {
    for (const Vec3d& vertex : hull->vertices) out << "    " << vertex.transpose() << '\n';
  }
  if (const auto* capsule = std::get_if<Capsule<double>>(&shape)) {
    for (const Vec3d& end : capsule->points) out << "    " << end.transpose() << '\n';
  }
  if (radius_of(shape) > 0) out << "    radius " << radius_of(shape) << '\n';
}

}  // namespace

Comparison compare(const test::PairCase<double>& pair, const test::BruteForceAxis& truth,
                   const PeerContact& answer, double tolerance) {
  Comparison result{answer, truth.separation, tolerance, 0, 0, &pair, nullptr};
  if (const PeerPoint* deepest = answer.deepest()) {
    result.reported = -deepest->separation;
    result.overlap = -test::separation_along(deepest->normal.normalized(), pair.a, pair.pose_a,
                                             pair.b, pair.pose_b);
  }
  return result;
}

Comparison compare(const RoundPair& pair, double separation, const PeerContact& answer,
                   double tolerance) {
  Comparison result{answer, separation, tolerance, 0, 0, nullptr, &pair};
  if (const PeerPoint* deepest = answer.deepest()) {
    result.reported = -deepest->separation;
    result.overlap = -separation_along(deepest->normal.normalized(), pair);
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
      << " points, overlap along its normal " << comparison.overlap << '\n';
  if (comparison.hulls != nullptr) {
    describe(out, comparison.hulls->a, comparison.hulls->pose_a);
    describe(out, comparison.hulls->b, comparison.hulls->pose_b);
  } else {
    describe(out, comparison.round->a, comparison.round->pose_a);
    describe(out, comparison.round->b, comparison.round->pose_b);
  }
  unexplained_ += out.str();
  return false;
}

void Tally::add(const Comparison& comparison) {
  ++compared_;
  const bool touching = comparison.separation <= 0;
  const bool kiss = std::abs(comparison.separation) <= comparison.tolerance;
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

void Tally::add(Aspect aspect, const Comparison& comparison) {
  ++compared_;
  explain(aspect, comparison);
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
