#pragma once
#include <Eigen/Geometry>
#include <memory>
#include <span>
#include <vector>

#include "core/base/ids.h"
#include "core/capture/intrinsics.h"
#include "core/discovery/candidate.h"
#include "core/discovery/discovery_params.h"
#include "core/labeling/region_map.h"

namespace scantrove {

/// What discovery may look at in one frame.
struct DiscoveryInput {
  const RegionMap& regions;
  std::span<const Eigen::Vector4f> vertices_world;  ///< V_t on the host; w = 0 = no surface
  Intrinsics K;                                     ///< of the working resolution
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
};

/// One way to discover objects; others plug in here.
class CandidateFinder {
 public:
  virtual ~CandidateFinder() = default;
  virtual void setParams(const DiscoveryParams& params) = 0;
  /// Candidates of this frame, by region id. Keeps what it needs to know of earlier frames.
  [[nodiscard]] virtual std::vector<Candidate> find(const DiscoveryInput& input) = 0;
  /// `from` is now part of `into`: its history goes with it.
  virtual void regionsMerged(RegionId into, RegionId from) = 0;
};

/// The rules of thesis 5.1: central, persistent in size, size in range, not flat, not eccentric, off the
/// border.
[[nodiscard]] std::unique_ptr<CandidateFinder> makeRuleBasedFinder(const DiscoveryParams& params);

}  // namespace scantrove
