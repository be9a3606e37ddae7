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

/// Says which regions and sets of regions are one whole thing, once nothing more comes of a scan: by a look
/// and by all that is known of them. What CandidateFinder says while a scan runs waits for looks that show
/// a thing entirely; here the image may cut some of it off, and others may hide some.
class RegionJudge final : public CandidateSource {
 public:
  RegionJudge(const DiscoveryParams& params, RegionSamples known)
      : params_(params), known_(std::move(known)) {}

  /// From now on nothing is said of sets that `asked` is false of: each takes its time. At first, of all.
  void askOnlyOf(std::function<bool(const RegionSet&)> asked) { asked_ = std::move(asked); }

  struct Judged {
    RegionHypothesis hypothesis;
    ObjectnessEvidence evidence;
  };
  /// All that are no larger than things are, and of which enough is in view to say. `input.joining_odds` is
  /// asked by several threads at once.
  [[nodiscard]] std::vector<Judged> judge(const DiscoveryInput& input);
  /// The same as candidates, with Candidate::objectness.
  [[nodiscard]] std::vector<Candidate> find(const DiscoveryInput& input) override;
  [[nodiscard]] const RegionCensus& census() const override { return census_; }

 private:
  [[nodiscard]] const RegionSamples::Shape& shapeOf(const RegionSet& regions);

  DiscoveryParams params_;
  std::function<bool(const RegionSet&)> asked_;  // empty: all
  RegionSamples known_;
  std::map<RegionSet, RegionSamples::Shape> shapes_;  // as far as they were asked for
  RegionCounter counter_;
  RegionCensus census_;
};

}  // namespace scantrove
