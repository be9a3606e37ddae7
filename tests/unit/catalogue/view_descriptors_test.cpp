#include <gmock/gmock.h>

#include "catalogue_test_support.h"
#include "core/catalogue/view_summary.h"

namespace scantrove::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class ViewDescriptorsTest : public CatalogueTest {
 protected:
  static std::vector<StoredDescriptor> descriptorsOf(ObjectDatabase& database, std::int64_t after = 0) {
    std::vector<StoredDescriptor> found;
    const Result<std::int64_t> last =
        database.views().forEachDescriptor(after, [&](const StoredDescriptor& d) { found.push_back(d); });
    EXPECT_TRUE(last) << last.error().message();
    EXPECT_EQ(*last, found.empty() ? after : found.back().view);
    return found;
  }
  static void expectDescribes(const StoredDescriptor& stored, const ObjectView& view) {
    const std::optional<ViewDescriptor> expected = describeView(view.color, view.mask);
    ASSERT_TRUE(expected && expected->colors);
    EXPECT_EQ(stored.descriptor.thumbnail.fine, expected->thumbnail.fine);
    EXPECT_EQ(stored.descriptor.thumbnail.coarse, expected->thumbnail.coarse);
    EXPECT_EQ(stored.descriptor.thumbnail.mean_lab, expected->thumbnail.mean_lab);
    ASSERT_TRUE(stored.descriptor.colors);
    EXPECT_EQ(stored.descriptor.colors->roots, expected->colors->roots);
    EXPECT_EQ(stored.size_m, view.size_m);
  }
  /// Changes the catalogue's schema back to version 1.
  void downgrade() const {
    forgetClasses(file());
    for (const char* sql : {"DROP TABLE view_vectors",
                            "DROP TABLE identity",
                            "DROP TABLE applied_edits",
                            "DROP TABLE view_summaries",
                            "DROP TABLE descriptors",
                            "DROP TABLE pictures",
                            "ALTER TABLE objects DROP COLUMN best_view",
                            "ALTER TABLE objects DROP COLUMN named_by_person",
                            "ALTER TABLE views DROP COLUMN box_x",
                            "ALTER TABLE views DROP COLUMN box_y",
                            "ALTER TABLE views DROP COLUMN box_width",
                            "ALTER TABLE views DROP COLUMN box_height",
                            "ALTER TABLE views DROP COLUMN frame_width",
                            "ALTER TABLE views DROP COLUMN frame_height",
                            "ALTER TABLE sessions DROP COLUMN fx",
                            "ALTER TABLE sessions DROP COLUMN fy",
                            "ALTER TABLE sessions DROP COLUMN cx",
                            "ALTER TABLE sessions DROP COLUMN cy",
                            "ALTER TABLE sessions DROP COLUMN image_width",
                            "ALTER TABLE sessions DROP COLUMN image_height",
                            "DELETE FROM schema_migrations WHERE version > 1",
                            "PRAGMA user_version = 1"}) {
      askSqlite(file(), sql);
    }
  }
};

TEST_F(ViewDescriptorsTest, AreStored_ForViewsOfVisibleAndDeletedObjects) {
  const auto database = openOrFail(file());
  const ObjectId first = database->addObject(randomView(0))->id;
  const ObjectId second = database->addObject(randomView(1))->id;
  ObjectView more = randomView(2);
  more.object = first;
  more.size_m = {0.7F, 0.6F, 0.5F};
  EXPECT_TRUE(database->addView(more));
  EXPECT_TRUE(database->remove({&second, 1}));  // it may be restored

  const std::vector<StoredDescriptor> all = descriptorsOf(*database);
  ASSERT_EQ(all.size(), 3U);
  expectDescribes(all[0], randomView(0));
  expectDescribes(all[1], randomView(1));
  expectDescribes(all[2], more);
  EXPECT_EQ(all[1].first_object, second);
  EXPECT_EQ(all[2].first_object, first);
  EXPECT_EQ(descriptorsOf(*database, all[1].view).size(), 1U);
}

