#include "app/check/known_same.h"

#include <elf.h>
#include <link.h>

#include <algorithm>
#include <cstring>

#include "core/at.h"
#include "core/workers.h"
#include "image/sha256.h"
#include "snapshot/meshes.h"
#include "snapshot/store.h"
#include "trace/listed_json.h"

namespace contactscope::app {
namespace {

namespace fs = std::filesystem;

/// Adds files that a scenario names: any quoted string that is a file relative to its folder.
void add_named_files(const std::string& text, const fs::path& folder, std::string& all) {
  for (std::size_t begin = text.find('"'); begin != std::string::npos;) {
    const std::size_t end = text.find('"', begin + 1);
    if (end == std::string::npos) return;
    const fs::path file = folder / text.substr(begin + 1, end - begin - 1);
    std::error_code unknown;
    if (end - begin > 3 && end - begin < 256 && fs::is_regular_file(file, unknown))
      all += snapshot::sha256_of_file(file) + " " + file.string() + "\n";
    begin = text.find('"', end + 1);
  }
}

std::string content_of(const Input& input, const fs::path& snapshots) {
  const std::string text = snapshot::read_text_file(input.scenario.path).value_or("");
  std::string all = input.scenario.path + "\n" + text;
  add_named_files(text, fs::path(input.scenario.path).parent_path(), all);
  for (const fs::path& file : snapshot::stored_files(snapshots, input.scenario.name)) {
    const std::string stored = snapshot::read_text_file(file).value_or("");
    all += sha256(stored) + " " + file.string() + "\n";
    if (file.extension() != ".jsonl") continue;
    for (const std::string& name : snapshot::meshes_named(stored))
      all += snapshot::sha256_of_file(snapshot::mesh_path(snapshots, name)) + " " + name + "\n";
  }
  return sha256(all);
}

/// Notes are consecutive: header, name, data. Name and data are padded to four bytes (System V ABI,
/// "Note Section").
std::string build_id_in(std::string_view notes) {
  const auto padded = [](std::size_t size) { return (size + 3) / 4 * 4; };
  ElfW(Nhdr) note;
  while (notes.size() >= sizeof note) {
    std::memcpy(&note, notes.data(), sizeof note);
    notes.remove_prefix(sizeof note);
    const std::size_t name = padded(note.n_namesz);
    if (notes.size() < name + note.n_descsz) break;
    if (note.n_type == NT_GNU_BUILD_ID &&
        notes.substr(0, note.n_namesz) == std::string_view("GNU", 4))
      return std::string(notes.substr(name, note.n_descsz));
    notes.remove_prefix(std::min(notes.size(), name + padded(note.n_descsz)));
  }
  return {};
}

/// The first loaded object is the program.
int find_in_program(dl_phdr_info* program, std::size_t, void* result) {
  for (int i = 0; i < program->dlpi_phnum; ++i) {
    const ElfW(Phdr)& segment = program->dlpi_phdr[i];
    if (segment.p_type != PT_NOTE) continue;
    const auto* notes = reinterpret_cast<const char*>(program->dlpi_addr + segment.p_vaddr);
    const std::string id = build_id_in({notes, segment.p_memsz});
    if (!id.empty()) *static_cast<std::string*>(result) = id;
  }
  return 1;  // skip its libraries
}

}  // namespace

std::string program_id() {
  std::string id;
  dl_iterate_phdr(find_in_program, &id);
  if (!id.empty()) return sha256(id);
  std::error_code unknown;
  const fs::path file = fs::read_symlink("/proc/self/exe", unknown);
  if (unknown) return {};
  return snapshot::sha256_of_file(file);
}

KnownSame::KnownSame(const fs::path& folder, std::string surroundings)
    : file_{std::move(surroundings)} {
  const std::optional<std::string> text = snapshot::read_text_file(folder / "known_same.json");
  if (!text) return;
  const trace::Json json = trace::Json::parse(*text, nullptr, false);
  if (!json.is_discarded() && json.value("surroundings", "") == file_.surroundings)
    trace::read_json(json, file_);
}

std::optional<snapshot::ScenarioOutcome> KnownSame::find(const std::string& scenario,
                                                         const std::string& content) const {
  const auto found = file_.scenarios.find(scenario);
  if (found == file_.scenarios.end() || found->second.content != content) return {};
  snapshot::ScenarioOutcome outcome = found->second.outcome;
  outcome.is_known_same = true;
  return outcome;
}

void KnownSame::add(const snapshot::ScenarioOutcome& outcome, const std::string& content) {
  if (!outcome.findings.empty() || outcome.written > 0)
    file_.scenarios.erase(outcome.scenario);
  else
    file_.scenarios[outcome.scenario] = {content, outcome};
}

std::string KnownSame::text() const {
  return trace::written("known_same.json", file_).dump(1) + "\n";
}

std::vector<std::string> contents_of(const std::vector<Input>& inputs, const fs::path& snapshots) {
  std::vector<std::string> contents(inputs.size());
  Workers(hardware_threads()).for_each(count_of(inputs), [&](int i, int) {
    const Input& input = at(inputs, i);
    if (!input.trace && input.unreadable.empty()) at(contents, i) = content_of(input, snapshots);
  });
  return contents;
}

}  // namespace contactscope::app
