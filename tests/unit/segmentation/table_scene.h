#pragma once
#include <cmath>
#include <opencv2/core/types.hpp>
#include <vector>

#include "core/segmentation/segment_map.h"
#include "tests/support/analytic_scene.h"

namespace scantrove::test {

/// A table (z = 0 in the world) with boxes on it, seen from above at 45 degrees. Around the table there is no
/// depth. The table is segment 1, the boxes are segments 2, 3, ... in the order of addBox().
class TableScene {
 public:
  static constexpr Intrinsics kCamera{285, 285, 159.5F, 119.5F, 320, 240};
  static constexpr std::uint32_t kTable = 1;
  static constexpr double kFillsTheImage = 100;

  explicit TableScene(double half_side_m = kFillsTheImage) : half_side_m_(half_side_m) {
    table_.plane(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ());
  }

  TableScene& addBox(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    boxes_.emplace_back().box(low, high);
    return *this;
  }

  [[nodiscard]] static Eigen::Isometry3d camera() {
    return lookAt({0, -0.7, 0.7}, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ());
  }
  /// Depth of the table's plane in a pixel.
  [[nodiscard]] float tableDepth(int u, int v) const {
    return static_cast<float>(table_.seenBy(kCamera, camera(), u, v)->t);
  }
  [[nodiscard]] static cv::Point pixelOf(const Eigen::Vector3d& point_world) {
    const Eigen::Vector3d p = camera().inverse() * point_world;
    return {static_cast<int>(std::lround(kCamera.fx * p.x() / p.z() + kCamera.cx)),
            static_cast<int>(std::lround(kCamera.fy * p.y() / p.z() + kCamera.cy))};
  }

  /// The segmentation by depth.
  [[nodiscard]] SegmentMap segments() const {
    SegmentMap map;
    map.width = kCamera.width;
    map.height = kCamera.height;
    map.areas.assign(boxes_.size() + 2, 0);
    for (int v = 0; v < kCamera.height; ++v) {
      for (int u = 0; u < kCamera.width; ++u) {
        std::uint32_t id = 0;
        double z_m = 0;
        const auto see = [&](std::uint32_t surface, double t) {
          if (id != 0 && t >= z_m) return;
          id = surface;
          z_m = t;
        };
        const auto table = table_.seenBy(kCamera, camera(), u, v);
        if (table && isOnTable(u, v, table->t)) see(kTable, table->t);
        std::uint32_t surface = kTable;
        for (const AnalyticScene& box : boxes_) {
          ++surface;
          if (const auto hit = box.seenBy(kCamera, camera(), u, v)) see(surface, hit->t);
        }
        map.ids.push_back(id);
        map.depths_m.push_back(static_cast<float>(z_m));
        ++map.areas[id];
      }
    }
    return map;
  }

 private:
  [[nodiscard]] bool isOnTable(int u, int v, double t) const {
    const Eigen::Vector3d point =
        camera() * (t * Eigen::Vector3d((u - static_cast<double>(kCamera.cx)) / kCamera.fx,
                                        (v - static_cast<double>(kCamera.cy)) / kCamera.fy, 1));
    return std::abs(point.x()) <= half_side_m_ && std::abs(point.y()) <= half_side_m_;
  }

  double half_side_m_;
  AnalyticScene table_;
  std::vector<AnalyticScene> boxes_;
};

}  // namespace scantrove::test
