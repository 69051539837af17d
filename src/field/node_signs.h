#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>

#include "core/pack.h"

namespace contactscope {

enum class NodeSign : std::uint8_t { Unknown, Outside, Inside };

/// Gives each node of a lattice the sign of a neighbour, along axes or diagonals, if no surface can
/// separate them: the sum of their distances exceeds the distance between them, `side` cells along
/// an axis. If no known node qualifies, `is_inside` decides one unknown node.
///
/// `counts`: nodes along x, y and z; `nodes`: unsigned distances in the first lanes, x first;
/// `signs`: one per node; some may be known.
void spread_signs(const std::array<int, 3>& counts, double side,
                  std::span<const lanes::Pack<float>> nodes, std::span<NodeSign> signs,
                  const std::function<bool(int x, int y, int z)>& is_inside);

/// Bound on the rounding of the sum of two nodes' distances, cells.
inline constexpr double kSignSlack = 0x1p-12;

}  // namespace contactscope
