// The times of frames in the trace event format that chrome://tracing and ui.perfetto.dev show.
#pragma once

#include <span>
#include <string>

#include "app/core/stage_times.h"

namespace lakshya {

// {"traceEvents":[..],"displayTimeUnit":"ms"}: one complete event ("ph":"X", ts and dur in microseconds from the first
// frame on) for every frame, inside it one for every stage, inside match one for every pass; all on one thread.
// Format: "Trace Event Format" of the Chromium project (catapult/docs/trace-event-format.md).
std::string trace_json(std::span<const FrameTimes> frames);

}  // namespace lakshya
