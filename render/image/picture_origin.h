#pragma once

#include <string>
#include <utility>
#include <vector>

namespace contactscope {

/// Where a picture comes from, written into it so that it can be made again: SVG and PDF as metadata,
/// PNG as text chunks.
struct PictureOrigin {
  std::string version;   // of the program, "1.2.3"
  std::string scenario;  // "hull/face_contact"
  std::string title;     // what the scenario is called
  int frame = 0;
  std::string frames{};  // where it is of several, "0, 8, 16"; the one of a sequence is then not told
  std::string view;     // its name
  std::string sha256;   // of the scenario's text, as sha256() gives it
  std::string command;  // "contactscope render hull/face_contact --frames 3 --format svg"
};

/// The same as keys and values, in a fixed order; what is empty is left out. Keys are Latin letters,
/// as PNG wants them.
std::vector<std::pair<std::string, std::string>> entries_of(const PictureOrigin& origin);

}  // namespace contactscope
