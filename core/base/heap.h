#pragma once

namespace scantrove {

/// All threads allocate from one heap, for the rest of the process: threads come and go with every frame, and
/// what the heap of one has free is lost to the others (40 MB in a scan). Before other threads start; nothing
/// where the C library is not GNU's, or when MALLOC_ARENA_MAX says what to do. What is freed stays with the
/// heap, up to 32 MB at its end: each frame takes what the one before gave back, and the system need not
/// clear it anew.
void useSingleArena();

/// Gives the system what the heap has free: after much was freed that nobody will want again, as when kernels
/// have been compiled. Some milliseconds; any thread.
void trimHeap();

}  // namespace scantrove
