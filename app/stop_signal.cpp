#include "app/stop_signal.h"

#include <unistd.h>

#include <atomic>
#include <csignal>

namespace scantrove {
namespace {

std::atomic<bool> g_stop{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free values");

constexpr unsigned kPatience_s = 4;  ///< for an orderly stop that has nothing to write
std::atomic<int> g_stopped_by{0};
std::atomic<bool> g_results{false};

extern "C" void onStopSignal(int signal) {
  g_stopped_by = signal;
  g_stop = true;
  alarm(kPatience_s);
}

extern "C" void onPatienceEnd(int) {
  if (g_results) {
    alarm(1);
    return;
  }
  constexpr char kMessage[] = "scantrove: Stopped while it was busy; there were no results to write.\n";
  static_cast<void>(!write(STDERR_FILENO, kMessage, sizeof kMessage - 1));
  std::signal(g_stopped_by, SIG_DFL);
  static_cast<void>(raise(g_stopped_by));
}

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
  handle(SIGALRM, onPatienceEnd, SA_RESTART);
  handle(SIGPIPE, SIG_IGN, 0);
}

bool stopRequested() { return g_stop; }

void keepResultsAtStop(bool has_results) { g_results = has_results; }

}  // namespace scantrove
