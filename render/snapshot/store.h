#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "trace/json.h"

/// Where snapshots lie:
///
///     root/<group>/<idea>/trace.jsonl
///     root/<group>/<idea>/frames.txt
///     root/<group>/<idea>/[<view>/]frame_0012.png
///
/// with the view's folder only where a scenario has several views, and large meshes in root/meshes, see meshes.h. Beside a picture or a trace there may be others of
/// its name with a word more: frame_0012.osmesa.png of another driver, frame_0012.bad_31.png of a bug that is known, which
/// frame_0012.bad_31.txt tells of.
namespace contactscope::snapshot {

/// One picture of a scenario.
struct PictureKey {
  std::string scenario;             // "<group>/<idea>"
  std::optional<std::string> view;  // set where the scenario has several
  int frame = 0;
};

/// "hull/face_contact frame 12", or "hull/face_contact frame 12, view side".
std::string to_string(const PictureKey& key);

/// "frame_0012": at least four digits, so that names sort by number.
std::string frame_stem(int frame);

/// Paths below a root folder; nothing is looked up. Throw std::invalid_argument where a name would
/// leave its folder (empty, "..", a slash in a view's name).
std::filesystem::path scenario_folder(const std::filesystem::path& root,
                                      const std::string& scenario);
std::filesystem::path picture_folder(const std::filesystem::path& root, const std::string& scenario,
                                     const std::optional<std::string>& view);
std::filesystem::path picture_path(const std::filesystem::path& root, const PictureKey& key);
std::filesystem::path trace_path(const std::filesystem::path& root, const std::string& scenario);
/// Of frames that are not stored.
std::filesystem::path hashes_path(const std::filesystem::path& root, const std::string& scenario);

/// The files beside `own`, and itself, that hold what it does: "frame_0012.png", "frame_0012.osmesa.png". Itself
/// first, then by name; those that exist.
std::vector<std::filesystem::path> baselines_of(const std::filesystem::path& own);
/// Whether one of them is there to be known again: its word more begins with "bad_".
bool is_known_bad(const std::filesystem::path& baseline);

/// All that is stored of a scenario, sorted.
std::vector<std::filesystem::path> stored_files(const std::filesystem::path& root,
                                                const std::string& scenario);
/// Removes a stored file, and the folder that it leaves empty, which a reader would call a scenario or a view.
void remove_stored(const std::filesystem::path& file);

/// Scenarios that have a folder with a trace or a picture in it, sorted: "<group>/<idea>".
std::vector<std::string> stored_scenarios(const std::filesystem::path& root);

/// Whether its stored trace is another engine's, which no scenario file describes. Throws InputError where the
/// trace cannot be read.
bool is_of_an_engine(const std::filesystem::path& root, const std::string& scenario);

/// Stored pictures below the scenario's folder that it does not store any more, sorted: frames not
/// in `frames`, views not in `views` (empty where the scenario has a single view), and pictures
/// under a name that is no frame's, with what tells of them.
std::vector<std::filesystem::path> stale_files(const std::filesystem::path& root,
                                               const std::string& scenario,
                                               std::span<const std::string> views,
                                               std::span<const int> frames);

/// All of a file; nothing where there is none.
std::optional<std::string> read_text_file(const std::filesystem::path& path);
/// Of its bytes, as sha256() gives it; empty where there is no file.
std::string sha256_of_file(const std::filesystem::path& path);
/// The text of the stored trace, with its meshes; nothing where there is none. Throws core's InputError where one of
/// them cannot be read.
std::optional<std::string> read_stored_trace(const std::filesystem::path& root,
                                             const std::string& scenario);

/// A trace as its file holds it: one line for the header, one a frame.
std::string to_json_lines(const trace::Trace& trace);

/// Writes a text file that is whole or absent, and the folders above it. Throws
/// std::filesystem::filesystem_error.
void write_text(const std::filesystem::path& path, const std::string& text);

}  // namespace contactscope::snapshot
