// Calibration tables of RealSense's series D400 as bytes; expected values come from the geometry of the
// images.
#include "core/capture/live/realsense_calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/support/realsense_bytes.h"

namespace scantrove {
namespace {

using namespace test;
using testing::HasSubstr;

std::vector<std::uint8_t> bytesOfText(const std::string& text) { return {text.begin(), text.end()}; }

RealsenseColorTable usualTable() { return {}; }

Result<RealsenseColor> colorFrom(const RealsenseColorTable& table, const cv::Size& size = {640, 480},
                                 bool is_d405 = false) {
  return realsenseColorCamera(bytesOfText(table.bytes()), size, is_d405);
}

TEST(RealsenseCalibration, AsksForATable) {
  const std::vector<std::uint8_t> command = realsenseTableCommand(RealsenseTable::color);
  std::string expected = "\x14";  // 20 bytes after these two and the magic number
  expected += std::string("\0\xab\xcd\x15\0\0\0\x20\0\0\0", 11);
  expected.resize(1024, '\0');
  EXPECT_EQ(command, bytesOfText(expected));
}

TEST(RealsenseCalibration, ReturnsTheTableOfAnAnswer) {
  const auto table = realsenseTableIn(bytesOfText(monitorAnswer(0x15, "calibration")));
  ASSERT_TRUE(table) << table.error().message();
  EXPECT_EQ(*table, bytesOfText("calibration"));
}

TEST(RealsenseCalibration, RefusesAnAnswer_WhenItIsAnErrorOrImpossible) {
  const auto refused = realsenseTableIn(bytesOfText(monitorAnswer(0xFFFFFFFA, "")));
  EXPECT_THAT(refused ? "" : refused.error().what, HasSubstr("refuses (-6)"));
  std::string too_large = monitorAnswer(0x15, "");
  too_large.replace(1020, 4, littleEndianBytes(1017, 4));
  const auto impossible = realsenseTableIn(bytesOfText(too_large));
  EXPECT_THAT(impossible ? "" : impossible.error().what, HasSubstr("1017 bytes"));
  EXPECT_FALSE(realsenseTableIn(bytesOfText("short")));
}

TEST(RealsenseCalibration, ReadsTheDepthCameraOfTheImageSize) {
  const auto table = bytesOfText(realsenseDepthTable({385.5F, 386.5F, 321, 238}, {424, 425, 423, 241}));
  const auto vga = realsenseDepthIntrinsics(table, {640, 480});
  ASSERT_TRUE(vga) << vga.error().message();
  EXPECT_EQ(*vga, (Intrinsics{385.5F, 386.5F, 321, 238, 640, 480}));
  const auto wide = realsenseDepthIntrinsics(table, {848, 480});
  ASSERT_TRUE(wide) << wide.error().message();
  EXPECT_EQ(*wide, (Intrinsics{424, 425, 423, 241, 848, 480}));
}

TEST(RealsenseCalibration, RefusesADepthTable_WhenDamagedOrWithoutTheSize) {
  const std::string table = realsenseDepthTable({385, 385, 320, 240}, {424, 424, 424, 240});
  std::string damaged = table;
  damaged[300] = static_cast<char>(damaged[300] ^ 1);
  const auto checksum = realsenseDepthIntrinsics(bytesOfText(damaged), {640, 480});
  EXPECT_THAT(checksum ? "" : checksum.error().what, HasSubstr("checksum"));
  const auto size = realsenseDepthIntrinsics(bytesOfText(table), {256, 144});
  EXPECT_THAT(size ? "" : size.error().what, HasSubstr("256x144"));
  EXPECT_FALSE(realsenseDepthIntrinsics(bytesOfText(table), {1280, 720}));  // all zeros
  for (std::size_t bytes = 0; bytes < 420; ++bytes)
    EXPECT_FALSE(realsenseDepthIntrinsics(bytesOfText(table.substr(0, bytes)), {640, 480})) << bytes;
}

TEST(RealsenseCalibration, CropsTheColorCameraToTheImage) {
  // In 1920x1080 pixels: f = 1382.4, cx = 969.6, cy = 529.2. 480 rows are 4/9 of 1080; of the 853.33 columns
  // 106.67 are cropped on both sides.
  const auto color = colorFrom(usualTable());
  ASSERT_TRUE(color) << color.error().message();
  const Intrinsics& K = color->camera.K;
  EXPECT_NEAR(K.fx, 614.4, 1e-3);
  EXPECT_NEAR(K.fy, 614.4, 1e-3);
  EXPECT_NEAR(K.cx, 969.6 * 4 / 9 - 320.0 / 3, 1e-3);
  EXPECT_NEAR(K.cy, 529.2 * 4 / 9, 1e-3);
  EXPECT_EQ(cv::Size(K.width, K.height), cv::Size(640, 480));
  EXPECT_TRUE(color->lens.isZero());
}

TEST(RealsenseCalibration, ReadsTheLensOfTheColorCamera) {
  RealsenseColorTable table;
  table.lens = {-0.05F, 0.06F, 0.001F, -0.002F, 0.03F};
  const auto color = colorFrom(table);
  ASSERT_TRUE(color) << color.error().message();
  EXPECT_NEAR(color->lens.k1, -0.05, 1e-7);
  EXPECT_NEAR(color->lens.k2, 0.06, 1e-7);
  EXPECT_NEAR(color->lens.p1, 0.001, 1e-7);
  EXPECT_NEAR(color->lens.p2, -0.002, 1e-7);
  EXPECT_NEAR(color->lens.k3, 0.03, 1e-7);
  EXPECT_TRUE(color->lens.is_inverse);
}

TEST(RealsenseCalibration, PlacesTheColorCameraBesideTheDepthCamera) {
  RealsenseColorTable table;
  const float c = std::cos(0.01F), s = std::sin(0.01F);
  table.rotation = {c, s, 0, -s, c, 0, 0, 0, 1};  // about z, column by column
  const auto color = colorFrom(table);
  ASSERT_TRUE(color) << color.error().message();
  // p_depth = R p_color - t: the origin of the colour camera is at -t, and R turns x towards y.
  const Eigen::Isometry3d T_depth_color = color->camera.T_color_depth.inverse();
  EXPECT_TRUE(T_depth_color.translation().isApprox(Eigen::Vector3d(-0.015, -0.0002, 0.0001), 1e-6));
  EXPECT_TRUE(
      T_depth_color.linear().col(0).isApprox(Eigen::Vector3d(std::cos(0.01), std::sin(0.01), 0), 1e-6));
}

TEST(RealsenseCalibration, CropsTheColorCameraOfAD405) {
  // 1280x720 with f = 640, cx = 640, cy = 378 lies in the middle of a sensor of 800 rows, which is scaled to
  // 770 columns (481.25 rows) and cropped to 640x480.
  RealsenseColorTable table;
  table.normalized = {1, 640.0F / 360, 0, 0.05F};
  table.width = 1280;
  table.height = 720;
  const auto color = colorFrom(table, {640, 480}, true);
  ASSERT_TRUE(color) << color.error().message();
  const double scale = 770.0 / 1280;
  EXPECT_NEAR(color->camera.K.fx, 640 * scale, 1e-3);
  EXPECT_NEAR(color->camera.K.fy, 640 * scale, 1e-3);
  EXPECT_NEAR(color->camera.K.cx, 640 * scale - 65, 1e-3);
  EXPECT_NEAR(color->camera.K.cy, (378 + 40) * scale - 0.625, 1e-3);
  const auto wide = colorFrom(table, {848, 480}, true);
  ASSERT_TRUE(wide) << wide.error().message();
  EXPECT_NEAR(wide->camera.K.fx, 640 * 480.0 / 720, 0.5);  // 848 is not exactly 16/9 of 480
  EXPECT_NEAR(wide->camera.K.cx, 424, 1e-3);
}

TEST(RealsenseCalibration, RefusesTheColorCamera_WhenItIsImpossible) {
  RealsenseColorTable far_away, skew, lens;
  far_away.translation_mm = {5000, 0, 0};
  EXPECT_FALSE(colorFrom(far_away));
  skew.rotation = {1, 0, 0, 1, 0, 0, 0, 0, 1};
  EXPECT_FALSE(colorFrom(skew));
  skew.rotation.assign(9, std::numeric_limits<float>::quiet_NaN());
  EXPECT_FALSE(colorFrom(skew));
  lens.lens[2] = std::numeric_limits<float>::infinity();
  EXPECT_FALSE(colorFrom(lens));
  const std::string whole = usualTable().bytes();
  for (std::size_t bytes = 0; bytes < 232; ++bytes)
    EXPECT_FALSE(realsenseColorCamera(bytesOfText(whole.substr(0, bytes)), {640, 480}, false)) << bytes;
}

TEST(RealsenseCalibration, KnowsTheUsualLensesOfModels) {
  const Intrinsics wide = nominalRealsenseIntrinsics(0x0b07, {848, 480});  // D435: 86 to 91 degrees
  EXPECT_NEAR(2 * std::atan(424 / wide.fx) * 180 / CV_PI, 88.5, 2.5);
  const Intrinsics narrow = nominalRealsenseIntrinsics(0x0ad3, {848, 480});  // D415: 65 to 70 degrees
  EXPECT_NEAR(2 * std::atan(424 / narrow.fx) * 180 / CV_PI, 67.5, 2.5);
  EXPECT_EQ(wide.cx, 423.5F);
  EXPECT_EQ(wide.cy, 239.5F);
}

}  // namespace
}  // namespace scantrove
