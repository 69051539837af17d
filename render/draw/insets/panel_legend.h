#pragma once

#include "core/view.h"
#include "draw/scene/legend.h"
#include "trace/trace.h"

/// What the legend has to say about the panels: it is one for the whole picture.
namespace contactscope::draw {

/// The pair whose contact plane is shown, the first that touches; nullptr where none does.
const trace::Pair* pair_of_contact_plane(const trace::Frame& frame);

/// Whether that panel shows which points were kept; of many manifolds each was reduced by itself.
bool reduction_in_contact_plane(const trace::Pair& pair);

void explain_panels(const View& view, const trace::Frame& frame, Legend& legend);

}  // namespace contactscope::draw
