#include "core/discovery/region_candidate.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/discovery/oriented_box.h"
#include "core/discovery/region_points.h"

namespace scantrove {
namespace {

/// Pixels of the region, 255, in an image of all.
cv::Mat pixelsOfRegion(RegionId region, const RegionMap& map) {
  cv::Mat pixels(map.height, map.width, CV_8UC1);
  std::ranges::transform(map.regions, pixels.begin<unsigned char>(), [region](RegionId one) {
    return static_cast<unsigned char>(one == region ? 255 : 0);
  });
  return pixels;
}

}  // namespace

std::optional<Candidate> candidateOf(RegionId region, const DiscoveryInput& input, int least_points) {
  const cv::Mat pixels = pixelsOfRegion(region, input.regions);
  const cv::Rect box_px = cv::boundingRect(pixels);
  if (box_px.empty()) return std::nullopt;
  const std::vector<Eigen::Vector4f> points = pointsOf({region}, box_px, input);
  if (points.size() < static_cast<std::size_t>(std::max(3, least_points))) return std::nullopt;
  const OrientedBox box = fitOrientedBox(points);
  Candidate candidate;
  candidate.regions = {region};
  candidate.box_px = box_px;
  candidate.mask = pixels(box_px).clone();
  candidate.centroid_world = box.mean;
  candidate.centroid_camera = (input.T_world_camera.inverse() * box.mean.cast<double>()).cast<float>();
  candidate.size_m = box.size_m;
  candidate.pixels = cv::countNonZero(candidate.mask);
  return candidate;
}

}  // namespace scantrove
