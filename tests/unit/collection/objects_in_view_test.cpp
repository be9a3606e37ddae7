#include "core/collection/objects_in_view.h"

#include <gtest/gtest.h>

namespace scantrove {
namespace {

constexpr RegionId kTableTop{1}, kBody{2}, kHandle{3}, kCrumb{4};
constexpr ObjectId kTheMug{7}, kTheCrumb{9};

ObjectId objectOf(RegionId region) {
  if (region == kBody || region == kHandle) return kTheMug;
  return region == kCrumb ? kTheCrumb : ObjectId{};
}

/// A table of 10 x 8 pixels with a mug of two regions and a crumb, in depth and colour of one camera.
class ObjectsInViewTest : public testing::Test {
 protected:
  ObjectsInViewTest() {
    view_.K = {10, 10, 4.5F, 3.5F, 10, 8};
    view_.regions.assign(80, kTableTop);
    fill({2, 3, 3, 4}, kBody);
    fill({5, 4, 1, 2}, kHandle);
    fill({8, 1, 1, 1}, kCrumb);
    in_color_ = locateInColor(std::nullopt, view_);
  }
  void fill(const cv::Rect& pixels, RegionId region) {
    for (int v = pixels.y; v < pixels.br().y; ++v) {
      for (int u = pixels.x; u < pixels.br().x; ++u)
        view_.regions[static_cast<std::size_t>(v * view_.K.width + u)] = region;
    }
  }
  [[nodiscard]] std::vector<SeenObject> visibleObjects(int least_pixels) const {
    return objectsInView(view_, in_color_, objectOf, least_pixels);
  }

  RenderedView view_;
  SurfaceInColor in_color_;
};

TEST_F(ObjectsInViewTest, OneRectangleHoldsAllRegions) {
  const std::vector<SeenObject> objects = visibleObjects(2);
  ASSERT_EQ(objects.size(), 1U) << "the crumb is too small";
  const SeenObject& mug = objects.front();
  EXPECT_EQ(mug.object, kTheMug);
  EXPECT_EQ(mug.regions, (RegionSet{kBody, kHandle}));
  // Columns 2 to 5 of 10, rows 3 to 6 of 8, whole pixels.
  EXPECT_NEAR(mug.box.x, 0.2F, 1e-6F);
  EXPECT_NEAR(mug.box.y, 3 / 8.0F, 1e-6F);
  EXPECT_NEAR(mug.box.width, 0.4F, 1e-6F);
  EXPECT_NEAR(mug.box.height, 0.5F, 1e-6F);
}

TEST_F(ObjectsInViewTest, OnePixelCounts_WhenThatIsEnough) {
  const std::vector<SeenObject> objects = visibleObjects(1);
  ASSERT_EQ(objects.size(), 2U);
  EXPECT_EQ(objects[0].object, kTheMug);
  EXPECT_EQ(objects[1].object, kTheCrumb);
}

TEST_F(ObjectsInViewTest, RectangleIsSmaller_WhenColorDoesNotShowAllOfTheObject) {
  in_color_.hidden(cv::Rect(5, 0, 1, 8)).setTo(255);  // the handle
  const std::vector<SeenObject> objects = visibleObjects(2);
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_EQ(objects.front().regions, RegionSet{kBody});
  EXPECT_NEAR(objects.front().box.width, 0.3F, 1e-6F);
}

TEST(ObjectsInView, RectangleLeavesOutStrayPixels_AndHoldsPartsBehindAnOccluder) {
  constexpr Intrinsics kWide{60, 60, 39.5F, 29.5F, 80, 60};
  RenderedView view;
  view.K = kWide;
  view.regions.assign(static_cast<std::size_t>(kWide.pixels()), kTableTop);
  const auto fill = [&](const cv::Rect& pixels, RegionId region) {
    for (int v = pixels.y; v < pixels.br().y; ++v)
      for (int u = pixels.x; u < pixels.br().x; ++u) view.regions[kWide.indexOf(u, v)] = region;
  };
  fill({20, 20, 20, 20}, kBody);
  fill({26, 20, 4, 20}, kTableTop);  // an occluder
  fill({70, 5, 2, 1}, kBody);        // two of 322 pixels
  const std::vector<SeenObject> objects =
      objectsInView(view, locateInColor(std::nullopt, view), objectOf, 10);
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_NEAR(objects.front().box.x, 20 / 80.0F, 1e-6F);
  EXPECT_NEAR(objects.front().box.y, 20 / 60.0F, 1e-6F);
  EXPECT_NEAR(objects.front().box.width, 20 / 80.0F, 1e-6F);
  EXPECT_NEAR(objects.front().box.height, 20 / 60.0F, 1e-6F);
}

TEST_F(ObjectsInViewTest, NothingIsInView_WhenNoRegionIsAnObject) {
  EXPECT_TRUE(objectsInView(
                  view_, in_color_, [](RegionId) { return ObjectId{}; }, 1)
                  .empty());
}

}  // namespace
}  // namespace scantrove
