#pragma once

#include <optional>
#include <string>
#include <vector>

#include "collide.h"
#include "manifold.h"
#include "trace.h"

/// Compares contacts with stored ones in any test framework. GoogleTest has matchers in
/// `contactscope/gtest.h`; with Catch2 and doctest:
///
///     const auto same = contactscope::compare_with_snapshot(manifold, "stack/frame_12");
///     INFO(same.message);
///     CHECK(same.ok);
namespace contactscope::package {

struct Comparison {
  bool ok = false;
  /// Which point moved and how far, the pictures, and the remedy. If ok, only what was written.
  std::string message{};

  explicit operator bool() const { return ok; }
};

struct SnapshotOptions {
  /// Folder of snapshots FOLDER/GROUP/IDEA/trace.jsonl. Empty: $CONTACTSCOPE_SNAPSHOTS, or else
  /// "snapshots" in the working directory of the test.
  std::string folder{};
  /// Pictures of failures are in OUT/check/GROUP/IDEA/. Empty: $CONTACTSCOPE_OUT, or else "out".
  std::string out{};
  /// Writes missing and changed snapshots. Nullopt: if $CONTACTSCOPE_UPDATE is 1 or true. Never
  /// writes if CI is 1 or true in the environment.
  std::optional<bool> update{};
  bool pictures = true;  // false: failures do not open OpenGL
  /// For manifolds without a trace: the precision of the engine, which determines tolerances.
  Scalar scalar = Scalar::Float;
};

/// Compares with the stored trace GROUP/IDEA by the rules of `contactscope check`: ids, counts and
/// names exactly, numbers within a few roundings of the scalar at the shapes' size and position.
/// Pictures are drawn from the facts when these differ; none are stored.
///
/// Returns ok after writing a snapshot on request. A missing snapshot is a failure; the message
/// explains how to write it. Throws InputError for an invalid stored trace, std::invalid_argument
/// if the name is not GROUP/IDEA, and std::filesystem::filesystem_error.
Comparison compare_with_snapshot(const Trace& trace, const std::string& name,
                                 const SnapshotOptions& options = {});

/// For manifolds without a trace, from any engine. Pictures show stand-ins for the shapes: the
/// plane of the first manifold and the outline of all points on it. Stand-ins are not compared.
Comparison compare_with_snapshot(const std::vector<Manifold>& manifolds, const std::string& name,
                                 const SnapshotOptions& options = {});
Comparison compare_with_snapshot(const Manifold& manifold, const std::string& name,
                                 const SnapshotOptions& options = {});

/// Compares the trace if it was recorded, else the manifolds.
Comparison compare_with_snapshot(const Contacts& contacts, const std::string& name,
                                 const SnapshotOptions& options = {});

/// Compares a manifold with a normal, a depth (metres, positive = overlap of the deepest point) and
/// points in any order (world, metres). Each coordinate and length may differ by `tolerance`
/// metres, each component of the normal by the same number.
Comparison compare_manifold(const Manifold& manifold, const Vec3& normal, double depth,
                            const std::vector<Vec3>& points, double tolerance);

}  // namespace contactscope::package
