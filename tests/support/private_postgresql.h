#pragma once
#include <gtest/gtest.h>
#include <pwd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace scantrove::test {

/// A PostgreSQL server of its own in a temporary folder, reached by a UNIX socket there only, so that a
/// system's server is neither used nor disturbed. Started as another user when the tests run as root, which
/// PostgreSQL refuses. The user `scantrove` may do all; the user `locked` needs the password "secret".
class PrivatePostgresql {
 public:
  /// The newest version of Debian's package; empty: it is not installed.
  static std::filesystem::path programs() {
    std::filesystem::path newest;
    std::error_code ignored;
    for (const auto& version : std::filesystem::directory_iterator("/usr/lib/postgresql", ignored)) {
      if (std::filesystem::exists(version.path() / "bin/initdb", ignored))
        newest = std::max(newest, version.path() / "bin");
    }
    return newest;
  }

  PrivatePostgresql() {
    for (const char* name :
         {"PGPASSWORD", "PGSERVICE", "PGHOST", "PGPORT", "PGUSER", "PGDATABASE", "PGOPTIONS"})
      ::unsetenv(name);
    if (::geteuid() == 0) {
      const passwd* other = ::getpwnam("postgres");
      if (other == nullptr) other = ::getpwnam("nobody");
      EXPECT_NE(other, nullptr);
      EXPECT_EQ(::chown(folder_.path().c_str(), other->pw_uid, other->pw_gid), 0);
      as_other_ = {"setpriv", "--reuid=" + std::to_string(other->pw_uid),
                   "--regid=" + std::to_string(other->pw_gid), "--clear-groups", "--"};
    }
    EXPECT_EQ(run({"initdb", "-D", data(), "-A", "trust", "-U", "scantrove", "-E", "UTF8", "--locale=C",
                   "--no-sync"}),
              0)
        << log();
    std::ofstream(data() + "/pg_hba.conf") << "local all locked scram-sha-256\nlocal all all trust\n";
    start();
  }
  ~PrivatePostgresql() { stop(); }
  PrivatePostgresql(const PrivatePostgresql&) = delete;
  PrivatePostgresql& operator=(const PrivatePostgresql&) = delete;

  /// After kill() the shared memory of the killed server may still be in use for a moment.
  void start() {
    const std::string options = "-k " + folder_.path().string() + " -c listen_addresses='' -c fsync=off";
    int failure = 1;
    for (int i = 0; i < 20 && failure != 0; ++i) {
      if (i > 0) std::this_thread::sleep_for(std::chrono::milliseconds(250));
      failure = run({"pg_ctl", "-D", data(), "-w", "-l", data() + "/server.log", "-o", options, "start"});
    }
    EXPECT_EQ(failure, 0) << log();
  }
  void stop() { run({"pg_ctl", "-D", data(), "-w", "-m", "immediate", "stop"}); }
  /// As a power cut would end it.
  void kill() const {
    pid_t server = 0;
    std::ifstream(data() + "/postmaster.pid") >> server;
    ASSERT_GT(server, 1);
    // Processes of its connections may answer once more, so they are killed with it.
    const std::vector<pid_t> children = childrenOf(server);
    ::kill(server, SIGKILL);
    for (const pid_t child : children) ::kill(child, SIGKILL);
    // Nobody may collect its exit status here, so that it seems to run to the next server.
    for (const char* lock : {"data/postmaster.pid", ".s.PGSQL.5432.lock", ".s.PGSQL.5432"})
      std::filesystem::remove(folder_ / lock);
  }

  [[nodiscard]] std::string url(const std::string& database, const std::string& user = "scantrove") const {
    return "postgresql:///" + database + "?host=" + folder_.path().string() + "&user=" + user;
  }
  /// Runs SQL with psql.
  void execute(const std::string& sql, const std::string& database = "postgres") const {
    EXPECT_EQ(
        run({"psql", "-q", "-h", folder_.path().string(), "-U", "scantrove", "-d", database, "-c", sql}), 0)
        << log();
  }
  /// Creates an empty database. Result: its address.
  std::string createDatabase() {
    const std::string name = "test_" + std::to_string(++databases_);
    execute("CREATE DATABASE " + name);
    return url(name);
  }

 private:
  static std::vector<pid_t> childrenOf(pid_t parent) {
    std::vector<pid_t> children;
    for (const auto& process : std::filesystem::directory_iterator("/proc")) {
      const std::string name = process.path().filename();
      if (!std::isdigit(static_cast<unsigned char>(name.front()))) continue;
      std::ifstream file(process.path() / "stat");
      std::string stat;  // "PID (NAME) STATE PARENT ..."
      std::getline(file, stat);
      const std::size_t end = stat.rfind(')');
      if (end == std::string::npos) continue;
      std::istringstream rest(stat.substr(end + 1));
      char state = 0;
      pid_t its_parent = 0;
      if (rest >> state >> its_parent && its_parent == parent) children.push_back(std::stoi(name));
    }
    return children;
  }
  [[nodiscard]] std::string data() const { return folder_ / "data"; }
  [[nodiscard]] std::string log() const {
    std::ostringstream text;
    text << std::ifstream(folder_ / "log").rdbuf();
    return text.str();
  }
  /// Runs a program of the package. Result: its exit status.
  int run(std::vector<std::string> command) const {
    command.front() = programs() / command.front();
    command.insert(command.begin(), as_other_.begin(), as_other_.end());
    std::vector<char*> arguments;
    for (std::string& argument : command) arguments.push_back(argument.data());
    arguments.push_back(nullptr);
    const std::string log_file = folder_ / "log";
    const pid_t child = ::fork();
    if (child == 0) {
      // The folder of the tests may be closed to the other user.
      const bool is_ready = ::chdir("/") == 0 && std::freopen(log_file.c_str(), "a", stdout) != nullptr &&
                            ::dup2(::fileno(stdout), STDERR_FILENO) >= 0;
      if (is_ready) ::execvp(arguments.front(), arguments.data());
      ::_exit(127);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  TemporaryFolder folder_;
  std::vector<std::string> as_other_;
  int databases_ = 0;
};

}  // namespace scantrove::test
