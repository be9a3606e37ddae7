#include "core/base/check.h"

#include <cstdio>
#include <cstdlib>

namespace scantrove::detail {

void checkFailed(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "scantrove: internal error: %s does not hold at %s:%d\n", condition, file, line);
  std::abort();
}

}  // namespace scantrove::detail
