#include "field/block_filler.h"

namespace contactscope {
namespace {

class SignSpreader {
 public:
  SignSpreader(const std::array<int, 3>& counts, double side,
               std::span<const lanes::Pack<float>> nodes, std::span<NodeSign> signs)
      : counts_(counts), nodes_(nodes), signs_(signs) {
    constexpr std::array<double, 4> kStepLengths = {0, 1, 1.4142135623730951, 1.7320508075688772};
    for (std::size_t axes = 0; axes < 4; ++axes)
      lengths_[axes] = static_cast<float>(side * kStepLengths[axes] + kSignSlack);
  }

  int index(int x, int y, int z) const { return (z * counts_[1] + y) * counts_[0] + x; }
  NodeSign& sign(int i) const { return at(signs_, i); }

  /// If no surface can separate neighbours, gives all nodes the sign of any known one.
  bool one_sign() const {
    lanes::Pack<float> least = nodes_.front();
    for (const lanes::Pack<float>& node : nodes_) least = lanes::smaller(least, node);
    if (!(least[0] + least[0] > lengths_[1])) return false;
    const auto known =
        std::ranges::find_if(signs_, [](NodeSign own) { return own != NodeSign::Unknown; });
    if (known == signs_.end()) return false;
    std::ranges::fill(signs_, *known);
    return true;
  }

  /// Spreads signs along axes, in memory order and back, which is enough for nearly all nodes.
  bool sweep() const {
    const int last = static_cast<int>(nodes_.size()) - 1;
    bool all = true;
    for (int i = 0; i <= last; ++i) take_from_neighbour(i, -1);
    for (int i = last; i >= 0; --i) all &= take_from_neighbour(i, 1);
    return all;
  }

  /// Takes a sign from any neighbour, along diagonals too; false if there is none.
  bool take_from_any(int x, int y, int z) const {
    const int to = index(x, y, z);
    return any_around(x, y, z, [&](int u, int v, int w, int axes) {
      const int from = index(u, v, w);
      if (sign(from) == NodeSign::Unknown || !is_passable(from, to, axes)) return false;
      sign(to) = sign(from);
      return true;
    });
  }

  /// Spreads signs from the open nodes to all neighbours, and on from those.
  void spread() {
    while (!open_.empty()) {
      const auto [x, y, z] = open_.back();
      open_.pop_back();
      const int from = index(x, y, z);
      any_around(x, y, z, [&](int u, int v, int w, int axes) {
        const int to = index(u, v, w);
        if (sign(to) != NodeSign::Unknown || !is_passable(from, to, axes)) return false;
        sign(to) = sign(from);
        open_.push_back({u, v, w});
        return false;
      });
    }
  }
  void open(int x, int y, int z) { open_.push_back({x, y, z}); }

 private:
  /// Calls visit(u, v, w, axes) around a node until true; `axes`: along how many the two differ.
  template <class Visit> bool any_around(int x, int y, int z, const Visit& visit) const {
    for (int w = std::max(z - 1, 0); w <= std::min(z + 1, counts_[2] - 1); ++w)
      for (int v = std::max(y - 1, 0); v <= std::min(y + 1, counts_[1] - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, counts_[0] - 1); ++u)
          if (visit(u, v, w, (u != x) + (v != y) + (w != z))) return true;
    return false;
  }
  bool is_passable(int from, int to, int axes) const {
    return at(nodes_, from)[0] + at(nodes_, to)[0] > at(lengths_, axes);
  }
  bool take_from_neighbour(int i, int toward) const {
    if (sign(i) != NodeSign::Unknown) return true;
    const std::array<int, 3> place = {i % counts_[0], i / counts_[0] % counts_[1],
                                      i / (counts_[0] * counts_[1])};
    int step = toward;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int next = place[axis] + toward;
      const int from = i + step;
      step *= counts_[axis];
      if (next < 0 || next >= counts_[axis]) continue;
      if (sign(from) == NodeSign::Unknown || !is_passable(from, i, 1)) continue;
      sign(i) = sign(from);
      return true;
    }
    return false;
  }

  std::array<int, 3> counts_;
  std::span<const lanes::Pack<float>> nodes_;
  std::span<NodeSign> signs_;
  std::array<float, 4> lengths_{};
  std::vector<std::array<int, 3>> open_;
};

}  // namespace

void spread_signs(const std::array<int, 3>& counts, double side,
                  std::span<const lanes::Pack<float>> nodes, std::span<NodeSign> signs,
                  const std::function<bool(int, int, int)>& is_inside) {
  SignSpreader spreader(counts, side, nodes, signs);
  if (spreader.one_sign() || spreader.sweep()) return;
  const auto for_nodes = [&](const auto& visit) {
    for (int z = 0; z < counts[2]; ++z)
      for (int y = 0; y < counts[1]; ++y)
        for (int x = 0; x < counts[0]; ++x) visit(x, y, z, spreader.sign(spreader.index(x, y, z)));
  };
  for_nodes([&](int x, int y, int z, NodeSign sign) {
    if (sign != NodeSign::Unknown || !spreader.take_from_any(x, y, z)) return;
    spreader.open(x, y, z);
    spreader.spread();
  });
  for_nodes([&](int x, int y, int z, NodeSign& sign) {
    if (sign != NodeSign::Unknown) return;
    sign = is_inside(x, y, z) ? NodeSign::Inside : NodeSign::Outside;
    spreader.open(x, y, z);
    spreader.spread();
  });
}

}  // namespace contactscope
