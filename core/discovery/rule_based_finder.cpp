#include "core/discovery/rule_based_finder.h"

#include <algorithm>
#include <cstdint>
#include <functional>

#include "core/base/check.h"
#include "core/discovery/observation_history.h"
#include "core/discovery/oriented_box.h"
#include "core/discovery/reach_history.h"
#include "core/discovery/region_candidate.h"
#include "core/discovery/region_hypotheses.h"
#include "core/discovery/region_points.h"
#include "core/discovery/region_rules.h"
#include "core/discovery/size_history.h"

namespace scantrove {
namespace {

/// A set is a candidate only if its outline is not clearly worse than that of its regions.
constexpr float kOutlineSlack = 0.05F;
/// The part of a cut-off object that must be visible along each axis.
constexpr float kMinVisiblePart = 0.6F;
/// Parts of a set may be smaller than the minimum for an object.
constexpr int kPartSizeFactor = 8;

class RuleBasedFinder final : public CandidateFinder {
 public:
  explicit RuleBasedFinder(const DiscoveryParams& params) : params_(params) {}

  void setParams(const DiscoveryParams& params) override { params_ = params; }
  [[nodiscard]] const RegionCensus& census() const override { return census_; }
  void regionsJoined(RegionId into, RegionId from) override {
    sizes_.joinRegions(into, from);
    observations_.joinRegions(into, from);
    reaches_.forget(into);
    reaches_.forget(from);
  }
  void regionParted(RegionId from) override { reaches_.forget(from); }

  std::vector<Candidate> find(const DiscoveryInput& input) override {
    SCANTROVE_CHECK(input.view.vertices_world.size() == input.regions.size());
    census_ = counter_.count(input.regions, input.view.K.width);
    const RegionOutlines outlines(input);
    const cv::Rect visible = visibleFrame(census_, input.view.K.width, input.view.K.height, params_);
    const std::vector<RegionHypothesis> hypotheses =
        proposeHypotheses(completeRegions(census_, visible, input), outlines, input, params_);
    rememberSizes(hypotheses);
    observations_.nextFrame();
    reaches_.add(input, visible, params_.max_size_m);

    std::vector<Candidate> candidates;
    for (const RegionHypothesis& hypothesis : hypotheses) {
      const RegionExtent& extent = hypothesis.extent;
      if (hypothesis.is_inconsistent || !hasEnoughPoints(extent, input.view.K, params_) ||
          !isCentral(extent, input.view.K, params_) || isEccentric(extent, params_))
        continue;
      if (!sizes_.isPersistent(hypothesis.regions, params_.persistent_frames, params_.size_tolerance))
        continue;
      const OutlineSteps outline = outlines.of(hypothesis.regions);
      if (isBackground(outline, params_) || !isOutlineKept(hypothesis, outline, outlines, hypotheses))
        continue;
      const OrientedBox box = fitOrientedBox(pointsOf(hypothesis.regions, extent.box_px, input));
      Candidate candidate = candidateOf(hypothesis, box, input);
      if (!isShapedAsObject(box, candidate.bulge, params_)) continue;
      candidates.push_back(std::move(candidate));
      measure(outline, input, candidates.back());
    }
    for (const RegionExtent& extent : cutRegions(census_, visible, input)) {
      const RegionHypothesis hypothesis{{extent.region}, extent, visibleArea(extent, input)};
      const OutlineSteps outline = outlines.of(hypothesis.regions);
      if (isBackground(outline, params_)) continue;
      OrientedBox box = fitOrientedBox(pointsOf(hypothesis.regions, extent.box_px, input));
      box.size_m = reaches_.sizeOf(extent.region, box.axes);
      std::sort(box.size_m.begin(), box.size_m.end(), std::greater<>());
      Candidate candidate = candidateOf(hypothesis, box, input);
      if (!isShapedAsObject(box, candidate.bulge, params_)) continue;
      candidates.push_back(std::move(candidate));
      measure(outline, input, candidates.back());
    }
    std::ranges::sort(candidates, {}, &Candidate::regions);
    return candidates;
  }

 private:
  /// Regions in full view: only their size counts.
  [[nodiscard]] std::vector<RegionExtent> completeRegions(const RegionCensus& census, const cv::Rect& visible,
                                                          const DiscoveryInput& input) const {
    std::vector<RegionExtent> complete;
    for (const RegionExtent& extent : census.extents) {
      RegionExtent enlarged = extent;
      enlarged.pixels *= kPartSizeFactor;
      if (isOffBorder(extent, visible, params_) && hasEnoughPoints(enlarged, input.view.K, params_))
        complete.push_back(extent);
    }
    return complete;
  }

  /// Regions that the border cuts off and that earlier frames showed completely.
  [[nodiscard]] std::vector<RegionExtent> cutRegions(const RegionCensus& census, const cv::Rect& visible,
                                                     const DiscoveryInput& input) const {
    std::vector<RegionExtent> cut;
    for (const RegionExtent& extent : census.extents) {
      if (!isOffBorder(extent, visible, params_) && hasEnoughPoints(extent, input.view.K, params_) &&
          reaches_.isSeenToItsEnds(extent.region, params_.persistent_frames) &&
          reaches_.shownPart(extent.region) >= kMinVisiblePart)
        cut.push_back(extent);
    }
    return cut;
  }

  void rememberSizes(const std::vector<RegionHypothesis>& hypotheses) {
    std::vector<SizeHistory::Sighting> sightings;
    for (const RegionHypothesis& hypothesis : hypotheses)
      sightings.push_back({hypothesis.regions, hypothesis.visible_area_m2});
    sizes_.add(sightings, params_.persistent_frames);
  }

  /// Not clearly worse than the outline of any of its regions that could be an object alone.
  [[nodiscard]] static bool isOutlineKept(const RegionHypothesis& hypothesis, const OutlineSteps& outline,
                                          const RegionOutlines& outlines,
                                          const std::vector<RegionHypothesis>& all) {
    return std::ranges::all_of(hypothesis.regions, [&](RegionId region) {
      const auto alone = std::ranges::lower_bound(all, RegionSet{region}, {}, &RegionHypothesis::regions);
      const bool is_object =
          alone == all.end() || alone->regions != RegionSet{region} || !alone->is_inconsistent;
      return !is_object || outline.own() >= outlines.of({region}).own() - kOutlineSlack;
    });
  }

  void measure(const OutlineSteps& outline, const DiscoveryInput& input, Candidate& candidate) {
    const Eigen::Vector3f camera_center = input.view.T_world_camera.translation().cast<float>();
    candidate.outline = outline.own();
    candidate.hidden = outline.hiddenPart();
    observations_.add(candidate.regions,
                      {candidate.outline, candidate.hidden - candidate.mostHidden(0), candidate.size_m,
                       (camera_center - candidate.centroid_world).normalized()});
    candidate.is_complete = observations_.isComplete(candidate.regions, params_);
  }

  DiscoveryParams params_;
  RegionCounter counter_;
  RegionCensus census_;
  SizeHistory sizes_;
  ObservationHistory observations_;
  ReachHistory reaches_;
};

}  // namespace

std::unique_ptr<CandidateFinder> makeRuleBasedFinder(const DiscoveryParams& params) {
  return std::make_unique<RuleBasedFinder>(params);
}

}  // namespace scantrove
