#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "trace/trace.h"

/// The facts of a sequence in a compact form: shapes once, then columns of integers.
namespace contactscope::viewer {

/// The columns, in the order in which data.js reads them. An integer is stored as its difference
/// from a predicted one, zigzag, then LEB128: resting bodies give runs of zeros.
enum Columns {
  kPoses,     // number in a frame
  kPoseBody,  // predicted: the next body
  kPose,      // position, rotation w, x, y, z; predicted: the body's last pose
  kPairs = kPose + 7,
  kPair,
  kPairState,       // 1: touching
  kPairSeparation,  // predicted: that of its deepest point
  kPairStages,      // 1 + index of its stages; 0: none
  kManifolds,
  kNormal,  // predicted: the pair's last one
  kAxis = kNormal + 3,
  kType,
  kTriangle,
  kPoints,
  kPoint,  // position, separation, impulse + 1, friction impulse + 1, id; predicted: the
           // point at the same place of the pair's last list
  kColumns = kPoint + 7
};

/// Positions are multiples of `quantum`: 1/16384 of the smallest shape, rounded down to a power of
/// two. Separations are multiples of quantum / 256, impulses the upper 21 bits of a float.
class PackedFacts {
 public:
  explicit PackedFacts(const trace::Header& header);

  void add(const trace::Frame& frame);
  /// Length of the JSON (4 bytes, little-endian), the JSON, the columns. `page` has the page's own
  /// keys.
  std::string bytes(nlohmann::ordered_json page) const;

 private:
  template <std::size_t N> using Row = std::array<std::int32_t, N>;
  struct Column {
    std::string bytes;
    int count = 0;
  };

  void put(int column, std::int32_t value, std::int32_t predicted = 0);
  template <std::size_t N> void put_row(int first, const Row<N>& now, Row<N>& last);
  int number_of(const std::string& text);
  void add_poses(const trace::Frame& frame);
  void add_pair(const trace::Pair& pair, const nlohmann::ordered_json& stages);

  double quantum_;
  nlohmann::ordered_json json_;
  std::array<Column, kColumns> columns_;
  std::map<std::string, int> bodies_, pairs_, texts_;
  std::vector<Row<7>> last_poses_;
  std::vector<std::vector<Row<7>>> last_points_;  // of each pair
  std::vector<Row<3>> last_normals_;
};

}  // namespace contactscope::viewer
