#pragma once
#include <Eigen/Geometry>
#include <map>
#include <span>
#include <vector>

#include "core/labeling/region_map.h"
#include "core/labeling/region_table.h"

namespace scantrove {

/// Learns from each frame from which directions the fragments in it are seen: those from the middle of what
/// is seen of their region, as they are parts of one thing. One thread; cost: a read of every fourth pixel.
class ObservationRecorder {
 public:
  /// Fewer of an image's pixels are no look: one in so many of the whole image, and so many at least.
  static constexpr int kMinPart = 1500;
  static constexpr int kMinPixels = 16;

  /// `vertices_world`: V_t, as large as `map`, w = 0: no surface.
  void record(const RegionMap& map, std::span<const Eigen::Vector4f> vertices_world,
              const Eigen::Isometry3d& T_world_camera, RegionTable& table);

 private:
  struct Seen {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    int points = 0;
  };
  std::vector<Seen> seen_;            // by fragment; zero between frames
  std::map<RegionId, Seen> regions_;  // of the frame
  std::vector<FragmentId> in_view_;   // of the frame
};

}  // namespace scantrove
