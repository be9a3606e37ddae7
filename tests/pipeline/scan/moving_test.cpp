#include "tests/support/moving_scan.h"

#include <gtest/gtest.h>

#include "tests/support/qt_main_thread.h"

namespace scantrove::test {
namespace {

TEST(MovingScene, LeavesNoGhosts_TracksTheCamera_AndRecognizesTheMovedMug) {
  const auto compute = ComputeContext::create({}).value();
  const QtMainThread qt;
  const Result<MovingScan> result = scanMoving(2, *compute);
  ASSERT_TRUE(result) << result.error().message();
  const MovingScan& scan = *result;
  EXPECT_EQ(scan.frames, 420);
  EXPECT_EQ(scan.tracked, scan.frames);
  EXPECT_EQ(scan.mug_before.size(), 1U);
  EXPECT_EQ(scan.mug_after, scan.mug_before);
  // Errors are without alignment, so larger than the ATE. Without the motion filter the camera drifted up to
  // 180 mm with the person who passes.
  EXPECT_LT(scan.rms_m, 0.015);
  EXPECT_LT(scan.farthest_m, 0.040);
  EXPECT_GT(scan.points, 300000);
  EXPECT_LT(static_cast<double>(scan.ghosts_4cm), 0.001 * static_cast<double>(scan.points))
      << scan.ghosts_4cm << " ghosts";
}

}  // namespace
}  // namespace scantrove::test
