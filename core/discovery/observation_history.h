#pragma once
#include <Eigen/Core>
#include <map>

#include "core/discovery/discovery_params.h"
#include "core/discovery/region_set.h"

namespace scantrove {

/// What sets of regions looked like, for saying which of them are whole things. Forgets what was not seen for
/// a while.
class ObservationHistory {
 public:
  static constexpr int kMemory = 900;  ///< frames

  struct Observation {
    float outline = 0, hidden = 0;                        ///< as in Candidate; less what may be hidden more
    Eigen::Vector3f size_m = Eigen::Vector3f::Zero();     ///< of the oriented box
    Eigen::Vector3f direction = Eigen::Vector3f::Zero();  ///< unit, from the thing to the camera, world
  };

  /// Time goes on by a frame.
  void nextFrame();
  /// A look in this frame. One of clearly another size does not count; several in a row start anew: it is not
  /// the same thing any more.
  void add(const RegionSet& regions, const Observation& look);
  /// `from` is now part of `into`: where that makes two sets one, the one with more looks stays.
  void follow(RegionId into, RegionId from);

  /// Seen often enough, from two directions or for long enough, with an outline that was its own.
  [[nodiscard]] bool isComplete(const RegionSet& regions, const DiscoveryParams& params) const;

  [[nodiscard]] std::size_t setCount() const { return watched_.size(); }

 private:
  struct Watched {
    int observations = 0;
    int others = 0;                             ///< the last so many were of another size
    float outline = 0, hidden = 0, size_m = 0;  ///< means; the size is the box's diagonal
    Eigen::Vector3f first_direction = Eigen::Vector3f::Zero();
    float widest_angle_rad = 0;  ///< between the first direction and another
    int first_frame = 0, last_frame = 0;
  };
  std::map<RegionSet, Watched> watched_;
  int frame_ = 0;
};

}  // namespace scantrove
