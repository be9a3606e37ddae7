#include <gmock/gmock.h>

#include "catalogue_test_support.h"
#include "core/catalogue/image_blob.h"
#include "tests/support/captured_log.h"

namespace scantrove::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A catalogue of three objects with one view each, whose rows the tests damage through plain SQL.
class DamagedRowsTest : public CatalogueTest {
 protected:
  void SetUp() override {
    const auto database = openOrFail(file());
    for (int i = 0; i < 3; ++i) ASSERT_TRUE(database->addObject(randomView(i)));
  }

  void setBlob(const std::string& column, const QByteArray& bytes, const std::string& table = "views",
               const std::string& key = "id") const {
    askSqlite(file(), QString::fromStdString("UPDATE " + table + " SET " + column + " = x'") + bytes.toHex() +
                          QString::fromStdString("' WHERE " + key + " = 2"));
  }
  /// Removes all that older versions did not store of view 2.
  void forgetSummary() const {
    askSqlite(file(), "UPDATE view_summaries SET object_pixels = NULL WHERE view = 2");
    askSqlite(file(), "DELETE FROM descriptors WHERE view = 2");
    askSqlite(file(), "DELETE FROM pictures WHERE view = 2");
  }
  static int countDescriptors(ObjectDatabase& database) {
    int count = 0;
    const auto last = database.views().forEachDescriptor(0, [&](const StoredDescriptor&) { ++count; });
    EXPECT_TRUE(last);
    return count;
  }
  /// Every query of views skips view 2 and names it in the log; the others remain.
  void expectSkipped(const std::string& flaw) {
    SCOPED_TRACE(flaw);
    log_.clear();
    forgetSummary();
    const auto database = openOrFail(file());
    ASSERT_NE(database, nullptr);
    const auto views = database->views().of(ObjectId{2});
    ASSERT_TRUE(views);
    EXPECT_TRUE(views->empty());
    EXPECT_THAT(log_.text(), AllOf(HasSubstr("View 2 of object 2"), HasSubstr(file()), HasSubstr(flaw)));
    log_.clear();
    EXPECT_EQ(countDescriptors(*database), 2);
    EXPECT_THAT(log_.text(), AllOf(HasSubstr("View 2 of object 2"), HasSubstr(file()), HasSubstr(flaw)));
    EXPECT_TRUE(database->views().picture(ObjectId{2})->empty());
    EXPECT_EQ(database->views().of(ObjectId{1})->size(), 1U);
    EXPECT_EQ(database->objects()->size(), 3U);
  }

  CapturedLog log_;
};

TEST_F(DamagedRowsTest, SkipsTheView_WhenItsImagesDisagree) {
  setBlob("mask", toPng(cv::Mat(5, 7, CV_8UC1, cv::Scalar(255))));
  expectSkipped("pixels and not");
  setBlob("mask", toPng(cv::Mat(17, 31, CV_16UC1, cv::Scalar(255))));
  expectSkipped("its mask is of another type");
  setBlob("mask", toPng(randomView(1).mask));
  setBlob("color", toPng(cv::Mat(17, 31, CV_8UC1, cv::Scalar(255))));
  expectSkipped("its colour is of another type");
  setBlob("color", toPng(cv::Mat(4, 4, CV_8UC3, cv::Scalar(255))));
  expectSkipped("its colour is 4 x 4 pixels and not 31 x 17");
}

TEST_F(DamagedRowsTest, SkipsTheView_WhenAnImageDoesNotDecode) {
  QByteArray png = toPng(randomView(1).color);
  setBlob("color", QByteArray("not an image"));
  expectSkipped("its colour is not an image");
  setBlob("color", png.first(20));
  expectSkipped("its colour is not an image");
  png.replace(16, 8, QByteArray::fromHex("7fffffff7fffffff"));  // claims 2^62 pixels
  setBlob("color", png);
  expectSkipped("its colour is not an image");
}

