// Objects whose regions are no longer what the user confirmed.
#include <gtest/gtest.h>

#include <QComboBox>

#include "tests/ui/window/window_fixture.h"
#include "ui/models/object_filter.h"
#include "ui/panels/object_filter_bar.h"

namespace scantrove::test {
namespace {

constexpr int kChecking_ms = 8000;

class ShapeWatchTest : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    window_->open(QStringLiteral("demo"));
  }

  /// A region of the first object, of so many bricks in a row; each is 4.7 cm wide.
  void showBricks(int bricks, int frame, const PackedColor& color = PackedColor::of(200, 30, 30)) {
    ScanSnapshot snapshot = snapshotOf(frame);
    snapshot.changed_regions = {{FragmentId{1}, RegionId{5}}};
    snapshot.region_infos =
        std::make_shared<const RegionInfos>(RegionInfos{{.region = RegionId{5},
                                                         .voxels = 64LL * bricks + frame % 2 * 20,
                                                         .note = {},
                                                         .object = objects_.front()}});
    for (int b = 0; b < 4; ++b) {
      CloudBrick brick{Eigen::Vector3i(b, 0, 32), static_cast<std::uint64_t>(frame) + 1, {}};
      for (int i = 0; i < 64 && b < bricks; ++i) {
        const Eigen::Vector3f in_brick(Eigen::Vector3i(i % 8, i / 8, 0).cast<float>().array() + 0.5F);
        const Eigen::Vector3f point = (brick.position.cast<float>() * 8 + in_brick) * 3 / 512;
        brick.points.push_back({point.x(), point.y(), point.z(), FragmentId{1}, color, 0, {}});
      }
      snapshot.changed_bricks.push_back(brick);
    }
    worker_->report(std::move(snapshot));
    ASSERT_TRUE(QTest::qWaitFor([&] { return worker_->snapshots().empty(); }, kChecking_ms));
    QTest::qWait(0);
  }
  [[nodiscard]] QString change() {
    return window_->model().indexOf(objects_[0]).data(ObjectListModel::ChangeRole).toString();
  }
  [[nodiscard]] bool becomesChanged() {
    return QTest::qWaitFor([&] { return !change().isEmpty(); }, kChecking_ms);
  }
  void confirmInList() {
    clickOn(objects_[0]);
    QTest::keyClick(list(), Qt::Key_Return);
  }
};

TEST_F(ShapeWatchTest, MarksAnObjectThatBecomesLarger_AndReturnTakesItAsItIs) {
  showBricks(2, 1);
  confirmInList();
  ASSERT_TRUE(stored(objects_[0]).confirmed);
  EXPECT_TRUE(change().isEmpty());
  showBricks(4, 2);
  ASSERT_TRUE(becomesChanged());
  EXPECT_TRUE(change().contains(QStringLiteral("as large as when you confirmed it")))
      << change().toStdString();
  const QString tool_tip = window_->model().indexOf(objects_[0]).data(Qt::ToolTipRole).toString();
  EXPECT_TRUE(tool_tip.contains(change())) << tool_tip.toStdString();

  confirmInList();
  EXPECT_TRUE(change().isEmpty());
  EXPECT_TRUE(stored(objects_[0]).confirmed) << "it confirms again";
  confirmInList();
  EXPECT_FALSE(stored(objects_[0]).confirmed) << "Return unconfirms what has not changed";
}

TEST_F(ShapeWatchTest, SaysThatItIsSmaller_OrHasOtherColors) {
  showBricks(4, 1);
  confirmInList();
  showBricks(1, 2);
  ASSERT_TRUE(becomesChanged());
  EXPECT_TRUE(change().startsWith(QStringLiteral("Only "))) << change().toStdString();
  showBricks(4, 3, PackedColor::of(20, 20, 220));
  ASSERT_TRUE(QTest::qWaitFor([&] { return change().contains(QStringLiteral("colours")); }, kChecking_ms))
      << change().toStdString();
}

TEST_F(ShapeWatchTest, LeavesOthersAlone) {
  showBricks(2, 1);
  showBricks(4, 2);
  confirmInList();
  showBricks(4, 3);
  QTest::qWait(1500);
  EXPECT_TRUE(change().isEmpty()) << "it grew before it was confirmed";
}

TEST_F(ShapeWatchTest, FilterShowsOnlyWhatHasChanged) {
  QComboBox* const entries = window_->parts().objects->filterBar()->shown();
  const int changed = static_cast<int>(ObjectFilter::Shown::changed);
  EXPECT_LT(entries->findData(changed), 0) << "no entry without need";
  showBricks(2, 1);
  confirmInList();
  showBricks(4, 2);
  ASSERT_TRUE(becomesChanged());
  window_->parts().objects->filterBar()->updateEntries();
  const int entry = entries->findData(changed);
  ASSERT_GE(entry, 0);
  entries->setCurrentIndex(entry);
  ASSERT_EQ(list()->model()->rowCount(), 1);
  EXPECT_EQ(list()->filter().objectAt(list()->model()->index(0, 0)), objects_[0]);
}

}  // namespace
}  // namespace scantrove::test
