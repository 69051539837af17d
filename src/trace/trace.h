#pragma once

#include "trace/frame.h"

/// The facts that each stage of the pipeline decided: world space, metres, double. Float results
/// are held exactly. No algorithms here; an optional stage that did not run, or that nobody asked
/// for, is empty. Each struct lists its fields (field.h); README.md gives the JSON that follows.