TEST_F(ViewDescriptorsTest, HaveAPlace_WhenSessionAndCentroidAreKnown) {
  const auto database = openOrFail(file());
  const std::int64_t session = *database->sessions().begin("kitchen");
  ObjectView placed = randomView(0), without_session = randomView(1), without_place = randomView(2);
  placed.session = without_place.session = session;
  placed.centroid_world = without_session.centroid_world = Eigen::Vector3f(1.5F, -0.25F, 3);
  for (const ObjectView* view : {&placed, &without_session, &without_place})
    EXPECT_TRUE(database->addObject(*view));
  const std::vector<StoredDescriptor> all = descriptorsOf(*database);
  ASSERT_EQ(all.size(), 3U);
  ASSERT_TRUE(all[0].place);
  EXPECT_EQ(all[0].place->session, session);
  EXPECT_EQ(all[0].place->centroid_world, Eigen::Vector3f(1.5F, -0.25F, 3));
  EXPECT_FALSE(all[1].place) << "without a session, coordinates have no frame";
  EXPECT_FALSE(all[2].place);
}

TEST_F(ViewDescriptorsTest, KeepTheirFirstObject_WhenItIsMerged) {
  const auto database = openOrFail(file());
  const ObjectId a = database->addObject(randomView(0))->id, b = database->addObject(randomView(1))->id;
  EXPECT_TRUE(database->merge(std::array{a, b}));
  EXPECT_EQ(descriptorsOf(*database)[1].first_object, b);
}

TEST_F(ViewDescriptorsTest, AreTheCallers_WhenGiven) {
  const auto database = openOrFail(file());
  ObjectView view = randomView(0);
  view.descriptor = describeView(randomView(5).color, randomView(5).mask);
  EXPECT_TRUE(database->addObject(view));
  expectDescribes(descriptorsOf(*database)[0], randomView(5));
}

TEST_F(ViewDescriptorsTest, AreComputed_WhenTheCatalogueIsOfVersionOne) {
  {
    const auto database = openOrFail(file());
    for (int i = 0; i < 230; ++i) EXPECT_TRUE(database->addObject(randomView(i)));
    ObjectView larger = randomView(300, {60, 40});
    larger.object = ObjectId{1};
    EXPECT_TRUE(database->addView(larger));
    ObjectView newest = randomView(301);
    newest.object = ObjectId{1};
    EXPECT_TRUE(database->addView(newest));
    EXPECT_TRUE(database->rename(ObjectId{2}, "Obj_1000"));
    EXPECT_TRUE(database->rename(ObjectId{3}, "Obj_3 (2)"));
  }
  downgrade();
  ASSERT_EQ(askSqlite(file(), "SELECT count(*) FROM sqlite_master WHERE name = 'descriptors'"), "0");
  const auto database = openOrFail(file());
  ASSERT_NE(database, nullptr);
  EXPECT_EQ(database->views().picture(ObjectId{2})->size(),
            cv::Size(31, 17));  // the first query after the migration
  const std::vector<StoredDescriptor> all = descriptorsOf(*database);
  ASSERT_EQ(all.size(), 232U);
  EXPECT_FALSE(all[0].place) << "version 1 stored no place";
  for (int i = 0; i < 230; ++i) expectDescribes(all[static_cast<std::size_t>(i)], randomView(i));
  EXPECT_EQ(askSqlite(file(), "SELECT count(*) FROM descriptors"), "232");
  EXPECT_EQ(askSqlite(file(), "SELECT count(*) FROM view_summaries WHERE object_pixels IS NULL"), "0");
  EXPECT_EQ(database->views().picture(ObjectId{1})->size(), cv::Size(60, 40));
  EXPECT_EQ(database->object(ObjectId{1})->named_by, NamedBy::program);
  EXPECT_EQ(database->object(ObjectId{2})->named_by, NamedBy::user);
  EXPECT_EQ(database->object(ObjectId{3})->named_by, NamedBy::program);
  EXPECT_EQ(database->object(ObjectId{1})->size_m, randomView(0).size_m);
  EXPECT_TRUE(database->views().of(ObjectId{1})->front().frame_px.empty()) << "version 1 stored no box";
}

/// Changes the catalogue's schema back to version 7, which had no colours.
void forgetColors(const std::string& file) {
  forgetClasses(file);
  for (const char* sql : {"DROP TABLE view_vectors", "DROP INDEX descriptors_without_colors",
                          "ALTER TABLE descriptors DROP COLUMN colors",
                          "DELETE FROM schema_migrations WHERE version > 7", "PRAGMA user_version = 7"})
    askSqlite(file, sql);
}

