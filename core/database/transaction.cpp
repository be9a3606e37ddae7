#include "core/database/transaction.h"

#include <chrono>
#include <string>
#include <thread>
#include <utility>

#include "core/database/database_connection.h"
#include "core/database/server_notifications.h"

namespace scantrove {
namespace {

constexpr int kMostTries = 6;  // of a transaction that conflicts with others
constexpr std::chrono::milliseconds kFirstPause{20};

QString savepoint(int depth) { return QString("part_%1").arg(depth); }

/// PostgreSQL's equivalent of BEGIN IMMEDIATE: one writer at a time. Ids are therefore committed in their
/// order, which reading "all after the last one" relies on, and what a transaction has read stays true.
constexpr const char* kLockOfWriters =
    "SELECT pg_advisory_xact_lock(1399025268, hashtext(coalesce(current_schema(), '')))";

}  // namespace

Result<Transaction> Transaction::begin(DatabaseConnection& connection) {
  const int depth = connection.transactions_;
  if (depth == 0) {
    connection.is_change_announced_ = false;
    connection.server_.has_conflict = connection.server_.is_aborted = false;
  }
  const QString outermost =
      connection.isOnServer() ? QString("BEGIN ISOLATION LEVEL READ COMMITTED") : QString("BEGIN IMMEDIATE");
  const Result<QSqlQuery> begun =
      connection.execute(depth == 0 ? outermost : "SAVEPOINT " + savepoint(depth));
  if (!begun) return fail(begun.error());
  ++connection.transactions_;
  Transaction transaction(connection, depth);
  if (depth == 0 && connection.isOnServer()) SCANTROVE_TRY(connection.execute(kLockOfWriters));
  return Result<Transaction>(std::move(transaction));
}

Transaction::~Transaction() {
  if (connection_ == nullptr) return;
  // After some failures (a full disk) SQLite has already rolled back and reports an error here, which is
  // harmless (sqlite.org/lang_transaction.html).
  if (depth_ == 0) {
    connection_->has_lost_transaction_ = false;
    static_cast<void>(connection_->execute("ROLLBACK"));
  } else if (!connection_->execute("ROLLBACK TO " + savepoint(depth_)) ||
             !connection_->execute("RELEASE " + savepoint(depth_))) {
    // The outer transaction is gone as well; its further statements would be committed one by one.
    connection_->has_lost_transaction_ = true;
  } else {
    connection_->server_.is_aborted = false;
  }
  --connection_->transactions_;
}

Result<void> Transaction::commit() {
  if (connection_->isOnServer()) {
    if (connection_->server_.is_aborted) {
      return fail("The database " + connection_->file() + " has taken back what was being written into it.",
                  "An earlier message names the reason; nothing was changed.");
    }
    if (depth_ == 0 && connection_->is_change_announced_)
      SCANTROVE_TRY(connection_->execute(ServerNotifications::kNotify));
  }
  const Result<QSqlQuery> done =
      connection_->execute(depth_ == 0 ? QString("COMMIT") : "RELEASE " + savepoint(depth_));
  if (!done) return fail(done.error());
  --connection_->transactions_;
  connection_ = nullptr;
  return {};
}

bool Transaction::mayTryAgain(const DatabaseConnection& connection, int tries) {
  if (connection.transactions_ > 0 || !connection.server_.has_conflict || tries >= kMostTries) return false;
  std::this_thread::sleep_for(kFirstPause * tries);
  return true;
}

Result<ReadSnapshot> ReadSnapshot::begin(DatabaseConnection& connection) {
  const Result<QSqlQuery> begun = connection.execute(
      connection.isOnServer() ? "BEGIN ISOLATION LEVEL REPEATABLE READ READ ONLY" : "BEGIN DEFERRED");
  if (!begun) return fail(begun.error());
  ++connection.transactions_;
  return Result<ReadSnapshot>(ReadSnapshot(connection));
}

ReadSnapshot::~ReadSnapshot() {
  if (connection_ == nullptr) return;
  static_cast<void>(connection_->execute("ROLLBACK"));
  --connection_->transactions_;
}

}  // namespace scantrove
