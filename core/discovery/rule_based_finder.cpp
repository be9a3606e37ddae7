#include "core/base/check.h"
#include "core/discovery/candidate_finder.h"
#include "core/discovery/oriented_box.h"
#include "core/discovery/region_census.h"
#include "core/discovery/region_points.h"
#include "core/discovery/region_rules.h"
#include "core/discovery/size_history.h"

namespace scantrove {
namespace {

cv::Mat maskOf(const RegionExtent& extent, const RegionMap& map) {
  cv::Mat mask(extent.box_px.size(), CV_8UC1);
  for (int y = 0; y < mask.rows; ++y) {
    const RegionId* regions =
        map.regions.data() + static_cast<std::ptrdiff_t>(extent.box_px.y + y) * map.width + extent.box_px.x;
    unsigned char* out = mask.ptr(y);
    for (int x = 0; x < mask.cols; ++x) out[x] = regions[x] == extent.region ? 255 : 0;
  }
  return mask;
}

Candidate toCandidate(const RegionExtent& extent, const OrientedBox& box, const DiscoveryInput& input) {
  Candidate candidate;
  candidate.region = extent.region;
  candidate.box_px = extent.box_px;
  candidate.mask = maskOf(extent, input.regions);
  candidate.centroid_world = box.mean;
  candidate.centroid_camera = (input.T_world_camera.inverse() * box.mean.cast<double>()).cast<float>();
  candidate.size_m = box.size_m;
  candidate.pixels = static_cast<int>(extent.pixels);
  return candidate;
}

class RuleBasedFinder final : public CandidateFinder {
 public:
  explicit RuleBasedFinder(const DiscoveryParams& params) : params_(params) {}

  void setParams(const DiscoveryParams& params) override { params_ = params; }
  void regionsMerged(RegionId into, RegionId from) override { history_.merge(into, from); }

  std::vector<Candidate> find(const DiscoveryInput& input) override {
    SCANTROVE_CHECK(input.vertices_world.size() == input.regions.regions.size());
    const RegionCensus census = counter_.count(input.regions);
    const std::vector<RegionExtent> whole = wholeRegions(census, input);

    std::vector<SizeHistory::Sighting> sightings;
    for (const RegionExtent& extent : whole) sightings.push_back({extent.region, visibleArea(extent, input)});
    history_.add(sightings, params_.persistent_frames);

    std::vector<Candidate> candidates;
    for (const RegionExtent& extent : whole) {
      if (!isCentral(extent, input.K, params_) || !isNotEccentric(extent, params_)) continue;
      if (!history_.isPersistent(extent.region, params_.persistent_frames, params_.size_tolerance)) continue;
      const OrientedBox box = fitOrientedBox(pointsOf(extent, input));
      if (!isSizeInRange(box, params_) || !isNotFlat(box, params_)) continue;
      if (!isNotBackground(hiddenFraction(extent, input, params_), params_)) continue;
      candidates.push_back(toCandidate(extent, box, input));
    }
    return candidates;
  }

 private:
  /// Regions that are seen entirely and are not too small: only their size means anything.
  [[nodiscard]] std::vector<RegionExtent> wholeRegions(const RegionCensus& census,
                                                       const DiscoveryInput& input) const {
    const cv::Rect visible = visibleFrame(census, input.regions.width, input.regions.height, params_);
    std::vector<RegionExtent> whole;
    for (const RegionExtent& extent : census.extents) {
      if (isOffBorder(extent, visible, params_) && hasEnoughPoints(extent, input.K, params_))
        whole.push_back(extent);
    }
    return whole;
  }

  DiscoveryParams params_;
  RegionCounter counter_;
  SizeHistory history_;
};

}  // namespace

std::unique_ptr<CandidateFinder> makeRuleBasedFinder(const DiscoveryParams& params) {
  return std::make_unique<RuleBasedFinder>(params);
}

}  // namespace scantrove
