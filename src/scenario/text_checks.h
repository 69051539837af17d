#pragma once

#include <cstddef>
#include <string>

namespace contactscope {

/// Largest scenario file. A hull of 100000 vertices written with 17 digits each takes 6 MB.
inline constexpr std::size_t kMaxScenarioBytes = std::size_t{16} << 20;

/// Most names that one dotted key may join. The deepest key of the format joins three,
/// [shapes.crate.motion]; a table nested a hundred thousand deep would exhaust the stack.
inline constexpr int kMaxDottedNames = 16;

/// Reads a whole scenario file. Throws InputError when it is missing, no plain file, cannot be
/// read, or is larger than kMaxScenarioBytes, in which case nothing of it is read.
std::string read_scenario_text(const std::string& path);

/// What can be said of the text before it is parsed: throws InputError at the first byte that makes
/// it no TOML document of ours (empty, a NUL byte, not UTF-8, a key of too many names).
void check_scenario_text(const std::string& text, const std::string& path);

}  // namespace contactscope
