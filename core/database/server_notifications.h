#pragma once
#include <atomic>
#include <functional>
#include <memory>
#include <string>

#include "core/base/result.h"

class QThread;

namespace scantrove {

class DatabaseConnection;

/// Listens to the changes that programs announce in a server's database (LISTEN and NOTIFY), on a thread and
/// a connection of its own. It only saves waiting: who needs the changes reads them, and also reads them now
/// and then while this does not listen.
class ServerNotifications {
 public:
  static constexpr const char* kNotify = "NOTIFY scantrove_changes";

  /// Calls `on_change` on its thread, after each announced commit of any program and after each (new) start
  /// of listening. Null: `database` is a file, or there is no QCoreApplication, whose event loops it needs.
  [[nodiscard]] static std::unique_ptr<ServerNotifications> start(const std::string& database,
                                                                  std::function<void()> on_change);
  ~ServerNotifications();
  ServerNotifications(const ServerNotifications&) = delete;
  ServerNotifications& operator=(const ServerNotifications&) = delete;

  /// False while the server is away, or refuses to be listened to. Any thread.
  [[nodiscard]] bool isListening() const { return is_listening_; }

 private:
  explicit ServerNotifications(std::function<void()> on_change);
  void run(const std::string& database);
  /// Begins to listen if it does not. Also notices a lost connection, which libpq reports to nobody.
  void check(DatabaseConnection& connection);

  const std::function<void()> on_change_;
  std::atomic<bool> is_listening_ = false;
  std::unique_ptr<QThread> thread_;  // last: uses all members above
};

}  // namespace scantrove
