#pragma once

#include <gmock/gmock.h>

#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "snapshot.h"

/// Matchers for GoogleTest, header only. They need gmock in a version with EXPECT_THAT.
namespace contactscope::package {

/// Printers for GoogleTest.
inline void PrintTo(const Manifold& manifold, std::ostream* out) { *out << to_string(manifold); }
inline void PrintTo(const Contacts& contacts, std::ostream* out) {
  *out << to_string(contacts.status) << ", " << contacts.manifolds.size() << " manifolds";
  for (const Manifold& manifold : contacts.manifolds) *out << "; " << to_string(manifold);
}
inline void PrintTo(const Trace& trace, std::ostream* out) {
  *out << "a trace of " << trace.frame_count() << " frames";
}

class SnapshotMatcher {
 public:
  SnapshotMatcher(std::string name, SnapshotOptions options)
      : name_(std::move(name)), options_(std::move(options)) {}

  template <class Value>
  bool MatchAndExplain(const Value& value, testing::MatchResultListener* listener) const {
    const Comparison found = compare_with_snapshot(value, name_, options_);
    if (!found.message.empty()) *listener << (found.ok ? "" : "which differs:\n") << found.message;
    return found.ok;
  }
  void DescribeTo(std::ostream* out) const { *out << "matches the snapshot " << name_; }
  void DescribeNegationTo(std::ostream* out) const {
    *out << "differs from the snapshot " << name_;
  }

 private:
  std::string name_;
  SnapshotOptions options_;
};

/// EXPECT_THAT(manifold, contactscope::MatchesSnapshot("stack/frame_12")). Accepts a Manifold, a
/// vector of them, Contacts or a Trace; see compare_with_snapshot().
inline testing::PolymorphicMatcher<SnapshotMatcher> MatchesSnapshot(std::string name,
                                                                    SnapshotOptions options = {}) {
  return testing::MakePolymorphicMatcher(SnapshotMatcher(std::move(name), std::move(options)));
}

class ManifoldMatcher {
 public:
  ManifoldMatcher(Vec3 normal, double depth, std::vector<Vec3> points, double tolerance)
      : normal_(normal), depth_(depth), points_(std::move(points)), tolerance_(tolerance) {}

  bool MatchAndExplain(const Manifold& manifold, testing::MatchResultListener* listener) const {
    const Comparison found = compare_manifold(manifold, normal_, depth_, points_, tolerance_);
    *listener << found.message;
    return found.ok;
  }
  void DescribeTo(std::ostream* out) const {
    *out << "has the " << to_string(expected()) << ", within " << tolerance_ << " m, and is "
         << depth_ << " m deep";
  }
  void DescribeNegationTo(std::ostream* out) const {
    *out << "is not a manifold that ";
    DescribeTo(out);
  }

 private:
  Manifold expected() const {
    Manifold manifold{normal_};
    for (const Vec3& point : points_) manifold.points.push_back({point, -depth_});
    return manifold;
  }

  Vec3 normal_;
  double depth_;
  std::vector<Vec3> points_;
  double tolerance_;
};

/// EXPECT_THAT(manifold, contactscope::IsManifold({0, 1, 0}, 0.02, {{1, 0, 1}, {-1, 0, 1}}, 1e-6)).
/// See compare_manifold().
inline testing::PolymorphicMatcher<ManifoldMatcher> IsManifold(Vec3 normal, double depth,
                                                               std::vector<Vec3> points,
                                                               double tolerance) {
  return testing::MakePolymorphicMatcher(
      ManifoldMatcher(normal, depth, std::move(points), tolerance));
}

}  // namespace contactscope::package
