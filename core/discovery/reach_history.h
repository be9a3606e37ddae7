#pragma once
#include <Eigen/Core>
#include <array>
#include <map>
#include <opencv2/core/types.hpp>

#include "core/discovery/candidate_finder.h"

namespace scantrove {

/// How far regions reach in the world, and where they were seen to end. What the image cuts off in one frame
/// it may show in another: a region that was seen to its end in every direction is known whole, though
/// perhaps no frame shows all of it. Forgets what was not seen for a while.
class ReachHistory {
 public:
  static constexpr int kMemory = 900;  ///< frames

  /// The next frame. `visible_px`: its part in which regions do not end because the image does. Regions
  /// larger than `max_size_m` are of no interest.
  void add(const DiscoveryInput& input, const cv::Rect& visible_px, float max_size_m);

  /// It was seen to its end in every direction, and for `frames` frames it has not grown.
  [[nodiscard]] bool isSeenToItsEnds(RegionId region, int frames) const;
  /// How much of its extent the last frame showed, in the direction in which it showed least; 0 .. 1.
  [[nodiscard]] float shownPart(RegionId region) const;
  /// The sides of the box that fits its extents best: along the axes of the world, along these turned by 45
  /// degrees about one of them, or along `axes` (columns of a rotation), as the last frame suggests them. 0:
  /// it is not known, or too large.
  [[nodiscard]] Eigen::Vector3f sizeOf(RegionId region,
                                       const Eigen::Matrix3f& axes = Eigen::Matrix3f::Identity()) const;

  /// It is not what it was: it starts anew.
  void forget(RegionId region) { reaches_.erase(region); }

  [[nodiscard]] std::size_t regionCount() const { return reaches_.size(); }

  /// The axes of a cube, of its faces' diagonals, and its own diagonals; each seen from both ends.
  static constexpr std::size_t kAxes = 13;

 private:
  struct End {
    float far_m = 0;        ///< along the direction, the farthest there ever was
    bool is_shown = false;  ///< it ends there: where it was farthest, the image went on
  };
  struct Reach {
    std::array<End, 2 * kAxes> ends = {};  ///< direction 2 i is axis i, and 2 i + 1 its opposite
    int last_grown = 0, last_seen = 0;     ///< frames
    float shown_part = 0;                  ///< in the last of them
    bool is_too_large = false;
  };
  struct Seen;
  void follow(RegionId region, const Seen& seen, float max_size_m);

  std::map<RegionId, Reach> reaches_;
  int frame_ = 0;
};

}  // namespace scantrove
