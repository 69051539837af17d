#pragma once

#include "trace/json.h"

namespace contactscope::versus {

/// The contacts of this program for a request, in double and with its default settings: what it answers where
/// there is no scenario that says more.
trace::Trace own_contacts(const trace::Trace& request);

}  // namespace contactscope::versus
