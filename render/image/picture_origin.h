#pragma once

#include <string>
#include <utility>
#include <vector>

namespace contactscope {

/// Origin of a picture, embedded so that it can be reproduced: metadata in SVG and PDF, text chunks
/// in PNG.
struct PictureOrigin {
  std::string version;   // of the program, "1.2.3"
  std::string scenario;  // "hull/face_contact"
  std::string title;     // of the scenario
  int frame = 0;
  std::string frames{};  // for several frames: "0, 8, 16"; `frame` is ignored then
  std::string view;
  std::string sha256;   // sha256() of the scenario's text
  std::string command;  // "contactscope render hull/face_contact --frames 3 --format svg"
};

/// Non-empty entries as keys and values, in a fixed order. Keys are Latin letters, as PNG requires.
std::vector<std::pair<std::string, std::string>> entries_of(const PictureOrigin& origin);

}  // namespace contactscope
