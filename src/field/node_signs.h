#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>

#include "core/pack.h"

namespace contactscope {

enum class NodeSign : std::uint8_t { Unknown, Outside, Inside };

/// Gives each node of a lattice the sign of a neighbour, next to it along axes or diagonals, to which the
/// surface leaves a way: their distances together are larger than the one between them, `side` cells
/// along an axis. Where no known node does so, the sign of one unknown node is asked.
///
/// `counts`: nodes along x, y and z; `nodes`: distances without sign in the first lanes, x first; `signs`:
/// as many, some of which may be known.
void spread_signs(const std::array<int, 3>& counts, double side,
                  std::span<const lanes::Pack<float>> nodes, std::span<NodeSign> signs,
                  const std::function<bool(int x, int y, int z)>& is_inside);

/// What rounding may add to two distances of nodes, cells.
inline constexpr double kSignSlack = 0x1p-12;

}  // namespace contactscope
