#include "tests/render/scene_fixture.h"

namespace scantrove {
namespace {

using test::SceneTest;

class ViewpointTest : public SceneTest {
 protected:
  /// The viewing direction of a standard view.
  Eigen::Vector3f directionOf(StandardView view) {
    scene_.lookFrom(view);
    return scene_.viewpoint().forward();
  }
};

TEST_F(ViewpointTest, StandardViewsAreRelativeToTheSensor) {
  const Eigen::Vector3f ahead = Eigen::Vector3f::UnitZ();
  const Eigen::Vector3f right = Eigen::Vector3f::UnitX();
  const Eigen::Vector3f down = Eigen::Vector3f::UnitY();
  EXPECT_GT(directionOf(StandardView::front).dot(ahead), 0.999F);
  EXPECT_FALSE(scene_.following());
  EXPECT_GT(directionOf(StandardView::back).dot(-ahead), 0.999F);
  EXPECT_GT(directionOf(StandardView::left).dot(right), 0.999F) << "the left view looks to the right";
  EXPECT_GT(directionOf(StandardView::right).dot(-right), 0.999F);
  EXPECT_GT(directionOf(StandardView::top).dot(down), 0.99F);
  EXPECT_GT(directionOf(StandardView::top).dot(ahead), 0) << "the forward direction points up in the image";
  EXPECT_GT(directionOf(StandardView::bottom).dot(-down), 0.99F);
}

TEST_F(ViewpointTest, StandardViewsKeepTheTarget) {
  scene_.viewpoint().lookAt({0, -1, 0}, {0.3F, 0.2F, 2});
  const Eigen::Vector3f target = scene_.viewpoint().target();
  const float distance = scene_.viewpoint().distance();
  scene_.lookFrom(StandardView::left);
  EXPECT_EQ(scene_.viewpoint().target(), target);
  EXPECT_EQ(scene_.viewpoint().distance(), distance);
}

TEST_F(ViewpointTest, FitShowsABoxAndKeepsTheDirection) {
  scene_.viewpoint().lookAt({0, -1, 0}, {0, 0, 2});
  const Eigen::Vector3f direction = scene_.viewpoint().forward();
  const Eigen::AlignedBox3f box(Eigen::Vector3f(1, 1, 1), Eigen::Vector3f(1.2F, 1.3F, 1.1F));
  scene_.fit(box, 1.5F);
  EXPECT_LT((scene_.viewpoint().forward() - direction).norm(), 1e-4F);
  for (int corner = 0; corner < 8; ++corner) {
    const auto position =
        scene_.viewpoint().positionOf(box.corner(static_cast<Eigen::AlignedBox3f::CornerType>(corner)), 1.5F);
    ASSERT_TRUE(position);
    EXPECT_LE(position->cwiseAbs().maxCoeff(), 1);
  }
  const Eigen::Vector3f eye = scene_.viewpoint().eye();
  scene_.fit({}, 1.5F);
  EXPECT_EQ(scene_.viewpoint().eye(), eye);
}

TEST_F(ViewpointTest, PlaceOfInvertsRayAt) {
  scene_.viewpoint().lookAt({0.2F, -1, 0}, {0, 0, 2});
  const Eigen::Vector3f ray = scene_.viewpoint().rayAt(0.4F, -0.7F, 1.6F);
  const auto position = scene_.viewpoint().positionOf(scene_.viewpoint().eye() + 3 * ray, 1.6F);
  ASSERT_TRUE(position);
  EXPECT_NEAR(position->x(), 0.4F, 1e-4);
  EXPECT_NEAR(position->y(), -0.7F, 1e-4);
  EXPECT_FALSE(scene_.viewpoint().positionOf(scene_.viewpoint().eye() - ray, 1.6F));
}

}  // namespace
}  // namespace scantrove
