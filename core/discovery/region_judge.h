#pragma once
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "core/discovery/candidate_finder.h"
#include "core/discovery/objectness/objectness_evidence.h"
#include "core/discovery/region_hypotheses.h"
#include "core/discovery/region_samples.h"

namespace scantrove {

/// Rates which regions and sets of regions are one complete object, after the scan has ended, from one
/// observation and all known points. CandidateFinder, during the scan, needs observations of the complete
/// object. Here parts may be cut off or occluded.
class RegionJudge final : public CandidateSource {
 public:
  RegionJudge(const DiscoveryParams& params, RegionSamples known)
      : params_(params), known_(std::move(known)) {}

  /// From now on skips sets for which `asked` is false, to save time. By default no set is skipped.
  void askOnlyOf(std::function<bool(const RegionSet&)> asked) { asked_ = std::move(asked); }

  struct Judged {
    RegionHypothesis hypothesis;
    ObjectnessEvidence evidence;
  };
  /// All sets that are no larger than objects and sufficiently in view. Calls `input.joining_odds` from
  /// several threads at once.
  [[nodiscard]] std::vector<Judged> judge(const DiscoveryInput& input);
  /// The results of judge() as candidates, with Candidate::objectness.
  [[nodiscard]] std::vector<Candidate> find(const DiscoveryInput& input) override;
  [[nodiscard]] const RegionCensus& census() const override { return census_; }

 private:
  [[nodiscard]] const RegionSamples::Shape& shapeOf(const RegionSet& regions);

  DiscoveryParams params_;
  std::function<bool(const RegionSet&)> asked_;  // empty: all
  RegionSamples known_;
  std::map<RegionSet, RegionSamples::Shape> shapes_;  // computed on demand
  RegionCounter counter_;
  RegionCensus census_;
};

}  // namespace scantrove
