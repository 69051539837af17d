#include "app/check/program_id.h"

#include <elf.h>
#include <link.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <string_view>

#include "image/sha256.h"
#include "image/whole_file.h"

namespace contactscope::app {
namespace {

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
  const std::filesystem::path file = std::filesystem::read_symlink("/proc/self/exe", unknown);
  if (unknown) return {};
  const std::vector<std::uint8_t> bytes = read_whole_file(file.string());
  return sha256({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace contactscope::app
