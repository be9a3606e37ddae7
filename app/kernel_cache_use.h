#pragma once
#include "app/command.h"
#include "core/compute/kernel_cache.h"

namespace scantrove {

/// Kernel cache of a command. Prints the remark of the cache on stderr.
class KernelCacheUse {
 public:
  KernelCacheUse() {
    if (cache_.remark()) std::cerr << "scantrove: " << forTerminal(cache_.remark()->message()) << '\n';
  }

 private:
  KernelCache cache_;
};

}  // namespace scantrove
