#include "snapshot/meshes.h"

#include <nlohmann/json.hpp>

#include "core/input_error.h"
#include "image/encoding.h"
#include "snapshot/store.h"

namespace contactscope::snapshot {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFolder = "meshes";
constexpr const char* kEnding = ".json.gz";
constexpr const char* kKey = "geometry";
constexpr std::size_t kDigits = 32;  // of SHA-256: no collisions in practice

fs::path mesh_path(const fs::path& root, const std::string& name) {
  return root / kFolder / (name + kEnding);
}

bool is_name(const std::string& name) {
  return name.size() == kDigits && name.find_first_not_of("0123456789abcdef") == std::string::npos;
}

std::string header_of(const std::string& text) { return text.substr(0, text.find('\n')); }

/// The default of readers of a trace without `edges`.
Json edges_of(const Json& faces) {
  trace::Shape shape;
  shape.faces = faces.get<std::vector<std::vector<int>>>();
  trace::Shape::edges_from_faces(shape);
  return shape.edges;
}

/// Content of the file of a shape's mesh; empty if it is small or not a mesh.
std::string mesh_of(const Json& shape) {
  if (!shape.contains("vertices") || !shape.contains("faces") || !shape.contains("edges"))
    return {};
  Json mesh{{"vertices", shape["vertices"]}, {"faces", shape["faces"]}};
  if (shape["edges"] != edges_of(shape["faces"])) mesh["edges"] = shape["edges"];
  std::string text = mesh.dump();
  return text.size() < kLargeMesh ? "" : text + "\n";
}

/// Throws InputError.
Json read_mesh(const fs::path& trace, const std::string& name) {
  fs::path file;
  for (fs::path folder = fs::absolute(trace).lexically_normal().parent_path();;
       folder = folder.parent_path()) {
    file = mesh_path(folder, name);
    if (fs::exists(file) || folder == folder.parent_path()) break;
  }
  const auto wrong = [&](const std::string& what) {
    return InputError(trace.generic_string(), 1, 1,
                      "its mesh " + std::string(kFolder) + "/" + name + kEnding + " " + what +
                          "; copy it from the source of the trace, or store both again with "
                          "contactscope check --update");
  };
  const std::optional<std::string> bytes = is_name(name) ? read_text_file(file) : std::nullopt;
  if (!bytes) throw wrong("is in no folder above it");
  try {
    const std::string text = gunzip(*bytes);
    if (sha256(text).substr(0, kDigits) != name)
      throw std::runtime_error("it belongs to another mesh");
    return Json::parse(text);
  } catch (const std::exception& error) {
    throw wrong(std::string("does not match its name: ") + error.what());
  }
}

/// Mesh names in all stored traces below a folder, including variants.
std::set<std::string> meshes_in_use(const fs::path& root) {
  std::set<std::string> names;
  if (!fs::is_directory(root)) return names;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root)) {
    if (!entry.is_regular_file() || entry.path().extension() != ".jsonl") continue;
    std::ifstream file(entry.path(), std::ios::binary);
    std::string header;
    std::getline(file, header);
    names.merge(meshes_named(header));
  }
  return names;
}

void remove_unless_named(const fs::path& root, const std::set<std::string>& meshes) {
  if (meshes.empty()) return;
  const std::set<std::string> used = meshes_in_use(root);
  for (const std::string& name : meshes)
    if (!used.contains(name) && fs::exists(mesh_path(root, name)))
      remove_stored(mesh_path(root, name));
}

}  // namespace

std::set<std::string> meshes_named(const std::string& text) {
  const std::string mark = std::string("\"") + kKey + "\":\"";
  std::set<std::string> names;
  const std::size_t end = std::min(text.find('\n'), text.size());
  for (std::size_t at = text.find(mark); at < end; at = text.find(mark, at + 1)) {
    const std::size_t begin = at + mark.size();
    const std::string name = text.substr(begin, text.find('"', begin) - begin);
    if (is_name(name)) names.insert(name);
  }
  return names;
}

std::string with_meshes(const std::string& text, const fs::path& path) {
  const std::string line = header_of(text);
  if (meshes_named(line).empty()) return text;
  Json header = Json::parse(line, nullptr, false);
  if (header.is_discarded() || !header.contains("shapes"))
    return text;  // the trace reader reports the error
  for (auto& [shape_name, shape] : header["shapes"].items()) {
    const bool is_elsewhere = shape.contains(kKey) && shape[kKey].is_string() &&
                              shape.contains("vertices") && shape["vertices"].empty();
    if (!is_elsewhere) continue;
    Json mesh = read_mesh(path, shape[kKey].get<std::string>());
    shape.erase(kKey);
    shape["edges"] = mesh.contains("edges") ? mesh["edges"] : edges_of(mesh["faces"]);
    shape["vertices"] = std::move(mesh["vertices"]);
    shape["faces"] = std::move(mesh["faces"]);
  }
  return header.dump() + text.substr(line.size());
}

void write_stored_trace(const fs::path& root, const fs::path& path, const std::string& text) {
  // Another process may have stored a mesh whose trace is not written yet.
  fs::create_directories(root);
  const FolderLock lock(root);
  const std::set<std::string> before = meshes_named(read_text_file(path).value_or(""));
  const std::string line = header_of(text);
  std::string stored = text;
  if (line.size() >= kLargeMesh) {
    Json header = Json::parse(line);
    for (auto& [shape_name, shape] : header["shapes"].items()) {
      const std::string mesh = mesh_of(shape);
      if (mesh.empty()) continue;
      const std::string name = sha256(mesh).substr(0, kDigits);
      const fs::path file = mesh_path(root, name);
      const std::string bytes = gzip(mesh);
      if (read_text_file(file) != bytes) write_text(file, bytes);
      shape["vertices"] = shape["faces"] = shape["edges"] = Json::array();
      shape[kKey] = name;
    }
    stored = header.dump() + text.substr(line.size());
  }
  write_text(path, stored);
  remove_unless_named(root, before);
}

void remove_with_meshes(const fs::path& root, const fs::path& file) {
  const FolderLock lock(root);
  const bool is_trace = file.extension() == ".jsonl";
  const std::set<std::string> meshes =
      meshes_named(is_trace ? read_text_file(file).value_or("") : "");
  remove_stored(file);
  remove_unless_named(root, meshes);
}

std::set<fs::path> unnamed_meshes(const fs::path& root) {
  std::set<fs::path> files;
  if (!fs::is_directory(root / kFolder)) return files;
  for (const fs::directory_entry& entry : fs::directory_iterator(root / kFolder))
    if (entry.is_regular_file() && entry.path().string().ends_with(kEnding))
      files.insert(entry.path());
  if (files.empty()) return files;
  for (const std::string& name : meshes_in_use(root)) files.erase(mesh_path(root, name));
  return files;
}

}  // namespace contactscope::snapshot
