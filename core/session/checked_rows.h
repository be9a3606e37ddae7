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

/// Rows with a checksum in their column `row_check`, and tables with a stored row count. They detect damage
/// by disks and other programs, not by intent. Rows of earlier versions have no checksum (NULL).
namespace scantrove::rows {

struct Column {
  const char* name;
  QVariant value;
};

/// Checksum of the columns by name, in any order. NULL, 0 and empty values do not count, so a later version
/// may add a column with such a default.
[[nodiscard]] std::uint32_t checkOf(std::span<const Column> columns);

/// Inserts or replaces the row with its checksum. In a transaction; seal() follows.
[[nodiscard]] Result<void> put(DatabaseConnection& database, const char* table,
                               std::initializer_list<Column> columns);

/// Stores the table's current row count and the sum of its checksums. In a transaction.
[[nodiscard]] Result<void> seal(DatabaseConnection& database, const char* table);

/// Compares rows with their checksums, and all of them with the values of seal().
class RowAudit {
 public:
  /// `rows`: a query that selects `row_check` and all columns of the checksum.
  explicit RowAudit(const QSqlQuery& rows);

  /// False: the row differs from the stored one. Counts it.
  [[nodiscard]] bool take(const QSqlQuery& row);
  /// A sentence about `table` after its last row; empty: it is complete, or of an earlier version.
  /// `called`: "frames".
  [[nodiscard]] Result<std::string> close(DatabaseConnection& database, const char* table, const char* called,
                                          const QSqlQuery& rows) const;

 private:
  std::vector<QByteArray> names_;
  int check_column_ = -1;
  std::int64_t rows_ = 0, sum_ = 0, bad_ = 0;
};

}  // namespace scantrove::rows
