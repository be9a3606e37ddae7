// The steps of a reopened scan have the words that they had when they were made.
#include "tests/ui/window/pointing_fixture.h"
#include "ui/models/undo_history.h"

namespace scantrove::test {
namespace {

using HistoryTitlesTest = PointingTest;

TEST_F(HistoryTitlesTest, SaysWhatARegionWasCalledThen) {
  restart();
  window_->open(QStringLiteral("demo"));
  ScanSnapshot snapshot = twoRegions(4);
  DoneOperation name, join, rename, other;
  name.regions = join.regions = rename.regions = {RegionId{7}};
  name.name = "box";
  join.kind = OperationKind::join;
  rename.name = "red cup";
  other.kind = OperationKind::background;
  other.regions = {RegionId{5}};
  snapshot.operations = std::make_shared<const std::vector<DoneOperation>>(
      std::vector<DoneOperation>{name, join, rename, join, other});
  worker_->report(std::move(snapshot));
  const QUndoStack& stack = window_->history().stack();
  ASSERT_TRUE(QTest::qWaitFor([&] { return stack.count() == 5; }, kPatience_ms));
  EXPECT_EQ(stack.text(0), QStringLiteral("Name Region 7 “box”"));
  EXPECT_EQ(stack.text(1), QStringLiteral("Join box"));
  EXPECT_EQ(stack.text(2), QStringLiteral("Name box “red cup”"));
  EXPECT_EQ(stack.text(3), QStringLiteral("Join red cup"));
  EXPECT_EQ(stack.text(4), QStringLiteral("Region 5: background"));
}

}  // namespace
}  // namespace scantrove::test
