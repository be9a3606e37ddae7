// Supports that the window proposes as background.
#include <gtest/gtest.h>

#include <QAction>

#include "tests/ui/window/pointing_fixture.h"

namespace scantrove::test {
namespace {

/// Nobody has marked region 5, which things stand on.
class ProposedBackgroundTest : public PointingTest {
 protected:
  void report(bool is_proposed) {
    ScanSnapshot snapshot = twoRegions(5);
    RegionInfos infos = *snapshot.region_infos;
    infos[0].is_proposed_background = is_proposed;  // region 5
    snapshot.region_infos = std::make_shared<const RegionInfos>(std::move(infos));
    worker_->report(std::move(snapshot));
    ASSERT_TRUE(QTest::qWaitFor([&] { return action()->isEnabled() == is_proposed; }, kPatience_ms));
  }
  QAction* action() { return window_->regions().actions().mark_supports; }
};

TEST_F(ProposedBackgroundTest, HoverSaysSo) {
  const QString text = QStringLiteral("looks like background: things stand on it");
  report(true);
  QTest::mouseMove(panel(0), panel(0)->positionOf({0.2, 0.3}).toPoint());
  ASSERT_TRUE(QTest::qWaitFor([&] { return panel(0)->tag().contains(text); }, kPatience_ms));
  QTest::mouseMove(panel(0), panel(0)->positionOf({0.8, 0.3}).toPoint());
  ASSERT_TRUE(QTest::qWaitFor([&] { return selection().hovered() == RegionId{7}; }, kPatience_ms));
  EXPECT_FALSE(panel(0)->tag().contains(text));
}

TEST_F(ProposedBackgroundTest, CtrlBMarksAllSupportsInOneStep) {
  QTest::keyClick(panel(0), Qt::Key_B, Qt::ControlModifier);
  EXPECT_TRUE(worker_->edits.empty()) << "none is proposed";
  report(true);
  panel(0)->setFocus();
  QTest::keyClick(panel(0), Qt::Key_B, Qt::ControlModifier);
  ASSERT_EQ(worker_->edits.size(), 1U);
  EXPECT_EQ(lastOperation()->kind, OperationKind::background);
  EXPECT_TRUE(lastOperation()->on);
  EXPECT_EQ(lastOperation()->regions, std::vector{RegionId{5}});
  EXPECT_EQ(window_->history().stack().undoText(), QStringLiteral("Region 5: background"));
  report(false);
  QTest::keyClick(panel(0), Qt::Key_B, Qt::ControlModifier);
  EXPECT_EQ(worker_->edits.size(), 1U) << "none is left";
}

TEST_F(ProposedBackgroundTest, AutomaticEditIsAnUndoStep) {
  Operation operation;
  operation.kind = OperationKind::background;
  operation.regions = {RegionId{5}, RegionId{7}};
  worker_->report(Edited{operation, operation.regions, true});
  const QUndoStack& stack = window_->history().stack();
  ASSERT_TRUE(QTest::qWaitFor([&] { return stack.canUndo(); }, kPatience_ms));
  EXPECT_EQ(stack.undoText(), QStringLiteral("2 regions: background"));
  EXPECT_TRUE(worker_->edits.empty()) << "it is done already";
  QTest::keyClick(window_.get(), Qt::Key_Z, Qt::ControlModifier);
  ASSERT_EQ(worker_->edits.size(), 1U);
  EXPECT_TRUE(std::holds_alternative<UndoEdit>(worker_->edits[0]));
}

}  // namespace
}  // namespace scantrove::test
