#include <gtest/gtest.h>

#include <cmath>

#include "core/synthetic/lighting.h"
#include "core/synthetic/placed_part.h"

namespace scantrove::synthetic {
namespace {

/// A table top at z = 0 and a post that casts a shadow on it.
SyntheticScene makeTopWithPost() {
  SyntheticScene scene;
  const auto id = scene.addInstance("table", false);
  addBox(scene, id, {}, {2, 2, 0.02}, 0, {}, {0, 0, -0.02});
  addBox(scene, id, {}, {0.1, 0.1, 0.3}, 0, {}, {0.4, 0, 0});
  return scene;
}

/// Light of places on the top, as seen from `eye`.
class LitTop {
 public:
  explicit LitTop(const Lights& lights) : lighting_(makeTopWithPost(), Vec3::Zero(), 1.2, lights) {}
  [[nodiscard]] float at(const Eigen::Vector2d& place, const Vec3& eye, float gloss) const {
    Material material;
    material.gloss = gloss;
    const Vec3 point(place.x(), place.y(), 0);
    const Vec3 to_eye = (eye - point).normalized();
    return lighting_.shade(point, Vec3::UnitZ(), to_eye, Rgb::Constant(0.3F), material, 1).sum();
  }
  [[nodiscard]] Eigen::Vector2d brightest(const Vec3& eye, float gloss) const {
    Eigen::Vector2d best = Eigen::Vector2d::Zero();
    for (double x = -0.9; x <= 0.9; x += 0.02) {
      for (double y = -0.9; y <= 0.9; y += 0.02) {
        if (at({x, y}, eye, gloss) > at(best, eye, gloss)) best = {x, y};
      }
    }
    return best;
  }

 private:
  Lighting lighting_;
};

const Lights kFromLeft{.to_sun = {-1, 0, 1}, .lamp = {}};

TEST(Highlights, FollowTheCamera) {
  const LitTop top(kFromLeft);
  // The mirrored ray (1, 0, 1) meets an eye at height 0.6 where the eye is 0.6 m farther along x.
  for (const double x : {0.2, 0.6}) {
    const Eigen::Vector2d brightest = top.brightest({x, 0.3, 0.6}, 0.8F);
    EXPECT_NEAR(brightest.x(), x - 0.6, 0.08);
    EXPECT_NEAR(brightest.y(), 0.3, 0.08);
  }
}

TEST(Highlights, ShowALamp_WhenItsMirrorImageIsInView) {
  const LitTop without(kFromLeft);
  Lights lights = kFromLeft;
  lights.lamp = Vec3(-0.6, 0, 1.2);
  const LitTop with(lights);
  const auto lampLight = [&](const Vec3& eye, float gloss) {
    return with.at({0, 0}, eye, gloss) - without.at({0, 0}, eye, gloss);
  };
  EXPECT_GT(lampLight({0.6, 0, 1.2}, 0.8F), 1);  // sum of three channels
  EXPECT_LT(lampLight({0.6, 0.6, 1.2}, 0.8F), 0.5);
  EXPECT_EQ(lampLight({0.6, 0, 1.2}, 0), 0) << "it lights no matt surface";
}

TEST(Shadows, StayInPlace_WhenTheCameraMoves) {
  const LitTop top(kFromLeft);
  const Eigen::Vector2d in_shadow(0.6, 0), lit(0.6, 0.4);
  for (const Vec3& eye : {Vec3(0.2, 0.3, 0.6), Vec3(-0.5, -0.6, 1.0)}) {
    EXPECT_LT(top.at(in_shadow, eye, 0), 0.7F * top.at(lit, eye, 0));
    EXPECT_EQ(top.at(in_shadow, eye, 0), top.at(in_shadow, Vec3(0, 0, 2), 0));
    EXPECT_EQ(top.at(lit, eye, 0), top.at(lit, Vec3(0, 0, 2), 0));
  }
}

}  // namespace
}  // namespace scantrove::synthetic
