#include "core/database/transaction.h"

#include "core/database/database_connection.h"

namespace scantrove {

Result<Transaction> Transaction::begin(DatabaseConnection& connection) {
  const Result<QSqlQuery> begun = connection.execute("BEGIN IMMEDIATE");
  if (!begun) return fail(begun.error());
  return Transaction(connection);
}

Transaction::~Transaction() {
  if (connection_ == nullptr) return;
  // After some failures (a full disk) SQLite has rolled back already and says here that it cannot; nothing is
  // wrong then (sqlite.org/lang_transaction.html).
  static_cast<void>(connection_->execute("ROLLBACK"));
}

Result<void> Transaction::commit() {
  const Result<QSqlQuery> done = connection_->execute("COMMIT");
  if (!done) return fail(done.error());
  connection_ = nullptr;
  return {};
}

}  // namespace scantrove
