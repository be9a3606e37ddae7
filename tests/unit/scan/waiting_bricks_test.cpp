#include "core/scan/waiting_bricks.h"

#include <gtest/gtest.h>

#include <vector>

namespace scantrove {
namespace {

using Positions = std::vector<Eigen::Vector3i>;

const Eigen::Vector3i kTable{0, 0, 0};
const Eigen::Vector3i kMug{1, 0, 0};
const Eigen::Vector3i kWall{-3, 2, 5};

Positions positionsOf(const std::vector<WaitingBricks::Brick>& bricks) {
  Positions positions;
  for (const WaitingBricks::Brick& brick : bricks) positions.push_back(brick.position);
  return positions;
}

class WaitingBricksTest : public testing::Test {
 protected:
  void addFrameOf(const Positions& bricks) {
    waiting_.beginFrame();
    waiting_.add(bricks);
  }
  Positions takeDue(std::size_t most = 100) { return positionsOf(waiting_.takeDue(most)); }

  WaitingBricks waiting_;
};

TEST_F(WaitingBricksTest, TakesABrickOnce_WhenAddedSeveralTimes) {
  addFrameOf({kTable, kMug, kTable});
  waiting_.add(Positions{kMug});
  EXPECT_EQ(takeDue(), (Positions{kTable, kMug}));
  EXPECT_TRUE(takeDue().empty());
}

TEST_F(WaitingBricksTest, TakesAtMostTheRequestedNumber) {
  addFrameOf({kTable, kMug, kWall});
  EXPECT_EQ(takeDue(2), (Positions{kTable, kMug}));
  EXPECT_EQ(takeDue(2), (Positions{kWall}));
}

TEST_F(WaitingBricksTest, TakesNewBricksFirst) {
  addFrameOf({kTable});
  EXPECT_EQ(takeDue(), Positions{kTable});
  addFrameOf({kTable, kMug});
  EXPECT_EQ(takeDue(), (Positions{kMug, kTable}));
}

// The wait doubles up to its limit: frames 1, 2, 4, 8, 16, 32, then every 24.
TEST_F(WaitingBricksTest, TakesABrickLessOften_WhenItChangesInEveryFrame) {
  std::vector<int> shown_in;
  for (int frame = 1; frame <= 110; ++frame) {
    addFrameOf({kTable});
    if (!takeDue().empty()) shown_in.push_back(frame);
  }
  EXPECT_EQ(shown_in, (std::vector<int>{1, 2, 4, 8, 16, 32, 56, 80, 104}));
}

TEST_F(WaitingBricksTest, TakeAnyIncludesDelayedBricks) {
  for (int frame = 0; frame < 2; ++frame) {
    addFrameOf({kTable});
    EXPECT_EQ(takeDue(), Positions{kTable});
  }
  addFrameOf({kTable});
  EXPECT_TRUE(takeDue().empty()) << "its wait is not over";
  EXPECT_EQ(positionsOf(waiting_.takeAny(100)), Positions{kTable});
  EXPECT_TRUE(waiting_.takeAny(100).empty());
}

TEST_F(WaitingBricksTest, TakesAndMarksUserChangesFirst) {
  addFrameOf({kTable, kMug});
  EXPECT_EQ(takeDue(), (Positions{kTable, kMug}));
  addFrameOf({kWall, kTable, kMug});
  waiting_.addByPerson(Positions{kMug});
  const std::vector<WaitingBricks::Brick> taken = waiting_.takeDue(100);
  ASSERT_EQ(positionsOf(taken), (Positions{kMug, kWall, kTable}));
  EXPECT_TRUE(taken[0].by_person);
  EXPECT_FALSE(taken[1].by_person);
  EXPECT_FALSE(taken[2].by_person);
  // A user change is never delayed.
  waiting_.addByPerson(Positions{kMug});
  EXPECT_EQ(takeDue(), Positions{kMug});
}

}  // namespace
}  // namespace scantrove
