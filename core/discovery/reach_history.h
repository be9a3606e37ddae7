#pragma once
#include <Eigen/Core>
#include <array>
#include <map>
#include <opencv2/core/types.hpp>

#include "core/discovery/candidate_finder.h"

namespace scantrove {

/// The extents of regions in the world, and the directions in which their ends were seen. A region whose ends
/// were all seen is completely known, even if no single frame shows all of it. Drops regions that were not
/// seen for kMemory frames.
class ReachHistory {
 public:
  static constexpr int kMemory = 900;  ///< frames

  /// Adds a frame. `visible_px`: its part in which the image's edge does not cut off regions. Regions larger
  /// than `max_size_m` are ignored.
  void add(const DiscoveryInput& input, const cv::Rect& visible_px, float max_size_m);

  /// True if its end was seen in every direction and it has not grown for `frames` frames.
  [[nodiscard]] bool isSeenToItsEnds(RegionId region, int frames) const;
  /// The part of its extent that the last frame showed, in the direction with the smallest part; 0 .. 1.
  [[nodiscard]] float shownPart(RegionId region) const;
  /// The sides of the box that fits its extents best; 0 if it is unknown or too large. The box lies along the
  /// world axes, along these turned by 45 degrees about one of them, or along `axes` (columns of a rotation,
  /// as the last frame suggests).
  [[nodiscard]] Eigen::Vector3f sizeOf(RegionId region,
                                       const Eigen::Matrix3f& axes = Eigen::Matrix3f::Identity()) const;

  /// Drops the history of a region that has changed.
  void forget(RegionId region) { reaches_.erase(region); }

  [[nodiscard]] std::size_t regionCount() const { return reaches_.size(); }

  /// The axes of a cube, the diagonals of its faces, and its space diagonals; each in both directions.
  static constexpr std::size_t kAxes = 13;

 private:
  struct End {
    float far_m = 0;        ///< along the direction, maximum over all frames
    bool is_shown = false;  ///< the image continued beyond the farthest point
  };
  struct Reach {
    std::array<End, 2 * kAxes> ends = {};  ///< direction 2 i is axis i, and 2 i + 1 its opposite
    int last_grown = 0, last_seen = 0;     ///< frames
    float shown_part = 0;                  ///< in frame last_seen
    bool is_too_large = false;
  };
  struct Seen;
  void update(RegionId region, const Seen& seen, float max_size_m);

  std::map<RegionId, Reach> reaches_;
  int frame_ = 0;
};

}  // namespace scantrove
