#pragma once
#include <type_traits>
#include <utility>

#include "core/base/result.h"

namespace scantrove {

class DatabaseConnection;

/// A write transaction. Takes the write lock at once, because a later upgrade could fail without waiting;
/// rolls back unless committed. Nested in another one of the same connection it is a savepoint: it rolls back
/// only its own part, and reaches the disk only with the outer commit.
class Transaction {
 public:
  [[nodiscard]] static Result<Transaction> begin(DatabaseConnection& connection);
  Transaction(Transaction&& other) noexcept
      : connection_(std::exchange(other.connection_, nullptr)), depth_(other.depth_) {}
  Transaction& operator=(Transaction&&) = delete;
  ~Transaction();

  [[nodiscard]] Result<void> commit();

 private:
  Transaction(DatabaseConnection& connection, int depth) : connection_(&connection), depth_(depth) {}
  DatabaseConnection* connection_;
  int depth_;  // 0: outermost
};

/// Runs `work`, which returns a Result, in one transaction: commits on success, rolls back on failure.
template <class Work>
[[nodiscard]] auto inTransaction(DatabaseConnection& connection, Work&& work) -> std::invoke_result_t<Work> {
  Result<Transaction> transaction = Transaction::begin(connection);
  if (!transaction) return fail(transaction.error());
  std::invoke_result_t<Work> result = std::forward<Work>(work)();
  if (!result) return result;
  SCANTROVE_TRY(transaction->commit());
  return result;
}

}  // namespace scantrove
