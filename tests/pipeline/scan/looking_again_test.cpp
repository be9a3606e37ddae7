#include <gtest/gtest.h>

#include "tests/support/scan_session_runner.h"
#include "tests/support/temporary_folder.h"

namespace scantrove {
namespace {

using test::runScan;
using test::ScanEnding;

ScanRequest requestIn(const test::TemporaryFolder& folder) {
  ScanRequest request;
  request.source = "demo:tabletop:7";
  request.source_options.frames = 40;
  request.output_folder = folder / "out";
  request.database = (folder / "catalogue.sqlite").string();
  return request;
}

TEST(LookingAgain, TellsHowFarItIs) {
  const test::TemporaryFolder folder;
  const ScanEnding ending = runScan(requestIn(folder));
  ASSERT_TRUE(ending.report) << ending.error;
  ASSERT_FALSE(ending.again.empty());
  EXPECT_EQ(ending.again.front().done, 0);
  const int steps = ending.again.front().steps;
  int last = 0;
  for (const LookingAgain& again : ending.again) {
    EXPECT_EQ(again.steps, steps) << "how much there is does not change on the way";
    EXPECT_GE(again.done, last);
    EXPECT_LT(again.done, steps);
    last = again.done;
  }
  EXPECT_GT(last, steps * 2 / 3);
}

TEST(LookingAgain, NotWithoutASession) {
  const test::TemporaryFolder folder;
  ScanRequest request = requestIn(folder);
  request.session = false;
  const ScanEnding ending = runScan(std::move(request));
  ASSERT_TRUE(ending.report) << ending.error;
  EXPECT_TRUE(ending.again.empty());
}

TEST(LookingAgain, WhoClosesTheProgramDoesNotWaitForIt) {
  const test::TemporaryFolder folder;
  const test::QtMainThread qt;
  std::atomic<int> steps = 0;
  std::atomic<bool> has_finished = false;
  ScanSession session([&](const ScanEvent& event) {
    if (std::holds_alternative<LookingAgain>(event)) ++steps;
    if (std::holds_alternative<ScanFinished>(event)) has_finished = true;
  });
  ScanRequest request = requestIn(folder);
  request.start_paused = true;
  session.start(std::move(request));
  for (int i = 0; i < 3; ++i) session.step();
  int read = 0;
  while (read < 3) {
    if (const auto snapshot = session.snapshots().collect()) read = snapshot->frames.read;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  session.close();
  session.wait();
  EXPECT_TRUE(has_finished) << "all else is kept";
  EXPECT_EQ(steps, 0);
}

}  // namespace
}  // namespace scantrove
