#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <string>
#include <system_error>

#include "app/command_line.h"
#include "app/window_main.h"
#include "core/base/heap.h"
#include "core/base/log.h"
#include "core/base/text.h"
#include "core/compute/device_threads.h"

namespace scantrove {
namespace {

/// A failed write of the output, for example on a full disk, is a failure of the command.
int flushOutput(int exit_code) {
  errno = 0;
  std::cout.flush();
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout) return exit_code;
  const std::string reason = errno != 0 ? ": " + std::generic_category().message(errno) : "";
  std::cerr << "scantrove: Cannot write to the standard output" << reason << ".\n";
  return exit_code == kDone ? kJobFailed : exit_code;
}

int run(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // exceeding `ulimit -f` is then a write error, as a full disk is
  useSingleArena();
  initializeLog();
  pinDeviceThreads();
  const CommandLine line = parseCommandLine(argc, argv);
  if (line.exit_code) {
    std::cout << line.out;
    std::cerr << line.err;
    return *line.exit_code;
  }
  if (!line.job) {
    int own_arguments = 1;  // hides our options from Qt
    return runWindow(own_arguments, argv, line.window);
  }
  const Result<void> done = line.job();
  if (done) return kDone;
  std::cerr << "scantrove: " << forTerminal(done.error().message()) << '\n';
  return kJobFailed;
}

}  // namespace
}  // namespace scantrove

int main(int argc, char** argv) {
  try {
    return scantrove::flushOutput(scantrove::run(argc, argv));
  } catch (const std::exception& error) {
    std::cerr << "scantrove: " << scantrove::forTerminal(error.what()) << '\n';
    return scantrove::kJobFailed;
  }
}
