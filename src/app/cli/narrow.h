#pragma once

#include "app/cli/catalogue.h"
#include "app/render/renderer.h"
#include "find/finder.h"

namespace contactscope::app {

/// Reduces a sequence to the shapes of --pair and --shapes. Throws UsageError for an unknown shape.
void narrow(Sequence& sequence, const Options& options);

/// Throws UsageError unless `names`, those of the shapes, have the one that an option was given.
void require_shape(const std::vector<std::string_view>& names, const std::string& option,
                   const std::string& name);

/// Whether a pair is that of --pair, in either order; without the option every pair is. Throws
/// UsageError unless it names two shapes of the header.
std::function<bool(const trace::Pair&)> chosen_pair(const trace::Header& header,
                                                    const Options& options);

/// The condition in the text of an option or argument. Throws UsageError.
find::Expression condition_of(const std::string& option, const std::string& text,
                              const find::Vocabulary& words = find::vocabulary());

/// Reduces the frames to draw to those with a pair for which --where holds, and their pairs to
/// these. Heaps keep all pairs, and the views mark these.
void keep_where(Sequence& sequence, Input& input, std::vector<View>& views, const Options& options);

/// Applies the camera options of the command line to all views. Throws UsageError if a position is
/// not three numbers.
void place_camera(std::vector<View>& views, const Options& options);

/// Applies --focus to all views, `worst` with the panel lint. narrow() refuses unknown names.
void place_focus(std::vector<View>& views, const Options& options);

/// True if --view names a file.
bool views_are_of_file(const Options& options);

/// Views of the TOML file that --view names, or one of them (FILE:VIEW); empty if it names no file.
/// Throws InputError and UsageError.
std::vector<View> views_of_file(const Options& options);

/// Names of a staged view's layers for which the frames have no data. Long sequences are sampled.
std::vector<std::string> idle_layers(const draw::Staging& staging,
                                     const std::vector<trace::Frame>& frames);

}  // namespace contactscope::app
