#pragma once

#include <optional>
#include <string>
#include <vector>

#include "collide.h"
#include "manifold.h"
#include "trace.h"

/// Contacts held against stored ones, for any test framework: `contactscope/gtest.h` has matchers for
/// GoogleTest; with Catch2 and doctest
///
///     const auto same = contactscope::compare_with_snapshot(manifold, "stack/frame_12");
///     INFO(same.message);
///     CHECK(same.ok);
namespace contactscope::package {

struct Comparison {
  bool ok = false;
  /// Which point moved and how far, where the pictures are, and what to do; of one that is ok empty, but
  /// for a snapshot that was written.
  std::string message{};

  explicit operator bool() const { return ok; }
};

struct SnapshotOptions {
  /// Where snapshots lie: FOLDER/GROUP/IDEA/trace.jsonl. Empty: $CONTACTSCOPE_SNAPSHOTS, and without it
  /// "snapshots", in the working directory of the test.
  std::string folder{};
  /// Where a failure leaves pictures: OUT/check/GROUP/IDEA/. Empty: $CONTACTSCOPE_OUT, and without it "out".
  std::string out{};
  /// Whether a snapshot is written that is missing or differs. Nothing: where $CONTACTSCOPE_UPDATE is 1 or
  /// true. With CI=true or 1 in the environment nothing is ever written.
  std::optional<bool> update{};
  bool pictures = true;  // false: a failure opens no OpenGL
  /// Of manifolds alone: what the engine computed them with, which says how exactly they are compared.
  Scalar scalar = Scalar::Float;
};

/// Compares with the trace that is stored under a name, GROUP/IDEA, by the rules of `contactscope check`:
/// ids, counts and names exactly, numbers within a few roundings of the scalar at the size and place of
/// the shapes. Pictures are drawn of the facts where these differ; none are stored.
///
/// A snapshot is written when that is asked for, and then it is ok. A missing one is a failure that says
/// how to write it. Throws InputError of a stored file that is no trace, std::invalid_argument for a name
/// that is not GROUP/IDEA, and std::filesystem::filesystem_error.
Comparison compare_with_snapshot(const Trace& trace, const std::string& name,
                                 const SnapshotOptions& options = {});

/// The same of manifolds alone, as any engine gives them. Pictures have stand-ins for the shapes, which
/// are not compared: the plane of the first manifold, and on it the outline of all points.
Comparison compare_with_snapshot(const std::vector<Manifold>& manifolds, const std::string& name,
                                 const SnapshotOptions& options = {});
Comparison compare_with_snapshot(const Manifold& manifold, const std::string& name,
                                 const SnapshotOptions& options = {});

/// The same of a whole trace where they were recorded, else of the manifolds.
Comparison compare_with_snapshot(const Contacts& contacts, const std::string& name,
                                 const SnapshotOptions& options = {});

/// Whether a manifold has this normal, this depth (metres that its deepest point overlaps by; negative:
/// apart) and these points in any order, world, metres: each coordinate and length within `tolerance`,
/// metres, and each component of the normal within the same number.
Comparison compare_manifold(const Manifold& manifold, const Vec3& normal, double depth,
                            const std::vector<Vec3>& points, double tolerance);

}  // namespace contactscope::package
