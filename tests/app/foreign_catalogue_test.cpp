// A session with another catalogue than its own leaves the objects of that catalogue unchanged.
#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/core.hpp>

#include "core/catalogue/object_database.h"
#include "core/database/database_connection.h"
#include "tests/app/demo_scan.h"
#include "tests/support/qt_main_thread.h"

namespace scantrove::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using testing::HasSubstr;

/// More objects than a scan of the demo finds: each id of the session is also a foreign object's id.
constexpr int kForeignObjects = 40;
constexpr const char* kOtherCatalogue = "is another one than the session";

ObjectView foreignView(int seed) {
  cv::RNG random(static_cast<std::uint64_t>(seed) + 1);
  ObjectView view;
  view.box_px = {20, 20, 40, 30};
  view.frame_px = {640, 480};
  view.color.create(30, 40, CV_8UC3);
  random.fill(view.color, cv::RNG::UNIFORM, 0, 256);
  view.mask = cv::Mat(30, 40, CV_8UC1, cv::Scalar(255));
  view.depth_mm = cv::Mat(30, 40, CV_16UC1, cv::Scalar(1000));
  view.size_m = {0.3F, 0.2F, 0.1F};
  return view;
}

void makeForeignCatalogue(const fs::path& file) {
  const QtMainThread qt;
  const auto database = ObjectDatabase::open(file);
  ASSERT_TRUE(database) << database.error().message();
  for (int i = 1; i <= kForeignObjects; ++i) {
    const auto object = (*database)->addObject(foreignView(i));
    ASSERT_TRUE(object);
    if (i % 2 == 0) continue;  // half of them have no name by a user
    ASSERT_TRUE((*database)->nameByUser(object->id, "foreign " + std::to_string(i)));
  }
}

class ForeignCatalogueTest : public DemoScanTest {
 protected:
  /// A large region without an object.
  static std::string plainRegion(std::size_t index = 0) { return plainRegions().at(index); }
  Json objects() const { return jsonOf(scantrove({"objects", "list", "--database", catalogue_, "--json"})); }
  /// The objects that the foreign catalogue had at first.
  Json foreignObjects() const {
    Json all = objects();
    all.erase(all.begin() + std::min<std::ptrdiff_t>(kForeignObjects, std::ssize(all)), all.end());
    return all;
  }
  /// Puts a foreign catalogue in the place of the session's.
  void replaceCatalogue() {
    moveCatalogueAway();
    makeForeignCatalogue(catalogue_);
  }
  void moveCatalogueAway() {
    for (const char* file : {"catalogue.sqlite", "catalogue.sqlite-wal", "catalogue.sqlite-shm"}) {
      if (fs::exists(scan_ / file)) fs::rename(scan_ / file, folder_ / (std::string("own-") + file));
    }
  }
  void putCatalogueBack() {
    for (const char* file : {"catalogue.sqlite", "catalogue.sqlite-wal", "catalogue.sqlite-shm"}) {
      fs::remove(scan_ / file);
      if (fs::exists(folder_ / (std::string("own-") + file)))
        fs::rename(folder_ / (std::string("own-") + file), scan_ / file);
    }
  }
};

TEST_F(ForeignCatalogueTest, UndoAndRedoChangeNoForeignObject) {
  const std::string one = plainRegion();
  ASSERT_EQ(session({"name", "--region", one, "--name", "mug"}).exit_code, 0);
  ASSERT_FALSE(region(one)["object"].is_null());
  replaceCatalogue();
  const Json before = foreignObjects();
  const Finished undone = session({"undo"});
  EXPECT_EQ(undone.exit_code, 0);
  EXPECT_THAT(undone.err, HasSubstr(kOtherCatalogue));
  EXPECT_EQ(objects(), before);
  EXPECT_EQ(region(one)["name"], "");
  ASSERT_EQ(session({"redo"}).exit_code, 0);
  EXPECT_EQ(foreignObjects(), before);
  EXPECT_EQ(objects().size(), kForeignObjects + 1U) << "the named region becomes a new object";
  EXPECT_EQ(region(one)["object"], objects().back()["id"]);
}

TEST_F(ForeignCatalogueTest, NamingChangesNoForeignObject) {
  const std::string one = plainRegion();
  ASSERT_EQ(session({"name", "--region", one, "--name", "mug"}).exit_code, 0);
  replaceCatalogue();
  const Json before = foreignObjects();
  Json of_other = region(one);
  EXPECT_TRUE(of_other["object"].is_null()) << "the id belongs to the other catalogue";
  EXPECT_EQ(of_other["name"], "mug");
  const Finished named = session({"name", "--region", one, "--name", "red mug"});
  EXPECT_EQ(named.exit_code, 0);
  EXPECT_THAT(named.err, HasSubstr(kOtherCatalogue));
  EXPECT_EQ(foreignObjects(), before);
  EXPECT_EQ(objects().back()["name"], "red mug");
  EXPECT_EQ(session({"regions"}).err, "") << "no warning once the session uses that catalogue";
  ASSERT_EQ(session({"name", "--region", one, "--name", ""}).exit_code, 0);
  ASSERT_EQ(session({"object", one}).exit_code, 0);
  ASSERT_EQ(session({"undo", "--steps", "3"}).exit_code, 0);
  EXPECT_EQ(foreignObjects(), before);
}

