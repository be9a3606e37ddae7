#include <algorithm>
#include <cstdint>
#include <functional>

#include "core/base/check.h"
#include "core/discovery/candidate_finder.h"
#include "core/discovery/look_history.h"
#include "core/discovery/oriented_box.h"
#include "core/discovery/reach_history.h"
#include "core/discovery/region_hypotheses.h"
#include "core/discovery/region_points.h"
#include "core/discovery/region_rules.h"
#include "core/discovery/size_history.h"

namespace scantrove {
namespace {

/// A set is one way to see its regions only where its outline is not clearly worse than theirs.
constexpr float kOutlineSlack = 0.05F;
/// Of a thing that the border cuts off so much must be seen, along each axis.
constexpr float kMostOfThing = 0.6F;
/// Of what is not seen whole there must be more to see, by half.
constexpr float kPointsOfRest = 1.5F;
/// Steps along which it touches what it may be a part of.
constexpr int kLeastTouch = 2;
/// Parts of a set may be smaller than what must be seen of a thing.
constexpr int kLeastPartOfThing = 8;

cv::Mat maskOf(const RegionHypothesis& hypothesis, const RegionMap& map) {
  const cv::Rect& box = hypothesis.extent.box_px;
  cv::Mat mask(box.size(), CV_8UC1);
  for (int y = 0; y < mask.rows; ++y) {
    const RegionId* regions = map.regions.data() + static_cast<std::ptrdiff_t>(box.y + y) * map.width + box.x;
    unsigned char* out = mask.ptr(y);
    for (int x = 0; x < mask.cols; ++x) out[x] = hypothesis.regions.contains(regions[x]) ? 255 : 0;
  }
  return mask;
}

/// Most of what is masked came into the scene.
bool hasCome(const cv::Mat& mask, const cv::Rect& box_px, const DiscoveryInput& input) {
  if (input.came.empty()) return false;
  int all = 0, came = 0;
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      if (mask.at<unsigned char>(y, x) == 0) continue;
      const int at = (box_px.y + y) * input.regions.width + box_px.x + x;
      ++all;
      came += input.came[static_cast<std::size_t>(at)] != 0 ? 1 : 0;
    }
  }
  return 2 * came > all;
}

Candidate toCandidate(const RegionHypothesis& hypothesis, const OrientedBox& box,
                      const DiscoveryInput& input) {
  Candidate candidate;
  candidate.regions = hypothesis.regions;
  candidate.box_px = hypothesis.extent.box_px;
  candidate.mask = maskOf(hypothesis, input.regions);
  candidate.has_come = hasCome(candidate.mask, candidate.box_px, input);
  candidate.centroid_world = box.mean;
  candidate.centroid_camera = (input.T_world_camera.inverse() * box.mean.cast<double>()).cast<float>();
  candidate.size_m = box.size_m;
  candidate.bulge = bulgeOf(hypothesis.regions, hypothesis.extent.box_px, input);
  candidate.odds = hypothesis.odds;
  candidate.pixels = static_cast<int>(hypothesis.extent.pixels);
  return candidate;
}

class RuleBasedFinder final : public CandidateFinder {
 public:
  explicit RuleBasedFinder(const DiscoveryParams& params) : params_(params) {}

  void setParams(const DiscoveryParams& params) override { params_ = params; }
  [[nodiscard]] const RegionCensus& census() const override { return census_; }
  void regionsJoined(RegionId into, RegionId from) override {
    sizes_.follow(into, from);
    looks_.follow(into, from);
    reaches_.forget(into);
    reaches_.forget(from);
  }
  void regionParted(RegionId from) override { reaches_.forget(from); }

