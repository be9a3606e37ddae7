#include "core/discovery/region_judge.h"

#include <algorithm>
#include <opencv2/core/utility.hpp>
#include <optional>

#include "core/base/check.h"
#include "core/discovery/color_changes.h"
#include "core/discovery/oriented_box.h"
#include "core/discovery/outline_bounds.h"
#include "core/discovery/outward_odds.h"
#include "core/discovery/region_candidate.h"
#include "core/discovery/region_colors.h"
#include "core/discovery/region_points.h"
#include "core/discovery/region_rules.h"
#include "core/discovery/silhouette.h"

namespace scantrove {
namespace {

/// Factor on DiscoveryParams::max_size_m: all known points of an object extend farther than one observation.
constexpr float kLargestPart = 8.0F / 7;
constexpr float kMinPixels = 240;      // of a reference image; fewer are not judged ...
constexpr float kMinPartPixels = 120;  // ... and with fewer than this, not even as parts of sets
/// Pixels of a reference image per pixel of 320 x 240, in which the objectness model counts.
constexpr float kPixelsOfModel = 4;
/// Limits for judging an observation: the object must be mostly in view and its outline known.
constexpr float kMinShown = 0.45F;                  // of its known points
constexpr float kMaxCut = 0.5F, kMaxUnseen = 0.3F;  // of the outline

bool isInView(const OutlineSteps& outline) {
  const auto known = static_cast<float>(outline.known()), unseen = static_cast<float>(outline.unseen);
  return static_cast<float>(outline.cut) <= kMaxCut * known && unseen <= kMaxUnseen * (known + unseen);
}

bool isCutOff(const ObjectnessEvidence& evidence) {
  constexpr float kShown = 0.8F, kCut = 0.3F;  // within both limits the image shows nearly all of it
  return evidence.shown < kShown || evidence.cut > kCut;
}

/// Calls `work` with 0 .. `count` - 1, from several threads.
template <class Work>
void forEachInParallel(std::size_t count, const Work& work) {
  cv::parallel_for_({0, static_cast<int>(count)}, [&work](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) work(static_cast<std::size_t>(i));
  });
}

/// The evidence of the image.
ObjectnessEvidence seenOf(const RegionHypothesis& hypothesis, const OutlineSteps& outline,
                          const DiscoveryInput& input) {
  const RegionExtent& extent = hypothesis.extent;
  const auto partOfOutline = [steps = std::max(1, outline.known())](int of) {
    return static_cast<float>(of) / static_cast<float>(steps);
  };
  ObjectnessEvidence evidence;
  evidence.open = partOfOutline(outline.open);
  evidence.folded = partOfOutline(outline.folded);
  evidence.ridged = partOfOutline(outline.ridged);
  evidence.hidden = partOfOutline(outline.hidden);
  evidence.cut = partOfOutline(outline.cut);
  evidence.fill = static_cast<float>(extent.pixels) / static_cast<float>(std::max(1, extent.box_px.area()));
  evidence.bulge = bulgeOf(hypothesis.regions, extent.box_px, input);
  const Silhouette silhouette = silhouetteOf(hypothesis.regions, extent.box_px, input);
  evidence.convexity = silhouette.convexity;
  evidence.relief_m = silhouette.relief_m;
  evidence.area_m2 = hypothesis.visible_area_m2;
  const SetPixels pixels(hypothesis.regions, extent.box_px, input);
  const SetAxes axes(pixels, extent);
  evidence.bounds = outlineBoundsOf(pixels, axes, input);
  if (!input.color_lab.empty()) evidence.changes = colorChangesOf(pixels, axes, input);
  evidence.is_inconsistent = hypothesis.is_inconsistent;
  evidence.odds = hypothesis.odds;
  return evidence;
}

void setKnown(const RegionSamples::Shape& known, ObjectnessEvidence& evidence) {
  evidence.known_bulge = known.bulge;
  evidence.known_flatness = known.box.thickness_ratio;
  evidence.known_size_m = known.box.size_m;
}

}  // namespace

const RegionSamples::Shape& RegionJudge::shapeOf(const RegionSet& regions) {
  const auto [entry, is_new] = shapes_.try_emplace(regions);
  if (is_new) entry->second = known_.shapeOf(regions);
  return entry->second;
}