TEST_F(ForeignCatalogueTest, JoiningChangesNoForeignObject) {
  const std::string one = plainRegion(0), other = plainRegion(1);
  ASSERT_EQ(session({"name", "--region", one, "--name", "mug"}).exit_code, 0);
  ASSERT_EQ(session({"name", "--region", other, "--name", "handle"}).exit_code, 0);
  replaceCatalogue();
  const Json before = objects();
  ASSERT_EQ(session({"join", one, other}).exit_code, 0);
  ASSERT_EQ(session({"undo"}).exit_code, 0);
  ASSERT_EQ(session({"redo"}).exit_code, 0);
  EXPECT_EQ(objects(), before);
}

TEST_F(ForeignCatalogueTest, ObjectIdsAreValidAgain_WhenTheCatalogueIsRestored) {
  const std::string one = plainRegion(0), other = plainRegion(1);
  ASSERT_EQ(session({"name", "--region", one, "--name", "mug"}).exit_code, 0);
  const Json own = objects(), object = region(one)["object"];
  replaceCatalogue();
  ASSERT_EQ(session({"name", "--region", other, "--name", "box"}).exit_code, 0);
  putCatalogueBack();
  Json restored = regions();
  EXPECT_EQ(restored[one]["object"], object);
  EXPECT_TRUE(restored[other]["object"].is_null());
  EXPECT_EQ(objects(), own);
  ASSERT_EQ(session({"name", "--region", one, "--name", "red mug"}).exit_code, 0);
  EXPECT_EQ(objects().size(), own.size()) << "the same object has another name";
}

TEST_F(ForeignCatalogueTest, ResumingWithAnotherCatalogueChangesNoForeignObject) {
  const std::string one = plainRegion();
  ASSERT_EQ(session({"name", "--region", one, "--name", "mug"}).exit_code, 0);
  const std::string other = folder_ / "other.sqlite";
  makeForeignCatalogue(other);
  const auto foreignObjectsInOther = [&] {
    Json all = jsonOf(scantrove({"objects", "list", "--database", other, "--json"}));
    all.erase(all.begin() + kForeignObjects, all.end());
    return all;
  };
  const Json before = foreignObjectsInOther();
  const Finished run =
      scantrove({"scan", "demo", "--start", "40", "--frames", "20", "--resume", scan_, "--database", other});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr(kOtherCatalogue));
  EXPECT_EQ(foreignObjectsInOther(), before);
  const Json resumed = regions();
  for (const Json& one_region : resumed) {
    if (one_region["object"].is_null()) continue;
    EXPECT_GT(one_region["object"], kForeignObjects) << one_region;
  }
  ASSERT_EQ(session({"undo"}).exit_code, 0);
  EXPECT_EQ(foreignObjectsInOther(), before);
}

TEST_F(ForeignCatalogueTest, UndoDeletesNoNewObject_WhenTheScanResumedWithoutItsCatalogue) {
  const std::string one = plainRegion();
  ASSERT_EQ(session({"name", "--region", one, "--name", "mug"}).exit_code, 0);
  moveCatalogueAway();
  const Finished run = scantrove({"scan", "demo", "--start", "40", "--frames", "40", "--resume", scan_});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr(kOtherCatalogue));
  const Json before_undo = objects();
  ASSERT_EQ(session({"undo"}).exit_code, 0);
  for (const Json& object : before_undo) {
    if (object["name"] == "mug") continue;
    EXPECT_EQ(jsonOf(scantrove({"objects", "show", std::to_string(object["id"].get<int>()), "--database",
                                catalogue_, "--json"}))["name"],
              object["name"]);
  }
}

TEST_F(ForeignCatalogueTest, ExportHasNoForeignObjectIds) {
  const std::string one = plainRegion();
  ASSERT_EQ(session({"name", "--region", one, "--name", "mug"}).exit_code, 0);
  replaceCatalogue();
  const Json before = objects();
  const Finished run = scantrove({"export", scan_, "--format", "masks", "--out", folder_ / "masks"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr(kOtherCatalogue));
  EXPECT_EQ(objects(), before);
  for (const auto& file : fs::recursive_directory_iterator(folder_ / "masks")) {
    if (file.path().extension() != ".json") continue;
    const std::string text = readText(file.path());
    EXPECT_THAT(text, testing::Not(HasSubstr("foreign"))) << file.path();
    EXPECT_THAT(text, testing::Not(testing::ContainsRegex("\"object\": *[0-9]"))) << file.path();
  }
}

TEST_F(ForeignCatalogueTest, SessionOfAnOlderVersionKeepsItsObjectIds_WhenTheCatalogueHasItsScan) {
  const std::string one = plainRegion();
  ASSERT_EQ(session({"name", "--region", one, "--name", "mug"}).exit_code, 0);
  const Json object = region(one)["object"];
  {
    const QtMainThread qt;
    const auto connection = DatabaseConnection::open(scan_ / "session.sqlite");
    ASSERT_TRUE(connection);
    for (const char* sql :
         {"DELETE FROM facts WHERE name = 'catalogue'", "DELETE FROM fact_copies WHERE name = 'catalogue'",
          "INSERT INTO facts (name, value) SELECT 'begun', applied FROM schema_migrations"
          " WHERE version = 1"})
      ASSERT_TRUE((*connection)->execute(sql)) << sql;
  }
  const fs::path older = folder_ / "older";
  fs::copy(scan_, older, fs::copy_options::recursive);
  EXPECT_EQ(region(one)["object"], object);
  fs::remove_all(scan_);
  fs::rename(older, scan_);
  replaceCatalogue();
  EXPECT_TRUE(region(one)["object"].is_null());
}

}  // namespace
}  // namespace scantrove::test
