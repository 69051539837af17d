#include "snapshot/store.h"

#include "core/input_error.h"
#include "core/spell.h"
#include "image/encoding.h"
#include "snapshot/meshes.h"

namespace contactscope::snapshot {
namespace fs = std::filesystem;
namespace {

constexpr const char* kTraceName = "trace.jsonl";
constexpr const char* kHashesName = "frames.txt";
constexpr const char* kPictureExtension = ".png";
constexpr const char* kNoteExtension = ".txt";

/// "osmesa" for "frame_0012.osmesa.png"; empty for "frame_0012.png".
std::string word_of(const fs::path& file) { return fs::path(file).stem().extension().string(); }

/// "frame_0012.png" for "frame_0012.osmesa.png" and for its note.
fs::path without_word(const fs::path& file) {
  return file.parent_path() / (fs::path(file).stem().stem().string() + kPictureExtension);
}

void require_plain(const std::string& name, const std::string& whole) {
  if (name.empty() || name == "." || name == ".." || name.find('/') != std::string::npos)
    throw std::invalid_argument("'" + whole + "' cannot name a snapshot's folder");
}

}  // namespace

std::string to_string(const PictureKey& key) {
  std::string text = key.scenario + " frame " + std::to_string(key.frame);
  if (key.view) text += ", view " + *key.view;
  return text;
}

std::string frame_stem(int frame) { return printed("frame_%04d", frame); }

fs::path scenario_folder(const fs::path& root, const std::string& scenario) {
  const std::size_t slash = scenario.find('/');
  if (slash == std::string::npos)
    throw std::invalid_argument("'" + scenario + "' is not a scenario: expected <group>/<idea>");
  const std::string group = scenario.substr(0, slash), idea = scenario.substr(slash + 1);
  require_plain(group, scenario);
  require_plain(idea, scenario);
  return root / group / idea;
}

fs::path picture_folder(const fs::path& root, const std::string& scenario,
                        const std::optional<std::string>& view) {
  const fs::path folder = scenario_folder(root, scenario);
  if (!view) return folder;
  require_plain(*view, *view);
  return folder / *view;
}

fs::path picture_path(const fs::path& root, const PictureKey& key) {
  return picture_folder(root, key.scenario, key.view) / (frame_stem(key.frame) + kPictureExtension);
}

fs::path trace_path(const fs::path& root, const std::string& scenario) {
  return scenario_folder(root, scenario) / kTraceName;
}

fs::path hashes_path(const fs::path& root, const std::string& scenario) {
  return scenario_folder(root, scenario) / kHashesName;
}

std::vector<fs::path> baselines_of(const fs::path& own) {
  std::vector<fs::path> files;
  if (!fs::is_directory(own.parent_path())) return files;
  const std::string stem = own.stem().string() + ".";
  for (const fs::directory_entry& entry : fs::directory_iterator(own.parent_path())) {
    const fs::path& file = entry.path();
    if (file.extension() == own.extension() && file.filename().string().starts_with(stem))
      files.push_back(file);
  }
  std::ranges::sort(files, [&](const fs::path& a, const fs::path& b) {
    return std::pair(a != own, a) < std::pair(b != own, b);
  });
  return files;
}

bool is_known_bad(const fs::path& baseline) { return word_of(baseline).starts_with(".bad_"); }

std::vector<fs::path> stored_files(const fs::path& root, const std::string& scenario) {
  std::vector<fs::path> files;
  const fs::path folder = scenario_folder(root, scenario);
  if (!fs::is_directory(folder)) return files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    const fs::path extension = entry.path().extension();
    const bool is_ours = extension == kPictureExtension || extension == kNoteExtension ||
                         extension == fs::path(kTraceName).extension();
    if (entry.is_regular_file() && is_ours) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

void remove_stored(const fs::path& file) {
  fs::remove(file);
  std::error_code not_empty;
  fs::remove(file.parent_path(), not_empty);
}

std::vector<std::string> stored_scenarios(const fs::path& root) {
  std::set<std::string> found;
  if (!fs::is_directory(root)) return {};
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root)) {
    if (!entry.is_regular_file()) continue;
    const fs::path& file = entry.path();
    if (file.filename() != kTraceName && file.extension() != kPictureExtension) continue;
    const fs::path inside = file.lexically_relative(root);
    auto part = inside.begin();
    if (std::distance(part, inside.end()) < 3) continue;
    const std::string group = (part++)->string();
    found.insert(group + "/" + part->string());
  }
  return {found.begin(), found.end()};
}

bool is_of_an_engine(const fs::path& root, const std::string& scenario) {
  // Skip the meshes: only the header matters.
  const fs::path path = trace_path(root, scenario);
  const std::optional<std::string> text = read_text_file(path);
  if (!text) return false;
  std::istringstream header(text->substr(0, text->find('\n')));
  return !trace::read_trace(header, path.string()).header.engine.empty();
}

std::vector<fs::path> stale_files(const fs::path& root, const std::string& scenario,
                                  std::span<const std::string> views, std::span<const int> frames) {
  std::set<fs::path> stored;
  const auto store = [&](const std::optional<std::string>& view) {
    for (const int frame : frames) stored.insert(picture_path(root, {scenario, view, frame}));
  };
  for (const std::string& view : views) store(view);
  if (views.empty()) store({});

  std::vector<fs::path> stale;
  for (const fs::path& file : stored_files(root, scenario)) {
    const bool is_note = file.extension() == kNoteExtension && !word_of(file).empty();
    if (file.extension() != kPictureExtension && !is_note) continue;
    if (is_note && without_word(file).stem() == fs::path(kTraceName).stem()) continue;
    if (!stored.contains(word_of(file).empty() ? file : without_word(file))) stale.push_back(file);
  }
  return stale;
}

std::optional<std::string> read_text_file(const fs::path& path) {
  if (!fs::exists(path)) return {};
  require_regular_file(path.string(), "give one that can be read more than once");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    throw fs::filesystem_error("cannot read", path,
                               std::make_error_code(std::errc::permission_denied));
  }
  return std::string(std::istreambuf_iterator<char>(stream), {});
}

std::string sha256_of_file(const fs::path& path) {
  const std::optional<std::string> bytes = read_text_file(path);
  return bytes ? sha256(*bytes) : "";
}

std::optional<std::string> read_stored_trace(const fs::path& root, const std::string& scenario) {
  const fs::path path = trace_path(root, scenario);
  std::optional<std::string> text = read_text_file(path);
  return text ? std::optional(with_meshes(*text, path)) : text;
}

std::string to_json_lines(const trace::Trace& trace) {
  std::string text = trace::to_json_line(trace.header) + "\n";
  for (const trace::Frame& frame : trace.frames) text += trace::to_json_line(frame) + "\n";
  return text;
}

void write_text(const fs::path& path, const std::string& text) {
  if (path.has_parent_path()) fs::create_directories(path.parent_path());
  write_whole_file(path.string(),
                   {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

}  // namespace contactscope::snapshot
