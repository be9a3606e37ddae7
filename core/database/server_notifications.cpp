#include "core/database/server_notifications.h"

#include <QCoreApplication>
#include <QEventLoop>
#include <QSqlDatabase>
#include <QSqlDriver>
#include <QThread>
#include <QTimer>
#include <utility>

#include "core/database/database_connection.h"
#include "core/database/server_address.h"

namespace scantrove {
namespace {

const QString& channelOfChanges() {
  static const QString name = QStringLiteral("scantrove_changes");
  return name;
}

constexpr int kCheckInterval_ms = 1000;

}  // namespace

std::unique_ptr<ServerNotifications> ServerNotifications::start(const std::string& database,
                                                                std::function<void()> on_change) {
  if (!isServerAddress(database) || QCoreApplication::instance() == nullptr) return nullptr;
  std::unique_ptr<ServerNotifications> notifications(new ServerNotifications(std::move(on_change)));
  notifications->thread_.reset(
      QThread::create([self = notifications.get(), database] { self->run(database); }));
  notifications->thread_->start();
  return notifications;
}

ServerNotifications::ServerNotifications(std::function<void()> on_change)
    : on_change_(std::move(on_change)) {}

ServerNotifications::~ServerNotifications() {
  if (!thread_) return;
  thread_->quit();
  thread_->wait();
}

void ServerNotifications::run(const std::string& database) {
  std::unique_ptr<DatabaseConnection> connection;
  QEventLoop loop;
  QTimer timer;
  const auto tick = [&] {
    if (!connection) {
      auto made = DatabaseConnection::openToRead(database);
      if (!made) return;
      connection = std::move(*made);
      QObject::connect(connection->driver(), &QSqlDriver::notification, &timer, on_change_);
    }
    check(*connection);
  };
  QObject::connect(&timer, &QTimer::timeout, &timer, tick);
  tick();
  timer.start(kCheckInterval_ms);
  loop.exec();
}

void ServerNotifications::check(DatabaseConnection& connection) {
  if (!connection.execute(QStringLiteral("SELECT 1"))) {
    is_listening_ = false;
    return;
  }
  QSqlDriver* driver = connection.driver();
  if (driver->subscribedToNotifications().contains(channelOfChanges())) return;
  is_listening_ = driver->subscribeToNotification(channelOfChanges());
  on_change_();
}

}  // namespace scantrove
