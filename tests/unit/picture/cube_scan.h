#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/dataset/labeled_scan.h"
#include "core/picture/picture_surface.h"

namespace scantrove::test {

/// The corners of the cube from -1 to 1: bit 0 of the index is x, bit 1 y, bit 2 z.
inline Eigen::Vector3f cubeCorner(std::size_t i) {
  return {(i & 1U) != 0 ? 1.0F : -1.0F, (i & 2U) != 0 ? 1.0F : -1.0F, (i & 4U) != 0 ? 1.0F : -1.0F};
}

/// Two triangles a side, counter-clockwise from outside: the sides -x, +x, -y, +y, -z, +z.
inline std::vector<std::array<std::uint32_t, 3>> cubeFaces() {
  return {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
          {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
}

/// The cube with one color for all sides.
inline PictureSurface cubeSurface(const Rgb& color) {
  PictureSurface surface;
  for (std::size_t i = 0; i < 8; ++i) surface.vertices.push_back({cubeCorner(i), {0, 0, 0}, color});
  surface.faces = cubeFaces();
  return surface;
}

/// A scan of two cubes without common corners: region 3, "mug", at the origin, and region 5, unnamed, 6 m
/// along x; both green. One key frame at (0, -8, 0), upright with z up.
class CubeScan final : public LabeledScan {
 public:
  [[nodiscard]] std::string name() const override { return "cubes"; }
  [[nodiscard]] Result<std::vector<LabeledRegion>> regions() override {
    LabeledRegion mug, other;
    mug.id = 3;
    mug.name = "mug";
    other.id = 5;
    return std::vector<LabeledRegion>{mug, other};
  }
  [[nodiscard]] Result<std::vector<KeyFrameInfo>> keyFrames(bool) override {
    KeyFrameInfo frame;
    frame.T_world_depth.translation() = Eigen::Vector3d(0, -8, 0);
    frame.T_world_depth.linear() << 1, 0, 0, 0, 0, 1, 0, -1, 0;  // x right, y down, z forward
    return std::vector<KeyFrameInfo>{frame};
  }
  [[nodiscard]] Result<cv::Mat> color(int) override { return cv::Mat(); }
  [[nodiscard]] Result<cv::Mat> depth(int) override { return cv::Mat(); }
  [[nodiscard]] Result<ViewOfMap> renderView(const Intrinsics&, const Eigen::Isometry3d&) override {
    return ViewOfMap();
  }
  [[nodiscard]] Result<LabeledMesh> mesh() override {
    LabeledMesh mesh;
    for (const auto& [region, x] : {std::pair{3U, 0.0F}, std::pair{5U, 6.0F}}) {
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      for (std::size_t i = 0; i < 8; ++i) {
        const Eigen::Vector3f corner = cubeCorner(i);
        mesh.vertices.push_back(
            {corner + Eigen::Vector3f(x, 0, 0), corner.normalized(), {0, 255, 0}, region});
      }
      for (const auto& face : cubeFaces())
        mesh.faces.push_back({face[0] + first, face[1] + first, face[2] + first});
    }
    return mesh;
  }
  [[nodiscard]] Result<void> forEachPoint(const std::function<void(const SurfacePoint&)>&) override {
    return {};
  }
  [[nodiscard]] Result<Trajectory> trajectory() override { return Trajectory(); }
};

}  // namespace scantrove::test
