#include "app/progress_line.h"

#include <unistd.h>

#include <iomanip>
#include <iostream>
#include <sstream>

#include "core/base/text.h"

namespace scantrove {

using namespace std::chrono_literals;

ProgressLine::ProgressLine() : is_terminal_(::isatty(STDERR_FILENO) == 1) {
  next_ = Clock::now() + (is_terminal_ ? 0ms : 3000ms);
}

ProgressLine::~ProgressLine() {
  if (line_is_open_) std::cerr << '\n';
}

void ProgressLine::show(const ScanSnapshot& snapshot) {
  show([&] { return describeProgress(snapshot); });
}

void ProgressLine::show(const std::function<std::string()>& describe) {
  if (Clock::now() < next_) return;
  next_ = Clock::now() + (is_terminal_ ? 200ms : 3000ms);
  clearLine();
  std::cerr << forTerminal(describe()) << (is_terminal_ ? "" : "\n") << std::flush;
  line_is_open_ = is_terminal_;
}

void ProgressLine::print(const std::string& message) {
  clearLine();
  line_is_open_ = false;
  std::cerr << forTerminal(message) << '\n';
}

void ProgressLine::clearLine() {
  if (line_is_open_) std::cerr << "\r\033[K";
}

std::string describeProgress(const ScanSnapshot& snapshot) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << snapshot.frames.done();
  if (snapshot.frames_total > 0) {
    text << '/' << snapshot.frames_total << " frames ("
         << 100LL * snapshot.frames.done() / snapshot.frames_total << " %)";
  } else {
    text << " frames";
  }
  text << ", " << snapshot.fps << " fps, " << toString(snapshot.pose.state) << ", " << snapshot.region_count
       << " regions";
  if (snapshot.frames.lost > 0) text << ", " << snapshot.frames.lost << " lost";
  if (snapshot.frames.skipped > 0) text << ", " << snapshot.frames.skipped << " unreadable";
  if (snapshot.frames.dropped > 0) text << ", " << snapshot.frames.dropped << " dropped";
  return text.str();
}

}  // namespace scantrove
