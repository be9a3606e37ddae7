#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/synthetic/synthetic_source.h"

namespace scantrove {
namespace {

class TurntableSceneTest : public testing::TestWithParam<std::uint32_t> {
 protected:
  static SyntheticOptions options(int start = 0) {
    SyntheticOptions options;
    options.recipe = [] { return synthetic::makeRandomTurntableScene(GetParam()); };
    options.K = options.K.resizedTo(320, 240);
    options.noise = options.color = false;
    options.start = start;
    return options;
  }
};
INSTANTIATE_TEST_SUITE_P(Seeds, TurntableSceneTest, testing::Range(1U, 7U));

TEST_P(TurntableSceneTest, ShowsOneThingOfTheSizeOfAHand) {
  const auto source = makeSyntheticSource(options()).value();
  const SyntheticScene& scene = source->scene();
  const std::uint16_t thing = scene.find("thing"), disc = scene.find("turntable");
  ASSERT_TRUE(thing != 0 && disc != 0);
  EXPECT_TRUE(scene.instances()[thing - 1U].is_object);
  EXPECT_FALSE(scene.instances()[disc - 1U].is_object);
  EXPECT_EQ(source->info().frame_count, 240);
  const double size_m = scene.boundsOf(thing).sizes().maxCoeff();
  EXPECT_GE(size_m, 0.12);
  EXPECT_LE(size_m, 0.25);
  EXPECT_NEAR(scene.boundsOf(thing).min().z(), scene.boundsOf(disc).max().z(), 1e-6) << "it stands there";
  const cv::Mat mask = source->next().frame.instances == thing;
  // 12 cm by 6 cm at 0.6 m are 52 x 26 pixels of the camera's 262 pixels a radian: 1.8 % of the image.
  EXPECT_GT(cv::countNonZero(mask), 0.018 * static_cast<double>(mask.total()));
  const cv::Rect box = cv::boundingRect(mask), inner(8, 8, 320 - 16, 240 - 16);
  EXPECT_EQ(box & inner, box) << "it is in view as a whole";
}

TEST_P(TurntableSceneTest, PosesCircleAroundTheThing) {
  const auto source = makeSyntheticSource(options()).value();
  const Eigen::Isometry3d first = source->pose(0);
  const Eigen::Isometry3d quarter = source->pose(60) * first.inverse();
  // The thing turns by +90 degrees about the vertical, so the camera seems to turn by -90 degrees.
  const Eigen::Matrix3d expected =
      Eigen::AngleAxisd(-std::numbers::pi / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  EXPECT_LT((quarter.linear() - expected).norm(), 1e-9);
  EXPECT_LT((source->pose(240).matrix() - first.matrix()).norm(), 1e-9) << "240 frames are one turn";
  const Eigen::Vector3d middle = source->scene().boundsOf(source->scene().find("turntable")).center();
  for (const int frame : {0, 33, 60, 151})
    EXPECT_NEAR((source->pose(frame).translation() - middle).norm(), (first.translation() - middle).norm(),
                1e-9);
}

TEST_P(TurntableSceneTest, DepthIsThatOfTheStandingThing_SeenFromThePose) {
  const auto at_rest = makeSyntheticSource(options()).value();
  const auto turned = makeSyntheticSource(options(80)).value();
  const std::uint16_t thing = at_rest->scene().find("thing");
  const RgbdFrame frame = turned->next().frame;
  const Eigen::Isometry3d T_thing_camera = at_rest->pose(80);
  ASSERT_TRUE(frame.T_world_camera->matrix() == T_thing_camera.matrix());
  const Intrinsics K = options().K;
  int compared = 0;
  for (int v = 0; v < K.height; v += 5) {
    for (int u = 0; u < K.width; u += 5) {
      if (frame.instances.at<std::uint16_t>(v, u) != thing) continue;
      const Eigen::Vector3d ray((u - static_cast<double>(K.cx)) / static_cast<double>(K.fx),
                                (v - static_cast<double>(K.cy)) / static_cast<double>(K.fy), 1);
      const RayHit hit = at_rest->scene().cast(T_thing_camera.translation(), T_thing_camera.linear() * ray);
      ASSERT_EQ(hit.instance, thing);
      EXPECT_NEAR(hit.distance, 0.001 * frame.depth.at<std::uint16_t>(v, u), 0.0011);
      ++compared;
    }
  }
  EXPECT_GT(compared, 80);
}

TEST_P(TurntableSceneTest, RoomStandsStill) {
  const auto early = makeSyntheticSource(options()).value(), late = makeSyntheticSource(options(97)).value();
  const std::uint16_t thing = early->scene().find("thing"), disc = early->scene().find("turntable");
  const RgbdFrame a = early->next().frame, b = late->next().frame;
  const cv::Mat turns =
      (a.instances == thing) | (a.instances == disc) | (b.instances == thing) | (b.instances == disc);
  ASSERT_GT(cv::countNonZero(turns == 0), 10000);
  cv::Mat differs = a.depth != b.depth;
  differs.setTo(0, turns);
  EXPECT_EQ(cv::countNonZero(differs), 0);
  EXPECT_GT(cv::countNonZero(a.depth != b.depth), 200) << "the thing turned";
}

}  // namespace
}  // namespace scantrove
