#pragma once

namespace scantrove {

/// Each thread of a processor device stays on a core of its own: PoCL starts one for every core and wakes
/// them together, and Linux otherwise often queues two of them on one core while another one has nothing to
/// do. Call at the start of a program, before other threads are there and before OpenCL is used. What the
/// environment's POCL_AFFINITY says stands; and nothing happens where this program may not use every core,
/// as PoCL counts them from the first.
void pinDeviceThreads();

}  // namespace scantrove
