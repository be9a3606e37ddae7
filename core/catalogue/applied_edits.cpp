// Edits that a session asks for, each carried out once.
#include "core/catalogue/object_database.h"
#include "core/database/database_connection.h"
#include "core/database/transaction.h"

namespace scantrove {

Result<std::string> ObjectDatabase::applyOnce(const std::string& token,
                                              const std::function<Result<std::string>()>& edit) {
  const QString key = QString::fromStdString(token);
  return inTransaction(*connection_, [&]() -> Result<std::string> {
    Result<QSqlQuery> earlier =
        connection_->execute("SELECT result FROM applied_edits WHERE token = ?", {key});
    if (!earlier) return fail(earlier.error());
    if (earlier->next()) return earlier->value(0).toString().toStdString();
    Result<std::string> result = edit();
    if (!result) return result;
    SCANTROVE_TRY(connection_->execute("INSERT INTO applied_edits (token, result, applied) VALUES (?, ?, ?)",
                                       {key, QString::fromStdString(*result), DatabaseConnection::now()}));
    return result;
  });
}

}  // namespace scantrove
