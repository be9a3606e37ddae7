#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/core.hpp>
#include <set>
#include <string>
#include <vector>

#include "core/synthetic/hard_materials.h"
#include "core/synthetic/palette.h"
#include "core/synthetic/synthetic_source.h"

namespace scantrove {
namespace {

using synthetic::Material;
using synthetic::Pattern;

RgbdFrame hardFrame(const std::string& scene, int frame = 40) {
  SourceOptions options;
  options.start = frame;
  options.frames = 1;
  auto source = makeSyntheticSource(scene, options);
  EXPECT_TRUE(source) << scene << (source ? "" : source.error().message());
  return (*source)->next().frame;
}

/// Standard deviation of the brightness over its mean, on a face of 1 m seen from near.
double contrastOf(const Material& material) {
  double sum = 0, squares = 0;
  constexpr int kSteps = 200;
  for (int i = 0; i < kSteps; ++i) {
    for (int k = 0; k < kSteps; ++k) {
      synthetic::SurfacePoint surface;
      surface.face = 5;
      surface.ru = 2 * static_cast<float>(i) / kSteps - 1;
      surface.rv = 2 * static_cast<float>(k) / kSteps - 1;
      surface.u = 0.5F * surface.ru;
      surface.v = 0.5F * surface.rv;
      const double light = albedo(material, surface, 0.0015F).sum();
      sum += light;
      squares += light * light;
    }
  }
  const double mean = sum / (kSteps * kSteps);
  return std::sqrt(std::max(0.0, squares / (kSteps * kSteps) - mean * mean)) / mean;
}

/// The part of a frame's labelled pixels that have no depth.
double lostShare(const RgbdFrame& frame) {
  const cv::Mat lost = (frame.depth == 0) & (frame.instances > 0);
  return cv::countNonZero(lost) / static_cast<double>(cv::countNonZero(frame.instances));
}

TEST(HardScenes, LoseMoreDepth_ButKeepTheirTruth) {
  for (const std::string kind : {"room", "tabletop"}) {
    const RgbdFrame exact = hardFrame(kind + ":3:hard:exact"), hard = hardFrame(kind + ":3:hard");
    EXPECT_EQ(cv::norm(hard.instances, exact.instances, cv::NORM_INF), 0);
    EXPECT_EQ(lostShare(exact), 0) << kind;
    EXPECT_GT(lostShare(hard), lostShare(hardFrame(kind + ":3:uneven"))) << kind;
    EXPECT_LT(lostShare(hard), 0.7) << kind;
  }
}

TEST(HardScenes, ShowFlatThingsOnTables) {
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    SyntheticOptions options;
    options.recipe = [seed] { return synthetic::makeHardTabletopScene(seed); };
    options.K = options.K.resizedTo(320, 240);
    options.noise = options.color = false;
    options.stride = 40;
    const auto source = makeSyntheticSource(options).value();
    const SyntheticScene& scene = source->scene();
    const double top = scene.boundsOf(scene.find("table")).max().z();
    std::map<std::uint16_t, int> seen;
    for (FrameRead read = source->next(); read.status == FrameRead::Status::frame; read = source->next())
      for (const std::uint16_t id : cv::Mat_<std::uint16_t>(read.frame.instances)) ++seen[id];
    const auto flat = std::ranges::count_if(scene.instances(), [&](const InstanceName& who) {
      const Eigen::AlignedBox3d box = scene.boundsOf(who.id);
      const bool is_on_table = box.min().z() > top - 0.001 && box.min().z() < top + 0.1;
      return who.is_object && is_on_table && box.sizes().z() < 0.015 && seen[who.id] > 50;
    });
    EXPECT_GE(flat, 3) << "seed " << seed;
  }
}

TEST(HardScenes, HavePatternedGroundsAndPrint) {
  std::set<Pattern> grounds;
  int printed = 0, boxes = 0;
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    const SyntheticScene scene = synthetic::makeHardTabletopScene(seed).scene;
    std::set<std::uint16_t> done;
    for (const SyntheticScene::Part& part : scene.parts()) {
      const std::string& name = scene.instances()[part.instance - 1U].name;
      const bool is_first = done.insert(part.instance).second;
      if (is_first && (name == "table" || name == "tablecloth")) grounds.insert(part.material.pattern);
      const bool is_box = name == "box" || name.starts_with("box ");
      boxes += is_box ? 1 : 0;
      printed += is_box && part.material.pattern == Pattern::packaging ? 1 : 0;
    }
  }
  EXPECT_TRUE(grounds.contains(Pattern::grain));
  EXPECT_GE(grounds.size(), 4U);
  EXPECT_GT(printed, boxes / 3);
  EXPECT_GT(boxes, 5);
}

