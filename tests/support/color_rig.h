#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/fusion/color_integrator.h"
#include "core/fusion/dense_map.h"
#include "tests/support/analytic_scene.h"

namespace scantrove::test {

/// An analytic scene with colours: red, green, blue in 0 .. 255 by world position.
struct PaintedScene {
  AnalyticScene shape;
  std::function<Eigen::Vector3d(const Eigen::Vector3d& p_world)> paint;

  /// CV_8UC3, BGR; black without a surface.
  [[nodiscard]] cv::Mat photograph(const Intrinsics& K, const Eigen::Isometry3d& T_world_camera) const {
    cv::Mat image(K.height, K.width, CV_8UC3, cv::Scalar(0, 0, 0));
    for (int v = 0; v < K.height; ++v) {
      for (int u = 0; u < K.width; ++u) {
        const auto hit = shape.seenBy(K, T_world_camera, u, v);
        if (!hit) continue;
        const Eigen::Vector3d ray =
            K.backProject(static_cast<float>(u), static_cast<float>(v), 1).cast<double>();
        const Eigen::Vector3d rgb = paint(T_world_camera * (hit->t * ray));
        image.at<cv::Vec3b>(v, u) = {static_cast<uchar>(std::lround(rgb.z())),
                                     static_cast<uchar>(std::lround(rgb.y())),
                                     static_cast<uchar>(std::lround(rgb.x()))};
      }
    }
    return image;
  }

  /// Whether another surface lies between `eye` and a point of a surface.
  [[nodiscard]] bool isHidden(const Eigen::Vector3d& p_world, const Eigen::Vector3d& eye) const {
    const auto hit = shape.cast(eye, p_world - eye);
    return hit && hit->t < 0.98;
  }
};

/// One view of a scene: a frame with exact depth, and the surface of the map.
struct ColorShot {
  RgbdFrame frame;
  DepthPyramid depth;
  SurfaceMaps surface;
  RenderedView view;
  cv::Mat hidden;
};

/// Fuses views of an analytic scene and their colours into a map. Depth images have the working resolution.
class ColorRig {
 public:
  ColorRig(ComputeContext& compute, const FusionParams& params) : compute_(compute) {
    auto map = DenseMap::create(compute, params);
    EXPECT_TRUE(map) << (map ? "" : map.error().message());
    map_ = std::move(*map);
    auto integrator = ColorIntegrator::create(compute, params);
    EXPECT_TRUE(integrator) << (integrator ? "" : integrator.error().message());
    integrator_ = std::move(*integrator);
  }

  /// Fuses the depth of a view and raycasts the map. Without `camera`, colour is registered, of `color_size`.
  [[nodiscard]] ColorShot observe(const PaintedScene& scene, const Intrinsics& K, const Eigen::Isometry3d& T,
                                  const std::optional<ColorCamera>& camera, const cv::Size& color_size = {}) {
    ColorShot shot;
    const std::vector<float> depth_m = scene.shape.depth(K, T);
    shot.depth.K = K;
    shot.depth.depth_m = {compute_.context(), depth_m.size()};
    shot.depth.depth_m.write(compute_.queue(), std::span<const float>(depth_m));
    std::vector<cl_float4> readings;
    for (int i = 0; i < K.pixels(); ++i) {
      const float z = depth_m[static_cast<std::size_t>(i)];
      const Eigen::Vector3f p =
          K.backProject(static_cast<float>(i % K.width), static_cast<float>(i / K.width), z);
      readings.push_back({{p.x(), p.y(), p.z(), z > 0 ? 1.0F : 0.0F}});
    }
    DepthPyramid::Level level{K, {compute_.context(), readings.size()}, {}};
    level.vertices_camera.write(compute_.queue(), std::span<const cl_float4>(readings));
    shot.depth.levels.push_back(level);
    map_->integrate(shot.depth, T);
    map_->raycast(T, K, shot.surface);
    const ColorCamera seen_by = camera.value_or(
        ColorCamera{K.resizedTo(color_size.width, color_size.height), Eigen::Isometry3d::Identity()});
    const Eigen::Isometry3d T_world_color = T * seen_by.T_color_depth.inverse();
    shot.frame.color_camera = camera;
    shot.frame.color = scene.photograph(seen_by.K, T_world_color);
    shot.hidden = cv::Mat::zeros(K.height, K.width, CV_8UC1);
    shot.view = readView(compute_, shot.surface);
    for (std::size_t pixel = 0; pixel < shot.view.vertices_world.size(); ++pixel) {
      const Eigen::Vector4f& v = shot.view.vertices_world[pixel];
      if (v.w() > 0 && camera && scene.isHidden(v.head<3>().cast<double>(), T_world_color.translation()))
        shot.hidden.ptr<uchar>()[pixel] = 255;
    }
    return shot;
  }

  void paint(const ColorShot& shot) {
    integrator_->integrate(map_->bricks(), {shot.surface, shot.view, shot.depth, shot.hidden}, shot.frame);
  }

  void show(const PaintedScene& scene, const Intrinsics& K, const Eigen::Isometry3d& T,
            const std::optional<ColorCamera>& camera, const cv::Size& color_size = {}) {
    paint(observe(scene, K, T, camera, color_size));
  }

  [[nodiscard]] DenseMap& map() { return *map_; }

 private:
  ComputeContext& compute_;
  std::unique_ptr<DenseMap> map_;
  std::optional<ColorIntegrator> integrator_;
};

}  // namespace scantrove::test
