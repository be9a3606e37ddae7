#include "core/scan/met_objects.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <optional>

namespace scantrove {
namespace {

/// Two sightings of one scan are of one object when their centroids lie within this fraction of its diagonal,
constexpr float kSamePlaceFraction = 0.25F;
/// and the smaller diagonal is at least this fraction of the larger.
constexpr float kAsLargeFraction = 0.6F;

/// The place is looked at in so many pixels to each side.
constexpr int kAroundMiddle_px = 2;

/// Between the centroids, where both are at one place.
std::optional<float> distanceAtOnePlace(const MetObjects::Met& met, const Candidate& candidate) {
  if (MetObjects::wasRemoved(met)) return std::nullopt;
  const float diagonal = std::max(met.size_m.norm(), candidate.size_m.norm());
  if (std::min(met.size_m.norm(), candidate.size_m.norm()) < kAsLargeFraction * diagonal) return std::nullopt;
  const float distance_m = (met.centroid_world - candidate.centroid_world).norm();
  if (distance_m >= kSamePlaceFraction * diagonal) return std::nullopt;
  return distance_m;
}

}  // namespace

void MetObjects::bind(const RegionSet& regions, ObjectId object) {
  for (const RegionId region : regions) object_of_region_[region] = object;
}

void MetObjects::unbind(const RegionSet& regions, ObjectId object) {
  for (const RegionId region : regions) {
    if (objectOf(region) == object) object_of_region_.erase(region);
  }
}

void MetObjects::forget(ObjectId object) {
  std::erase_if(object_of_region_, [object](const auto& entry) { return entry.second == object; });
  met_.erase(object);
}

std::vector<RegionId> MetObjects::regionsOf(ObjectId object) const {
  std::vector<RegionId> regions;
  for (const auto& [region, of_region] : object_of_region_) {
    if (of_region == object) regions.push_back(region);
  }
  std::ranges::sort(regions);
  return regions;
}

ObjectId MetObjects::objectOf(RegionId region) const {
  const auto found = object_of_region_.find(region);
  return found == object_of_region_.end() ? ObjectId{} : found->second;
}

ObjectId MetObjects::objectOf(const RegionSet& regions) const {
  ObjectId object;
  for (const RegionId region : regions) {
    const ObjectId of_region = objectOf(region);
    if (!of_region || of_region == object) continue;
    if (object) return {};
    object = of_region;
  }
  return object;
}

std::pair<ObjectId, ObjectId> MetObjects::regionsJoined(RegionId into, RegionId from) {
  const auto found = object_of_region_.find(from);
  if (found == object_of_region_.end()) return {};
  const ObjectId object = found->second;
  object_of_region_.erase(found);
  const auto [entry, is_first] = object_of_region_.try_emplace(into, object);
  if (is_first || entry->second == object) return {};
  return {entry->second, object};
}

void MetObjects::meet(ObjectId object, const Candidate& candidate, int frame) {
  Met& met = met_[object];
  met.centroid_world = candidate.centroid_world;
  met.size_m = candidate.size_m;
  met.last_frame = frame;
  met.times_empty = 0;
}

void MetObjects::stillThere(ObjectId object, int frame) {
  const auto found = met_.find(object);
  if (found == met_.end()) return;
  found->second.last_frame = frame;
  found->second.times_empty = 0;
}

void MetObjects::lookAtPlaces(const DepthView& now, float depth_noise_m, int frame) {
  const Eigen::Isometry3f T_camera_world = now.T_world_camera.inverse().cast<float>();
  const cv::Rect image({}, now.z_m.size());
  for (auto& [object, met] : met_) {
    if (met.last_frame >= frame) continue;
    const Eigen::Vector3f middle = T_camera_world * met.centroid_world;
    if (!(middle.z() > 0)) continue;
    const cv::Point pixel(static_cast<int>(std::lround(now.K.fx * middle.x() / middle.z() + now.K.cx)),
                          static_cast<int>(std::lround(now.K.fy * middle.y() / middle.z() + now.K.cy)));
    const cv::Rect around(pixel - cv::Point(kAroundMiddle_px, kAroundMiddle_px),
                          cv::Size(2 * kAroundMiddle_px + 1, 2 * kAroundMiddle_px + 1));
    if ((around & image) != around) continue;
    const float through_m = middle.z() + kBehind.at(middle.z(), depth_noise_m);
    if (cv::countNonZero(now.z_m(around) > through_m) == around.area()) ++met.times_empty;
  }
}

ObjectId MetObjects::nearby(const Candidate& candidate, int frame,
                            const std::function<bool(ObjectId)>& may_be_it) const {
  ObjectId nearest;
  float least_m = std::numeric_limits<float>::max();
  for (const auto& [object, met] : met_) {
    if (met.last_frame >= frame) continue;
    const std::optional<float> distance_m = distanceAtOnePlace(met, candidate);
    if (!distance_m || *distance_m >= least_m || !may_be_it(object)) continue;
    nearest = object;
    least_m = *distance_m;
  }
  return nearest;
}

bool MetObjects::isAt(ObjectId object, const Candidate& candidate) const {
  const auto found = met_.find(object);
  return found != met_.end() && distanceAtOnePlace(found->second, candidate).has_value();
}

}  // namespace scantrove
