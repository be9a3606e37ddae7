#include "core/base/heap.h"

#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace scantrove {

void useSingleArena() {
#ifdef __GLIBC__
  if (std::getenv("MALLOC_ARENA_MAX") == nullptr) ::mallopt(M_ARENA_MAX, 1);
  constexpr int kUntrimmed_bytes = 32 << 20;
  ::mallopt(M_MMAP_THRESHOLD, kUntrimmed_bytes);
  ::mallopt(M_TRIM_THRESHOLD, kUntrimmed_bytes);
#endif
}

}  // namespace scantrove
