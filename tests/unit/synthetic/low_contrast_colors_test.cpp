#include "core/synthetic/low_contrast_colors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/synthetic/scene_recipe.h"
#include "core/synthetic/synthetic_source.h"

namespace scantrove {
namespace {

using synthetic::Rgb;

/// Chromaticity: shares of red and green.
Eigen::Array2f tintOf(const Rgb& color) { return color.head<2>() / color.sum(); }

std::vector<Eigen::Array2f> tintsOf(const SyntheticScene& scene) {
  std::vector<Eigen::Array2f> tints;
  for (const SyntheticScene::Part& part : scene.parts()) {
    const Eigen::Array2f tint = tintOf(part.material.main);
    const auto is_same = [&](const Eigen::Array2f& other) { return (other - tint).abs().maxCoeff() < 1e-4F; };
    if (std::ranges::none_of(tints, is_same)) tints.push_back(tint);
  }
  return tints;
}

TEST(LowContrastColors, UseThreeTints_ForObjectsAndFurniture) {
  for (const std::uint32_t seed : {5U, 6U}) {
    SyntheticScene colorful = synthetic::makeRandomTabletopScene(seed).scene;
    EXPECT_GT(tintsOf(colorful).size(), 10U);
    const SyntheticScene low_contrast = synthetic::makeLowContrast(std::move(colorful), seed);
    const std::vector<Eigen::Array2f> tints = tintsOf(low_contrast);
    EXPECT_EQ(tints.size(), 3U);
    for (const Eigen::Array2f& tint : tints) {
      bool of_object = false, of_furniture = false;
      for (const SyntheticScene::Part& part : low_contrast.parts()) {
        if ((tintOf(part.material.main) - tint).abs().maxCoeff() > 1e-4F) continue;
        const bool is_object = low_contrast.instances()[part.instance - 1U].is_object;
        (is_object ? of_object : of_furniture) = true;
      }
      EXPECT_TRUE(of_object && of_furniture);
    }
  }
}

TEST(LowContrastColors, ChangeOnlyColors) {
  const auto frameOf = [](const char* scene) {
    SourceOptions options;
    options.start = 40;
    options.frames = 1;
    return makeSyntheticSource(scene, options).value()->next().frame;
  };
  const RgbdFrame colorful = frameOf("room:3"), low_contrast = frameOf("room:3:drab");
  EXPECT_EQ(cv::norm(colorful.depth, low_contrast.depth, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(colorful.instances, low_contrast.instances, cv::NORM_INF), 0);
  EXPECT_GT(cv::norm(colorful.color, low_contrast.color, cv::NORM_INF), 50);
  EXPECT_EQ(cv::norm(low_contrast.color, frameOf("room:3:drab").color, cv::NORM_INF), 0) << "deterministic";
}

}  // namespace
}  // namespace scantrove
