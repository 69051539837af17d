#pragma once

#include <array>
#include <cstdint>
#include <cstring>

#include "manifold/collide_options.h"
#include "manifold/contact.h"
#include "query/fast/box_edges.h"
#include "reduce/reducer.h"

/// Contact of two boxes and its manifold: Contact and finish_contact() for kernels that work on
/// whole vectors. Each value is written by one store of as many bytes as the next load reads. A
/// load across several stores waits until they reach the cache.
namespace contactscope::boxes {

/// Two rectangles clip to at most eight corners.
inline constexpr int kMaxPoints = 8;

/// In A's frame.
template <class S>
struct BoxContact {
  AxisKind axis;
  ContactType type;
  int count = 0;
  Three<S> normal;  // unit, from A to B
  S scale;          // metres, as in Contact
  ContactPoint<S> points[kMaxPoints];

  /// `first` and `second` are indices into kEdgeRefs, in this order.
  [[gnu::always_inline]] void put(const Three<S>& position, S separation, int first, int second);
};

/// The edges of both boxes in the order of ids, A's before B's, as words: reading a reference as
/// one word stalls if it was written as two bytes and an int.
inline constexpr std::array<std::uint64_t, 24> kEdgeRefs = [] {
  std::array<std::uint64_t, 24> refs{};
  for (int i = 0; i < 24; ++i) {
    const FeatureRef ref = edge_ref(i < 12 ? Owner::A : Owner::B, i % 12);
    struct Bytes {
      Owner owner;
      FeatureKind kind;
      std::uint8_t gap[2];
      std::uint32_t index;
    };
    refs[static_cast<std::size_t>(i)] =
        std::bit_cast<std::uint64_t>(Bytes{ref.owner, ref.kind, {}, ref.index});
  }
  return refs;
}();

/// A position and a separation in one pack.
template <class S>
[[gnu::always_inline]] inline Three<S> with_separation(const Three<S>& position,
                                                       const Three<S>& distance) {
  const Three<S> z = __builtin_shufflevector(position, distance, 2, 2, 7, 7);
  return __builtin_shufflevector(position, z, 0, 1, 4, 6);
}

template <class S>
[[gnu::always_inline]] inline void BoxContact<S>::put(const Three<S>& position, S separation,
                                                      int first, int second) {
  static_assert(sizeof(ContactPoint<S>) == sizeof(Three<S>) + 16);
  // NOLINTNEXTLINE(modernize-use-using): GCC wants it so
  typedef std::uint64_t Words __attribute__((vector_size(16)));
  const Words id = {kEdgeRefs[static_cast<std::size_t>(first)],
                    kEdgeRefs[static_cast<std::size_t>(second)]};
  const Three<S> four = with_separation<S>(position, all_of<S>(separation));
  auto* const to = reinterpret_cast<std::byte*>(&points[count++]);
  std::memcpy(to, &four, sizeof four);
  std::memcpy(to + sizeof four, &id, sizeof id);
}

/// ToWorld for packs, with the same bits.
template <class S>
class PacksToWorld;
template <>
class PacksToWorld<float> {
 public:
  [[gnu::always_inline]] explicit PacksToWorld(const Pose<float>& a)
      : columns_(lanes::rotation_columns(a.rotation)), position_(three(a.position)) {}
  [[gnu::always_inline]] Three<float> direction(const Three<float>& v) const {
    return columns_.of[0] * spread<0>(v) +
           (columns_.of[1] * spread<1>(v) + columns_.of[2] * spread<2>(v));
  }
  [[gnu::always_inline]] Three<float> point(const Three<float>& v) const {
    return direction(v) + position_;
  }

 private:
  Columns<float> columns_;
  Three<float> position_;
};
/// In double Eigen's matrix products may add by rows or by columns, so this calls Eigen.
template <>
class PacksToWorld<double> {
 public:
  explicit PacksToWorld(const Pose<double>& a) : to_world_(a) {}
  Three<double> direction(const Three<double>& v) const {
    return three(to_world_.direction(vector<double>(v)));
  }
  Three<double> point(const Three<double>& v) const {
    return three(to_world_.point(vector<double>(v)));
  }

 private:
  ToWorld<double> to_world_;
};

/// finish_contact() without a record.
template <class S>
[[gnu::always_inline]] inline void finish(const Pose<S>& pose_a, const CollideOptions& options,
                                          BoxContact<S>& contact, Manifold<S>& manifold) {
  const PacksToWorld<S> to_world(pose_a);
  manifold.axis = contact.axis;
  manifold.type = contact.type;
  const Three<S> normal = to_world.direction(contact.normal);
  manifold.normal = vector<S>(normal);
  const bool few = contact.count <= options.reduction.max_points;
  // Zero times a finite number is zero; times any other it is NaN.
  Three<S> nothing = S(0) * three(manifold.normal);
  for (int i = 0; i < contact.count; ++i) {
    const Three<S> in_a = lanes::load_pack<Three<S>>(contact.points[i].position.data());
    const Three<S> four = with_separation<S>(to_world.point(in_a), in_a);
    nothing += S(0) * four;
    std::memcpy(static_cast<void*>(&contact.points[i]), &four, sizeof four);
  }
  const ContactPoints<S> points(contact.points, static_cast<std::size_t>(contact.count));
  const bool finite = lane_bits<S>(nothing == Three<S>{}) == 0xfU;
  if (options.reducer == nullptr || (few && finite)) {
    for (const ContactPoint<S>& point : points) manifold.points.push_back(point);
    return;
  }
  const ReduceOptions reduction = options.reduction_at(contact.scale);
  for (const int index : reduce(options.reducer, points, manifold.normal, reduction))
    manifold.points.push_back(at(points, index));
}

}  // namespace contactscope::boxes
