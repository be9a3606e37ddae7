#pragma once

namespace scantrove {

/// Pins each PoCL worker thread to its own core. PoCL starts one per core and wakes them together, and Linux
/// otherwise often queues two on one core while another is idle. Call at program start, before other threads
/// and OpenCL. POCL_AFFINITY in the environment takes precedence. No effect if the program may not use every
/// core, as PoCL counts them from the first.
void pinDeviceThreads();

}  // namespace scantrove
