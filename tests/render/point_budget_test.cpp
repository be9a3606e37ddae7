#include "ui/view/point_budget.h"

#include <gtest/gtest.h>

namespace scantrove {
namespace {

TEST(PointBudget, ConvergesToTheDrawingTime) {
  PointBudget budget(100, 1e4, 1e5);
  // At 20 ms per image and 1 ms per 10,000 points, 800,000 points take 100 ms.
  for (int i = 0; i < 40; ++i) {
    budget.update(budget.points(), 20 + static_cast<double>(budget.points()) * 1e-4);
  }
  EXPECT_NEAR(static_cast<double>(budget.points()), 8e5, 0.02 * 8e5);
}

TEST(PointBudget, KeepsTheMinimum_WhenDrawingIsSlow) {
  PointBudget budget(60, 1.5e5, 2e5);
  for (int i = 0; i < 40; ++i) budget.update(budget.points(), 400);
  EXPECT_EQ(budget.points(), 150'000U);
}

TEST(PointBudget, IsUnchanged_AfterSmallScenes) {
  PointBudget budget(60, 1e4, 1e5);
  for (int i = 0; i < 40; ++i) budget.update(1000, 5);
  EXPECT_EQ(budget.points(), 100'000U);
}

}  // namespace
}  // namespace scantrove