TEST(HardMaterials, HaveGroundsOfHighContrast) {
  synthetic::HashStream random(5);
  const Material wood = synthetic::randomWood(random);
  Material grain = wood;
  grain.pattern = Pattern::grain;
  grain.scale = 0.02F;
  EXPECT_GT(contrastOf(grain), 0.12);
  for (const Pattern pattern : {Pattern::floral, Pattern::tartan, Pattern::packaging, Pattern::page,
                                Pattern::magazine, Pattern::keys}) {
    Material material{pattern, synthetic::rgb(0xe8e0d0), synthetic::rgb(0x803030), synthetic::rgb(0x204060)};
    material.scale = 0.06F;
    EXPECT_GT(contrastOf(material), 0.12) << static_cast<int>(pattern);
  }
  EXPECT_LT(contrastOf(Material{Pattern::plain, synthetic::rgb(0xe8e0d0)}), 0.05);
}

TEST(HardMaterials, LetCamerasFail) {
  int glossy = 0, dark = 0, transparent = 0;
  for (std::uint32_t seed = 1; seed <= 6; ++seed) {
    const SyntheticScene scene = synthetic::makeHardTabletopScene(seed).scene;
    for (const SyntheticScene::Part& part : scene.parts()) {
      glossy += part.material.gloss > 0.8F ? 1 : 0;
      dark += part.material.darkness > 0.7F ? 1 : 0;
      transparent += part.material.transparency > 0.6F ? 1 : 0;
      EXPECT_LE(part.material.gloss, 1);
      EXPECT_LT(part.material.darkness, 1);
      EXPECT_LT(part.material.transparency, 1);
    }
  }
  EXPECT_GT(glossy, 10);
  EXPECT_GT(dark, 10);
  EXPECT_GT(transparent, 5);
}

TEST(HardScenes, AreEqual_WhenSeedsAreEqual) {
  for (const std::string scene : {"room:5:hard", "tabletop:5:hard", "hands:5"}) {
    const RgbdFrame once = hardFrame(scene), again = hardFrame(scene);
    EXPECT_EQ(cv::norm(once.depth, again.depth, cv::NORM_INF), 0) << scene;
    EXPECT_EQ(cv::norm(once.color, again.color, cv::NORM_INF), 0) << scene;
    EXPECT_EQ(cv::norm(once.instances, again.instances, cv::NORM_INF), 0) << scene;
    EXPECT_TRUE(once.T_world_camera->matrix() == again.T_world_camera->matrix()) << scene;
  }
  EXPECT_GT(cv::countNonZero(hardFrame("room:5:hard").instances != hardFrame("room:6:hard").instances),
            50000);
  EXPECT_GT(cv::countNonZero(hardFrame("room:5:hard").instances != hardFrame("room:5").instances), 50000);
}

TEST(HardScenes, AreNamedByASuffixInAnyOrder) {
  const auto same = [](const std::string& a, const std::string& b) {
    return cv::norm(hardFrame(a).depth, hardFrame(b).depth, cv::NORM_INF) == 0;
  };
  EXPECT_TRUE(same("room:hard:5", "room:5:hard"));
  EXPECT_TRUE(same("tabletop:hard", "tabletop:1:hard"));
  EXPECT_TRUE(same("hands", "hands:1:hard"));
  EXPECT_FALSE(same("room:5:hard", "room:5:hard:uneven"));
  for (const char* scene : {"wall:hard", "corridor:hard", "sweep:3:hard", "moving:hard"}) {
    const auto refused = makeSyntheticSource(scene, {});
    ASSERT_FALSE(refused) << scene;
    EXPECT_THAT(refused.error().message(), testing::HasSubstr(":hard"));
  }
}

}  // namespace
}  // namespace scantrove
