#include "app/child_scan.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <string_view>
#include <system_error>
#include <utility>

#include "app/command.h"

namespace scantrove {
namespace {

/// Before the error of a command on stderr.
constexpr std::string_view kErrorPrefix = "scantrove: ";

/// Only what may be called between fork() and exec() in a program with threads.
[[noreturn]] void becomeScan(char* const* arguments, int out, int err, pid_t parent) {
  // A group of its own: Ctrl+C in the terminal reaches this process alone, which passes it on once.
  static_cast<void>(::setpgid(0, 0));
  static_cast<void>(::prctl(PR_SET_PDEATHSIG, SIGTERM));
  if (::getppid() != parent) _exit(kJobFailed);
  const int nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  if (nothing >= 0) static_cast<void>(::dup2(nothing, STDIN_FILENO));
  static_cast<void>(::dup2(out, STDOUT_FILENO));
  static_cast<void>(::dup2(err, STDERR_FILENO));
  ::execv("/proc/self/exe", arguments);
  _exit(kJobFailed);
}

/// Appends what `descriptor` has; closes it at its end.
void drain(int& descriptor, std::string& text) {
  std::array<char, 4096> bytes{};
  while (descriptor >= 0) {
    const ssize_t got = ::read(descriptor, bytes.data(), bytes.size());
    if (got > 0) {
      text.append(bytes.data(), static_cast<std::size_t>(got));
      continue;
    }
    if (got < 0 && errno == EINTR) continue;
    if (got < 0 && errno == EAGAIN) return;
    ::close(descriptor);
    descriptor = -1;
  }
}

std::string titleOf(const std::string& source) {
  const std::string name = std::filesystem::path(source).filename().string();
  return inLine(name.empty() ? source : name);
}

}  // namespace

Result<std::unique_ptr<ChildScan>> ChildScan::start(std::string source,
                                                    const std::vector<std::string>& arguments) {
  std::unique_ptr<ChildScan> child(new ChildScan(std::move(source)));
  std::array<int, 2> out{-1, -1}, err{-1, -1};
  std::vector<std::string> words{"scantrove"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  int failure = 0;
  if (::pipe2(out.data(), O_CLOEXEC) != 0 || ::pipe2(err.data(), O_CLOEXEC) != 0) failure = errno;
  const pid_t parent = ::getpid();
  const pid_t process = failure == 0 ? ::fork() : -1;
  if (process == 0) becomeScan(pointers.data(), out[1], err[1], parent);
  if (process < 0 && failure == 0) failure = errno;
  for (const int end : {out[1], err[1]})
    if (end >= 0) ::close(end);
  child->process_ = process;
  child->out_ = out[0];
  child->err_ = err[0];
  if (process < 0) {
    return fail("The scan of " + child->source_ +
                    " cannot be started: " + std::generic_category().message(failure) + ".",
                "Give a smaller number of --jobs.");
  }
  for (const int end : {out[0], err[0]}) static_cast<void>(::fcntl(end, F_SETFL, O_NONBLOCK));
  return child;
}

ChildScan::~ChildScan() {
  if (process_ > 0) {
    ::kill(process_, SIGTERM);
    static_cast<void>(::waitpid(process_, nullptr, 0));
  }
  for (const int end : {out_, err_})
    if (end >= 0) ::close(end);
}

void ChildScan::read() {
  drain(out_, answer_);
  drain(err_, messages_);
  showLines(false);
}

void ChildScan::showLines(bool all) {
  while (!messages_.empty()) {
    const std::size_t end = messages_.find('\n');
    if (end == std::string::npos && !all) return;
    std::string line = messages_.substr(0, end);
    messages_.erase(0, end == std::string::npos ? end : end + 1);
    if (!error_line_.empty()) show(std::exchange(error_line_, {}));
    if (line.starts_with(kErrorPrefix)) {
      error_line_ = std::move(line);
    } else {
      show(line);
    }
  }
}

void ChildScan::show(const std::string& line) const {
  std::cerr << titleOf(source_) << ": " << forTerminal(line) << '\n';
}

void ChildScan::interrupt() {
  is_interrupted_ = true;
  if (process_ > 0) ::kill(process_, SIGINT);
}

std::optional<RecordingOutcome> ChildScan::outcome() {
  int status = 0;
  if (process_ <= 0 || ::waitpid(process_, &status, WNOHANG) != process_) return std::nullopt;
  process_ = -1;
  read();
  showLines(true);
  RecordingOutcome outcome = outcomeOf(status);
  // The reason of a failure is shown by who gets the outcome.
  if (!error_line_.empty() && error_line_.substr(kErrorPrefix.size()) != outcome.reason) show(error_line_);
  return outcome;
}

RecordingOutcome ChildScan::outcomeOf(int status) const {
  const Json answer = Json::parse(answer_, nullptr, false);
  if (answer.is_object() && answer.contains("recordings") && answer["recordings"].size() == 1) {
    if (std::optional<RecordingOutcome> outcome = outcomeFrom(answer["recordings"][0])) return *outcome;
  }
  RecordingOutcome outcome;
  outcome.source = source_;
  outcome.kind = is_interrupted_ ? RecordingOutcome::Kind::stopped : RecordingOutcome::Kind::failed;
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    outcome.reason = "The process of this scan was ended by signal " + std::to_string(signal) + " (" +
                     ::strsignal(signal) + "). Run the same command again; it continues the stored part.";
    if (signal == SIGKILL) outcome.reason += " If memory was short, give a smaller number of --jobs.";
  } else if (!error_line_.empty()) {
    outcome.reason = error_line_.substr(kErrorPrefix.size());
  } else {
    outcome.reason = "The process of this scan ended with exit code " + std::to_string(WEXITSTATUS(status)) +
                     " and without a message.";
  }
  return outcome;
}

}  // namespace scantrove
