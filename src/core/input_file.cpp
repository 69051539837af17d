#include "core/input_error.h"

namespace contactscope {
namespace {

constexpr std::string_view kBlank = " \t\r\n";

std::string_view without_blanks(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlank), text.size()));
  return text;
}

/// Name of the first element of an XML document, after declarations and comments.
std::string_view root_element(std::string_view text) {
  while (text.starts_with("<?") || text.starts_with("<!")) {
    const std::string_view close = text.starts_with("<!--") ? "-->" : ">";
    const std::size_t end = text.find(close);
    if (end == std::string_view::npos) return {};
    text = without_blanks(text.substr(end + close.size()));
  }
  if (!text.starts_with('<')) return {};
  return text.substr(1, text.find_first_of(" \t\r\n/>", 1) - 1);
}

/// Binary STL: eighty arbitrary bytes, the number of triangles, and fifty bytes per triangle.
bool is_binary_stl(std::string_view begin, std::uintmax_t size) {
  constexpr std::size_t kHeader = 84, kTriangle = 50;
  if (begin.size() < kHeader) return false;
  std::uintmax_t triangles = 0;
  for (std::size_t i = kHeader; i-- > kHeader - 4;)
    triangles = triangles << 8 | static_cast<unsigned char>(begin[i]);
  return triangles > 0 && size == kHeader + kTriangle * triangles;
}

/// Whether the first statement belongs to a Wavefront .obj.
bool is_obj(std::string_view text) {
  while (text.starts_with('#'))
    text = without_blanks(text.substr(std::min(text.find_first_of("\r\n"), text.size())));
  const std::string_view word = text.substr(0, text.find_first_of(" \t"));
  const std::string_view rest = without_blanks(text.substr(word.size()));
  if (rest.starts_with('=') || rest.starts_with('.')) return false;  // a TOML key
  for (const std::string_view statement : {"v", "vn", "vt", "o", "g", "mtllib"})
    if (word == statement) return true;
  return false;
}

}  // namespace

void require_regular_file(const std::string& path, const std::string& wanted) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (exists(status) && !is_regular_file(status) && !is_directory(status))
    throw InputError(path, 0, 0, "this is not a regular file; " + wanted);
}

std::string foreign_format(std::string_view begin, std::uintmax_t size) {
  using Format = std::pair<std::string_view, const char*>;
  if (begin.starts_with("\xEF\xBB\xBF")) begin.remove_prefix(3);
  constexpr std::array<Format, 12> kMagic = {{{"\x89PNG", "a PNG picture"},
                                              {"\x7F"
                                               "ELF",
                                               "a program"},
                                              {"\x1F\x8B", "a compressed file (gzip)"},
                                              {"\x28\xB5\x2F\xFD", "a compressed file (zstd)"},
                                              {"glTF", "binary glTF"},
                                              {"PXR-USDC", "binary USD"},
                                              {"#usda", "USD (text)"},
                                              {"PK\x03\x04", "a ZIP archive, as USDZ or 3MF"},
                                              {"Kaydara FBX", "binary FBX"},
                                              {"; FBX", "FBX (text)"},
                                              {"ply\n", "PLY"},
                                              {"ply\r\n", "PLY"}}};
  for (const auto& [magic, name] : kMagic)
    if (begin.starts_with(magic)) return name;
  if (is_binary_stl(begin, size)) return "binary STL";
  const std::string_view text = without_blanks(begin);
  if (text.starts_with("solid") && text.find("facet") != std::string_view::npos) return "STL";
  constexpr std::array<Format, 4> kRoots = {{{"robot", "URDF (XML)"},
                                             {"mujoco", "MJCF (XML)"},
                                             {"sdf", "SDFormat (XML)"},
                                             {"COLLADA", "COLLADA (XML)"}}};
  for (const auto& [root, name] : kRoots)
    if (root_element(text) == root) return name;
  if (text.starts_with('<')) return "XML";
  if (text.starts_with('{') && text.find("\"asset\"") != std::string_view::npos &&
      text.find("\"contactscope.") == std::string_view::npos)
    return "glTF (JSON)";
  const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
  if (std::ranges::count(line, ',') > 1 && line.find_first_of("=[{'\"#") == line.npos) return "CSV";
  return is_obj(text) ? "a Wavefront .obj" : "";
}

std::string foreign_format_remedy(std::string_view begin, std::uintmax_t size) {
  if (const std::string_view text = without_blanks(begin);
      text.starts_with('[') && without_blanks(text.substr(1)).starts_with('{'))
    return "this is a JSON array, and a trace has one JSON object a line, the header first; "
           "`jq -c '.[]' FILE > run.jsonl` writes it so";
  const std::string format = foreign_format(begin, size);
  if (format.empty()) return {};
  if (format.find("(gzip)") != format.npos || format.find("(zstd)") != format.npos)
    return "this is " + format + "; unpack it, and give the name of what is in it, or pipe it to -";
  constexpr std::array kMeshes = {".obj", "STL", "PLY"};
  if (std::ranges::any_of(kMeshes, [&](auto mesh) { return format.find(mesh) != format.npos; }))
    return "this is " + format +
           " and no scenario; a scenario (.toml) names it: "
           "type = \"mesh\" or \"hull\", file = \"NAME\"";
  return "this is " + format +
         ", which is not read; a scenario is TOML (.toml), the meshes that it names are .obj, "
         ".stl, "
         ".ply or .off, and what an engine did is a trace (.jsonl); name the "
         "meshes in a scenario";
}

}  // namespace contactscope
