#pragma once

#include <string>
#include <string_view>

namespace contactscope {

/// A gzip file (RFC 1952) of bytes, without a name or a time: what `zcat` prints is them.
std::string gzip(std::string_view bytes);

/// The bytes of a gzip file of one member. Throws std::runtime_error where it is none or is torn, or holds more
/// than 2 GiB.
std::string gunzip(std::string_view file);

}  // namespace contactscope