std::vector<RegionJudge::Judged> RegionJudge::judge(const DiscoveryInput& input) {
  SCANTROVE_CHECK(input.view.vertices_world.size() == input.regions.size());
  census_ = counter_.count(input.regions, input.view.K.width);
  const auto scale = static_cast<float>(1 / input.view.K.pixelScale());
  const float largest_m = kLargestPart * params_.max_size_m;
  std::vector<RegionExtent> parts;
  std::ranges::copy_if(census_.extents, std::back_inserter(parts), [&](const RegionExtent& extent) {
    if (static_cast<float>(extent.pixels) * scale < kMinPartPixels) return false;
    const float size_m = shapeOf({extent.region}).box.size_m[0];
    return size_m >= params_.min_size_m && size_m <= largest_m;
  });
  const RegionOutlines outlines(input);
  const RegionColors colors(input);
  const cv::Rect visible = visibleFrame(census_, input.view.K.width, input.view.K.height, params_);
  const auto pixelsOf = [&parts](RegionId region) {
    return std::ranges::find(parts, region, &RegionExtent::region)->pixels;
  };
  const auto evidenceOf = [&](const RegionHypothesis& hypothesis) -> std::optional<ObjectnessEvidence> {
    const auto pixels = static_cast<float>(hypothesis.extent.pixels);
    const OutlineSteps outline = outlines.of(hypothesis.regions);
    float shown = 0, largest = 0;
    SupportShares shares;
    for (const RegionId region : hypothesis.regions) {
      const auto of_region = static_cast<float>(pixelsOf(region));
      shown += of_region * known_.partInView(region, input.view.K, input.view.T_world_camera, visible);
      largest = std::max(largest, of_region);
      if (!input.support_shares) continue;
      const SupportShares of = input.support_shares(region);
      shares.support += of_region / pixels * of.support;
      shares.carried += of_region / pixels * of.carried;
    }
    if (!isInView(outline) || shown < kMinShown * pixels) return std::nullopt;
    ObjectnessEvidence evidence = seenOf(hypothesis, outline, input);
    setKnown(shapes_.at(hypothesis.regions), evidence);
    evidence.pixels = pixels * scale / kPixelsOfModel;
    evidence.largest_part = largest / pixels;
    evidence.shown = shown / pixels;
    evidence.support = shares.support;
    evidence.carried = shares.carried;
    evidence.likeness = colors.likenessOf(hypothesis.regions, hypothesis.extent);
    const auto [most, joined_part] = outwardOddsOf(hypothesis.regions, outlines, input);
    evidence.outward_odds = most;
    evidence.joined_part = joined_part;
    return evidence;
  };
  std::vector<RegionHypothesis> hypotheses = proposeHypotheses(parts, outlines, input, params_);
  std::erase_if(hypotheses, [&](const RegionHypothesis& hypothesis) {
    return (asked_ && !asked_(hypothesis.regions)) ||
           static_cast<float>(hypothesis.extent.pixels) * scale < kMinPixels ||
           shapeOf(hypothesis.regions).box.size_m[0] > largest_m;
  });
  std::vector<std::optional<ObjectnessEvidence>> evidence(hypotheses.size());
  forEachInParallel(hypotheses.size(), [&](std::size_t i) { evidence[i] = evidenceOf(hypotheses[i]); });
  std::vector<Judged> judged;
  for (std::size_t i = 0; i < hypotheses.size(); ++i) {
    if (evidence[i]) judged.push_back({std::move(hypotheses[i]), *evidence[i]});
  }
  return judged;
}

std::vector<Candidate> RegionJudge::find(const DiscoveryInput& input) {
  const std::vector<Judged> judged = judge(input);
  std::vector<Candidate> candidates(judged.size());
  forEachInParallel(judged.size(), [&](std::size_t i) {
    const auto& [hypothesis, evidence] = judged[i];
    const bool is_cut_off = isCutOff(evidence);
    // The visible part of a cut-off object does not show its size.
    const OrientedBox box =
        is_cut_off ? shapes_.at(hypothesis.regions).box
                   : fitOrientedBox(pointsOf(hypothesis.regions, hypothesis.extent.box_px, input));
    candidates[i] = candidateOf(hypothesis, box, input);
    candidates[i].objectness = evidence.logOdds();
    candidates[i].is_cut_off = is_cut_off;
  });
  return candidates;
}

}  // namespace scantrove
