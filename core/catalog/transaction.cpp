#include "core/catalog/transaction.h"

#include "core/base/log.h"
#include "core/catalog/database_connection.h"

namespace scantrove {

Result<Transaction> Transaction::begin(DatabaseConnection& connection) {
  const Result<QSqlQuery> begun = connection.execute("BEGIN IMMEDIATE");
  if (!begun) return fail(begun.error());
  return Transaction(connection);
}

Transaction::~Transaction() {
  if (connection_ == nullptr) return;
  const Result<QSqlQuery> undone = connection_->execute("ROLLBACK");
  if (!undone) spdlog::warn("{}", undone.error().message());
}

Result<void> Transaction::commit() {
  const Result<QSqlQuery> done = connection_->execute("COMMIT");
  if (!done) return fail(done.error());
  connection_ = nullptr;
  return {};
}

}  // namespace scantrove
