#pragma once
#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <vector>

#include "core/discovery/candidate_finder.h"
#include "core/discovery/region_census.h"
#include "core/discovery/region_set.h"

namespace scantrove::test {

// CIE L*a*b*, at bins of a ColorHistogram: 25 apart.
inline const Eigen::Vector3f kGrayLab{50, 0, 0}, kRedLab{50, 50, 25};

/// A camera of 160 x 120 at the origin of a world turned and moved by `T_world_camera`, looking at regions
/// that are painted as image rectangles with a depth for each pixel.
struct PaintedScene {
  mutable RenderedView view{{150, 150, 79.5F, 59.5F, 160, 120}};  ///< input() makes its view.normals_world
  std::function<float(RegionId, RegionId)> joining_odds;
  std::vector<std::uint8_t> appeared;
  std::vector<Eigen::Vector3f> color_lab;

  PaintedScene() {
    view.regions.assign(static_cast<std::size_t>(view.K.pixels()), RegionId{});
    view.vertices_world.assign(view.regions.size(), Eigen::Vector4f::Zero());
    view.T_world_camera =
        Eigen::Translation3d(0.3, -1, 2) * Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized());
    paint(1, {0, 0, view.K.width, view.K.height}, [](int, int) { return 2.0F; });  // a wall behind everything
  }

  void paint(std::uint32_t region, const cv::Rect& box, const std::function<float(int, int)>& depth) {
    for (int v = box.y; v < box.br().y; ++v) {
      for (int u = box.x; u < box.br().x; ++u) {
        const auto pixel = static_cast<std::size_t>(v * view.K.width + u);
        view.regions[pixel] = RegionId{region};
        const Eigen::Vector3f p =
            view.K.backProject(static_cast<float>(u), static_cast<float>(v), depth(u, v));
        view.vertices_world[pixel] << (view.T_world_camera * p.cast<double>()).cast<float>(), 1;
      }
    }
  }

  /// Colours all painted pixels of the region; other pixels without a colour become black.
  void color(std::uint32_t region, const Eigen::Vector3f& lab) {
    color_lab.resize(view.regions.size(), Eigen::Vector3f::Zero());
    for (std::size_t i = 0; i < view.regions.size(); ++i) {
      if (view.regions[i] == RegionId{region}) color_lab[i] = lab;
    }
  }

  /// A bulge towards the camera (height 1: like half a ball) over the rectangle, so that it is not flat.
  void paintBump(std::uint32_t region, const cv::Rect& box, float z, float height = 1) {
    paint(region, box, [&](int u, int v) {
      const float x = (static_cast<float>(u - box.x) + 0.5F) / static_cast<float>(box.width) * 2 - 1;
      const float y = (static_cast<float>(v - box.y) + 0.5F) / static_cast<float>(box.height) * 2 - 1;
      const float radius = static_cast<float>(box.width) * z / view.K.fx / 2;
      return z - height * radius * std::sqrt(std::max(0.0F, 1 - (x * x + y * y) / 2));
    });
  }

  /// The inside of a bowl over the rectangle, 8 cm behind its rim.
  void paintBowl(std::uint32_t region, const cv::Rect& box, float rim_z) {
    paint(region, box, [&](int u, int v) {
      const float x = (static_cast<float>(u - box.x) + 0.5F) / static_cast<float>(box.width) * 2 - 1;
      const float y = (static_cast<float>(v - box.y) + 0.5F) / static_cast<float>(box.height) * 2 - 1;
      return rim_z + 0.08F * std::sqrt(std::max(0.0F, 2 - x * x - y * y));
    });
  }

  /// The extent of all `regions` together.
  [[nodiscard]] RegionExtent extentOf(const RegionSet& regions) const {
    RegionExtent extent;
    for (int v = 0; v < view.K.height; ++v) {
      for (int u = 0; u < view.K.width; ++u) {
        if (!regions.contains(view.regions[static_cast<std::size_t>(v * view.K.width + u)])) continue;
        ++extent.pixels;
        extent.box_px |= cv::Rect(u, v, 1, 1);
        extent.sum_u += u;
        extent.sum_v += v;
        extent.sum_uu += u * u;
        extent.sum_uv += u * v;
        extent.sum_vv += v * v;
      }
    }
    return extent;
  }

  /// Normals follow from the view.vertices_world, by differences within a region.
  [[nodiscard]] DiscoveryInput input() const {
    view.normals_world.assign(view.vertices_world.size(), Eigen::Vector4f::Zero());
    for (int v = 0; v < view.K.height; ++v) {
      for (int u = 0; u < view.K.width; ++u) {
        const Eigen::Vector3f normal = difference(u, v, 0, 1).cross(difference(u, v, 1, 0));
        if (normal.norm() > 0)
          view.normals_world[static_cast<std::size_t>(v * view.K.width + u)] << normal.normalized(), 1;
      }
    }
    return {view, view.regions, joining_odds, appeared, color_lab};
  }

 private:
  /// Difference to the next pixel of the region, else from the previous one; zero without either.
  [[nodiscard]] Eigen::Vector3f difference(int u, int v, int du, int dv) const {
    const auto at = [this](int x, int y) { return static_cast<std::size_t>(y * view.K.width + x); };
    const auto isSameRegion = [&](int x, int y) {
      return x >= 0 && y >= 0 && x < view.K.width && y < view.K.height &&
             view.regions[at(x, y)] == view.regions[at(u, v)];
    };
    if (isSameRegion(u + du, v + dv))
      return (view.vertices_world[at(u + du, v + dv)] - view.vertices_world[at(u, v)]).head<3>();
    if (isSameRegion(u - du, v - dv))
      return (view.vertices_world[at(u, v)] - view.vertices_world[at(u - du, v - dv)]).head<3>();
    return Eigen::Vector3f::Zero();
  }
};

}  // namespace scantrove::test