TEST_F(ViewDescriptorsTest, GetTheirColors_WhenTheCatalogueIsOfVersionSeven) {
  {
    const auto database = openOrFail(file());
    for (int i = 0; i < 130; ++i) EXPECT_TRUE(database->addObject(randomView(i)));
  }
  forgetColors(file());
  const auto database = openOrFail(file());
  ASSERT_NE(database, nullptr);
  const std::vector<StoredDescriptor> all = descriptorsOf(*database);
  ASSERT_EQ(all.size(), 130U);
  for (int i = 0; i < 130; ++i) expectDescribes(all[static_cast<std::size_t>(i)], randomView(i));
  EXPECT_EQ(askSqlite(file(), "SELECT count(*) FROM descriptors WHERE length(colors) = 605"), "130");
}

TEST_F(ViewDescriptorsTest, HaveNoColors_WhenTheStoredImagesAreUnusable) {
  {
    const auto database = openOrFail(file());
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(database->addObject(randomView(i)));
  }
  forgetColors(file());
  askSqlite(file(), "UPDATE views SET mask = x'00' WHERE id = 2");
  const auto database = openOrFail(file());
  ASSERT_NE(database, nullptr);
  for (int reading = 0; reading < 2; ++reading) {
    const std::vector<StoredDescriptor> all = descriptorsOf(*database);
    ASSERT_EQ(all.size(), 3U) << "the thumbnail remains";
    expectDescribes(all[0], randomView(0));
    EXPECT_FALSE(all[1].descriptor.colors);
    EXPECT_EQ(all[1].descriptor.thumbnail.fine, makeThumbnail(randomView(1).color, randomView(1).mask)->fine);
    expectDescribes(all[2], randomView(2));
  }
  EXPECT_EQ(askSqlite(file(), "SELECT count(*) FROM descriptors WHERE colors IS NULL"), "0")
      << "it is not tried again";
}

TEST_F(ViewDescriptorsTest, KeepTheVectorOfANetwork) {
  const auto database = openOrFail(file());
  ObjectView view = randomView(0);
  view.descriptor = describeView(view.color, view.mask);
  view.descriptor->network = NetworkVector{"a1b2", {0.6F, -0.8F}};
  EXPECT_TRUE(database->addObject(view));
  EXPECT_TRUE(database->addObject(randomView(1)));
  std::vector<StoredDescriptor> all = descriptorsOf(*database);
  ASSERT_EQ(all.size(), 2U);
  ASSERT_TRUE(all[0].descriptor.network);
  EXPECT_EQ(all[0].descriptor.network->network, "a1b2");
  EXPECT_EQ(all[0].descriptor.network->values, (std::vector<float>{0.6F, -0.8F}));
  EXPECT_FALSE(all[1].descriptor.network);
  for (const char* damage : {"vector = x'0102'", "vector = x''", "vector = x'0000C07F'",  // NaN
                             "vector = x'0000004000000040'"}) {                           // length 2.8
    askSqlite(file(), QString("UPDATE view_vectors SET %1").arg(damage));
    all = descriptorsOf(*database);
    ASSERT_EQ(all.size(), 2U);
    EXPECT_FALSE(all[0].descriptor.network) << damage;
  }
}

TEST(ListPicture, IsSmallAndDimsTheBackground) {
  cv::Mat color(400, 800, CV_8UC3, cv::Scalar(200, 200, 200)), mask(400, 800, CV_8UC1, cv::Scalar(0));
  mask(cv::Rect(0, 0, 400, 400)).setTo(255);
  const cv::Mat picture = listPicture(color, mask);
  EXPECT_EQ(picture.size(), cv::Size(128, 64));
  EXPECT_EQ(picture.at<cv::Vec3b>(10, 20), cv::Vec3b(200, 200, 200));
  EXPECT_EQ(picture.at<cv::Vec3b>(10, 100), cv::Vec3b(80, 80, 80));
  EXPECT_EQ(listPicture(color, {}).at<cv::Vec3b>(10, 100), cv::Vec3b(200, 200, 200));
  EXPECT_EQ(listPicture(cv::Mat(1, 1000, CV_8UC3), {}).size(), cv::Size(128, 1));
  EXPECT_EQ(listPicture(color(cv::Rect(0, 0, 20, 10)), {}).size(), cv::Size(20, 10)) << "it is not enlarged";
  EXPECT_TRUE(listPicture({}, mask).empty());
}

}  // namespace
}  // namespace scantrove::test
