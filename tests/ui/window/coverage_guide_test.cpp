// The guide in the window to sides of an object that were not seen.
#include <gtest/gtest.h>

#include <QAction>

#include "tests/ui/window/window_fixture.h"
#include "ui/main_window/coverage_guide.h"
#include "ui/main_window/region_controller.h"
#include "ui/main_window/scan_controller.h"
#include "ui/main_window/scene_pane.h"
#include "ui/panels/scene_overlay.h"

namespace scantrove::test {
namespace {

constexpr RegionId kRegion{5};

/// A region of 5 cm, 1.5 m before a level camera at the origin (y down) that looks along +z.
class CoverageGuideTest : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    window_->open(QStringLiteral("demo"));
    fromInFront_.addDirection({0, 0, -1});
  }

  ScanSnapshot regionSeen(int frame, const ViewCoverage& from, const RegionNote& note = {}) {
    ScanSnapshot snapshot = snapshotOf(frame);
    snapshot.changed_regions = {{FragmentId{1}, kRegion}};
    snapshot.region_infos = std::make_shared<const RegionInfos>(RegionInfos{
        {.region = kRegion, .voxels = 4000, .note = note, .object = objects_.front(), .seen_from = from}});
    CloudBrick brick{Eigen::Vector3i(0, 0, 32), static_cast<std::uint64_t>(frame) + 1, {}};
    for (int i = 0; i < 64; ++i) {
      const Eigen::Vector3f in_brick(Eigen::Vector3i(i % 8, i / 8, 0).cast<float>().array() + 0.5F);
      const Eigen::Vector3f point = (brick.position.cast<float>() * 8 + in_brick) * 3 / 512;
      brick.points.push_back({point.x(), point.y(), point.z(), FragmentId{1}, {}, 0, {}});
    }
    snapshot.changed_bricks.push_back(brick);
    return snapshot;
  }

  void show(ScanSnapshot snapshot) {
    worker_->report(std::move(snapshot));
    ASSERT_TRUE(QTest::qWaitFor([&] { return worker_->snapshots().empty(); }, 4000));
  }

  CoverageGuide& guide() { return window_->guide(); }
  SceneOverlay* overlay() { return window_->parts().scene->overlay(); }

  ViewCoverage fromInFront_;
};

ViewCoverage fromAllAround() {
  ViewCoverage coverage;
  for (int i = 0; i < 36; ++i) {
    const float angle = static_cast<float>(i) * 0.1745F;
    coverage.addDirection({std::cos(angle), -0.4F, std::sin(angle)});  // y is down
  }
  return coverage;
}

TEST_F(CoverageGuideTest, NeedsNoSelection_WhenOneObjectIsScanned) {
  window_->controller().open(QStringLiteral("demo:turntable"), {}, ScanRequest::Poses::automatic,
                             ObjectChoice{});
  EXPECT_TRUE(worker_->last_request.object);
  show(regionSeen(1, fromInFront_));
  ASSERT_TRUE(guide().shown());
  ASSERT_TRUE(guide().targetDirection());
  EXPECT_FALSE(fromInFront_.covers(*guide().targetDirection()));
  window_->open(QStringLiteral("demo"));
  EXPECT_FALSE(worker_->last_request.object);
  show(regionSeen(2, fromInFront_));
  EXPECT_FALSE(guide().shown()) << "nothing is selected";
}

TEST_F(CoverageGuideTest, ArrowPointsToAnUnseenSide) {
  show(regionSeen(1, fromInFront_));
  EXPECT_FALSE(guide().shown());
  window_->regions().selection().select(kRegion);
  ASSERT_TRUE(guide().shown());
  EXPECT_GE(guide().shown()->count(), 1);
  EXPECT_LE(guide().shown()->count(), 3);  // covered by one view
  ASSERT_TRUE(guide().targetDirection());
  EXPECT_FALSE(fromInFront_.covers(*guide().targetDirection()));
  EXPECT_LT(guide().targetDirection()->y(), 0);  // from above, not from below
}

TEST_F(CoverageGuideTest, ArrowHasALabelInThePicture) {
  show(regionSeen(1, fromInFront_));
  window_->regions().selection().select(kRegion);
  window_->parts().scene->view()->scene().viewpoint().lookAt({0, -2, -3}, {0, 0, 1.5F});
  window_->parts().scene->view()->drawing().redraw();
  ASSERT_TRUE(QTest::qWaitFor([&] { return overlay()->mark().has_value(); }, 4000));
  EXPECT_TRUE(QRectF(overlay()->rect()).contains(*overlay()->mark()));
  window_->regions().selection().select(RegionId{});
  EXPECT_FALSE(overlay()->mark());
}

TEST_F(CoverageGuideTest, HasNoArrow_WhenAllSidesWereSeen) {
  show(regionSeen(1, fromAllAround()));
  window_->regions().selection().select(kRegion);
  ASSERT_TRUE(guide().shown());
  EXPECT_TRUE(guide().shown()->isComplete());
  EXPECT_FALSE(guide().targetDirection());
}

TEST_F(CoverageGuideTest, CountsNewViews_WhileTheRegionIsSelected) {
  show(regionSeen(1, fromInFront_));
  window_->regions().selection().select(kRegion);
  const int before = guide().shown()->count();
  ViewCoverage more = fromInFront_;
  more.addDirection({1, 0, 0});
  show(regionSeen(2, more));
  EXPECT_GT(guide().shown()->count(), before);
}

TEST_F(CoverageGuideTest, ShowsNothing_ForBackground) {
  RegionNote wall;
  wall.background = true;
  show(regionSeen(1, fromInFront_, wall));
  window_->regions().selection().select(kRegion);
  EXPECT_FALSE(guide().shown());
  EXPECT_FALSE(guide().targetDirection());
}

TEST_F(CoverageGuideTest, ArrowCanBeSwitchedOff_AndThatIsRemembered) {
  show(regionSeen(1, fromInFront_));
  window_->regions().selection().select(kRegion);
  ASSERT_TRUE(guide().targetDirection());
  guide().action()->trigger();
  EXPECT_FALSE(guide().targetDirection());
  EXPECT_TRUE(guide().shown()) << "the ring stays";
  EXPECT_FALSE(QSettings().value(QStringLiteral("view/guide")).toBool());
  guide().action()->trigger();
  EXPECT_TRUE(guide().targetDirection());
}

TEST_F(CoverageGuideTest, ListShowsRings_ForObjectsOfTheScan) {
  show(regionSeen(1, fromAllAround()));
  const QVariant seen = rowOf(objects_[0]).data(ObjectListModel::SeenSidesRole);
  ASSERT_TRUE(seen.isValid());
  EXPECT_TRUE(seen.value<SeenSides>().isComplete());
  EXPECT_FALSE(rowOf(objects_[1]).data(ObjectListModel::SeenSidesRole).isValid());
}

}  // namespace
}  // namespace scantrove::test
