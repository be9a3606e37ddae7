#include "app/stop_signal.h"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstddef>

namespace scantrove {
namespace {

std::atomic<bool> g_stop{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free values");

constexpr int kTimeout_s = 4, kTimeoutWithResults_s = 20;
std::atomic<int> g_stopped_by{0};
std::atomic<int> g_waited_s{0};
std::atomic<AtStop> g_at_stop{AtStop::nothing};
static_assert(std::atomic<AtStop>::is_always_lock_free);

extern "C" void onStopSignal(int signal) {
  g_stopped_by = signal;
  g_stop = true;
  alarm(1);
}

template <std::size_t kSize>
void print(const char (&message)[kSize]) {
  static_cast<void>(!write(STDERR_FILENO, message, kSize - 1));
}

extern "C" void onSecond(int) {
  const AtStop stage = g_at_stop;
  const bool has_results = stage == AtStop::results || stage == AtStop::complete;
  if (++g_waited_s < (has_results ? kTimeoutWithResults_s : kTimeout_s)) {
    alarm(1);
    return;
  }
  switch (stage) {
    case AtStop::nothing:
      print("scantrove: Stopped before there were results to write.\n");
      break;
    case AtStop::unfinished:
      print("scantrove: Stopped before the end; files written so far remain.\n");
      break;
    case AtStop::results:
      print("scantrove: Stopped while writing results; they are incomplete.\n");
      break;
    case AtStop::complete:
      print("scantrove: Stopped after the results were written.\n");
      break;
  }
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
  handle(SIGALRM, onSecond, SA_RESTART);
  handle(SIGPIPE, SIG_IGN, 0);
}

bool stopRequested() { return g_stop; }

void setAtStop(AtStop stage) {
  if (stage == AtStop::complete) g_waited_s = 0;
  g_at_stop = stage;
}

bool isInterrupted() { return g_stop && g_stopped_by == SIGINT; }

void listenForStopAgain() {
  g_stop = false;
  alarm(0);
  g_waited_s = 0;
  listenForStop();
}

}  // namespace scantrove
