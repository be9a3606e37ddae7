#include "core/database/database_connection.h"

#include <QByteArray>
#include <QDateTime>
#include <QSqlDatabase>
#include <QSqlDriver>
#include <QSqlError>
#include <algorithm>
#include <atomic>
#include <filesystem>

#include "core/base/check.h"
#include "core/database/server_address.h"
#include "core/database/server_errors.h"

namespace scantrove {
namespace {

/// At least, between two attempts to reach a server, so that a window does not stand still while it is away.
constexpr std::chrono::milliseconds kBetweenAttempts{1000};

/// For libpq: a server that vanished is noticed within half a minute. For the server: the longest wait for a
/// lock, and the end of a transaction whose program hangs.
QString optionsOfServer(const ServerAddress& address, bool is_read_only) {
  QString options =
      QStringLiteral(
          "connect_timeout='3';application_name='scantrove';keepalives_idle='10';keepalives_interval='5';"
          "keepalives_count='3';tcp_user_timeout='20000';options='-c lock_timeout=%1"
          " -c idle_in_transaction_session_timeout=60000%2'")
          .arg(QString::number(DatabaseConnection::kBusyTimeout_ms),
               is_read_only ? QStringLiteral(" -c default_transaction_read_only=on") : QString());
  return address.options.empty() ? options : QString::fromStdString(address.options) + u';' + options;
}

bool mayBeRepeated(const QString& sql) {
  return sql.startsWith(QStringLiteral("SELECT")) || sql.startsWith(QStringLiteral("BEGIN"));
}

}  // namespace

Error damagedDatabase(const std::string& file, const std::string& detail) {
  if (isServerAddress(file)) {
    return {"The database " + file + " is damaged or changed by another program (" + detail + ").",
            "Restore it from a backup."};
  }
  return {"The database " + file + " is damaged (" + detail + ").",
          "Restore it from a backup, or try to rescue it with: sqlite3 FILE .recover"};
}

Result<std::unique_ptr<DatabaseConnection>> DatabaseConnection::open(const std::string& database) {
  if (isServerAddress(database)) return connectToServer(database, Use::write);
  SCANTROVE_TRY(sqlite::checkPath(database));
  auto connection = connect(database, QString::fromStdString(database), {});
  if (!connection) return connection;
  for (const char* pragma : {"PRAGMA synchronous = NORMAL", "PRAGMA foreign_keys = ON"}) {
    SCANTROVE_TRY((*connection)->execute(pragma));
  }
  return connection;
}

Result<std::unique_ptr<DatabaseConnection>> DatabaseConnection::openToRead(const std::string& database) {
  if (isServerAddress(database)) return connectToServer(database, Use::read);
  SCANTROVE_TRY(sqlite::checkReadable(database));
  const std::optional<sqlite::Stamp> stamp = sqlite::stampOf(database);
  // Escapes bytes that have a meaning in a URI.
  const QByteArray path =
      QByteArray::fromStdString(std::filesystem::absolute(database).string()).toPercentEncoding("/");
  const QString uri = "file:" + QString::fromLatin1(path) + "?mode=ro" + (stamp ? "&immutable=1" : "");
  auto connection = connect(database, uri, ";QSQLITE_OPEN_READONLY;QSQLITE_OPEN_URI");
  if (connection) (*connection)->stamp_ = stamp;
  return connection;
}

bool DatabaseConnection::isStill() const { return !stamp_ || sqlite::stampOf(file_) == stamp_; }

std::unique_ptr<DatabaseConnection> DatabaseConnection::named(const std::string& database,
                                                              SqlDialect dialect) {
  static std::atomic<unsigned> serial = 0;
  std::unique_ptr<DatabaseConnection> connection(new DatabaseConnection);
  connection->file_ = database;
  connection->name_ = QString("scantrove-%1").arg(++serial);
  connection->dialect_ = dialect;
  connection->thread_ = std::this_thread::get_id();
  return connection;
}

Result<std::unique_ptr<DatabaseConnection>> DatabaseConnection::connect(const std::string& file,
                                                                        const QString& name_of_file,
                                                                        const QString& options) {
  auto connection = named(file, SqlDialect::sqlite);
  QSqlDatabase database = QSqlDatabase::addDatabase("QSQLITE", connection->name_);
  if (!database.isValid()) {
    return fail("QtSql's SQLite driver is missing.", "Install the package libqt6sql6-sqlite.");
  }
  database.setDatabaseName(name_of_file);
  database.setConnectOptions(QString("QSQLITE_BUSY_TIMEOUT=%1").arg(kBusyTimeout_ms) + options);
  if (!database.open()) return fail(sqlite::describe(file, database.lastError()));
  return connection;
}

Result<std::unique_ptr<DatabaseConnection>> DatabaseConnection::connectToServer(const std::string& url,
                                                                                Use use) {
  const Result<ServerAddress> address = serverAddressFrom(url);
  if (!address) return fail(address.error());
  if (!QSqlDatabase::isDriverAvailable("QPSQL")) {
    return fail("QtSql's PostgreSQL driver is missing, so " + url + " cannot be opened.",
                "Install the package libqt6sql6-psql.");
  }
  auto connection = named(url, SqlDialect::postgresql);
  QSqlDatabase database = QSqlDatabase::addDatabase("QPSQL", connection->name_);
  database.setHostName(QString::fromStdString(address->host));
  database.setPort(address->port);
  database.setUserName(QString::fromStdString(address->user));
  database.setDatabaseName(QString::fromStdString(address->database));
  database.setConnectOptions(optionsOfServer(*address, use == Use::read));
  connection->server_.is_lost = true;  // until it is made
  SCANTROVE_TRY(connection->reconnect());
  return connection;
}

DatabaseConnection::~DatabaseConnection() { QSqlDatabase::removeDatabase(name_); }

Result<void> DatabaseConnection::useWriteAheadLog() {
  if (isOnServer()) return {};
  // SQLite's busy timeout does not apply to the change to WAL, so wait here.
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(kBusyTimeout_ms);
  for (;;) {
    const Result<QSqlQuery> wal = execute("PRAGMA journal_mode = WAL");
    if (wal) return {};
    if (wal.error().what.find("locked") == std::string::npos || std::chrono::steady_clock::now() > deadline) {
      return fail(wal.error());
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

Result<QSqlQuery> DatabaseConnection::execute(const QString& sql, const QVariantList& values) {
  SCANTROVE_CHECK(thread_ == std::this_thread::get_id());
  if (has_lost_transaction_) {
    return fail("The database " + file_ + " has taken back what was being written into it.",
                "An earlier message names the reason; nothing was changed.");
  }
  if (!isOnServer()) return executeInFile(sql, values);
  Result<QSqlQuery> done = executeOnServer(sql, values);
  // A connection that was idle while the server restarted fails once.
  const bool may_repeat = transactions_ == 0 && server_.is_lost && !server_.refusal && mayBeRepeated(sql);
  return done || !may_repeat ? std::move(done) : executeOnServer(sql, values);
}

Result<QSqlQuery> DatabaseConnection::executeInFile(const QString& sql, const QVariantList& values) {
  QSqlQuery query(QSqlDatabase::database(name_, false));
  query.setForwardOnly(true);
  if (!query.prepare(sql)) return fail(sqlite::describe(file_, query.lastError()));
  for (const QVariant& value : values) query.addBindValue(value);
  if (!query.exec()) return fail(sqlite::describe(file_, query.lastError()));
  return query;
}

Result<QSqlQuery> DatabaseConnection::executeOnServer(const QString& sql, const QVariantList& values) {
  SCANTROVE_TRY(reconnect());
  const QSqlDatabase database = QSqlDatabase::database(name_, false);
  // Not forward-only: a query that is read row by row from the server would block all others.
  QSqlQuery query(database);
  if (query.exec(withLiterals(sql, values, *database.driver()))) return query;
  const server::Failure failure = server::failureOf(query.lastError());
  server_.is_lost = server_.is_lost || failure == server::Failure::lost;
  server_.has_conflict = server_.has_conflict || failure == server::Failure::conflict;
  server_.is_aborted = transactions_ > 0;
  return fail(server::describe(file_, query.lastError()));
}

Result<void> DatabaseConnection::reconnect() {
  if (!server_.is_lost) return {};
  if (transactions_ > 0) {
    return fail("The connection to " + file_ + " was lost; what was being stored is not in it.",
                "It is made again as soon as the server answers.");
  }
  const auto now = std::chrono::steady_clock::now();
  if (server_.refusal && now < server_.next_attempt) return fail(*server_.refusal);
  QSqlDatabase database = QSqlDatabase::database(name_, false);
  database.close();
  if (!database.open()) {
    const auto end = std::chrono::steady_clock::now();
    server_.refusal = server::describeConnecting(file_, database.lastError());
    server_.next_attempt =
        end + std::max<std::chrono::steady_clock::duration>(kBetweenAttempts, 10 * (end - now));
    return fail(*server_.refusal);
  }
  server_ = {};
  return {};
}

Result<std::int64_t> DatabaseConnection::insert(const QString& sql, const QVariantList& values) {
  Result<QSqlQuery> query = execute(isOnServer() ? sql + " RETURNING id" : sql, values);
  if (!query) return fail(query.error());
  if (!isOnServer()) return query->lastInsertId().toLongLong();
  return query->next() ? query->value(0).toLongLong() : 0;
}

QSqlDriver* DatabaseConnection::driver() const { return QSqlDatabase::database(name_, false).driver(); }

QString DatabaseConnection::now() { return QDateTime::currentDateTimeUtc().toString(Qt::ISODateWithMs); }

}  // namespace scantrove
