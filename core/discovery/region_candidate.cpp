#include "core/discovery/region_candidate.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/discovery/region_census.h"
#include "core/discovery/region_outlines.h"
#include "core/discovery/region_points.h"
#include "core/discovery/small_components.h"

namespace scantrove {
namespace {

/// Part of an outline at the image's border from which on an object is cut off.
constexpr float kCutOff = 0.1F;

/// Pixels of the region, 255, in an image of all.
cv::Mat pixelsOfRegion(RegionId region, const DiscoveryInput& input) {
  cv::Mat pixels(input.view.K.height, input.view.K.width, CV_8UC1);
  std::ranges::transform(input.regions, pixels.begin<unsigned char>(), [region](RegionId one) {
    return static_cast<unsigned char>(one == region ? 255 : 0);
  });
  return pixels;
}

cv::Mat maskOf(const RegionHypothesis& hypothesis, const DiscoveryInput& input) {
  const cv::Rect& box = hypothesis.extent.box_px;
  cv::Mat mask(box.size(), CV_8UC1);
  for (int y = 0; y < mask.rows; ++y) {
    const RegionId* regions =
        input.regions.data() + static_cast<std::ptrdiff_t>(box.y + y) * input.view.K.width + box.x;
    unsigned char* out = mask.ptr(y);
    for (int x = 0; x < mask.cols; ++x) out[x] = hypothesis.regions.contains(regions[x]) ? 255 : 0;
  }
  return mask;
}

/// True if most masked pixels belong to appeared objects.
bool hasAppeared(const cv::Mat& mask, const cv::Rect& box_px, const DiscoveryInput& input) {
  if (input.appeared.empty()) return false;
  int all = 0, appeared = 0;
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      if (mask.at<unsigned char>(y, x) == 0) continue;
      const int at = (box_px.y + y) * input.view.K.width + box_px.x + x;
      ++all;
      appeared += input.appeared[static_cast<std::size_t>(at)] != 0 ? 1 : 0;
    }
  }
  return 2 * appeared > all;
}

/// The candidate's place, from the box.
void place(const OrientedBox& box, const DiscoveryInput& input, Candidate& candidate) {
  candidate.centroid_world = box.mean;
  candidate.centroid_camera = (input.view.T_world_camera.inverse() * box.mean.cast<double>()).cast<float>();
  candidate.size_m = box.size_m;
}

}  // namespace

Candidate candidateOf(const RegionHypothesis& hypothesis, const OrientedBox& box,
                      const DiscoveryInput& input) {
  Candidate candidate;
  candidate.regions = hypothesis.regions;
  candidate.box_px = hypothesis.extent.box_px;
  candidate.mask = maskOf(hypothesis, input);
  dropSmallComponents(candidate.mask, candidate.box_px);
  candidate.has_appeared = hasAppeared(candidate.mask, candidate.box_px, input);
  candidate.bulge = bulgeOf(hypothesis.regions, hypothesis.extent.box_px, input);
  candidate.odds = hypothesis.odds;
  candidate.pixels = static_cast<int>(hypothesis.extent.pixels);
  place(box, input, candidate);
  return candidate;
}

std::optional<Candidate> candidateOf(RegionId region, const DiscoveryInput& input, int least_points) {
  const cv::Mat pixels = pixelsOfRegion(region, input);
  const cv::Rect box_px = cv::boundingRect(pixels);
  if (box_px.empty()) return std::nullopt;
  const std::vector<Eigen::Vector4f> points = pointsOf({region}, box_px, input);
  if (points.size() < static_cast<std::size_t>(std::max(3, least_points))) return std::nullopt;
  Candidate candidate;
  candidate.regions = {region};
  candidate.box_px = box_px;
  candidate.mask = pixels(box_px).clone();
  dropSmallComponents(candidate.mask, candidate.box_px);
  place(fitOrientedBox(points), input, candidate);
  candidate.pixels = cv::countNonZero(candidate.mask);
  return candidate;
}

std::optional<Candidate> onlyObject(const RegionCensus& census, const DiscoveryInput& input,
                                    int least_points) {
  const auto largest = std::ranges::max_element(census.extents, {}, &RegionExtent::pixels);
  if (largest == census.extents.end()) return std::nullopt;
  std::optional<Candidate> object = candidateOf(largest->region, input, least_points);
  if (!object) return std::nullopt;
  object->outline = 1;
  const cv::Rect inner(1, 1, input.view.K.width - 2, input.view.K.height - 2);
  object->is_cut_off = (object->box_px & inner) != object->box_px;
  return object;
}

std::vector<Candidate> candidatesOf(std::span<const RegionSet> sets, const DiscoveryInput& input,
                                    double least_pixels) {
  RegionCounter counter;
  const RegionCensus census = counter.count(input.regions, input.view.K.width);
  const RegionOutlines outlines(input);
  std::vector<Candidate> candidates;
  for (const RegionSet& set : sets) {
    RegionHypothesis hypothesis{set, {}};
    for (const RegionId region : set) {
      const auto extent = std::ranges::lower_bound(census.extents, region, {}, &RegionExtent::region);
      if (extent == census.extents.end() || extent->region != region) continue;
      if (hypothesis.extent.pixels == 0) hypothesis.extent.region = region;
      hypothesis.extent.add(*extent);
    }
    if (static_cast<double>(hypothesis.extent.pixels) < std::max(least_pixels, 1.0)) continue;
    const std::vector<Eigen::Vector4f> points = pointsOf(set, hypothesis.extent.box_px, input);
    if (points.size() < 3) continue;  // it has no shape
    const OutlineSteps outline = outlines.of(set);
    Candidate candidate = candidateOf(hypothesis, fitOrientedBox(points), input);
    candidate.outline = outline.own();
    candidate.hidden = outline.hiddenPart();
    candidate.is_cut_off = static_cast<float>(outline.cut) >= kCutOff * static_cast<float>(outline.known());
    candidates.push_back(std::move(candidate));
  }
  return candidates;
}

}  // namespace scantrove
