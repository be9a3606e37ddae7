#include "core/discovery/hypothesis_candidate.h"

#include "core/discovery/region_points.h"

namespace scantrove {
namespace {

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

}  // namespace

Candidate candidateOf(const RegionHypothesis& hypothesis, const OrientedBox& box,
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

}  // namespace scantrove
