// Names of regions in the 3D view and in the pictures, and one selection of regions and objects.
#include <gmock/gmock.h>

#include <QAction>

#include "tests/ui/window/pointing_fixture.h"
#include "ui/main_window/scene_names.h"
#include "ui/panels/color_panel.h"
#include "ui/panels/regions_in_picture.h"
#include "ui/panels/scene_overlay.h"

namespace scantrove::test {
namespace {

using testing::IsEmpty;

class ShownNamesTest : public PointingTest {
 protected:
  QStringList namesIn3d() {
    QStringList names;
    for (const SceneOverlay::Name& name : window_->parts().scene->overlay()->names()) names << name.name;
    return names;
  }
  QStringList namesInColor() {
    QStringList names;
    for (const auto& region : window_->parts().frames->colorPanel()->regionNames()) names << region.name;
    return names;
  }
  /// As after a user named region 5 in a paused scan.
  void reportNamed() {
    ScanSnapshot snapshot = twoRegions(4);
    RegionInfos infos = *snapshot.region_infos;
    infos[0].note.name = "table";
    snapshot.region_infos = std::make_shared<const RegionInfos>(std::move(infos));
    worker_->report(std::move(snapshot));
  }
};

TEST_F(ShownNamesTest, AppearWithTheNaming) {
  view()->fitAll();
  ASSERT_TRUE(QTest::qWaitFor([&] { return namesIn3d() == QStringList{"red cup"}; }, kPatience_ms));
  EXPECT_EQ(namesInColor(), QStringList{"red cup"});
  reportNamed();
  EXPECT_TRUE(QTest::qWaitFor([&] { return namesIn3d().contains(QStringLiteral("table")); }, kPatience_ms));
  EXPECT_TRUE(namesInColor().contains(QStringLiteral("table")));
}

TEST_F(ShownNamesTest, StandOnTheirRegion) {
  view()->fitAll();
  ASSERT_TRUE(QTest::qWaitFor([&] { return !namesIn3d().isEmpty(); }, kPatience_ms));
  const QPointF at = window_->parts().scene->overlay()->names().front().at;
  EXPECT_EQ(view()->at(at).region, RegionId{7});
}

TEST_F(ShownNamesTest, ShiftNHidesThemIn3d) {
  view()->fitAll();
  ASSERT_TRUE(QTest::qWaitFor([&] { return !namesIn3d().isEmpty(); }, kPatience_ms));
  QTest::keyClick(window_.get(), Qt::Key_N, Qt::ShiftModifier);
  EXPECT_FALSE(window_->parts().names->action()->isChecked());
  EXPECT_THAT(namesIn3d(), IsEmpty());
  restart();
  EXPECT_FALSE(window_->parts().names->action()->isChecked()) << "it is remembered";
}

TEST_F(ShownNamesTest, KnownObjectHasOneNameInThePicture) {
  ScanSnapshot snapshot = twoRegions(5);
  SeenObject seen;
  seen.object = objects_[0];
  seen.regions = RegionSet{RegionId{7}};
  seen.box = {0.5F, 0.1F, 0.4F, 0.5F};
  snapshot.objects = {seen};
  worker_->report(std::move(snapshot));
  EXPECT_TRUE(QTest::qWaitFor([&] { return namesInColor().isEmpty(); }, kPatience_ms));
}

class OneSelectionTest : public PointingTest {
 protected:
  void SetUp() override {
    PointingTest::SetUp();
    ScanSnapshot snapshot = twoRegions(5);
    RegionInfos infos = *snapshot.region_infos;
    infos[1].object = objects_[1];  // region 7
    infos[1].label = RegionLabel{.name = "Obj_2", .category = "cup", .object = objects_[1]};
    snapshot.region_infos = std::make_shared<const RegionInfos>(std::move(infos));
    worker_->report(std::move(snapshot));
    ASSERT_TRUE(QTest::qWaitFor([&] { return bool(selection().info(RegionId{7})->object); }, kPatience_ms));
  }
};

TEST_F(OneSelectionTest, ClickOnARegionSelectsItsObject) {
  clickPicture(0, 0.8);
  EXPECT_EQ(list()->selection(), std::vector{objects_[1]});
  clickPicture(0, 0.2);
  EXPECT_TRUE(list()->selection().empty()) << "region 5 is no object";
  EXPECT_EQ(selection().selected(), std::vector{RegionId{5}});
}

TEST_F(OneSelectionTest, ObjectInTheListSelectsItsRegion) {
  clickOn(objects_[1]);
  EXPECT_EQ(selection().selected(), std::vector{RegionId{7}});
  clickOn(objects_[0]);
  EXPECT_TRUE(selection().selected().empty()) << "it is not in this scan";
  EXPECT_EQ(list()->selection(), std::vector{objects_[0]});
}

TEST_F(OneSelectionTest, HoverBoxNamesObjectAndClass) {
  // No event comes if the pointer is there already.
  QTest::mouseMove(panel(0), panel(0)->positionOf({0.2, 0.6}).toPoint());
  QTest::mouseMove(panel(0), panel(0)->positionOf({0.8, 0.3}).toPoint());
  ASSERT_TRUE(QTest::qWaitFor([&] { return panel(0)->tag().size() > 1; }, kPatience_ms));
  EXPECT_TRUE(panel(0)->tag().value(1).contains(QStringLiteral("object Obj_2")));
  EXPECT_TRUE(panel(0)->tag().value(1).contains(QStringLiteral("class cup")));
}

TEST(RegionsInPicture, AnchorIsAPixelOfTheRegion_NearestToItsCenter) {
  // A ring has its centre outside of itself.
  cv::Mat ids(21, 31, CV_32SC1, cv::Scalar(0));
  ids(cv::Rect(5, 5, 11, 11)).setTo(4);
  ids(cv::Rect(7, 7, 7, 7)).setTo(9);
  const auto found = regionsInPicture(ids, {RegionId{4}, RegionId{9}, RegionId{6}}, 1);
  ASSERT_EQ(found.size(), 2U) << "region 6 is not there";
  EXPECT_EQ(found.at(RegionId{9}).anchor_px, cv::Point(10, 10));
  EXPECT_EQ(ids.at<int>(found.at(RegionId{4}).anchor_px), 4);
  EXPECT_EQ(found.at(RegionId{4}).box_px, cv::Rect(5, 5, 11, 11));
  EXPECT_EQ(found.at(RegionId{4}).pixels, 11 * 11 - 7 * 7);
  EXPECT_TRUE(regionsInPicture(ids, {RegionId{4}}, 1000).empty()) << "too small";
}

}  // namespace
}  // namespace scantrove::test
