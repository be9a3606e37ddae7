#pragma once
#include <type_traits>
#include <utility>

#include "core/base/result.h"

namespace scantrove {

class DatabaseConnection;

/// A write transaction. Takes the write lock at once, because a later upgrade could fail without waiting;
/// rolls back unless committed. Nested in another one of the same connection it is a savepoint: it rolls back
/// only its own part, and reaches the disk only with the outer commit.
///
/// If a server is lost while it commits, the error does not say whether the change was stored.
class Transaction {
 public:
  [[nodiscard]] static Result<Transaction> begin(DatabaseConnection& connection);
  Transaction(Transaction&& other) noexcept
      : connection_(std::exchange(other.connection_, nullptr)), depth_(other.depth_) {}
  Transaction& operator=(Transaction&&) = delete;
  ~Transaction();

  [[nodiscard]] Result<void> commit();

  /// After a failed outermost transaction: whether it only conflicted with others (a deadlock, or a
  /// serialisation failure), and was tried fewer than six times. Waits a little then.
  [[nodiscard]] static bool mayTryAgain(const DatabaseConnection& connection, int tries);

 private:
  Transaction(DatabaseConnection& connection, int depth) : connection_(&connection), depth_(depth) {}
  DatabaseConnection* connection_;
  int depth_;  // 0: outermost
};

/// Statements on the same connection see the database as it is at their first one, whatever others write
/// meanwhile. A lost connection is an error until the end, so that no statement sees a later state.
class ReadSnapshot {
 public:
  [[nodiscard]] static Result<ReadSnapshot> begin(DatabaseConnection& connection);
  ReadSnapshot(ReadSnapshot&& other) noexcept : connection_(std::exchange(other.connection_, nullptr)) {}
  ReadSnapshot& operator=(ReadSnapshot&&) = delete;
  ~ReadSnapshot();

 private:
  explicit ReadSnapshot(DatabaseConnection& connection) : connection_(&connection) {}
  DatabaseConnection* connection_;
};

/// Runs `work`, which returns a Result, in one transaction: commits on success, rolls back on failure. Runs
/// it again after a conflict with other programs on a server.
template <class Work>
[[nodiscard]] auto inTransaction(DatabaseConnection& connection, Work&& work) -> std::invoke_result_t<Work> {
  using Answer = std::invoke_result_t<Work>;
  const auto once = [&]() -> Answer {
    Result<Transaction> transaction = Transaction::begin(connection);
    if (!transaction) return fail(transaction.error());
    Answer result = work();
    if (!result) return result;
    SCANTROVE_TRY(transaction->commit());
    return result;
  };
  for (int tries = 1;; ++tries) {
    Answer result = once();
    if (result || !Transaction::mayTryAgain(connection, tries)) return result;
  }
}

}  // namespace scantrove
