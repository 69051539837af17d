#pragma once

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

/// The texts of a PNG file, by their keywords, in order. Reads tEXt and uncompressed iTXt chunks.
/// PNG specification, third edition, W3C 2025.
namespace contactscope::test {

inline std::vector<std::pair<std::string, std::string>> texts_of_png(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string all{std::istreambuf_iterator<char>(file), {}};
  const auto byte = [&](std::size_t at) {
    return static_cast<std::size_t>(static_cast<unsigned char>(all.at(at)));
  };
  std::vector<std::pair<std::string, std::string>> texts;
  for (std::size_t at = 8; at < all.size();) {
    const std::size_t length =
        byte(at) << 24 | byte(at + 1) << 16 | byte(at + 2) << 8 | byte(at + 3);
    const std::string type = all.substr(at + 4, 4), data = all.substr(at + 8, length);
    if (data.size() != length) throw std::runtime_error(path + " is cut off");
    const std::string key = data.substr(0, data.find('\0'));
    if (type == "tEXt") texts.emplace_back(key, data.substr(key.size() + 1));
    if (type == "iTXt") {  // two flags, a language and a translated keyword
      const std::size_t language = data.find('\0', key.size() + 3);
      texts.emplace_back(key, data.substr(data.find('\0', language + 1) + 1));
    }
    at += 12 + length;
  }
  return texts;
}

}  // namespace contactscope::test