  std::vector<Candidate> find(const DiscoveryInput& input) override {
    SCANTROVE_CHECK(input.vertices_world.size() == input.regions.regions.size());
    census_ = counter_.count(input.regions);
    const RegionOutlines outlines(input, params_);
    const cv::Rect visible = visibleFrame(census_, input.regions.width, input.regions.height, params_);
    const std::vector<RegionHypothesis> hypotheses =
        proposeHypotheses(wholeRegions(census_, visible, input), outlines, input, params_);
    rememberSizes(hypotheses);
    looks_.nextFrame();
    reaches_.add(input, visible, params_.max_size_m);

    std::vector<Candidate> candidates;
    for (const RegionHypothesis& hypothesis : hypotheses) {
      const RegionExtent& extent = hypothesis.extent;
      if (hypothesis.is_torn || !hasEnoughPoints(extent, input.K, params_) ||
          !isCentral(extent, input.K, params_) || !isNotEccentric(extent, params_))
        continue;
      if (!sizes_.isPersistent(hypothesis.regions, params_.persistent_frames, params_.size_tolerance))
        continue;
      const OutlineSteps outline = outlines.of(hypothesis.regions);
      if (!isNotBackground(outline, params_) || !isOutlineKept(hypothesis, outline, outlines, hypotheses))
        continue;
      const OrientedBox box = fitOrientedBox(pointsOf(hypothesis.regions, extent.box_px, input));
      Candidate candidate = toCandidate(hypothesis, box, input);
      if (!isShaped(hypothesis.regions, box, candidate.bulge, input)) continue;
      candidates.push_back(std::move(candidate));
      look(outline, input, candidates.back());
    }
    for (const RegionExtent& extent : cutRegions(census_, visible, input)) {
      const RegionHypothesis hypothesis{{extent.region}, extent, visibleArea(extent, input)};
      const OutlineSteps outline = outlines.of(hypothesis.regions);
      if (!isNotBackground(outline, params_)) continue;
      OrientedBox box = fitOrientedBox(pointsOf(hypothesis.regions, extent.box_px, input));
      box.size_m = reaches_.sizeOf(extent.region);
      std::sort(box.size_m.begin(), box.size_m.end(), std::greater<>());
      Candidate candidate = toCandidate(hypothesis, box, input);
      if (!isShaped(hypothesis.regions, box, candidate.bulge, input)) continue;
      candidates.push_back(std::move(candidate));
      look(outline, input, candidates.back());
    }
    if (input.known != nullptr) lookAtRest(outlines, visible, input, candidates);
    std::ranges::sort(candidates, {}, &Candidate::regions);
    return candidates;
  }

 private:
  /// As a thing, after this frame's `box` and `bulge`, or after all that is known.
  [[nodiscard]] bool isShaped(const RegionSet& regions, const OrientedBox& box, float bulge,
                              const DiscoveryInput& input) const {
    if (input.known == nullptr) return isShapedAsThing(box, bulge, params_);
    const RegionSamples::Shape known = input.known->shapeOf(regions);
    return isShapedAsThing(known.box, known.bulge, params_);
  }

  /// Regions that may never show themselves whole, as well as this frame can show them.
  void lookAtRest(const RegionOutlines& outlines, const cv::Rect& visible, const DiscoveryInput& input,
                  std::vector<Candidate>& candidates) const {
    for (const RegionExtent& extent : census_.extents) {
      RegionExtent smaller = extent;
      smaller.pixels = static_cast<std::int64_t>(static_cast<float>(extent.pixels) / kPointsOfRest);
      if (!hasEnoughPoints(smaller, input.K, params_)) continue;
      const PartialLook look = partialLook(extent, outlines, visible, input);
      const RegionSet regions{extent.region};
      if (!isClearInPart(look) || !isShapedAsThing(look.known.box, look.known.bulge, params_)) continue;
      auto candidate = std::ranges::find(candidates, regions, &Candidate::regions);
      if (candidate == candidates.end()) {
        candidates.push_back(
            toCandidate({regions, extent, visibleArea(extent, input)}, look.known.box, input));
        candidate = candidates.end() - 1;
        candidate->is_partial = true;
        candidate->outline = look.outline.own();
        candidate->hidden = look.outline.hiddenPart();
      }
      if (!candidate->is_whole) candidate->last_resort = look.worth(extent.pixels);
    }
  }

  [[nodiscard]] static PartialLook partialLook(const RegionExtent& extent, const RegionOutlines& outlines,
                                               const cv::Rect& visible, const DiscoveryInput& input) {
    const RegionId region = extent.region;
    PartialLook look;
    look.shown_part = input.known->partInView(region, input.K, input.T_world_camera, visible);
    look.outline = outlines.of({region});
    look.bulge = bulgeOf({region}, extent.box_px, input);
    look.known = input.known->shapeOf({region});
    if (!input.joining_odds) return look;
    for (const RegionId other : outlines.metBy(region, kLeastTouch)) {
      if (outlines.between(region, other).touching() >= kLeastTouch)
        look.odds = std::max(look.odds, input.joining_odds(region, other));
    }
    return look;
  }

