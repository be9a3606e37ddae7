#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <QSqlDatabase>
#include <QSqlQuery>
#include <QStringList>
#include <QVariant>
#include <filesystem>
#include <functional>
#include <opencv2/core.hpp>
#include <string>

#include "core/catalogue/object_database.h"
#include "core/database/server_address.h"

namespace scantrove::test {

/// Where the tests' catalogues lie, by a name that is unique to the test; empty: in files of its folder. The
/// tests of servers set it (unit/catalogue_postgresql).
inline std::function<std::string(const std::string&)>& catalogueNamer() {
  static std::function<std::string(const std::string&)> namer;
  return namer;
}

/// A folder of its own for each test, removed at its end.
class CatalogueTest : public ::testing::Test {
 protected:
  CatalogueTest() {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() / ("scantrove-" + std::to_string(::getpid()) + "-" +
                                                        info->test_suite_name() + "-" + info->name());
    std::filesystem::create_directories(folder_);
  }
  ~CatalogueTest() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  [[nodiscard]] std::string file(const std::string& name = "catalogue.sqlite") const {
    return catalogueNamer() ? catalogueNamer()(folder_ / name) : (folder_ / name).string();
  }

  std::filesystem::path folder_;
};

/// Opens, or fails the test with the message.
inline std::unique_ptr<ObjectDatabase> openOrFail(const std::string& file) {
  Result<std::unique_ptr<ObjectDatabase>> database = ObjectDatabase::open(file);
  if (!database) {
    ADD_FAILURE() << database.error().message();
    return nullptr;
  }
  return std::move(*database);
}

/// A view with noise in every image, different for each seed.
inline ObjectView randomView(int seed, const cv::Size& size = {31, 17}) {
  cv::RNG random(static_cast<std::uint64_t>(seed) + 1);
  ObjectView view;
  view.frame_index = seed;
  view.box_px = {seed, 20, 40, 30};
  view.frame_px = {640, 480};
  view.color.create(size, CV_8UC3);
  random.fill(view.color, cv::RNG::UNIFORM, 0, 256);
  view.mask.create(size, CV_8UC1);
  random.fill(view.mask, cv::RNG::UNIFORM, 0, 2);
  view.mask *= 255;
  view.depth_mm.create(size, CV_16UC1);
  random.fill(view.depth_mm, cv::RNG::UNIFORM, 0, 65536);
  view.T_world_camera = Eigen::Translation3d(0.1 * seed, 1.0 / 3, -2) *
                        Eigen::AngleAxisd(0.3 * seed + 0.1, Eigen::Vector3d(1, 2, 3).normalized());
  view.size_m = {0.3F, 0.2F, 0.1F};
  view.direction = Eigen::Vector3f(1, 0.2F * static_cast<float>(seed), -1).normalized();
  return view;
}

inline bool sameImage(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && (a.empty() || cv::norm(a, b, cv::NORM_INF) == 0);
}

/// One value by a plain connection beside the program's, as text.
inline std::string askPlainly(const QString& driver, const std::string& database_name,
                              const ServerAddress& address, const QStringList& statements) {
  const QString name = "scantrove-test-question";
  QString answer;
  {
    QSqlDatabase database = QSqlDatabase::addDatabase(driver, name);
    database.setDatabaseName(QString::fromStdString(database_name));
    database.setHostName(QString::fromStdString(address.host));
    database.setUserName(QString::fromStdString(address.user));
    for (const QString& sql : database.open() ? statements : QStringList()) {
      QSqlQuery query(database);
      answer = query.exec(sql) && query.next() ? query.value(0).toString() : QString();
    }
  }
  QSqlDatabase::removeDatabase(name);
  return answer.toStdString();
}

inline std::string askSqlite(const std::string& file, const QString& sql) {
  return askPlainly("QSQLITE", file, {}, {sql});
}

/// The same of a catalogue wherever it lies. Foreign keys are not checked, as in SQLite by default.
inline std::string askDatabase(const std::string& database, const QString& sql) {
  if (!isServerAddress(database)) return askSqlite(database, sql);
  const ServerAddress address = *serverAddressFrom(database);
  return askPlainly("QPSQL", address.database, address, {"SET session_replication_role = replica", sql});
}

/// Changes a catalogue's schema back to version 8, which had no classes.
inline void forgetClasses(const std::string& file) {
  for (const char* sql : {"DROP INDEX objects_class", "ALTER TABLE objects DROP COLUMN class",
                          "ALTER TABLE objects DROP COLUMN attributes", "DROP TABLE classes",
                          "DELETE FROM schema_migrations WHERE version > 8", "PRAGMA user_version = 8"})
    askSqlite(file, sql);
}

}  // namespace scantrove::test
