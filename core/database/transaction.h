#pragma once
#include <type_traits>
#include <utility>

#include "core/base/result.h"

namespace scantrove {

class DatabaseConnection;

/// A write transaction: takes the write lock at once (a later upgrade could fail without waiting), rolls back
/// when it is left without commit.
class Transaction {
 public:
  [[nodiscard]] static Result<Transaction> begin(DatabaseConnection& connection);
  Transaction(Transaction&& other) noexcept : connection_(std::exchange(other.connection_, nullptr)) {}
  Transaction& operator=(Transaction&&) = delete;
  ~Transaction();

  [[nodiscard]] Result<void> commit();

 private:
  explicit Transaction(DatabaseConnection& connection) : connection_(&connection) {}
  DatabaseConnection* connection_;
};

/// Runs `work`, which returns a Result, in one transaction: committed when it succeeds, undone when it fails.
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
