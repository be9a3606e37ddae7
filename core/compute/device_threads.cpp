#include "core/compute/device_threads.h"

#ifdef __linux__
#include <sched.h>
#include <unistd.h>
#endif

#include <cstdlib>

namespace scantrove {

void pinDeviceThreads() {
#ifdef __linux__
  cpu_set_t usable;
  CPU_ZERO(&usable);
  if (::sched_getaffinity(0, sizeof(usable), &usable) != 0) return;
  const auto cores = static_cast<int>(::sysconf(_SC_NPROCESSORS_CONF));
  for (int core = 0; core < cores; ++core) {
    if (core >= CPU_SETSIZE || !CPU_ISSET(static_cast<std::size_t>(core), &usable)) return;
  }
  constexpr int kKeepWhatIsSet = 0;
  static_cast<void>(::setenv("POCL_AFFINITY", "1", kKeepWhatIsSet));
#endif
}

}  // namespace scantrove
