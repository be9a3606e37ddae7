// A session meets another catalogue than the one that it was made with: nothing of that one is touched.
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

/// More than a scan of the demo finds: each of its numbers is a stranger's there.
constexpr int kStrangers = 40;
constexpr const char* kSentence = "is another one than the session";

ObjectView strangersView(int seed) {
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
  for (int i = 1; i <= kStrangers; ++i) {
    const auto object = (*database)->addObject(strangersView(i));
    ASSERT_TRUE(object);
    if (i % 2 == 0) continue;  // some that nobody has named
    ASSERT_TRUE((*database)->nameByUser(object->id, "stranger " + std::to_string(i)));
  }
}

class ForeignCatalogue : public DemoScanTest {
 protected:
  /// A large region without an object.
  [[nodiscard]] std::string plainRegion(std::size_t place = 0) const { return plainRegions().at(place); }
  Json objects() const { return jsonOf(scantrove({"objects", "list", "--database", catalogue_, "--json"})); }
  /// The first objects of the catalogue: those that were there before.
  Json strangers() const {
    Json all = objects();
    all.erase(all.begin() + std::min<std::ptrdiff_t>(kStrangers, std::ssize(all)), all.end());
    return all;
  }
  /// Another catalogue lies where that of the session lay.
  void replaceCatalogue() {
    takeCatalogueAway();
    makeForeignCatalogue(catalogue_);
  }
  void takeCatalogueAway() {
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

TEST_F(ForeignCatalogue, UndoAndRedoTouchNoStranger) {
  const std::string one = plainRegion();
  ASSERT_EQ(tell({"name", "--region", one, "--name", "mug"}).exit_code, 0);
  ASSERT_FALSE(region(one)["object"].is_null());
  replaceCatalogue();
  const Json before = strangers();
  const Finished undone = tell({"undo"});
  EXPECT_EQ(undone.exit_code, 0);
  EXPECT_THAT(undone.err, HasSubstr(kSentence));
  EXPECT_EQ(objects(), before);
  EXPECT_EQ(region(one)["name"], "");
  ASSERT_EQ(tell({"redo"}).exit_code, 0);
  EXPECT_EQ(strangers(), before);
  EXPECT_EQ(objects().size(), kStrangers + 1U) << "what is named there is an object of its own";
  EXPECT_EQ(region(one)["object"], objects().back()["id"]);
}

TEST_F(ForeignCatalogue, NamingTouchesNoStranger) {
  const std::string one = plainRegion();
  ASSERT_EQ(tell({"name", "--region", one, "--name", "mug"}).exit_code, 0);
  replaceCatalogue();
  const Json before = strangers();
  EXPECT_TRUE(region(one)["object"].is_null()) << "its number is not believed";
  EXPECT_EQ(region(one)["name"], "mug");
  const Finished named = tell({"name", "--region", one, "--name", "red mug"});
  EXPECT_EQ(named.exit_code, 0);
  EXPECT_THAT(named.err, HasSubstr(kSentence));
  EXPECT_EQ(strangers(), before);
  EXPECT_EQ(objects().back()["name"], "red mug");
  EXPECT_EQ(tell({"regions"}).err, "") << "said until the session knows that catalogue";
  ASSERT_EQ(tell({"name", "--region", one, "--name", ""}).exit_code, 0);
  ASSERT_EQ(tell({"object", one}).exit_code, 0);
  ASSERT_EQ(tell({"undo", "--steps", "3"}).exit_code, 0);
  EXPECT_EQ(strangers(), before);
}

TEST_F(ForeignCatalogue, JoiningTouchesNoStranger) {
  const std::string one = plainRegion(0), other = plainRegion(1);
  ASSERT_EQ(tell({"name", "--region", one, "--name", "mug"}).exit_code, 0);
  ASSERT_EQ(tell({"name", "--region", other, "--name", "handle"}).exit_code, 0);
  replaceCatalogue();
  const Json before = objects();
  ASSERT_EQ(tell({"join", one, other}).exit_code, 0);
  ASSERT_EQ(tell({"undo"}).exit_code, 0);
  ASSERT_EQ(tell({"redo"}).exit_code, 0);
  EXPECT_EQ(objects(), before);
}

TEST_F(ForeignCatalogue, NumbersHoldAgain_WhenTheCatalogueIsPutBack) {
  const std::string one = plainRegion(0), other = plainRegion(1);
  ASSERT_EQ(tell({"name", "--region", one, "--name", "mug"}).exit_code, 0);
  const Json own = objects(), object = region(one)["object"];
  replaceCatalogue();
  ASSERT_EQ(tell({"name", "--region", other, "--name", "box"}).exit_code, 0);
  putCatalogueBack();
  EXPECT_EQ(region(one)["object"], object);
  EXPECT_TRUE(region(other)["object"].is_null());
  EXPECT_EQ(objects(), own);
  ASSERT_EQ(tell({"name", "--region", one, "--name", "red mug"}).exit_code, 0);
  EXPECT_EQ(objects().size(), own.size()) << "the object has another name, and is the same";
}

TEST_F(ForeignCatalogue, GoingOnWithAnotherOneTouchesNoStranger) {
  const std::string one = plainRegion();
  ASSERT_EQ(tell({"name", "--region", one, "--name", "mug"}).exit_code, 0);
  const std::string other = folder_ / "other.sqlite";
  makeForeignCatalogue(other);
  const auto strangersThere = [&] {
    Json all = jsonOf(scantrove({"objects", "list", "--database", other, "--json"}));
    all.erase(all.begin() + kStrangers, all.end());
    return all;
  };
  const Json before = strangersThere();
  const Finished run =
      scantrove({"scan", "demo", "--start", "40", "--frames", "20", "--resume", scan_, "--database", other});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr(kSentence));
  EXPECT_EQ(strangersThere(), before);
  for (const Json& one_region : regions()) {
    if (one_region["object"].is_null()) continue;
    EXPECT_GT(one_region["object"], kStrangers) << one_region;
  }
  ASSERT_EQ(tell({"undo"}).exit_code, 0);
  EXPECT_EQ(strangersThere(), before);
}

TEST_F(ForeignCatalogue, GoingOnAfterItWasDeletedDeletesNothingNew) {
  const std::string one = plainRegion();
  ASSERT_EQ(tell({"name", "--region", one, "--name", "mug"}).exit_code, 0);
  takeCatalogueAway();
  const Finished run = scantrove({"scan", "demo", "--start", "40", "--frames", "40", "--resume", scan_});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr(kSentence));
  Json unnamed = objects();
  ASSERT_EQ(tell({"undo"}).exit_code, 0);
  for (const Json& object : unnamed) {
    if (object["name"] == "mug") continue;
    EXPECT_EQ(jsonOf(scantrove({"objects", "show", std::to_string(object["id"].get<int>()), "--database",
                                catalogue_, "--json"}))["name"],
              object["name"]);
  }
}

TEST_F(ForeignCatalogue, NumbersOfAnotherOneAreNotExported) {
  const std::string one = plainRegion();
  ASSERT_EQ(tell({"name", "--region", one, "--name", "mug"}).exit_code, 0);
  replaceCatalogue();
  const Json before = objects();
  const Finished run = scantrove({"export", scan_, "--format", "masks", "--out", folder_ / "masks"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr(kSentence));
  EXPECT_EQ(objects(), before);
  for (const auto& file : fs::recursive_directory_iterator(folder_ / "masks")) {
    if (file.path().extension() != ".json") continue;
    const std::string text = readText(file.path());
    EXPECT_THAT(text, testing::Not(HasSubstr("stranger"))) << file.path();
    EXPECT_THAT(text, testing::Not(testing::ContainsRegex("\"object\": *[0-9]"))) << file.path();
  }
}

TEST_F(ForeignCatalogue, AnOlderSessionKeepsItsNumbers_WhereTheCatalogueHasItsScan) {
  const std::string one = plainRegion();
  ASSERT_EQ(tell({"name", "--region", one, "--name", "mug"}).exit_code, 0);
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
