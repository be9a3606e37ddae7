#pragma once

namespace scantrove {

/// All threads allocate from one arena, and up to 32 MB of freed memory stay at its end, for the rest of the
/// process: a scan of 120 frames of a kitchen took 3.6 % less processor time and 18 MB less memory. Call
/// before other threads start. MALLOC_ARENA_MAX overrides the arena; other C libraries than GNU's ignore all.
void useSingleArena();

}  // namespace scantrove
