#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "core/discovery/observation_history.h"
#include "core/discovery/oriented_box.h"
#include "core/discovery/region_census.h"
#include "core/discovery/size_history.h"

namespace scantrove {
namespace {

TEST(RegionCensus, EqualsPixelByPixelSums) {
  std::mt19937 random(5);
  std::vector<RegionId> regions;
  for (int i = 0; i < 37 * 23; ++i)
    regions.push_back(RegionId{static_cast<std::uint32_t>(random() % 3 == 0 ? random() % 5 : 2)});
  RegionCounter counter;
  for (int repeat = 0; repeat < 2; ++repeat) {
    const RegionCensus census = counter.count(regions, 37);
    ASSERT_EQ(census.extents.size(), 4U);
    for (const RegionExtent& extent : census.extents) {
      double n = 0, u1 = 0, v1 = 0, uu = 0, uv = 0, vv = 0;
      for (int v = 0; v < 23; ++v) {
        for (int u = 0; u < 37; ++u) {
          if (regions[static_cast<std::size_t>(v * 37 + u)] != extent.region) continue;
          n += 1, u1 += u, v1 += v, uu += u * u, uv += u * v, vv += v * v;
        }
      }
      EXPECT_EQ(extent.pixels, n);
      EXPECT_EQ(extent.sum_u, u1);
      EXPECT_EQ(extent.sum_v, v1);
      EXPECT_EQ(extent.sum_uu, uu);
      EXPECT_EQ(extent.sum_uv, uv);
      EXPECT_EQ(extent.sum_vv, vv);
    }
  }
}

TEST(RegionCensus, MeasuresTheEccentricityOfARectangle) {
  // A rectangle a x b has second moments a^2/12 and b^2/12, so e = sqrt(1 - (b/a)^2) anywhere.
  std::vector<RegionId> regions(6000);
  for (int v = 10; v < 20; ++v) {
    for (int u = 30; u < 80; ++u) regions[static_cast<std::size_t>(v * 100 + u)] = RegionId{3};
  }
  const RegionCensus census = RegionCounter().count(regions, 100);
  ASSERT_EQ(census.extents.size(), 1U);
  EXPECT_NEAR(census.extents[0].eccentricity(), std::sqrt(1 - 0.04), 1e-6);
  EXPECT_EQ(census.labeled_px, cv::Rect(30, 10, 50, 10));
  EXPECT_EQ(census.regionsOfSize(500), std::vector<RegionId>{RegionId{3}});
  EXPECT_TRUE(census.regionsOfSize(501).empty());
}

TEST(OrientedBox, MeasuresATurnedBox) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit(-0.5F, 0.5F);
  const Eigen::Matrix3f R =
      Eigen::AngleAxisf(1.1F, Eigen::Vector3f(1, -2, 0.5F).normalized()).toRotationMatrix();
  std::vector<Eigen::Vector4f> points;
  for (int i = 0; i < 20000; ++i) {
    const Eigen::Vector3f p =
        R * Eigen::Vector3f(0.1F * unit(random), 0.4F * unit(random), 0.2F * unit(random));
    points.emplace_back(p.x() + 5, p.y() - 3, p.z() + 1, 1.0F);
  }
  points.emplace_back(9.0F, 9.0F, 9.0F, 1.0F);  // an outlier
  const OrientedBox box = fitOrientedBox(points);
  // 98 % of each side, within the sampling error of 4096 points.
  EXPECT_NEAR(box.size_m[0], 0.392F, 0.01F);
  EXPECT_NEAR(box.size_m[1], 0.196F, 0.01F);
  EXPECT_NEAR(box.size_m[2], 0.098F, 0.01F);
  EXPECT_LT((box.mean - Eigen::Vector3f(5, -3, 1)).norm(), 0.01F);
}

TEST(OrientedBox, IsFlatForAPlaneAndZero_WithoutPoints) {
  std::vector<Eigen::Vector4f> points;
  for (int i = 0; i < 400; ++i) {
    points.emplace_back(0.01F * static_cast<float>(i % 20), 0.01F * static_cast<float>(i / 20), 1.0F, 1.0F);
  }
  EXPECT_LT(fitOrientedBox(points).thickness_ratio, 1e-3F);
  EXPECT_LT(fitOrientedBox(points).size_m[2], 1e-4F);
  EXPECT_EQ(fitOrientedBox({}).size_m, Eigen::Vector3f(0, 0, 0));
}

TEST(SizeHistory, KeepsOnlySetsOfTheLastFrame) {
  SizeHistory history;
  const RegionSet always{RegionId{1000}};
  for (std::uint32_t frame = 0; frame < 100; ++frame) {
    const SizeHistory::Sighting sightings[] = {{{RegionId{frame + 1}}, 1.0F}, {always, 1.0F}};
    history.add(sightings, 5);
    EXPECT_EQ(history.setCount(), 2U);
  }
  EXPECT_TRUE(history.isPersistent(always, 5, 0.1F));
  EXPECT_FALSE(history.isPersistent({RegionId{100}}, 5, 0.1F));
}

TEST(SizeHistory, FollowsJoins_InEverySet) {
  SizeHistory history;
  const RegionSet both{RegionId{1}, RegionId{2}}, with_third{RegionId{2}, RegionId{3}};
  const SizeHistory::Sighting sightings[] = {{both, 1.0F}, {with_third, 2.0F}};
  history.add(sightings, 5);
  history.joinRegions(RegionId{1}, RegionId{2});
  EXPECT_TRUE(history.isPersistent({RegionId{1}}, 1, 0.1F));
  EXPECT_TRUE(history.isPersistent({RegionId{1}, RegionId{3}}, 1, 0.1F));
  EXPECT_FALSE(history.isPersistent(both, 1, 0.1F));
}

DiscoveryParams observationParams() {
  DiscoveryParams params;
  params.complete_observations = 4;
  params.complete_outline = 0.8F;
  params.complete_hidden = 0.3F;
  params.complete_angle_deg = 10;
  params.still_frames = 50;
  return params;
}

ObservationHistory::Observation seenFrom(float degrees, float outline = 0.9F, float hidden = 0,
                                         float size_m = 0.2F) {
  const float radians = degrees * 3.14159265F / 180;
  return {outline, hidden, Eigen::Vector3f(size_m, 0, 0),
          Eigen::Vector3f(std::sin(radians), 0, std::cos(radians))};
}

TEST(ObservationHistory, IsComplete_AfterObservationsFromTwoDirectionsWithOwnOutline) {
  const RegionSet object{RegionId{5}};
  const auto is_complete = [&](int observations, float degrees, float outline, float hidden) {
    ObservationHistory history;
    for (int i = 0; i < observations; ++i) {
      history.nextFrame();
      history.add(object, seenFrom(i == 0 ? 0 : degrees, outline, hidden));
    }
    return history.isComplete(object, observationParams());
  };
  EXPECT_TRUE(is_complete(4, 11, 0.9F, 0.1F));
  EXPECT_FALSE(is_complete(3, 11, 0.9F, 0.1F));
  EXPECT_FALSE(is_complete(4, 9, 0.9F, 0.1F));
  EXPECT_TRUE(is_complete(51, 0, 0.9F, 0.1F)) << "one direction, but many observations";
  EXPECT_FALSE(is_complete(4, 11, 0.7F, 0.1F));
  EXPECT_FALSE(is_complete(4, 11, 0.9F, 0.4F));
  EXPECT_FALSE(ObservationHistory().isComplete(object, observationParams()));
}

TEST(ObservationHistory, IsReset_AfterSeveralObservationsOfAnotherSize) {
  const RegionSet object{RegionId{5}};
  ObservationHistory history;
  for (int i = 0; i < 4; ++i) {
    history.nextFrame();
    history.add(object, seenFrom(4.0F * static_cast<float>(i)));
  }
  ASSERT_TRUE(history.isComplete(object, observationParams()));
  const auto observationOfAnotherSize = [&] {
    history.nextFrame();
    history.add(object, seenFrom(20, 0.9F, 0, 0.5F));
  };
  observationOfAnotherSize();
  observationOfAnotherSize();
  EXPECT_TRUE(history.isComplete(object, observationParams())) << "two observations may be a brief occlusion";
  history.nextFrame();
  history.add(object, seenFrom(20));
  observationOfAnotherSize();
  observationOfAnotherSize();
  EXPECT_TRUE(history.isComplete(object, observationParams())) << "not consecutive";
  observationOfAnotherSize();  // the set was divided or joined
  EXPECT_FALSE(history.isComplete(object, observationParams()));
}

TEST(ObservationHistory, DropsSets_WhenUnseenForLong) {
  ObservationHistory history;
  history.nextFrame();
  history.add({RegionId{5}}, seenFrom(0));
  for (int i = 0; i < ObservationHistory::kMemory; ++i) history.nextFrame();
  EXPECT_EQ(history.setCount(), 1U);
  history.nextFrame();
  EXPECT_EQ(history.setCount(), 0U);
}

TEST(ObservationHistory, KeepsTheSetWithMoreObservations_WhenRegionsJoin) {
  ObservationHistory history;
  for (int i = 0; i < 4; ++i) {
    history.nextFrame();
    history.add({RegionId{5}}, seenFrom(4.0F * static_cast<float>(i)));
    if (i == 0) history.add({RegionId{6}}, seenFrom(0));
  }
  history.joinRegions(RegionId{6}, RegionId{5});
  EXPECT_FALSE(history.isComplete({RegionId{5}}, observationParams()));
  EXPECT_TRUE(history.isComplete({RegionId{6}}, observationParams())) << "the set with more observations";
}

}  // namespace
}  // namespace scantrove
