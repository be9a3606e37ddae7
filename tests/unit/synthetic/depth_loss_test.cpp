#include "core/synthetic/depth_loss.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <set>

#include "core/synthetic/placed_part.h"

namespace scantrove::synthetic {
namespace {

const Intrinsics kLossCamera{525.0F, 525.0F, 319.5F, 239.5F, 640, 480};
constexpr int kBorder_px = 320;  // matt surface on the left, the other one on the right
constexpr int kRim_px = 8;       // holes may reach so far beyond the border

Material withLoss(float gloss, float darkness, float transparency) {
  Material material;
  material.gloss = gloss;
  material.darkness = darkness;
  material.transparency = transparency;
  return material;
}

/// Readings of two surfaces side by side, 1 m away, both seen at the same angle.
cv::Mat readings(const Material& right, float cosine, std::uint32_t frame = 0) {
  SyntheticScene scene;
  const auto id = scene.addInstance("wall", false);
  for (const Material& material : {Material{}, right}) addBox(scene, id, {}, {1, 1, 1}, 0, material);
  RenderedFrame image;
  image.z_m = cv::Mat(480, 640, CV_32FC1, cv::Scalar(1));
  image.incidence = cv::Mat(480, 640, CV_32FC1, cv::Scalar(cosine));
  image.parts = cv::Mat(480, 640, CV_32SC1, cv::Scalar(0));
  image.parts.colRange(kBorder_px, 640).setTo(1);
  cv::Mat measured = measureDepth(image.z_m, image.incidence, kLossCamera, {}, 1, frame);
  loseReadings(measured, returnedLight(image, scene.parts()), {}, 1, frame);
  return measured;
}

double shareLost(const cv::Mat& measured) {
  return 1 - cv::countNonZero(measured) / static_cast<double>(measured.total());
}

double shareLost(const Material& material, float cosine) {
  return shareLost(readings(material, cosine).colRange(kBorder_px + kRim_px, 640));
}

TEST(DepthLoss, TakesNoReading_WhenSurfacesAreMatt) {
  for (const float cosine : {1.0F, 0.7F, 0.4F}) EXPECT_EQ(shareLost(readings({}, cosine)), 0) << cosine;
  EXPECT_EQ(shareLost(readings(withLoss(0.95F, 0, 0), 1).colRange(0, kBorder_px - kRim_px)), 0)
      << "far from the hole";
}

TEST(DepthLoss, TakesMostReadings_WhenSurfacesAreShinyDarkOrTransparent) {
  EXPECT_GT(shareLost(withLoss(0.9F, 0, 0), 1), 0.5);
  EXPECT_GT(shareLost(withLoss(0, 0.95F, 0), 1), 0.5);
  EXPECT_GT(shareLost(withLoss(0, 0, 0.85F), 1), 0.5);
}

TEST(DepthLoss, DependsOnTheAngle) {
  const Material varnish = withLoss(0.6F, 0, 0);
  EXPECT_GT(shareLost(varnish, 1), 0.05) << "the mirrored projector blinds";
  EXPECT_EQ(shareLost(varnish, 0.7F), 0);
  const Material dark = withLoss(0, 0.8F, 0);
  EXPECT_EQ(shareLost(dark, 1), 0);
  EXPECT_GT(shareLost(dark, 0.45F), 0.2) << "less light returns at an angle";
}

TEST(DepthLoss, LeavesFrayedRimsThatFlicker) {
  const Material mirror = withLoss(0.97F, 0, 0);
  const cv::Mat first = readings(mirror, 1, 0);
  const cv::Mat second = readings(mirror, 1, 1);
  const cv::Rect rim(kBorder_px - kRim_px, 0, 2 * kRim_px, 480);
  std::set<int> widths;
  for (int v = 0; v < 480; ++v) widths.insert(cv::countNonZero(first(rim).row(v)));
  EXPECT_GE(widths.size(), 3U);
  const cv::Mat changed = (first > 0) != (second > 0);
  EXPECT_GT(cv::countNonZero(changed(rim)), 100);
}

TEST(DepthLoss, DisplacesReadings_WhenNextToHoles) {
  const cv::Mat measured = readings(withLoss(0.97F, 0, 0), 1);
  const auto meanError = [&](int from, int to) {
    double sum = 0;
    int count = 0;
    for (int v = 0; v < 480; ++v) {
      for (int u = from; u < to; ++u) {
        const float z = measured.at<float>(v, u);
        sum += z > 0 ? std::abs(z - 1.0) : 0;
        count += z > 0 ? 1 : 0;
      }
    }
    return sum / count;
  };
  EXPECT_GT(meanError(kBorder_px - 3, kBorder_px), 1.2 * meanError(100, 200));
}

TEST(DepthLoss, IsEqual_WhenSeedAndFrameAreEqual) {
  const Material dark = withLoss(0, 0.9F, 0);
  EXPECT_EQ(cv::norm(readings(dark, 1, 3), readings(dark, 1, 3), cv::NORM_INF), 0);
}

}  // namespace
}  // namespace scantrove::synthetic
