// The review of key frames on the command line, and what of it a data set has.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/app/demo_scan.h"

namespace scantrove::test {
namespace {

using testing::HasSubstr;

class ReviewCommandTest : public DemoScanTest {
 protected:
  [[nodiscard]] Json listed() const {
    const Finished run = session({"review", "--list", "--json"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return Json::parse(run.out);
  }
  [[nodiscard]] std::vector<std::string> frames() const {
    std::vector<std::string> numbers;
    const Json all = listed();
    for (const Json& one : all["frames"]) numbers.push_back(std::to_string(one["frame"].get<int>()));
    return numbers;
  }
  /// Numbers of images in a data set.
  [[nodiscard]] int exportedImages(const std::string& name, const std::vector<std::string>& options) const {
    std::vector<std::string> arguments{"export", scan_,          "--format",
                                       "masks",  "--background", "--json",
                                       "--out",  folder_ / name, "--include-unfit-frames"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Finished run = scantrove(arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return Json::parse(run.out)["images"];
  }
};

TEST_F(ReviewCommandTest, SetsStates_WhichUndoTakesBack) {
  const std::vector<std::string> all = frames();
  ASSERT_GE(all.size(), 2U);
  ASSERT_EQ(listed()["open"], all.size());
  ASSERT_EQ(session({"review", "--frame", all[0], "--frame", all[1], "--state", "checked"}).exit_code, 0);
  ASSERT_EQ(session({"review", "--frame", all[1], "--state", "left-out"}).exit_code, 0);
  EXPECT_EQ(listed()["checked"], 1);
  EXPECT_EQ(listed()["left_out"], 1);
  EXPECT_THAT(session({"history"}).out, HasSubstr("image " + all[1] + ": left-out"));
  ASSERT_EQ(session({"undo"}).exit_code, 0);
  EXPECT_EQ(listed()["checked"], 2);
  ASSERT_EQ(session({"redo"}).exit_code, 0);
  EXPECT_EQ(listed()["left_out"], 1);
}

TEST_F(ReviewCommandTest, FrameGivenTwiceIsOneStep) {
  const std::vector<std::string> all = frames();
  ASSERT_GE(all.size(), 1U);
  ASSERT_EQ(session({"review", "--frame", all[0], "--frame", all[0], "--state", "checked"}).exit_code, 0);
  EXPECT_EQ(listed()["checked"], 1);
  ASSERT_EQ(session({"undo"}).exit_code, 0);
  EXPECT_EQ(listed()["checked"], 0);
}

TEST_F(ReviewCommandTest, DataSetsHaveNoFrameThatWasLeftOut) {
  const std::vector<std::string> all = frames();
  ASSERT_GE(all.size(), 2U);
  ASSERT_EQ(session({"review", "--frame", all[0], "--state", "left-out"}).exit_code, 0);
  ASSERT_EQ(session({"review", "--frame", all[1], "--state", "checked"}).exit_code, 0);
  EXPECT_EQ(exportedImages("all", {"--all-frames"}), static_cast<int>(all.size()) - 1);
  EXPECT_EQ(exportedImages("checked", {"--checked-only"}), 1);
}

TEST_F(ReviewCommandTest, ExportSaysWhy_WhenNoFrameIsChecked) {
  const Finished run = scantrove(
      {"export", scan_, "--format", "masks", "--background", "--checked-only", "--out", folder_ / "none"});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.err, HasSubstr("not checked"));
  EXPECT_THAT(run.err, HasSubstr("session review --list"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "none"));
}

TEST_F(ReviewCommandTest, RefusesAnUnknownFrame_AndAMissingState) {
  expectJobFailure(session({"review", "--frame", "999", "--state", "checked"}), {"999", "--list"});
  expectWrongUsage(session({"review", "--frame", "0"}), {"--state"});
  expectWrongUsage(session({"review", "--frame", "0", "--state", "fine"}), {"--state"});
  EXPECT_EQ(listed()["checked"], 0);
}

}  // namespace
}  // namespace scantrove::test
