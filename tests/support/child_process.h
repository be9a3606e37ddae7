#pragma once
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace scantrove::test {

/// A program that runs during a test. The destructor kills it.
class ChildProcess {
 public:
  using Environment = std::map<std::string, std::string>;  ///< added to the environment of the test

  explicit ChildProcess(const std::vector<std::string>& command, const Environment& environment = {}) {
    std::vector<char*> arguments;
    for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    pid_ = fork();
    if (pid_ < 0) throw std::runtime_error("fork failed");
    if (pid_ > 0) return;
    redirect(STDOUT_FILENO, folder_ / "stdout");
    redirect(STDERR_FILENO, folder_ / "stderr");
    unsetenv("SCANTROVE_DEVICE");
    unsetenv("SCANTROVE_LOG");
    for (const auto& [name, value] : environment) setenv(name.c_str(), value.c_str(), 1);
    execvp(arguments[0], arguments.data());
    _exit(127);
  }
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess() {
    if (status_) return;
    kill(SIGKILL);
    waitpid(pid_, nullptr, 0);
  }

  [[nodiscard]] pid_t pid() const { return pid_; }
  void kill(int signal) const { ::kill(pid_, signal); }

  [[nodiscard]] bool isRunning() {
    int status = 0;
    if (!status_ && waitpid(pid_, &status, WNOHANG) == pid_) status_ = status;
    return !status_;
  }

  /// Waits for the end. Result: the exit code; 128 + signal when one ended it; -1 when `limit` passed.
  int wait(std::chrono::seconds limit = std::chrono::seconds(300)) {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (isRunning()) {
      if (std::chrono::steady_clock::now() > end) return -1;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return WIFEXITED(*status_) ? WEXITSTATUS(*status_) : 128 + WTERMSIG(*status_);
  }

  [[nodiscard]] std::string out() const { return readText(folder_ / "stdout"); }
  [[nodiscard]] std::string err() const { return readText(folder_ / "stderr"); }

 private:
  static void redirect(int descriptor, const std::filesystem::path& path) {
    const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    dup2(file, descriptor);
    close(file);
  }

  TemporaryFolder folder_;
  pid_t pid_ = -1;
  std::optional<int> status_;
};

/// Exit code and output of a finished program.
struct Finished {
  int exit_code = 0;
  std::string out;
  std::string err;
};

inline Finished runProgram(const std::vector<std::string>& command,
                           const ChildProcess::Environment& environment = {}) {
  ChildProcess child(command, environment);
  Finished result;
  result.exit_code = child.wait();
  result.out = child.out();
  result.err = child.err();
  return result;
}

}  // namespace scantrove::test
