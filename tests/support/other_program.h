#pragma once
#include <gtest/gtest.h>

#include <QSqlDatabase>
#include <QSqlQuery>
#include <QString>
#include <QVariant>
#include <string>

namespace scantrove::test {

/// Another program that has the database open. One at a time.
class OtherProgram {
 public:
  explicit OtherProgram(const std::string& file) {
    database_ = QSqlDatabase::addDatabase("QSQLITE", "other program");
    database_.setDatabaseName(QString::fromStdString(file));
    EXPECT_TRUE(database_.open());
  }
  ~OtherProgram() {
    database_ = {};
    QSqlDatabase::removeDatabase("other program");
  }
  OtherProgram(const OtherProgram&) = delete;
  OtherProgram& operator=(const OtherProgram&) = delete;

  void execute(const QString& sql) { EXPECT_TRUE(QSqlQuery(database_).exec(sql)) << sql.toStdString(); }
  /// The first value of the result; empty: none.
  std::string ask(const QString& sql) {
    QSqlQuery query(database_);
    EXPECT_TRUE(query.exec(sql)) << sql.toStdString();
    return query.next() ? query.value(0).toString().toStdString() : std::string();
  }

 private:
  QSqlDatabase database_;
};

}  // namespace scantrove::test
