#pragma once

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "trace/json.h"

/// Layout of the snapshot folder:
///
///     root/<group>/<idea>/trace.jsonl
///     root/<group>/<idea>/frames.txt
///     root/<group>/<idea>/[<view>/]frame_0012.png
///
/// The view's folder exists only if a scenario has several views. Large meshes are in root/meshes,
/// see meshes.h. A picture or trace may have variants with an extra word: frame_0012.osmesa.png for
/// another driver, frame_0012.bad_31.png for a known bug that frame_0012.bad_31.txt describes.
namespace contactscope::snapshot {

struct PictureKey {
  std::string scenario;             // "<group>/<idea>"
  std::optional<std::string> view;  // set if the scenario has several
  int frame = 0;
};

/// "hull/face_contact frame 12", or "hull/face_contact frame 12, view side".
std::string to_string(const PictureKey& key);

/// "frame_0012": at least four digits, so that names sort by number.
std::string frame_stem(int frame);

/// Paths below a root folder, without file access. Throw std::invalid_argument if a name would
/// leave its folder (empty, "..", a slash in a view's name).
std::filesystem::path scenario_folder(const std::filesystem::path& root,
                                      const std::string& scenario);
std::filesystem::path picture_folder(const std::filesystem::path& root, const std::string& scenario,
                                     const std::optional<std::string>& view);
std::filesystem::path picture_path(const std::filesystem::path& root, const PictureKey& key);
std::filesystem::path trace_path(const std::filesystem::path& root, const std::string& scenario);
/// Hashes of frames that are not stored.
std::filesystem::path hashes_path(const std::filesystem::path& root, const std::string& scenario);

/// Existing files of `own` and its variants: "frame_0012.png", "frame_0012.osmesa.png". `own`
/// first, then by name.
std::vector<std::filesystem::path> baselines_of(const std::filesystem::path& own);
/// True for a variant of a known bug: its extra word starts with "bad_".
bool is_known_bad(const std::filesystem::path& baseline);

/// All stored files of a scenario, sorted.
std::vector<std::filesystem::path> stored_files(const std::filesystem::path& root,
                                                const std::string& scenario);
/// Removes a stored file and its folder if empty: an empty one would look like a scenario or view.
void remove_stored(const std::filesystem::path& file);

/// Scenarios whose folder has a trace or a picture, sorted: "<group>/<idea>".
std::vector<std::string> stored_scenarios(const std::filesystem::path& root);

/// True if the stored trace is of another engine, which has no scenario file. Throws InputError if
/// the trace is unreadable.
bool is_of_an_engine(const std::filesystem::path& root, const std::string& scenario);

/// Stored pictures that the scenario no longer stores, sorted: frames not in `frames`, views not in
/// `views` (empty: a single view), and names that are not a frame's, with their notes.
std::vector<std::filesystem::path> stale_files(const std::filesystem::path& root,
                                               const std::string& scenario,
                                               std::span<const std::string> views,
                                               std::span<const int> frames);

/// Nullopt if the file is missing.
std::optional<std::string> read_text_file(const std::filesystem::path& path);
/// sha256() of the file; empty if the file is missing.
std::string sha256_of_file(const std::filesystem::path& path);
/// Text of the stored trace, with its meshes; nullopt if missing. Throws core's InputError if a
/// mesh is unreadable.
std::optional<std::string> read_stored_trace(const std::filesystem::path& root,
                                             const std::string& scenario);

/// A trace as in its file: one line for the header, one per frame.
std::string to_json_lines(const trace::Trace& trace);

/// Creates missing folders; the file is complete or absent. Throws
/// std::filesystem::filesystem_error.
void write_text(const std::filesystem::path& path, const std::string& text);

/// Exclusive lock of a folder between processes; waits for the current holder. Does nothing if the
/// folder cannot be opened.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder)
      : file_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (file_ >= 0) ::flock(file_, LOCK_EX);
  }
  ~FolderLock() {
    if (file_ >= 0) ::close(file_);
  }
  FolderLock& operator=(FolderLock&&) = delete;

 private:
  int file_;
};

}  // namespace contactscope::snapshot
