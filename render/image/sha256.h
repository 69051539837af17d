#pragma once

#include <string>
#include <string_view>

namespace contactscope {

/// SHA-256 (FIPS 180-4) as 64 hexadecimal digits, like `sha256sum`.
std::string sha256(std::string_view bytes);

}  // namespace contactscope
