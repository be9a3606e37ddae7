#pragma once
#include <Eigen/Core>
#include <map>

#include "core/discovery/discovery_params.h"
#include "core/discovery/region_set.h"

namespace scantrove {

/// Observations of sets of regions, from which complete objects are chosen. Drops sets that were not seen for
/// kMemory frames.
class ObservationHistory {
 public:
  static constexpr int kMemory = 900;  ///< frames

  struct Observation {
    float outline = 0,
          hidden = 0;  ///< as in Candidate; `hidden` less the extra part that mostHidden() accepts
    Eigen::Vector3f size_m = Eigen::Vector3f::Zero();     ///< of the oriented box
    Eigen::Vector3f direction = Eigen::Vector3f::Zero();  ///< unit, from the object to the camera, world
  };

  /// Starts the next frame.
  void nextFrame();
  /// Adds an observation of this frame. One with a clearly different size is ignored; several in a row reset
  /// the set's history, because the object has changed.
  void add(const RegionSet& regions, const Observation& observation);
  /// `from` is now part of `into`. If two sets become equal, the one with more observations is kept.
  void joinRegions(RegionId into, RegionId from);

  /// Seen often enough, from two directions or for long enough, with its own outline (DiscoveryParams).
  [[nodiscard]] bool isComplete(const RegionSet& regions, const DiscoveryParams& params) const;

  [[nodiscard]] std::size_t setCount() const { return watched_.size(); }

 private:
  struct Watched {
    int observations = 0;
    int others = 0;                             ///< observations of another size, in a row, at the end
    float outline = 0, hidden = 0, size_m = 0;  ///< means; the size is the box's diagonal
    Eigen::Vector3f first_direction = Eigen::Vector3f::Zero();
    float widest_angle_rad = 0;  ///< between the first direction and another
    int first_frame = 0, last_frame = 0;
  };
  std::map<RegionSet, Watched> watched_;
  int frame_ = 0;
};

}  // namespace scantrove
