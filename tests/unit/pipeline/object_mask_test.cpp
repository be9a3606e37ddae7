#include "core/pipeline/object_mask.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "core/synthetic/synthetic_source.h"

namespace scantrove {
namespace {

/// A turntable in steps of 4 frames, 6 degrees.
std::unique_ptr<SyntheticSource> turntable(std::uint32_t seed, bool noise) {
  SyntheticOptions options;
  options.recipe = [seed] { return synthetic::makeRandomTurntableScene(seed); };
  options.K = options.K.resizedTo(320, 240);
  options.noise = noise;
  options.color = false;
  options.stride = 4;
  options.frames = 64;
  return makeSyntheticSource(options).value();
}

struct Shares {
  double covered = 0;  ///< part of the object's pixels with depth that the mask has
  double wrong = 0;    ///< part of the other pixels that it has
};

Shares sharesOf(const cv::Mat1b& mask, const RgbdFrame& frame, std::uint16_t thing) {
  const cv::Mat object = (frame.instances == thing) & (frame.depth > 0);
  const cv::Mat others = frame.instances != thing;
  return {cv::countNonZero(mask & object) / static_cast<double>(cv::countNonZero(object)),
          cv::countNonZero(mask & others) / static_cast<double>(cv::countNonZero(others))};
}

class ObjectMaskTest : public testing::TestWithParam<std::uint32_t> {};
INSTANTIATE_TEST_SUITE_P(Seeds, ObjectMaskTest, testing::Range(1U, 6U));

TEST_P(ObjectMaskTest, CoversTheObjectAlone_FirstAndAfterAQuarterTurn) {
  const auto source = turntable(GetParam(), false);
  const std::uint16_t thing = source->scene().find("thing");
  ObjectMask object(source->info().intrinsics, {});
  for (int step = 0; step <= 15; ++step) {
    const RgbdFrame frame = source->next().frame;
    const RgbdFrame masked = object.apply(frame);
    ASSERT_TRUE(object.isFound()) << step;
    if (step == 0 || step == 15) {
      const Shares shares = sharesOf(object.mask(), frame, thing);
      EXPECT_GE(shares.covered, 0.95) << step;
      EXPECT_LE(shares.wrong, 0.02) << step;
    }
    EXPECT_EQ(cv::countNonZero((masked.depth > 0) != object.mask()), 0) << "exact depth is everywhere";
    object.follow(*frame.T_world_camera);
  }
  EXPECT_TRUE(object.box().stands);
}

TEST_P(ObjectMaskTest, LeavesOutTheNoisySurfaceBelow) {
  const auto source = turntable(GetParam(), true);
  const std::uint16_t thing = source->scene().find("thing");
  ObjectMask object(source->info().intrinsics, {});
  const RgbdFrame frame = source->next().frame;
  (void)object.apply(frame);
  const Shares shares = sharesOf(object.mask(), frame, thing);
  EXPECT_GE(shares.covered, 0.9);
  EXPECT_LE(shares.wrong, 0.02);
}

TEST_P(ObjectMaskTest, BoxEnclosesTheObject_AfterAQuarterTurn) {
  const auto source = turntable(GetParam(), false);
  const Eigen::Vector3d size = source->scene().boundsOf(source->scene().find("thing")).sizes();
  ObjectMask object(source->info().intrinsics, {});
  for (int step = 0; step <= 15; ++step) {
    const RgbdFrame frame = source->next().frame;
    (void)object.apply(frame);
    object.follow(*frame.T_world_camera);
  }
  const Eigen::Vector3d found = object.box().bounds.sizes();
  EXPECT_NEAR(found.z(), size.z(), 0.02);
  EXPECT_GE(found.head<2>().minCoeff(), 0.8 * size.head<2>().minCoeff());
  EXPECT_LE(found.head<2>().maxCoeff(), 1.5 * size.head<2>().norm()) << "it does not grow into the room";
}

TEST(ObjectMask, KeepsTheGivenBox) {
  const auto source = turntable(2, false);
  ObjectChoice choice;
  choice.box_m = Eigen::Vector3d(0.3, 0.25, 0.22);
  ObjectMask object(source->info().intrinsics, choice);
  for (int step = 0; step < 4; ++step) {
    const RgbdFrame frame = source->next().frame;
    (void)object.apply(frame);
    object.follow(*frame.T_world_camera);
  }
  EXPECT_LT((object.box().bounds.sizes() - *choice.box_m).norm(), 1e-9);
}

TEST(ObjectMask, FindsAnObjectAgain_WhenANewMapBegins) {
  const auto source = turntable(3, false);
  ObjectMask object(source->info().intrinsics, {});
  RgbdFrame frame = source->next().frame;
  (void)object.apply(frame);
  object.follow(*frame.T_world_camera);
  object.restart();
  EXPECT_FALSE(object.isFound());
  frame = source->next().frame;
  (void)object.apply(frame);
  ASSERT_TRUE(object.isFound());
  EXPECT_GE(sharesOf(object.mask(), frame, source->scene().find("thing")).covered, 0.95);
}

const Intrinsics kHeldCamera{262.5F, 262.5F, 159.5F, 119.5F, 320, 240};

/// A ball of 8 cm radius at 0.6 m before a wall at 2 m, both facing the camera.
RgbdFrame heldBall() {
  constexpr double kRadius_m = 0.08, kDistance_m = 0.6, kWall_m = 2;
  RgbdFrame frame;
  frame.depth = cv::Mat(kHeldCamera.height, kHeldCamera.width, CV_16UC1, cv::Scalar(0));
  frame.instances = frame.depth.clone();
  for (int v = 0; v < kHeldCamera.height; ++v) {
    for (int u = 0; u < kHeldCamera.width; ++u) {
      const Eigen::Vector3d ray((u - 159.5) / 262.5, (v - 119.5) / 262.5, 1);
      // |z ray - (0, 0, distance)| = radius
      const double a = ray.squaredNorm(), c = kDistance_m * kDistance_m - kRadius_m * kRadius_m;
      const double root = kDistance_m * kDistance_m - a * c;
      const double z_m = root > 0 ? (kDistance_m - std::sqrt(root)) / a : kWall_m;
      frame.depth.at<std::uint16_t>(v, u) = static_cast<std::uint16_t>(std::lround(1000 * z_m));
      frame.instances.at<std::uint16_t>(v, u) = root > 0 ? 1 : 0;
    }
  }
  return frame;
}

TEST(ObjectMask, KeepsWhatIsBeforeTheCamera_WithoutAPlane) {
  const RgbdFrame frame = heldBall();
  ObjectMask object(kHeldCamera, {});
  (void)object.apply(frame);
  ASSERT_TRUE(object.isFound());
  EXPECT_FALSE(object.box().stands);
  const Shares shares = sharesOf(object.mask(), frame, 1);
  EXPECT_EQ(shares.covered, 1);
  EXPECT_EQ(shares.wrong, 0);
}

TEST(ObjectMask, FindsNothing_WithoutDepth) {
  RgbdFrame frame = heldBall();
  frame.depth.setTo(0);
  ObjectMask object(kHeldCamera, {});
  const RgbdFrame masked = object.apply(frame);
  EXPECT_FALSE(object.isFound());
  EXPECT_EQ(cv::countNonZero(masked.depth), 0);
  object.follow(Eigen::Isometry3d::Identity());
  EXPECT_FALSE(object.isFound());
}

TEST(ObjectMask, TellsTrackingWhereTheObjectIsInColor) {
  RgbdFrame frame = heldBall();
  frame.color = cv::Mat(480, 640, CV_8UC3, cv::Scalar::all(90));
  ObjectMask object(kHeldCamera, {});
  const RgbdFrame masked = object.apply(frame);
  ASSERT_FALSE(masked.scanned.empty());
  const auto at = [&](double u, double v) {  // of the colour image
    return masked.scanned.at<unsigned char>(static_cast<int>(v * masked.scanned.rows / 480),
                                            static_cast<int>(u * masked.scanned.cols / 640));
  };
  EXPECT_EQ(at(320, 240), 255);
  EXPECT_EQ(at(320 + 60, 240), 255) << "the ball has a radius of 70 pixels";
  EXPECT_EQ(at(20, 20), 0);
  EXPECT_EQ(at(620, 240), 0);
}

}  // namespace
}  // namespace scantrove
