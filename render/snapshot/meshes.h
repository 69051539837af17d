#pragma once

#include "core/standard.h"

/// Stores each large mesh of traces once, in a file named by a hash of its content:
///
///     root/meshes/<32 hexadecimal digits>.json.gz
///
/// The file has `vertices`, `faces`, and `edges` unless they follow from the faces, as in
/// src/trace/README.md. The trace has empty lists instead, and its `geometry` is the name.
namespace contactscope::snapshot {

/// Shorter lists of a shape, as JSON, stay in the trace.
inline constexpr std::size_t kLargeMesh = 64 << 10;

/// Names of the meshes in a trace, from its text or its header line alone.
std::set<std::string> meshes_named(const std::string& text);

/// Restores every mesh of a trace, byte for byte; text without mesh names is returned unchanged.
/// Searches `meshes/` next to `path` and in parent folders. Throws core's InputError if a mesh is
/// missing or does not match its name.
std::string with_meshes(const std::string& text, const std::filesystem::path& path);

/// Stores a trace after its new large meshes (below `root`). Removes the files that it replaces and
/// unused meshes. Throws std::filesystem::filesystem_error.
void write_stored_trace(const std::filesystem::path& root, const std::filesystem::path& path,
                        const std::string& text);

/// Removes a stored file like remove_stored(), with meshes that only it used.
void remove_with_meshes(const std::filesystem::path& root, const std::filesystem::path& file);

/// Files below root/meshes that no stored trace uses, sorted.
std::set<std::filesystem::path> unnamed_meshes(const std::filesystem::path& root);

}  // namespace contactscope::snapshot