TEST_F(DamagedRowsTest, SkipsTheView_WhenDepthOrPoseIsDamaged) {
  const auto database = openOrFail(file());
  setBlob("depth_mm", toPng(cv::Mat(3, 3, CV_16UC1, cv::Scalar(9))));
  EXPECT_TRUE(database->views().of(ObjectId{2})->empty());
  EXPECT_THAT(log_.text(), HasSubstr("its depth is 3 x 3 pixels"));
  setBlob("depth_mm", toPng(randomView(1).depth_mm));
  EXPECT_EQ(database->views().of(ObjectId{2})->size(), 1U);
  for (const char* pose : {"1 2 3", "1 0 0 0 0 1 0 0 0 0 1 x", "1 0 0 0 0 1 0 0 0 0 1 nan", ""}) {
    askSqlite(file(), QString("UPDATE views SET pose = '%1' WHERE id = 2").arg(pose));
    EXPECT_TRUE(database->views().of(ObjectId{2})->empty()) << pose;
    EXPECT_THAT(log_.text(), HasSubstr("its pose is not twelve numbers"));
  }
}

TEST_F(DamagedRowsTest, ReadsTheViewWithoutItsBox_WhenTheBoxIsImpossible) {
  const auto database = openOrFail(file());
  EXPECT_EQ(database->views().of(ObjectId{2})->front().box_px, cv::Rect(1, 20, 40, 30));
  for (const char* damage :
       {"box_x = -1", "box_width = 0", "box_y = 470", "frame_width = 30", "box_width = 2147483647",
        "frame_height = NULL", "box_x = 'left'", "box_width = 100000, frame_width = 200000"}) {
    const QString undamaged = "box_x = 1, box_y = 20, box_width = 40, frame_width = 640, frame_height = 480";
    askSqlite(file(), "UPDATE views SET " + undamaged + " WHERE id = 2");
    askSqlite(file(), QString("UPDATE views SET %1 WHERE id = 2").arg(damage));
    const std::vector<ObjectView> views = *database->views().of(ObjectId{2});
    ASSERT_EQ(views.size(), 1U) << damage << ": the view stays usable";
    const bool is_known = !views.front().frame_px.empty();
    EXPECT_EQ(is_known, std::string(damage) == "box_x = 'left'") << damage;  // SQLite reads text as 0
  }
}

TEST_F(DamagedRowsTest, SkipsTheDescriptor_WhenItIsDamaged) {
  const auto database = openOrFail(file());
  EXPECT_EQ(countDescriptors(*database), 3);
  setBlob("fine", QByteArray("short"), "descriptors", "view");
  EXPECT_EQ(countDescriptors(*database), 2);
  EXPECT_THAT(log_.text(), AllOf(HasSubstr("View 2 of object 2"), HasSubstr("descriptor is damaged")));
  setBlob("fine", QByteArray(3 * 1024, 'x'), "descriptors", "view");
  EXPECT_EQ(countDescriptors(*database), 3);
  askSqlite(file(), "UPDATE descriptors SET mean_l = 9e999 WHERE view = 2");
  EXPECT_EQ(countDescriptors(*database), 2);
  setBlob("jpeg", QByteArray("no picture"), "pictures", "view");
  EXPECT_TRUE(database->views().picture(ObjectId{2})->empty());
}

TEST_F(DamagedRowsTest, RefusesANewView_WhenItsImagesDisagree) {
  const auto database = openOrFail(file());
  ObjectView view = randomView(4);
  view.mask = cv::Mat(5, 7, CV_8UC1, cv::Scalar(255));
  const Result<ObjectRecord> added = database->addObject(view);
  ASSERT_FALSE(added);
  EXPECT_THAT(added.error().message(), AllOf(HasSubstr(file()), HasSubstr("frame 4")));
  view = randomView(4);
  view.object = ObjectId{1};
  view.color.convertTo(view.color, CV_32F);
  EXPECT_FALSE(database->addView(view));
  EXPECT_EQ(database->objects()->size(), 3U);
  EXPECT_EQ(database->object(ObjectId{1})->views, 1);
}

}  // namespace
}  // namespace scantrove::test
