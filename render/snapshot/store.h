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
///     root/<group>/<idea>/[<view>/]frame_0012.png
///
/// with the view's folder only where a scenario has several views.
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

/// Scenarios that have a folder with a trace or a picture in it, sorted: "<group>/<idea>".
std::vector<std::string> stored_scenarios(const std::filesystem::path& root);

/// Those of them that are another engine's: no scenario file describes them.
std::vector<std::string> stored_of_engines(const std::filesystem::path& root);

/// Stored pictures below the scenario's folder that it does not store any more, sorted: frames not
/// in `frames`, views not in `views` (empty where the scenario has a single view), and pictures
/// under a name that is no frame's.
std::vector<std::filesystem::path> stale_files(const std::filesystem::path& root,
                                               const std::string& scenario,
                                               std::span<const std::string> views,
                                               std::span<const int> frames);

/// The text of the stored trace; nothing where there is none.
std::optional<std::string> read_stored_trace(const std::filesystem::path& root,
                                             const std::string& scenario);

/// A trace as its file holds it: one line for the header, one a frame.
std::string to_json_lines(const trace::Trace& trace);

/// Writes a text file that is whole or absent, and the folders above it. Throws
/// std::filesystem::filesystem_error.
void write_text(const std::filesystem::path& path, const std::string& text);

}  // namespace contactscope::snapshot
