#pragma once

#include "trace/json.h"

namespace contactscope::versus {

/// This program's contacts for a request, in double with default settings, for use without a
/// scenario.
trace::Trace own_contacts(const trace::Trace& request);

}  // namespace contactscope::versus
