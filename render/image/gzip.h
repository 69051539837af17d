#pragma once

#include <string>
#include <string_view>

namespace contactscope {

/// Compresses to a gzip file (RFC 1952) without name and time.
std::string gzip(std::string_view bytes);

/// Decompresses a gzip file with one member. Throws std::runtime_error if it is invalid, truncated,
/// or holds more than 2 GiB.
std::string gunzip(std::string_view file);

}  // namespace contactscope
