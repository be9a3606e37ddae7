#include "core/fusion/depth_preprocessor.h"

#include <gtest/gtest.h>

#include "tests/kernels/tracking/tracking_test_support.h"
#include "tests/support/each_device.h"

namespace scantrove::test {
namespace {

std::unique_ptr<DepthPreprocessor> make(ComputeContext& compute, const Intrinsics& K,
                                        const FusionParams& params = {}) {
  auto preprocessor = DepthPreprocessor::create(compute, K, params);
  EXPECT_TRUE(preprocessor) << preprocessor.error().message();
  return std::move(*preprocessor);
}

int countValid(const std::vector<cl_float4>& map) {
  return static_cast<int>(
      std::count_if(map.begin(), map.end(), [](const cl_float4& e) { return e.s[3] == 1.0F; }));
}

TEST(DepthPreprocessor, PyramidHasTheDocumentedSizes) {
  onEachWidth([](ComputeContext& compute) {
    struct Case {
      int width, height, working, level_width, level_height;
    };
    for (const Case& c : {Case{640, 480, 320, 320, 240}, Case{317, 233, 320, 317, 233},
                          Case{317, 233, 160, 160, 118}, Case{848, 480, 320, 320, 181}}) {
      const Intrinsics K{500, 500, 300, 200, c.width, c.height};
      const auto preprocessor = make(compute, K, {.working_width = c.working});
      RgbdFrame frame;
      frame.depth = cv::Mat(c.height, c.width, CV_16UC1, cv::Scalar(1500));
      const DepthPyramid& pyramid = preprocessor->process(frame);
      ASSERT_EQ(pyramid.levels.size(), 3U);
      EXPECT_EQ(pyramid.depth_m.size(), static_cast<std::size_t>(K.pixels()));
      EXPECT_EQ(pyramid.levels[0].K.width, c.level_width);
      EXPECT_EQ(pyramid.levels[0].K.height, c.level_height);
      for (std::size_t level = 0; level < 3; ++level) {
        const Intrinsics& k = pyramid.levels[level].K;
        if (level > 0) {
          EXPECT_EQ(k.width, pyramid.levels[level - 1].K.width / 2);
        }
        const auto vertices = pyramid.levels[level].vertices_camera.read(compute.queue());
        ASSERT_EQ(vertices.size(), static_cast<std::size_t>(k.pixels()));
        EXPECT_EQ(countValid(vertices), k.pixels());
        EXPECT_FLOAT_EQ(vertices.back().s[2], 1.5F);
        EXPECT_NEAR(vertices.back().s[0], (static_cast<float>(k.width - 1) - k.cx) * 1.5F / k.fx, 1e-5F);
        EXPECT_EQ(countValid(pyramid.levels[level].normals_camera.read(compute.queue())), k.pixels());
      }
    }
  });
}

TEST(DepthPreprocessor, RefusesImages_WhenTheyAreTooNarrow) {
  onEachDevice([](ComputeContext& compute) {
    const auto narrow = DepthPreprocessor::create(compute, {15, 15, 7, 20, 15, 40}, {});
    ASSERT_FALSE(narrow);
    EXPECT_NE(narrow.error().message().find("at least 16 pixels wide"), std::string::npos);
    EXPECT_TRUE(DepthPreprocessor::create(compute, {16, 16, 8, 20, 16, 40}, {}));
  });
}

TEST(DepthPreprocessor, GivesPositionAndNormalOfAPlane) {
  onEachWidth([](ComputeContext& compute) {
    const Eigen::Vector3d point(0, 0, 1.5), normal = Eigen::Vector3d(0.4, -0.3, -1).normalized();
    AnalyticScene scene;
    scene.plane(point, normal);
    const auto preprocessor = make(compute, kKinect);
    const DepthPyramid& pyramid =
        preprocessor->process(frameOf(scene, kKinect, Eigen::Isometry3d::Identity()));
    for (const DepthPyramid::Level& level : pyramid.levels) {
      const auto vertices = level.vertices_camera.read(compute.queue());
      const auto normals = level.normals_camera.read(compute.queue());
      for (int v = 1; v + 1 < level.K.height; ++v) {
        for (int u = 1; u + 1 < level.K.width; ++u) {
          const auto i = static_cast<std::size_t>(v * level.K.width + u);
          const Eigen::Vector3d p(vertices[i].s[0], vertices[i].s[1], vertices[i].s[2]);
          const Eigen::Vector3d n(normals[i].s[0], normals[i].s[1], normals[i].s[2]);
          // Units of 0.2 mm, averaged; the mean over a slanted square adds 0.1 mm.
          ASSERT_NEAR(normal.dot(p - point), 0, 4e-4);
          ASSERT_GT(n.dot(normal), 0.995);
        }
      }
    }
  });
}

TEST(DepthPreprocessor, SphereNormalsPointOutwardsAndIgnoreOtherSurfaces) {
  onEachWidth([](ComputeContext& compute) {
    const Eigen::Vector3d center(0, 0, 1.4);
    AnalyticScene scene;
    scene.sphere(center, 0.3).plane({0, 0, 2.5}, {0, 0, -1});
    const auto preprocessor = make(compute, kKinect);
    const DepthPyramid& pyramid =
        preprocessor->process(frameOf(scene, kKinect, Eigen::Isometry3d::Identity()));
    const DepthPyramid::Level& level = pyramid.levels.front();
    const auto vertices = level.vertices_camera.read(compute.queue());
    const auto normals = level.normals_camera.read(compute.queue());
    int on_ball = 0, on_wall = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      if (normals[i].s[3] == 0.0F) continue;
      const Eigen::Vector3d p(vertices[i].s[0], vertices[i].s[1], vertices[i].s[2]);
      const Eigen::Vector3d n(normals[i].s[0], normals[i].s[1], normals[i].s[2]);
      EXPECT_NEAR(n.norm(), 1, 1e-5);
      if (p.z() > 2.4) {
        ++on_wall;
        ASSERT_GT(-n.z(), 0.99);  // a normal across the edge would be tilted
      } else {
        ASSERT_LT(p.z(), 1.45);  // no vertices between ball and wall
        const Eigen::Vector3d outwards = (p - center).normalized();
        if (-outwards.dot(p.normalized()) < 0.4) continue;  // grazing
        ++on_ball;
        ASSERT_GT(n.dot(outwards), 0.96);
      }
    }
    EXPECT_GT(on_ball, 5000);
    EXPECT_GT(on_wall, 40000);
  });
}

TEST(DepthPreprocessor, GivesEmptyMaps_WithoutReadings) {
  onEachWidth([](ComputeContext& compute) {
    const auto preprocessor = make(compute, kKinect);
    RgbdFrame frame;
    for (const int value : {0, 65535}) {
      frame.depth = cv::Mat(480, 640, CV_16UC1, cv::Scalar(value));
      const DepthPyramid& pyramid = preprocessor->process(frame);
      for (const float z : pyramid.depth_m.read(compute.queue())) ASSERT_EQ(z, 0.0F);
      for (const DepthPyramid::Level& level : pyramid.levels) {
        for (const cl_float4& element : level.vertices_camera.read(compute.queue())) {
          for (const float value_of : element.s) ASSERT_EQ(value_of, 0.0F);
        }
        EXPECT_EQ(countValid(level.normals_camera.read(compute.queue())), 0);
      }
    }
  });
}

TEST(DepthPreprocessor, UsesTheFramesOwnCamera_AndThenThatOfTheRecordingAgain) {
  onEachWidth([](ComputeContext& compute) {
    const auto preprocessor = make(compute, kKinect, {.working_width = 320});
    RgbdFrame frame;
    frame.depth = cv::Mat(480, 640, CV_16UC1, cv::Scalar(2000));
    const Intrinsics own{600, 601, 322, 238, 640, 480};
    for (const bool has_own : {true, false}) {
      frame.intrinsics = has_own ? std::optional(own) : std::nullopt;
      const Intrinsics expected = has_own ? own : kKinect;
      const DepthPyramid& pyramid = preprocessor->process(frame);
      EXPECT_EQ(pyramid.K, expected);
      EXPECT_EQ(pyramid.levels[0].K, expected.resizedTo(320, 240));
      EXPECT_FLOAT_EQ(pyramid.levels[1].K.fx, expected.fx / 4);
      // A corner of the plane 2 m away, seen at full resolution in pixel 0.5.
      const cl_float4 first = pyramid.levels[0].vertices_camera.read(compute.queue()).front();
      EXPECT_NEAR(first.s[0], (0.5F - expected.cx) / expected.fx * 2, 1e-4F);
      EXPECT_NEAR(first.s[1], (0.5F - expected.cy) / expected.fy * 2, 1e-4F);
    }
  });
}

TEST(DepthPreprocessor, LeavesOutReadings_OfLowConfidence) {
  onEachWidth([](ComputeContext& compute) {
    const auto preprocessor = make(compute, kKinect);
    RgbdFrame frame;
    frame.depth = cv::Mat(480, 640, CV_16UC1, cv::Scalar(2000));
    frame.depth(cv::Rect(100, 100, 60, 60)) = 1990;  // a little off: the filter would mix them
    frame.confidence = cv::Mat(480, 640, CV_8UC1, cv::Scalar(kMediumConfidence));
    frame.confidence(cv::Rect(100, 100, 60, 60)) = kLowConfidence;
    const DepthPyramid& pyramid = preprocessor->process(frame);
    const std::vector<float> depth_m = pyramid.depth_m.read(compute.queue());
    EXPECT_EQ(std::ranges::count(depth_m, 0.0F), 60 * 60);
    EXPECT_EQ(depth_m[130 * 640 + 130], 0.0F);
    for (const cl_float4& vertex : pyramid.levels[0].vertices_camera.read(compute.queue())) {
      if (vertex.s[3] > 0) {
        ASSERT_FLOAT_EQ(vertex.s[2], 2);
      }
    }
  });
}

TEST(DepthPreprocessor, GivesFiniteValues_InHoles) {
  onEachWidth([](ComputeContext& compute) {
    const auto preprocessor = make(compute, kKinect);
    RgbdFrame frame;
    frame.depth = cv::Mat::zeros(480, 640, CV_16UC1);
    for (int i = 0; i < 640 * 480; i += 7)
      frame.depth.at<std::uint16_t>(i / 640, i % 640) = static_cast<std::uint16_t>(i);
    const DepthPyramid& pyramid = preprocessor->process(frame);
    for (const DepthPyramid::Level& level : pyramid.levels) {
      for (const auto* map : {&level.vertices_camera, &level.normals_camera}) {
        for (const cl_float4& element : map->read(compute.queue())) {
          for (const float value : element.s) ASSERT_TRUE(std::isfinite(value));
        }
      }
    }
  });
}

}  // namespace
}  // namespace scantrove::test
