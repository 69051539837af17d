#pragma once

#include <nlohmann/json.hpp>

#include "trace/trace.h"

/// The facts of a sequence in a compact form: shapes once, then integers.
namespace contactscope::viewer {

/// An integer that the next one is predicted to equal, and the number of bits of the last difference.
struct Last {
  std::int32_t value = 0;
  int bits = 0;
};

/// An adaptive binary range coder of differences: their number of bits, by the field and the bits of
/// the last difference, their two upper bits by the field, and the others as they are. data.js
/// decodes it.
class Coder {
 public:
  static constexpr int kContexts = 33, kSlots = 32;                // of one context
  static constexpr int kFieldSlots = kContexts * kSlots + 4 * 33;  // then two bits for each length

  explicit Coder(int fields) : chances_(static_cast<std::size_t>(fields * kFieldSlots), 1 << 15) {}

  /// Codes the difference to `last`, which then has this value.
  void put(int field, std::int32_t value, Last& last) {
    // Wraps around on overflow, as in JavaScript.
    const std::uint32_t difference =
        static_cast<std::uint32_t>(value) - static_cast<std::uint32_t>(last.value);
    const std::uint32_t zigzag =
        (difference << 1) ^ (difference >> 31 != 0 ? ~std::uint32_t{0} : 0);
    const int bits = std::bit_width(zigzag), slots = field * kFieldSlots;
    const int context = slots + last.bits * kSlots;
    put_bit(context, bits > 0);
    for (int i = 4, node = 1; bits > 0 && i >= 0; --i)
      node = 2 * node + put_bit(context + node, (bits - 1) >> i & 1);
    int left = bits - 1;
    for (int node = 1; left > 0 && node < 4; --left)
      node = 2 * node + put_bit(slots + kContexts * kSlots + 4 * (bits - 1) + node,
                                static_cast<int>(zigzag >> (left - 1) & 1));
    while (left > 0) {
      const int some = std::min(left, 16);
      left -= some;
      range_ >>= some;
      add(range_ * (zigzag >> left & ((1u << some) - 1)));
      shift();
    }
    last = {value, bits};
  }

  std::string bytes() const {
    std::string all = bytes_;
    for (int i = 24; i >= 0; i -= 8) all += static_cast<char>(low_ >> i & 0xff);
    return all;
  }

 private:
  int put_bit(int slot, int bit) {
    std::uint16_t& zero = at(chances_, slot);
    const std::uint32_t bound = (range_ >> 16) * zero;
    if (bit != 0) add(bound);
    range_ = bit != 0 ? range_ - bound : bound;
    zero = static_cast<std::uint16_t>(zero + (bit != 0 ? -(zero >> 5) : (65536 - zero) >> 5));
    shift();
    return bit;
  }
  void add(std::uint32_t more) {
    low_ += more;
    bool carries = low_ < more;
    for (std::size_t i = bytes_.size(); carries && i > 0;) carries = ++bytes_[--i] == 0;
  }
  void shift() {
    for (; range_ < 1 << 24; range_ <<= 8, low_ <<= 8) bytes_ += static_cast<char>(low_ >> 24);
  }

  std::vector<std::uint16_t> chances_;  // of a zero, times 2^16
  std::uint32_t low_ = 0, range_ = ~std::uint32_t{0};
  std::string bytes_;
};

/// The fields of the integers, the first of each row: name in the page, name, how many. Each is
/// stored as its difference from the one of the same body, or of the same place in the pair's last
/// list. The layout of a pair: 1: touching; 1 + index of the form of its stages, 0: none; manifolds;
/// and of each: axis, type, triangle, number of points, ids.
#define CONTACTSCOPE_VIEWER_FIELDS(ROW)                                                        \
  ROW(POSES, Poses, 1)        /* number in a frame */                                          \
  ROW(POSE_BODY, PoseBody, 1) /* predicted: the next body */                                   \
  ROW(POSE, Pose, 7)          /* position, rotation w, x, y, z */                              \
  ROW(PAIRS, Pairs, 1)                                                                         \
  ROW(PAIR, Pair, 1)     /* predicted: the one that followed the last time */                  \
  ROW(STEADY, Steady, 1) /* 1: the pair's layout is the last one */                            \
  ROW(LAYOUT_SIZE, LayoutSize, 1)                                                              \
  ROW(LAYOUT, Layout, 1)                                                                       \
  ROW(SEPARATION, PairSeparation, 1) /* predicted: that of its deepest point, if it has one */ \
  ROW(NORMAL, Normal, 3)                                                                       \
  ROW(POINT, Point, 6)     /* position, separation, impulse + 1, friction impulse + 1 */       \
  ROW(SAME, Same, 1)       /* of a value in the stages: 1 + index of an equal one; 0: none */  \
  ROW(INTEGER, Integer, 1) /* the kinds of values in stages */                                 \
  ROW(TEXT, Text, 1)                                                                           \
  ROW(SCALAR, Scalar, 1)                                                                       \
  ROW(PLACE, Place, 3)                                                                         \
  ROW(UNIT, Unit, 3)

#define CONTACTSCOPE_ENUMERATOR(page, name, count) k##name, kLast##name = k##name + (count)-1,
enum Field { CONTACTSCOPE_VIEWER_FIELDS(CONTACTSCOPE_ENUMERATOR) kFields };
#undef CONTACTSCOPE_ENUMERATOR

/// Positions of bodies are multiples of `quantum`: 1/16384 of the smallest shape, rounded down to a
/// power of two; those of points multiples of four quanta. Separations are multiples of quantum / 256
/// or have 12 bits, impulses have 11; the digits that the page shows of them do not change.
class PackedFacts {
 public:
  explicit PackedFacts(const trace::Header& header);

  void add(const trace::Frame& frame);
  /// Length of the JSON (4 bytes, little-endian), the JSON, the integers. `page` has the page's own
  /// keys.
  std::string bytes(nlohmann::ordered_json page) const;

 private:
  template <std::size_t N> using Row = std::array<Last, N>;
  using Value = std::array<std::int32_t, 3>;
  struct Leaf {
    int field;
    Value value{};
  };
  /// The last values of a pair.
  struct Known {
    Last follower, steady, gap;
    std::vector<std::int32_t> layout;
    std::vector<Row<3>> normals;
    std::vector<Row<6>> points;
    std::map<int, std::vector<Row<4>>> leaves;  // of each form
  };

  void put(int field, int value, int predicted = 0);
  template <std::size_t N>
  void put_row(int field, const std::array<std::int32_t, N>& now, std::vector<Row<N>>& rows,
               int place);
  int number_of(const char* list, const std::string& text);
  void take_leaves(nlohmann::ordered_json& node, const std::string& key, std::vector<Leaf>& leaves);
  void add_poses(const trace::Frame& frame);
  void add_pair(const trace::Pair& pair, nlohmann::ordered_json stages);
  Value places(const Vec3d& v, double step) const;

  double quantum_, fine_;
  nlohmann::ordered_json json_;
  Coder coder_{kFields};
  Row<kFields> last_{};
  std::map<std::string, int> bodies_, pairs_, counts_;
  std::map<std::pair<std::string, std::string>, int> numbers_;
  std::vector<Row<7>> poses_;
  std::vector<Known> known_;
  int previous_ = 0;  // pair
};

}  // namespace contactscope::viewer
