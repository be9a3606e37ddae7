#pragma once
#include <QString>
#include <QVariant>

class QSqlDriver;

namespace scantrove {

/// The databases that a catalogue may lie in. The program's statements are plain SQL that both accept. Only
/// schemas differ, by a few words, so one text serves both: see inDialect().
enum class SqlDialect { sqlite, postgresql };

/// A statement of a schema as that database takes it; empty: it has no meaning there. Replaces column types
/// (`id INTEGER PRIMARY KEY` is an automatic id) and `random_uuid()`.
[[nodiscard]] QString inDialect(const QString& statement, SqlDialect dialect);

/// The statement with its `?` replaced by `values`, quoted by the driver. A server then needs one message for
/// a statement, where prepared ones need three.
[[nodiscard]] QString withLiterals(const QString& sql, const QVariantList& values, const QSqlDriver& driver);

}  // namespace scantrove
