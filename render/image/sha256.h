#pragma once

#include <string>
#include <string_view>

namespace contactscope {

/// SHA-256 (FIPS 180-4) of bytes, as 64 hexadecimal digits: what `sha256sum` prints of a file that
/// holds them.
std::string sha256(std::string_view bytes);

}  // namespace contactscope
