#include "snapshot/accept.h"

#include <fnmatch.h>

#include "image/png.h"
#include "snapshot/check.h"
#include "snapshot/meshes.h"
#include "snapshot/store.h"

namespace contactscope::snapshot {
namespace fs = std::filesystem;

bool names(const std::string& pattern, const Finding& finding) {
  std::string wanted = pattern;
  while (wanted.size() > 1 && wanted.back() == '/') wanted.pop_back();
  std::string key = finding.key();
  // A candidate compared with frame_0012.osmesa.png is still the picture frame_0012.
  if (const std::size_t dot = key.rfind('.');
      dot != std::string::npos && dot > key.rfind('/') &&
      fnmatch(wanted.c_str(), key.substr(0, dot).c_str(), 0) == 0)
    return true;
  while (true) {
    if (fnmatch(wanted.c_str(), key.c_str(), 0) == 0) return true;
    const std::size_t slash = key.rfind('/');
    if (slash == std::string::npos) return false;
    key.resize(slash);
  }
}

std::string pattern_of(const std::string& key) {
  std::string pattern = key.starts_with('-') ? "\\" : "";
  for (const char c : key) {
    if (std::string_view("*?[\\").find(c) != std::string_view::npos) pattern += '\\';
    pattern += c;
  }
  return pattern;
}

std::string accept(const fs::path& report, const fs::path& snapshots, Finding& finding,
                   const Acceptance& how) {
  if (finding.done != Done::Nothing || finding.review == Review::Accepted)
    return finding.key() + " is done already";
  if (finding.kind == FindingKind::UnreadableScenario)
    return finding.key() + " could not be read; fix the file, and run check again";
  if (finding.file.empty())
    return finding.key() + " is an expectation; fix it in the scenario, or fix the program";
  if (finding.kind == FindingKind::KnownBad && how.word.empty())
    return finding.key() + " matches " + finding.file +
           ", which is known to be bad; if it is right after all, remove that file first";
  const fs::path stored = snapshots / finding.file;
  if (sha256_of_file(stored) != finding.stored_sha256)
    return finding.key() + " is stale: " + stored.generic_string() +
           " changed since the report; run check again";
  if (finding.kind == FindingKind::Orphaned) {
    remove_with_meshes(snapshots, stored);
    finding.done = Done::Removed;
    finding.review = Review::Accepted;
    return {};
  }
  const fs::path candidate = report / finding.candidate;
  if (finding.candidate.empty() || sha256_of_file(candidate) != finding.candidate_sha256)
    return finding.key() + " is stale: its candidate " + candidate.generic_string() +
           " is gone, or changed since the report; run check again";
  fs::path target = stored;
  const bool is_bad = how.word.starts_with("bad_");
  if (!how.word.empty()) {
    const bool is_list = stored == hashes_path(snapshots, finding.scenario);
    if (is_list) return finding.key() + " has only one baseline; accept it without --as";
    if (!finding.is_picture() && !is_bad)
      return finding.key() +
             " is not a picture, and only pictures have a baseline per driver; accept it without "
             "--as";
    const std::string name = stored.filename().string();
    target.replace_filename(name.substr(0, name.find('.')) + "." + how.word +
                            stored.extension().string());
  }
  const bool is_there = fs::exists(target);
  if (finding.is_picture())
    write_stored_picture(target, read_png(candidate.string()));
  else if (target.extension() == ".jsonl")
    write_stored_trace(snapshots, target, *read_text_file(candidate));
  else
    write_text(target, *read_text_file(candidate));
  if (!how.note.empty()) write_text(fs::path(target).replace_extension(".txt"), how.note + "\n");
  finding.review = is_bad ? Review::Rejected : Review::Accepted;
  if (!is_bad) finding.done = is_there ? Done::Updated : Done::Written;
  return {};
}

}  // namespace contactscope::snapshot
