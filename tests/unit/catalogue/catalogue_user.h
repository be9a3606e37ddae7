#pragma once
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <string>

namespace scantrove::test {

/// Another program on a catalogue (tests/support/catalogue_user.cpp), told line by line what to do.
class CatalogueUser {
 public:
  explicit CatalogueUser(const std::string& file) {
    std::array<int, 2> to_child{}, from_child{};
    // Both programs are built into one folder.
    const std::string program =
        std::filesystem::read_symlink("/proc/self/exe").parent_path() / "catalogue_user";
    EXPECT_EQ(::pipe2(to_child.data(), O_CLOEXEC), 0);
    EXPECT_EQ(::pipe2(from_child.data(), O_CLOEXEC), 0);
    pid_ = ::fork();
    if (pid_ == 0) {
      ::dup2(to_child[0], STDIN_FILENO);
      ::dup2(from_child[1], STDOUT_FILENO);
      ::execl(program.c_str(), program.c_str(), file.c_str(), nullptr);
      ::_exit(127);
    }
    ::close(to_child[0]);
    ::close(from_child[1]);
    in_ = ::fdopen(to_child[1], "w");
    out_ = ::fdopen(from_child[0], "r");
  }
  CatalogueUser(const CatalogueUser&) = delete;
  CatalogueUser& operator=(const CatalogueUser&) = delete;
  ~CatalogueUser() {
    kill();
    end();
    std::fclose(in_);
    std::fclose(out_);
  }

  /// Its answer; empty when it ended.
  std::string ask(const std::string& line) {
    send(line);
    return nextLine();
  }
  void send(const std::string& line) {
    std::fputs((line + '\n').c_str(), in_);
    std::fflush(in_);
  }
  std::string nextLine() {
    std::string line;
    for (int c = std::fgetc(out_); c != EOF && c != '\n'; c = std::fgetc(out_)) line += static_cast<char>(c);
    return line;
  }

  /// Stores an object: its id, 0 when that failed.
  std::uint32_t add() { return idOf(ask("add")); }
  static std::uint32_t idOf(const std::string& answer) {
    unsigned id = 0;
    EXPECT_EQ(std::sscanf(answer.c_str(), "stored %u", &id), 1) << answer;
    return id;
  }

  void quit() {
    send("quit");
    EXPECT_EQ(end(), 0);
  }
  void kill() const {
    if (pid_ > 0) ::kill(pid_, SIGKILL);
  }

 private:
  int end() {
    int status = 0;
    if (pid_ > 0) ::waitpid(pid_, &status, 0);
    pid_ = -1;
    return status;
  }

  pid_t pid_ = -1;
  std::FILE* in_ = nullptr;
  std::FILE* out_ = nullptr;
};

}  // namespace scantrove::test
