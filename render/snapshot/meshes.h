#pragma once

#include <filesystem>
#include <set>
#include <string>

/// Large meshes of stored traces: each stands once in a file that is named by its content, whoever names it.
///
///     root/meshes/<32 hexadecimal digits>.json.gz
///
/// holds `vertices`, `faces`, and `edges` where they do not follow from the faces, as src/trace/README.md has
/// them. The trace has empty lists instead, and its `geometry` is the name.
namespace contactscope::snapshot {

/// Lists of a shape that are shorter than this, as JSON, stay in the trace.
inline constexpr std::size_t kLargeMesh = 64 << 10;

std::filesystem::path mesh_path(const std::filesystem::path& root, const std::string& name);

/// The meshes that a trace names, by its text or its header's line alone.
std::set<std::string> meshes_named(const std::string& text);

/// The same trace with every mesh in it again, byte for byte as it was before it was stored; a text that names
/// none is returned as it is. They are looked for in `meshes/` beside `path` and above it. Throws core's InputError where one is
/// not there, or is not what its name says.
std::string with_meshes(const std::string& text, const std::filesystem::path& path);

/// Stores a trace: first its large meshes below `root`, but for those that are there, then itself. Removes what it
/// replaces, with meshes that nothing names any more. Throws std::filesystem::filesystem_error.
void write_stored_trace(const std::filesystem::path& root, const std::filesystem::path& path,
                        const std::string& text);

/// Removes a stored file, as remove_stored() does, with meshes that only it named.
void remove_with_meshes(const std::filesystem::path& root, const std::filesystem::path& file);

/// Files below root/meshes that no stored trace names, sorted.
std::set<std::filesystem::path> unnamed_meshes(const std::filesystem::path& root);

}  // namespace contactscope::snapshot
