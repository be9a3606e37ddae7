#pragma once
#include <QByteArray>
#include <QSqlQuery>
#include <QString>
#include <QVariant>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/database/database_connection.h"

/// Rows with a checksum in their column `row_check`, and tables that know how many rows they have. Both are
/// for damage by disks and other programs, not against intent. Rows of earlier versions have no checksum
/// (NULL).
namespace scantrove::rows {

struct Column {
  const char* name;
  QVariant value;
};

/// Of the columns by name, in any order. What is NULL, 0 or empty does not count: a later version may add a
/// column with such a default, and the checksums stay right.
[[nodiscard]] std::uint32_t checkOf(std::span<const Column> columns);

/// Inserts the row, or replaces the one with its key, with its checksum. In a transaction, seal() follows.
[[nodiscard]] Result<void> put(DatabaseConnection& database, const char* table,
                               std::initializer_list<Column> columns);

/// Keeps how many rows the table has by now, and the sum of their checksums. In a transaction.
[[nodiscard]] Result<void> seal(DatabaseConnection& database, const char* table);

/// Compares rows that are read with their checksums, and all of them with what seal() kept.
class RowAudit {
 public:
  /// `rows`: a query that selects `row_check` and all columns that it was made of.
  explicit RowAudit(const QSqlQuery& rows);

  /// False: the row is not the one that was written. Counts it.
  [[nodiscard]] bool take(const QSqlQuery& row);
  /// What is to be said of `table` after its last row, a sentence; empty: it is whole, or of an earlier
  /// version. `called`: "frames".
  [[nodiscard]] Result<std::string> close(DatabaseConnection& database, const char* table, const char* called,
                                          const QSqlQuery& rows) const;

 private:
  std::vector<QByteArray> names_;
  int check_column_ = -1;
  std::int64_t rows_ = 0, sum_ = 0, bad_ = 0;
};

}  // namespace scantrove::rows
