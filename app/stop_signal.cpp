#include "app/stop_signal.h"

#include <atomic>
#include <csignal>

namespace scantrove {
namespace {

std::atomic<bool> g_stop{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free values");

extern "C" void onStopSignal(int) { g_stop = true; }

void handle(int signal, void (*handler)(int), int flags) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = flags;
  sigemptyset(&action.sa_mask);
  sigaction(signal, &action, nullptr);
}

bool isIgnored(int signal) {
  struct sigaction action {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

void listenForStop() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    if (signal == SIGHUP && isIgnored(signal)) continue;
    handle(signal, onStopSignal, SA_RESTART | static_cast<int>(SA_RESETHAND));
  }
  handle(SIGPIPE, SIG_IGN, 0);
}

bool stopRequested() { return g_stop; }

}  // namespace scantrove
