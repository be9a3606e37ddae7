#include "core/base/thread_priority.h"

#include <sys/resource.h>
#include <unistd.h>

namespace scantrove {

void lowerThreadPriority(Niceness niceness) {
  if (niceness == Niceness::none) return;
#ifdef __linux__
  static_cast<void>(::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), static_cast<int>(niceness)));
#else
  static_cast<void>(niceness);
#endif
}

}  // namespace scantrove
