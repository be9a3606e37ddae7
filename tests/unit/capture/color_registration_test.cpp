#include "core/capture/color_registration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/capture/tiny_recordings.h"

namespace scantrove {
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;

const Intrinsics kDepthK{585, 585, 320, 240, 640, 480};

std::string errorOf(const std::string& text) {
  const auto parsed = parseColorRegistration(text);
  return parsed ? "(parsed)" : parsed.error().message();
}

TEST(ColorRegistration, ReadsWordsAndNumbers) {
  EXPECT_FALSE(parseColorRegistration("registered")->camera);
  const auto kinect = parseColorRegistration("kinect")->camera;
  ASSERT_TRUE(kinect);
  EXPECT_EQ(kinect->T_color_depth.translation(), Eigen::Vector3d(-0.025, 0, 0));
  const auto beside = parseColorRegistration("1050,1051,639.5,511.5,-0.03")->camera;
  ASSERT_TRUE(beside);
  EXPECT_EQ(beside->K, (Intrinsics{1050, 1051, 639.5F, 511.5F, 0, 0}));
  EXPECT_EQ(beside->T_color_depth.translation(), Eigen::Vector3d(-0.03, 0, 0));
  EXPECT_TRUE(beside->T_color_depth.linear().isIdentity());
  EXPECT_EQ(parseColorRegistration("1,1,0,0,0.1,0.2,0.3")->camera->T_color_depth.translation(),
            Eigen::Vector3d(0.1, 0.2, 0.3));
  // A quarter turn about z maps x to y.
  const auto turned = parseColorRegistration("1,1,0,0,0,0,0,0,0,90")->camera;
  EXPECT_TRUE((turned->T_color_depth * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitY()));
}

TEST(ColorRegistration, ListsAcceptedForms_WhenTheTextIsInvalid) {
  for (const char* text : {"", "nearby", "525,525,320,240", "525,525,320,240,0,0", "525,525,x,240,0",
                           "525,525,320,240,nan", "525,0,320,240,0", "525,525,320,240,1.5"}) {
    EXPECT_THAT(errorOf(text), AllOf(HasSubstr("registered, kinect"), HasSubstr("fx,fy,cx,cy"))) << text;
  }
  EXPECT_THAT(errorOf("525,0,320,240,0"), HasSubstr("must be positive"));
  EXPECT_THAT(errorOf("525,525,320,240,1.5"), HasSubstr("more than 1 m away"));
}

TEST(ColorRegistration, RefusesRegisteredImages_WhenTheirShapeDiffersFromDepth) {
  const auto same = colorCameraFor({}, {1280, 960}, kDepthK, "here");
  ASSERT_TRUE(same);
  EXPECT_FALSE(*same);
  const auto other = colorCameraFor({}, {1280, 1024}, kDepthK, "here");
  ASSERT_FALSE(other);
  EXPECT_THAT(other.error().message(), AllOf(HasSubstr("here"), HasSubstr("1280x1024"), HasSubstr("640x480"),
                                             HasSubstr("--color-registration")));
}

TEST(ColorRegistration, ResizesTheKinectCamera_WhenImagesHaveItsShape) {
  const auto camera = colorCameraFor({kinectColorCamera()}, {1280, 960}, kDepthK, "here");
  ASSERT_TRUE(camera);
  EXPECT_EQ((*camera)->K, (Intrinsics{1056, 1056, 640.5F, 480.5F, 1280, 960}));
  const auto other = colorCameraFor({kinectColorCamera()}, {1280, 1024}, kDepthK, "here");
  ASSERT_FALSE(other);
  EXPECT_THAT(other.error().message(), AllOf(HasSubstr("1280x1024"), HasSubstr("640x480")));
}

TEST(ColorRegistration, AppliesNumbersToTheActualImages) {
  const auto given = *parseColorRegistration("1050,1050,640,512,-0.025");
  EXPECT_EQ((*colorCameraFor(given, {1280, 1024}, kDepthK, "here"))->K,
            (Intrinsics{1050, 1050, 640, 512, 1280, 1024}));
  const auto small = colorCameraFor(given, {320, 256}, kDepthK, "here");
  ASSERT_FALSE(small) << "the centre lies outside";
  EXPECT_THAT(small.error().message(), AllOf(HasSubstr("here"), HasSubstr("--color-registration")));
}

/// The colour camera of a source's only frame.
std::optional<ColorCamera> colorCameraOf(const std::filesystem::path& folder,
                                         const SourceOptions& options = {}) {
  const auto source = openSource(folder.string(), options);
  EXPECT_TRUE(source) << source.error().message();
  if (!source) return std::nullopt;
  const FrameRead read = (*source)->next();
  EXPECT_EQ(read.status, FrameRead::Status::frame);
  return read.frame.color_camera;
}

TEST(SevenScenes, UsesItsKinectsColorCamera_WhenIntrinsicsAreIts) {
  const TemporaryFolder folder;
  writeSevenScenes(folder.path(), 0, 1);
  const auto own = colorCameraOf(folder.path());
  ASSERT_TRUE(own);
  EXPECT_EQ(own->K.width, kTinyWidth);
  EXPECT_FLOAT_EQ(own->K.fx, 52.7F) << "of 64x48";
  EXPECT_NEAR(own->T_color_depth.translation().x(), -0.026, 1e-9);

  SourceOptions options;
  options.intrinsics = Intrinsics{60, 60, 32, 24, 0, 0};
  EXPECT_FALSE(colorCameraOf(folder.path(), options))
      << "without a file, given intrinsics may be another camera's";
  options.intrinsics = Intrinsics{585, 585, 320, 240, 0, 0};
  folder.write("camera-intrinsics.txt", "585 0 320\n0 585 240\n0 0 1\n");
  options.intrinsics = Intrinsics{58, 58, 32, 24, 0, 0};
  EXPECT_TRUE(colorCameraOf(folder.path(), options)) << "refined intrinsics of the same camera";
  folder.write("camera-intrinsics.txt", "50 0 31\n0 51 23\n0 0 1\n");
  EXPECT_FALSE(colorCameraOf(folder.path()));
}

TEST(SevenScenes, OverridesColorRegistration_WhenAFileOrOptionGivesIt) {
  const TemporaryFolder folder;
  writeSevenScenes(folder.path(), 0, 1);
  const std::string K =
      R"("width": 640, "height": 480, "intrinsic_matrix": [585, 0, 0, 0, 585, 0, 320, 240, 1])";
  folder.write("intrinsic.json", "{" + K + R"(, "color_registered": true})");
  EXPECT_FALSE(colorCameraOf(folder.path()));
  folder.write("intrinsic.json", "{" + K + R"(, "color_camera": {"width": 128, "height": 96,
      "intrinsic_matrix": [100, 0, 0, 0, 101, 0, 62, 47, 1],
      "T_color_depth": [0, -1, 0, 0.1, 1, 0, 0, 0.2, 0, 0, 1, 0.3, 0, 0, 0, 1]}})");
  const auto recorded = colorCameraOf(folder.path());
  ASSERT_TRUE(recorded);
  EXPECT_EQ(recorded->K, (Intrinsics{100, 101, 62, 47, 128, 96}.resizedTo(kTinyWidth, kTinyHeight)));
  EXPECT_TRUE((recorded->T_color_depth * Eigen::Vector3d(1, 0, 0)).isApprox(Eigen::Vector3d(0.1, 1.2, 0.3)));
  SourceOptions options;
  options.color_registration = ColorRegistration{};
  EXPECT_FALSE(colorCameraOf(folder.path(), options));
  options.color_registration = ColorRegistration{kinectColorCamera()};
  EXPECT_NEAR(colorCameraOf(folder.path(), options)->T_color_depth.translation().x(), -0.025, 1e-9);
}

