#pragma once

#include "app/catalogue.h"
#include "app/studio.h"

namespace contactscope::app {

/// Leaves in a sequence what --pair and --shapes name: shapes that are not shown are not there. Throws
/// UsageError where it has no such shape.
void narrow(Sequence& sequence, const Options& options);

/// Puts what the command line says of the camera into all views of a scene. Throws UsageError of a place that
/// is not three numbers.
void place_camera(std::vector<View>& views, const Options& options);

/// Whether --view names a file.
bool views_are_of_file(const Options& options);

/// The views that --view names by a TOML file, alone or with a colon and the name of one; empty where it names none.
/// Throws InputError and UsageError.
std::vector<View> views_of_file(const Options& options);

/// Of the layers of a staged view those that add nothing to any frame, by name: the sequence has no data for
/// them. Of long sequences some frames are looked at.
std::vector<std::string> idle_layers(const draw::Staging& staging,
                                     const std::vector<trace::Frame>& frames);

}  // namespace contactscope::app
