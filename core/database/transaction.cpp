#include "core/database/transaction.h"

#include <string>

#include "core/database/database_connection.h"

namespace scantrove {
namespace {

QString savepoint(int depth) { return QString("part_%1").arg(depth); }

}  // namespace

Result<Transaction> Transaction::begin(DatabaseConnection& connection) {
  const int depth = connection.transactions_;
  const Result<QSqlQuery> begun =
      connection.execute(depth == 0 ? QString("BEGIN IMMEDIATE") : "SAVEPOINT " + savepoint(depth));
  if (!begun) return fail(begun.error());
  ++connection.transactions_;
  return Transaction(connection, depth);
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
  }
  --connection_->transactions_;
}

Result<void> Transaction::commit() {
  const Result<QSqlQuery> done =
      connection_->execute(depth_ == 0 ? QString("COMMIT") : "RELEASE " + savepoint(depth_));
  if (!done) return fail(done.error());
  --connection_->transactions_;
  connection_ = nullptr;
  return {};
}

}  // namespace scantrove
