// The tests of catalogues on a PostgreSQL server: those of unit/catalogue that are not about files, and those
// of this folder.
#include <gmock/gmock.h>

#include <QCoreApplication>
#include <QSqlDatabase>
#include <iostream>
#include <map>
#include <memory>

#include "server.h"
#include "tests/unit/catalogue/catalogue_test_support.h"

namespace scantrove::test {
namespace {

std::unique_ptr<PrivatePostgresql>& startedServer() {
  static std::unique_ptr<PrivatePostgresql> started;
  return started;
}

/// A database for each test and name.
std::string addressOf(const std::string& name) {
  static std::map<std::string, std::string> addresses;
  std::string& address = addresses[name];
  if (address.empty()) address = server().createDatabase();
  return address;
}

class ServerEnvironment : public ::testing::Environment {
 public:
  void SetUp() override {
    const bool has_driver = QSqlDatabase::isDriverAvailable("QPSQL");
    if (PrivatePostgresql::programs().empty() || !has_driver) {
      std::cerr
          << "\nNOTHING IS TESTED ON A SERVER: install the packages postgresql and libqt6sql6-psql.\n\n";
      GTEST_SKIP() << "PostgreSQL or its driver is not installed.";
    }
    startedServer() = std::make_unique<PrivatePostgresql>();
    server().execute("CREATE ROLE locked LOGIN PASSWORD 'secret'");
    catalogueNamer() = addressOf;
  }
  void TearDown() override { startedServer().reset(); }
};

}  // namespace

PrivatePostgresql& server() { return *startedServer(); }

}  // namespace scantrove::test

int main(int argc, char** argv) {
  const QCoreApplication qt(argc, argv);
  ::testing::InitGoogleMock(&argc, argv);
  // They are about files of SQLite.
  const std::string files =
      "InTransactionTest.*:ReadOnlyCatalogueTest.*:StoredClassesTest.CatalogueOfVersionEight*:"
      "StoredClassesTest.DamagedRows*";
  std::string& filter = ::testing::GTEST_FLAG(filter);
  filter += (filter.find('-') == std::string::npos ? "-" : ":") + files;
  ::testing::AddGlobalTestEnvironment(new scantrove::test::ServerEnvironment);
  return RUN_ALL_TESTS();
}
