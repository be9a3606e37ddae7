#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/base/ids.h"
#include "core/discovery/candidate.h"
#include "core/discovery/discovery_params.h"
#include "core/discovery/region_census.h"
#include "core/fusion/rendered_view.h"

namespace scantrove {

/// What discovery may look at in one frame.
struct DiscoveryInput {
  const RenderedView& view;
  /// By pixel: those of the view, none where the frame contradicts the map.
  std::span<const RegionId> regions = view.regions;
  /// Log-odds that two regions that touch are one thing; below 0, or they would be. Empty: no sets of
  /// regions.
  std::function<float(RegionId, RegionId)> joining_odds = {};
  /// By pixel: not 0 for what came into the scene and rests there now. Empty: nothing did.
  std::span<const std::uint8_t> appeared = {};
  /// By pixel: CIE L*a*b* of the surface, a little blurred. Empty: the image has no colour.
  std::span<const Eigen::Vector3f> color_lab = {};
};

/// Says what may be an object in one frame.
class CandidateSource {
 public:
  virtual ~CandidateSource() = default;
  /// Candidates of this frame, by their regions. They may overlap: each is one way to see the scene (see
  /// chooseDisjoint).
  [[nodiscard]] virtual std::vector<Candidate> find(const DiscoveryInput& input) = 0;
  /// What find() saw last.
  [[nodiscard]] virtual const RegionCensus& census() const = 0;
};

/// One way to discover objects while a scan runs; others plug in here. Keeps what it needs to know of earlier
/// frames.
class CandidateFinder : public CandidateSource {
 public:
  virtual void setParams(const DiscoveryParams& params) = 0;
  /// `from` is now part of `into`: its history goes with it.
  virtual void regionsJoined(RegionId into, RegionId from) = 0;
  /// `from` is not as large any more.
  virtual void regionParted(RegionId from) = 0;
};

/// The rules of thesis 5.1 (central, persistent in size, size in range, not flat, not eccentric, off the
/// border) for regions and for sets of neighbours (ch. 6), and of what passes them, which is whole.
[[nodiscard]] std::unique_ptr<CandidateFinder> makeRuleBasedFinder(const DiscoveryParams& params);

/// Of candidates that share regions only the best: the one that the catalogue speaks for (`known`, by index,
/// higher is better, 0: nothing), that is whole, whose outline is its own, that is likely to be one. In order
/// of their regions.
[[nodiscard]] std::vector<std::size_t> chooseDisjoint(std::span<const Candidate> candidates,
                                                      std::span<const float> known);

}  // namespace scantrove