  /// Regions that are seen entirely: only their size means anything.
  [[nodiscard]] std::vector<RegionExtent> wholeRegions(const RegionCensus& census, const cv::Rect& visible,
                                                       const DiscoveryInput& input) const {
    std::vector<RegionExtent> whole;
    for (const RegionExtent& extent : census.extents) {
      RegionExtent enlarged = extent;
      enlarged.pixels *= kLeastPartOfThing;
      if (isOffBorder(extent, visible, params_) && hasEnoughPoints(enlarged, input.K, params_))
        whole.push_back(extent);
    }
    return whole;
  }

  /// Regions that the border cuts off, and that earlier frames have seen the rest of.
  [[nodiscard]] std::vector<RegionExtent> cutRegions(const RegionCensus& census, const cv::Rect& visible,
                                                     const DiscoveryInput& input) const {
    std::vector<RegionExtent> cut;
    for (const RegionExtent& extent : census.extents) {
      if (!isOffBorder(extent, visible, params_) && hasEnoughPoints(extent, input.K, params_) &&
          reaches_.isSeenToItsEnds(extent.region, params_.persistent_frames) &&
          reaches_.shownPart(extent.region) >= kMostOfThing)
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

  /// No clearly worse than that of any of its regions which could be a thing by itself.
  [[nodiscard]] static bool isOutlineKept(const RegionHypothesis& hypothesis, const OutlineSteps& outline,
                                          const RegionOutlines& outlines,
                                          const std::vector<RegionHypothesis>& all) {
    return std::ranges::all_of(hypothesis.regions, [&](RegionId region) {
      const auto alone = std::ranges::lower_bound(all, RegionSet{region}, {}, &RegionHypothesis::regions);
      const bool is_thing = alone == all.end() || alone->regions != RegionSet{region} || !alone->is_torn;
      return !is_thing || outline.own() >= outlines.of({region}).own() - kOutlineSlack;
    });
  }

  void look(const OutlineSteps& outline, const DiscoveryInput& input, Candidate& candidate) {
    const Eigen::Vector3f camera_centre = input.T_world_camera.translation().cast<float>();
    candidate.outline = outline.own();
    candidate.hidden = outline.hiddenPart();
    looks_.add(candidate.regions,
               {candidate.outline, candidate.hidden - candidate.mostHidden(0), candidate.size_m,
                (camera_centre - candidate.centroid_world).normalized()});
    candidate.is_whole = looks_.isWhole(candidate.regions, params_);
  }

  DiscoveryParams params_;
  RegionCounter counter_;
  RegionCensus census_;
  SizeHistory sizes_;
  LookHistory looks_;
  ReachHistory reaches_;
};

}  // namespace

std::unique_ptr<CandidateFinder> makeRuleBasedFinder(const DiscoveryParams& params) {
  return std::make_unique<RuleBasedFinder>(params);
}

std::vector<std::size_t> chooseDisjoint(std::span<const Candidate> candidates, std::span<const float> known) {
  SCANTROVE_CHECK(candidates.size() == known.size());
  // Where odds are even a set and its regions are equally likely; regions join later than that.
  constexpr float kEvenOdds = -1, kOfOdds = 0.1F, kMostGain = 0.15F;
  const auto score = [&](std::size_t i) {
    const Candidate& candidate = candidates[i];
    const float together =
        candidate.regions.size() < 2 ? 0 : std::min(kOfOdds * (candidate.odds - kEvenOdds), kMostGain);
    return known[i] + (candidate.is_whole ? 0.5F : 0.0F) + candidate.outline - candidate.hidden + together;
  };
  std::vector<std::size_t> order(candidates.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, std::greater<>(), score);
  std::vector<std::size_t> chosen;
  for (const std::size_t i : order) {
    const bool is_free = std::ranges::none_of(
        chosen, [&](std::size_t other) { return candidates[i].regions.overlaps(candidates[other].regions); });
    if (is_free) chosen.push_back(i);
  }
  std::ranges::sort(chosen);
  return chosen;
}

}  // namespace scantrove
