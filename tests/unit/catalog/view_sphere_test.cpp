#include "core/catalog/view_sphere.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace scantrove {
namespace {

Eigen::Vector3f at(float degrees) {
  const float a = degrees * std::numbers::pi_v<float> / 180.0F;
  return {std::cos(a), std::sin(a), 0};
}

TEST(ViewSphere, KeepsNewDirectionsOfEachObject) {
  ViewSphere sphere(DetectionParams{});
  const ObjectId mug{1}, box{2};
  EXPECT_TRUE(sphere.isNew(mug, at(0)));
  sphere.keep(mug, at(0));
  EXPECT_FALSE(sphere.isNew(mug, at(19)));
  EXPECT_FALSE(sphere.isNew(mug, 3 * at(-19)));
  EXPECT_TRUE(sphere.isNew(mug, at(21)));
  EXPECT_TRUE(sphere.isNew(box, at(0)));
  sphere.keep(mug, at(21));
  EXPECT_FALSE(sphere.isNew(mug, at(30)));
  EXPECT_TRUE(sphere.isNew(mug, at(180)));
}

TEST(ViewSphere, HasRoomForSoManyViews) {
  DetectionParams params;
  params.max_views = 3;
  ViewSphere sphere(params);
  const ObjectId mug{1};
  sphere.countStored(mug, 1);
  for (const float angle : {0.0F, 60.0F}) {
    EXPECT_TRUE(sphere.isNew(mug, at(angle)));
    sphere.keep(mug, at(angle));
  }
  EXPECT_FALSE(sphere.isNew(mug, at(120)));
}

TEST(ViewSphere, RefusesWhatIsNoDirection) {
  const ViewSphere sphere(DetectionParams{});
  EXPECT_FALSE(sphere.isNew(ObjectId{1}, Eigen::Vector3f::Zero()));
  EXPECT_FALSE(sphere.isNew(ObjectId{1}, Eigen::Vector3f(NAN, 0, 1)));
}

TEST(ViewSphere, MergeJoinsTheViews) {
  ViewSphere sphere(DetectionParams{});
  sphere.keep(ObjectId{1}, at(0));
  sphere.keep(ObjectId{2}, at(90));
  sphere.merge(ObjectId{1}, ObjectId{2});
  EXPECT_FALSE(sphere.isNew(ObjectId{1}, at(91)));
  EXPECT_TRUE(sphere.isNew(ObjectId{2}, at(91)));
}

}  // namespace
}  // namespace scantrove
