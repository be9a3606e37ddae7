#include "core/discovery/region_rules.h"

#include <algorithm>
#include <cmath>

#include "core/discovery/candidate.h"

namespace scantrove {

cv::Rect visibleFrame(const RegionCensus& census, int width, int height, const DiscoveryParams& params) {
  const auto stripOf = [&](int size) {
    return static_cast<int>(params.max_strip_fraction * static_cast<float>(size));
  };
  const int strip_u = stripOf(width), strip_v = stripOf(height);
  const cv::Rect& seen = census.labeled_px;
  // A wider gap is not a strip; the image's own edge counts there.
  const auto inset = [](int gap, int strip) { return gap <= strip ? gap : 0; };
  const int left = inset(seen.x, strip_u), right = inset(width - seen.br().x, strip_u);
  const int top = inset(seen.y, strip_v), bottom = inset(height - seen.br().y, strip_v);
  return {left, top, width - left - right, height - top - bottom};
}

bool isOffBorder(const RegionExtent& extent, const cv::Rect& visible_px, const DiscoveryParams& params) {
  const cv::Rect& box = extent.box_px;
  const int margin = params.border_px;
  return box.x - visible_px.x >= margin && box.y - visible_px.y >= margin &&
         visible_px.br().x - box.br().x >= margin && visible_px.br().y - box.br().y >= margin;
}

bool hasEnoughPoints(const RegionExtent& extent, const Intrinsics& K, const DiscoveryParams& params) {
  return static_cast<double>(extent.pixels) >= params.min_points * K.pixelScale();
}

bool isCentral(const RegionExtent& extent, const Intrinsics& K, const DiscoveryParams& params) {
  const double half = params.central_fraction / 2;
  return std::abs(extent.centroidU() - (K.width - 1) / 2.0) <= half * K.width &&
         std::abs(extent.centroidV() - (K.height - 1) / 2.0) <= half * K.height;
}

bool isEccentric(const RegionExtent& extent, const DiscoveryParams& params) {
  return !(extent.eccentricity() <= params.max_eccentricity);
}

bool isSizeInRange(const OrientedBox& box, const DiscoveryParams& params) {
  return box.size_m[0] >= params.min_size_m && box.size_m[0] <= params.max_size_m;
}

bool isFlat(const OrientedBox& box, float bulge, const DiscoveryParams& params) {
  const bool is_small = box.size_m[0] <= params.max_flat_size_m;
  const bool is_thick = box.thickness_ratio >= params.min_thickness_ratio;
  return !is_small && !(is_thick && bulge >= kClearBulge);
}

bool isStrip(const OrientedBox& box, float bulge, const DiscoveryParams& params) {
  const bool is_wide = box.size_m[1] >= params.min_strip_ratio * box.size_m[0];
  const bool is_short = box.size_m[0] <= params.max_flat_size_m;
  return !is_wide && !(is_short && bulge >= kClearBulge);
}

bool isConcave(float bulge, const DiscoveryParams& params) { return !(bulge >= params.min_bulge); }

bool isBackground(const OutlineSteps& outline, const DiscoveryParams& params) {
  return !(outline.hiddenPart() <= params.max_hidden_fraction);
}

}  // namespace scantrove
