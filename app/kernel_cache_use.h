#pragma once
#include "app/command.h"
#include "core/compute/kernel_cache.h"

namespace scantrove {

/// For a command that computes: as KernelCache, and says on stderr what a person should know of it.
class KernelCacheUse {
 public:
  KernelCacheUse() {
    if (cache_.remark()) std::cerr << "scantrove: " << forTerminal(cache_.remark()->message()) << '\n';
  }

 private:
  KernelCache cache_;
};

}  // namespace scantrove
