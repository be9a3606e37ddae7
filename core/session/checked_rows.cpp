#include "core/session/checked_rows.h"

#include <QSqlError>
#include <QSqlRecord>
#include <array>
#include <cmath>
#include <cstring>
#include <string_view>

#include "core/base/checksum.h"

namespace scantrove::rows {
namespace {

constexpr const char* kCheck = "row_check";
/// Doubles represent all integers up to here. SQLite returns an integer as either type.
constexpr double kWholeNumbers = 9007199254740992.0;

template <class T>
std::uint32_t crcOf(std::uint32_t crc, char kind, const T& value) {
  std::array<char, 1 + sizeof(T)> bytes{kind};
  std::memcpy(bytes.data() + 1, &value, sizeof(T));
  return crc32Of(bytes, crc);
}

std::uint32_t crcOf(std::uint32_t crc, char kind, const QByteArray& bytes) {
  return crc32Of({bytes.constData(), static_cast<std::size_t>(bytes.size())}, crc32Of({&kind, 1}, crc));
}

/// 0 for NULL, 0 and empty values.
std::uint32_t checkOf(std::string_view name, const QVariant& value) {
  if (value.isNull()) return 0;
  const std::uint32_t crc = crc32Of({name.data(), name.size()});
  switch (value.typeId()) {
    case QMetaType::Double:
    case QMetaType::Float: {
      const double number = value.toDouble();
      if (std::isnan(number) || number == 0) return 0;  // SQLite stores a NaN as NULL
      const bool is_complete = std::abs(number) < kWholeNumbers && std::trunc(number) == number;
      return is_complete ? crcOf(crc, 'i', static_cast<std::int64_t>(number)) : crcOf(crc, 'd', number);
    }
    case QMetaType::QByteArray: {
      const QByteArray bytes = value.toByteArray();
      return bytes.isEmpty() ? 0 : crcOf(crc, 'b', bytes);
    }
    case QMetaType::QString: {
      const QByteArray text = value.toString().toUtf8();
      return text.isEmpty() ? 0 : crcOf(crc, 't', text);
    }
    default: {
      const std::int64_t number = value.toLongLong();
      return number == 0 ? 0 : crcOf(crc, 'i', number);
    }
  }
}

}  // namespace

std::uint32_t checkOf(std::span<const Column> columns) {
  std::uint32_t sum = 0;
  for (const Column& column : columns) sum += checkOf(column.name, column.value);
  return sum;
}

Result<void> put(DatabaseConnection& database, const char* table, std::initializer_list<Column> columns) {
  QString names, places;
  QVariantList values;
  for (const Column& column : columns) {
    names += QLatin1String(column.name) + QLatin1String(", ");
    places += QLatin1String("?, ");
    values << column.value;
  }
  values << checkOf(std::span(columns.begin(), columns.size()));
  SCANTROVE_TRY(database.execute(QString("INSERT OR REPLACE INTO %1 (%2%3) VALUES (%4?)")
                                     .arg(QLatin1String(table), names, QLatin1String(kCheck), places),
                                 values));
  return {};
}

Result<void> seal(DatabaseConnection& database, const char* table) {
  SCANTROVE_TRY(database.execute(QString("INSERT OR REPLACE INTO table_sums SELECT '%1', count(*), "
                                         "coalesce(sum(row_check), 0) FROM %1")
                                     .arg(QLatin1String(table))));
  return {};
}

RowAudit::RowAudit(const QSqlQuery& rows) {
  const QSqlRecord record = rows.record();
  for (int i = 0; i < record.count(); ++i) names_.push_back(record.fieldName(i).toUtf8());
  check_column_ = record.indexOf(QLatin1String(kCheck));
}

bool RowAudit::take(const QSqlQuery& row) {
  ++rows_;
  if (check_column_ < 0) return true;
  const QVariant written = row.value(check_column_);
  if (written.isNull()) return true;
  sum_ += written.toLongLong();
  std::uint32_t sum = 0;
  for (int i = 0; i < static_cast<int>(names_.size()); ++i) {
    const QByteArray& name = names_[static_cast<std::size_t>(i)];
    if (i != check_column_)
      sum += checkOf(std::string_view(name.constData(), static_cast<std::size_t>(name.size())), row.value(i));
  }
  const bool is_intact = written.typeId() == QMetaType::LongLong && written.toLongLong() == sum;
  bad_ += is_intact ? 0 : 1;
  return is_intact;
}

Result<std::string> RowAudit::close(DatabaseConnection& database, const char* table, const char* called,
                                    const QSqlQuery& rows) const {
  const std::string of = " of the session in " + database.file();
  if (rows.lastError().isValid()) {
    return "The " + std::string(called) + of + " cannot be read to their end (" +
           rows.lastError().databaseText().toStdString() + ").";
  }
  Result<QSqlQuery> kept = database.execute("SELECT rows, sum FROM table_sums WHERE name = ?", {table});
  if (!kept) return fail(kept.error());
  if (!kept->next()) return std::string();
  const std::int64_t missing = kept->value(0).toLongLong() - rows_;
  if (missing > 0) return std::to_string(missing) + " " + called + of + " are missing.";
  const bool is_changed = missing < 0 || (bad_ == 0 && kept->value(1).toLongLong() != sum_);
  return is_changed ? "The " + std::string(called) + of + " were changed by another program." : std::string();
}

}  // namespace scantrove::rows
