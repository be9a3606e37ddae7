#include "app/stop_signal.h"

#include <atomic>
#include <csignal>

namespace scantrove {
namespace {

std::atomic<bool> g_stop{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free values");

extern "C" void onStopSignal(int) { g_stop = true; }

}  // namespace

void listenForStop() {
  struct sigaction action {};
  action.sa_handler = onStopSignal;
  action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool stopRequested() { return g_stop; }

}  // namespace scantrove
