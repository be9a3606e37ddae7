#include "core/synthetic/hard_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>

#include "core/synthetic/placed_part.h"
#include "core/synthetic/synthetic_source.h"

namespace scantrove {
namespace {

using synthetic::HardCamera;
using synthetic::SceneRecipe;

constexpr double kSideways = 0.5;  // m/s

/// Passes a chequered wall at a distance of 1 m, sideways.
SceneRecipe makePassedWall(const HardCamera& camera) {
  using namespace synthetic;
  SceneRecipe recipe{.name = "passed wall", .scene = {}, .path = {}, .frames = 60};
  const auto id = recipe.scene.addInstance("wall", false);
  Material tiles{Pattern::checker, rgb(0xe8e8e0), rgb(0x404048), {}, 0.05F};
  tiles.casts_shadow = false;
  addBox(recipe.scene, id, {}, {6, 0.1, 4}, 0, tiles, {0, 1.05, -1});
  recipe.path = [](double time_s) -> Gaze {
    const double x = kSideways * time_s;
    return {{x, 0, 1}, {x, 1, 1}};
  };
  recipe.camera = camera;
  return recipe;
}

/// A box 0.9 m away, 20 cm wide, before a wall at 1.6 m.
SceneRecipe makeBoxBeforeWall(const HardCamera& camera) {
  using namespace synthetic;
  SceneRecipe recipe{.name = "box before a wall", .scene = {}, .path = {}, .frames = 1};
  addBox(recipe.scene, recipe.scene.addInstance("wall", false), {}, {6, 0.1, 4}, 0, {}, {0, 1.65, -1});
  addBox(recipe.scene, recipe.scene.addInstance("box", true), {}, {0.2, 0.1, 0.4}, 0, {}, {0, 0.95, 0.8});
  recipe.path = [](double /*time_s*/) -> Gaze { return {{0, 0, 1}, {0, 1, 1}}; };
  recipe.camera = camera;
  return recipe;
}

RgbdFrame firstFrame(const std::function<SceneRecipe()>& recipe, bool noise) {
  SyntheticOptions options;
  options.recipe = recipe;
  options.tremor = false;
  options.noise = noise;
  auto source = makeSyntheticSource(options);
  EXPECT_TRUE(source) << (source ? "" : source.error().message());
  return (*source)->next().frame;
}

/// Of differences between horizontal neighbours.
double gradientEnergy(const cv::Mat& color) {
  cv::Mat gray, difference;
  cv::cvtColor(color, gray, cv::COLOR_BGR2GRAY);
  gray.convertTo(gray, CV_32F);
  cv::subtract(gray.colRange(1, gray.cols), gray.colRange(0, gray.cols - 1), difference);
  return cv::norm(difference, cv::NORM_L2SQR) / static_cast<double>(difference.total());
}

TEST(HardCamera, ShowsColorOfALaterMoment_ByTheStatedDelay) {
  HardCamera camera;
  camera.color_delay_s = 0.03;
  camera.blurred_share = 0;
  const auto recipe = [&] { return makePassedWall(camera); };
  const cv::Mat later = firstFrame(recipe, true).color;
  const cv::Mat now = firstFrame(recipe, false).color;
  const int moved_px = static_cast<int>(std::lround(525 * kSideways * camera.color_delay_s));  // at 1 m
  constexpr int kMargin_px = 15;
  const cv::Rect middle(kMargin_px, 0, 640 - 2 * kMargin_px, 480);
  int best_px = 0;
  double least = 1e9;
  for (int shift_px = -kMargin_px; shift_px <= kMargin_px; ++shift_px) {
    const double difference = cv::norm(later(middle), now(middle + cv::Point(shift_px, 0)), cv::NORM_L1);
    if (difference < least) {
      least = difference;
      best_px = shift_px;
    }
  }
  EXPECT_EQ(best_px, moved_px);
}

TEST(HardCamera, BlursFrames_WhenExposedWhileMoving) {
  HardCamera camera;
  camera.exposure_s = 0.06;
  camera.blurred_share = 0;
  const double sharp = gradientEnergy(firstFrame([&] { return makePassedWall(camera); }, true).color);
  camera.blurred_share = 1;
  const double blurred = gradientEnergy(firstFrame([&] { return makePassedWall(camera); }, true).color);
  EXPECT_LT(blurred, 0.5 * sharp);
}

TEST(HardCamera, BlursTheStatedShareOfFrames) {
  const HardCamera camera = synthetic::makeHardCamera(3);
  int blurred = 0;
  for (std::uint32_t frame = 0; frame < 2000; ++frame) {
    const std::vector<double> moments = colorMoments(camera, frame);
    EXPECT_DOUBLE_EQ(moments.front(), camera.color_delay_s);
    if (moments.size() == 1) continue;
    ++blurred;
    EXPECT_NEAR(moments.back() - moments.front(), camera.exposure_s, 1e-12);
  }
  // The standard deviation of such a share is below 0.01.
  EXPECT_NEAR(blurred / 2000.0, camera.blurred_share, 0.03);
}

TEST(HardCamera, HasNoDepthLeftOfNearThings) {
  const HardCamera camera;
  const auto recipe = [&] { return makeBoxBeforeWall(camera); };
  const RgbdFrame frame = firstFrame(recipe, true);
  const auto readingsIn = [&](int from, int to) {
    const cv::Mat strip = frame.depth(cv::Rect(from, 220, to - from, 60));
    return cv::countNonZero(strip) / static_cast<double>(strip.total());
  };
  const double left_px = 319.5 - 525 * 0.1 / 0.9;
  const double right_px = 319.5 + 525 * 0.1 / 0.9;
  const double width_px = 525 * camera.depth.baseline_m * (1 / 0.9 - 1 / 1.6);
  EXPECT_LT(readingsIn(static_cast<int>(left_px - width_px + 5), static_cast<int>(left_px - 3)), 0.05);
  EXPECT_GT(readingsIn(static_cast<int>(right_px + 8), static_cast<int>(right_px + 8 + width_px)), 0.95);
  EXPECT_GT(readingsIn(static_cast<int>(left_px - width_px - 30), static_cast<int>(left_px - width_px - 10)),
            0.95);
  EXPECT_EQ(cv::norm(frame.instances, firstFrame(recipe, false).instances, cv::NORM_INF), 0)
      << "the truth has no holes";
}

}  // namespace
}  // namespace scantrove
