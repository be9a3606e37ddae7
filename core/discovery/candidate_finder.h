#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/base/ids.h"
#include "core/discovery/candidate.h"
#include "core/discovery/discovery_params.h"
#include "core/discovery/region_census.h"
#include "core/fusion/rendered_view.h"

namespace scantrove {

/// Of the pixels of a region in all frames so far.
struct SupportShares {
  float support = 0;  ///< the part that was a support: a table, the floor
  float carried = 0;  ///< the part that lay on one
};

/// Input of discovery for one frame.
struct DiscoveryInput {
  const RenderedView& view;
  /// By pixel: the view's regions; none where the frame contradicts the map.
  std::span<const RegionId> regions = view.regions;
  /// Log-odds that two touching regions are one object; below 0, since others are joined already. Empty: no
  /// sets of regions.
  std::function<float(RegionId, RegionId)> joining_odds = {};
  /// By pixel: not 0 for an object that appeared and is at rest. Empty: none.
  std::span<const std::uint8_t> appeared = {};
  /// By pixel: CIE L*a*b* of the surface, slightly blurred. Empty: no colour.
  std::span<const Eigen::Vector3f> color_lab = {};
  /// Of a region of `regions`. Empty: nothing is known.
  std::function<SupportShares(RegionId)> support_shares = {};
};

/// Finds the candidates of one frame.
class CandidateSource {
 public:
  virtual ~CandidateSource() = default;
  /// Candidates of this frame, ordered by their regions. They may overlap (see chooseDisjoint).
  [[nodiscard]] virtual std::vector<Candidate> find(const DiscoveryInput& input) = 0;
  /// The regions of the last find().
  [[nodiscard]] virtual const RegionCensus& census() const = 0;
};

/// Discovers objects while a scan runs. Keeps its own history of earlier frames.
class CandidateFinder : public CandidateSource {
 public:
  virtual void setParams(const DiscoveryParams& params) = 0;
  /// `from` is now part of `into`, with its history.
  virtual void regionsJoined(RegionId into, RegionId from) = 0;
  /// `from` has lost fragments.
  virtual void regionParted(RegionId from) = 0;
};

/// Keeps the best of candidates that share regions, ordered by their regions. Criteria in order: a match in
/// the catalogue (`known`, by index, higher is better, 0: none), completeness, own outline, odds.
[[nodiscard]] std::vector<std::size_t> chooseDisjoint(std::span<const Candidate> candidates,
                                                      std::span<const float> known);

}  // namespace scantrove
