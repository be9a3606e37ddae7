#include "core/picture/turntable_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/picture/cube_scan.h"

namespace scantrove::test {
namespace {

/// Where the camera stands.
Eigen::Vector3f placeOf(const PictureCamera& camera) { return camera.T_camera_world.inverse().translation(); }

void expectNear(const Eigen::Vector3f& actual, const Eigen::Vector3f& expected) {
  EXPECT_LT((actual - expected).norm(), 1e-4F)
      << actual.transpose() << " instead of " << expected.transpose();
}

// The sphere around the cube has the radius sqrt(3); with 5 % around it, it fills a field of view of 40
// degrees.
const float kDistance_m = static_cast<float>(1.05 * std::sqrt(3.0) / std::sin(20 * std::numbers::pi / 180));

TEST(TurntableCamera, StandsWhereItsAnglesSay) {
  const TurntableCamera orbit(cubeSurface({}), {0, 0, 1}, {1, 0, 0}, 640, 480);
  expectNear(placeOf(orbit.at(0, 0)), {kDistance_m, 0, 0});
  expectNear(placeOf(orbit.at(90, 0)), {0, kDistance_m, 0});  // counter-clockwise from above
  expectNear(placeOf(orbit.at(0, 90)), {0, 0, kDistance_m});
  expectNear(placeOf(orbit.at(0, 30)), {kDistance_m * std::sqrt(3.0F) / 2, 0, kDistance_m / 2});
}

TEST(TurntableCamera, LooksAtTheMiddle_WithUpUp) {
  const TurntableCamera orbit(cubeSurface({}), {0, 0, 1}, {1, 0, 0}, 640, 480);
  for (const double azimuth_deg : {0.0, 45.0, 200.0}) {
    for (const double elevation_deg : {-90.0, -20.0, 0.0, 60.0, 90.0}) {
      const PictureCamera camera = orbit.at(azimuth_deg, elevation_deg);
      expectNear(camera.T_camera_world * Eigen::Vector3f(0, 0, 0), {0, 0, kDistance_m});
      const Eigen::Vector3f up = camera.T_camera_world.linear() * Eigen::Vector3f(0, 0, 1);
      EXPECT_NEAR(up.x(), 0, 1e-5) << "no roll";
      EXPECT_NEAR(up.y(), -std::cos(elevation_deg * std::numbers::pi / 180), 1e-5);
      EXPECT_NEAR(camera.T_camera_world.linear().determinant(), 1, 1e-5);
    }
  }
}

TEST(TurntableCamera, ContentIsWithinThePicture_FromEverySide) {
  const PictureSurface cube = cubeSurface({});
  const TurntableCamera orbit(cube, {0, 0, 1}, {1, 0, 0}, 300, 500);
  for (int azimuth_deg = 0; azimuth_deg < 360; azimuth_deg += 15) {
    const PictureCamera camera = orbit.at(azimuth_deg, 30);
    for (const PictureSurface::Vertex& vertex : cube.vertices) {
      const Eigen::Vector3f p = camera.T_camera_world * vertex.position_world_m;
      const float x = camera.focal_px * p.x() / p.z() + camera.centerX();
      const float y = camera.focal_px * p.y() / p.z() + camera.centerY();
      EXPECT_TRUE(x >= 0 && x <= 299 && y >= 0 && y <= 499) << x << " " << y;
    }
  }
}

}  // namespace
}  // namespace scantrove::test
