#include "core/capture/containers/opening_progress.h"

#include <spdlog/spdlog.h>

#include "core/base/urgent_end.h"

namespace scantrove {

Result<void> OpeningProgress::report(double done) {
  constexpr int kCallsPerLook = 64;  // the clock is read once in so many calls
  if (++calls_ % kCallsPerLook != 0) return {};
  if (isEndUrgent()) return fail("Opening " + name_ + " was cancelled.");
  if (Clock::now() - last_ < std::chrono::seconds(1)) return {};
  last_ = Clock::now();
  spdlog::info("Reading the index of {}: {:.0f} %.", name_, 100 * done);
  if (on_opening_ && !on_opening_(done)) return fail("Opening " + name_ + " was cancelled.");
  return {};
}

}  // namespace scantrove