TEST(BadInput, NamesTheFile_WhenItsColorCameraIsInvalid) {
  const TemporaryFolder folder;
  writeNumberedFolder(folder.path(), 0, 1);
  const std::string K = R"("intrinsic_matrix": [60, 0, 0, 0, 60, 0, 32, 24, 1])";
  for (const char* motion : {"[1, 0, 0]", "[2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]", "\"none\""}) {
    folder.write("intrinsic.json",
                 "{" + K + ", \"color_camera\": {" + K + ", \"T_color_depth\": " + motion + "}}");
    EXPECT_THAT(openError(folder.path()), HasSubstr("intrinsic.json")) << motion;
  }
  folder.write("intrinsic.json", "{" + K + ", \"color_camera\": {" + K + "}}");
  EXPECT_THAT(openError(folder.path()), HasSubstr("T_color_depth"));
}

TEST(ColorRegistration, RefusesACameraOfAFile_WhenItIsNowhereNear) {
  ColorCamera camera = kinectColorCamera();
  for (const double x_m : {25.0, 1e300, std::numeric_limits<double>::quiet_NaN()}) {
    camera.T_color_depth.translation().x() = x_m;
    const auto chosen = colorCameraFor(ColorRegistration{camera}, {640, 480}, kDepthK, "scan.bag");
    ASSERT_FALSE(chosen) << x_m;
    EXPECT_THAT(chosen.error().what, HasSubstr("more than 10 m"));
  }
}

}  // namespace
}  // namespace scantrove
