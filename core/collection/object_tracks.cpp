#include "core/collection/object_tracks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <optional>

namespace scantrove {
namespace {

/// Two observations in a scan belong to one object if their centroids lie within this fraction of its
/// diagonal,
constexpr float kSamePlaceFraction = 0.25F;
/// and the smaller diagonal is at least this fraction of the larger.
constexpr float kAsLargeFraction = 0.6F;

/// Depth is read in so many pixels to each side of an object's centre.
constexpr int kAroundMiddle_px = 2;

/// Distance between the centroids; none: the two are not at one place.
std::optional<float> distanceAtOnePlace(const ObjectTrack& track, const Candidate& candidate) {
  if (track.isMissing()) return std::nullopt;
  const float diagonal_m = std::max(track.size_m.norm(), candidate.size_m.norm());
  if (std::min(track.size_m.norm(), candidate.size_m.norm()) < kAsLargeFraction * diagonal_m)
    return std::nullopt;
  const float distance_m = (track.centroid_world - candidate.centroid_world).norm();
  if (distance_m >= kSamePlaceFraction * diagonal_m) return std::nullopt;
  return distance_m;
}

}  // namespace

void ObjectTracks::bind(const RegionSet& regions, ObjectId object) {
  for (const RegionId region : regions) state_.object_of_region[region] = object;
}

void ObjectTracks::unbind(const RegionSet& regions, ObjectId object) {
  for (const RegionId region : regions) {
    if (objectOf(region) == object) state_.object_of_region.erase(region);
  }
}

void ObjectTracks::forget(ObjectId object) {
  std::erase_if(state_.object_of_region, [object](const auto& entry) { return entry.second == object; });
  state_.tracks.erase(object);
}

std::vector<RegionId> ObjectTracks::regionsOf(ObjectId object) const {
  std::vector<RegionId> regions;
  for (const auto& [region, of_region] : state_.object_of_region) {
    if (of_region == object) regions.push_back(region);
  }
  std::ranges::sort(regions);
  return regions;
}

ObjectId ObjectTracks::objectOf(RegionId region) const {
  const auto found = state_.object_of_region.find(region);
  return found == state_.object_of_region.end() ? ObjectId{} : found->second;
}

ObjectId ObjectTracks::objectOf(const RegionSet& regions) const {
  ObjectId object;
  for (const RegionId region : regions) {
    const ObjectId of_region = objectOf(region);
    if (!of_region || of_region == object) continue;
    if (object) return {};
    object = of_region;
  }
  return object;
}

ObjectId ObjectTracks::existingObjectOf(RegionId region) const {
  const ObjectId object = objectOf(region);
  return object && catalogue_.currentRecord(object) != nullptr ? object : ObjectId{};
}

bool ObjectTracks::areOneObject(const RegionSet& regions) const {
  const ObjectId first = catalogue_.mergeRootOf(existingObjectOf(*regions.begin()));
  return first && std::ranges::all_of(regions, [&](RegionId region) {
           return catalogue_.mergeRootOf(existingObjectOf(region)) == first;
         });
}

std::pair<ObjectId, ObjectId> ObjectTracks::joinRegions(RegionId into, RegionId from) {
  const auto found = state_.object_of_region.find(from);
  if (found == state_.object_of_region.end()) return {};
  const ObjectId object = found->second;
  state_.object_of_region.erase(found);
  const auto [entry, is_first] = state_.object_of_region.try_emplace(into, object);
  if (is_first || entry->second == object) return {};
  return {entry->second, object};
}

bool ObjectTracks::isInViewBeside(ObjectId object, const RegionSet& regions) const {
  return std::ranges::any_of(
      in_view_, [&](RegionId region) { return objectOf(region) == object && !regions.contains(region); });
}

void ObjectTracks::observe(ObjectId object, const Candidate& candidate, int frame) {
  // An object found elsewhere under its own regions was moved there.
  if (objectOf(candidate.regions) != object && state_.tracks.contains(object) && !isAt(object, candidate))
    state_.moved.insert(object);
  bind(candidate.regions, object);
  ObjectTrack& track = state_.tracks[object];
  track.centroid_world = candidate.centroid_world;
  track.size_m = candidate.size_m;
  track.last_frame = frame;
  track.frames_empty = 0;
}

void ObjectTracks::keepAlive(ObjectId object, int frame) {
  const auto found = state_.tracks.find(object);
  if (found == state_.tracks.end()) return;
  found->second.last_frame = frame;
  found->second.frames_empty = 0;
}

void ObjectTracks::checkPlaces(const DepthView& now, float depth_noise_m, int frame) {
  const Eigen::Isometry3f T_camera_world = now.T_world_camera.inverse().cast<float>();
  const cv::Rect image({}, now.z_m.size());
  for (auto& [object, track] : state_.tracks) {
    if (track.last_frame >= frame) continue;
    const Eigen::Vector3f middle = T_camera_world * track.centroid_world;
    if (!(middle.z() > 0)) continue;
    const cv::Point pixel(static_cast<int>(std::lround(now.K.fx * middle.x() / middle.z() + now.K.cx)),
                          static_cast<int>(std::lround(now.K.fy * middle.y() / middle.z() + now.K.cy)));
    const cv::Rect around(pixel - cv::Point(kAroundMiddle_px, kAroundMiddle_px),
                          cv::Size(2 * kAroundMiddle_px + 1, 2 * kAroundMiddle_px + 1));
    if ((around & image) != around) continue;
    const float through_m = middle.z() + kBehind.at(middle.z(), depth_noise_m);
    if (cv::countNonZero(now.z_m(around) > through_m) == around.area()) ++track.frames_empty;
  }
}

ObjectId ObjectTracks::nearest(const Candidate& candidate, int frame,
                               const std::function<bool(ObjectId)>& matches) const {
  ObjectId nearest;
  float least_m = std::numeric_limits<float>::max();
  for (const auto& [object, track] : state_.tracks) {
    if (track.last_frame >= frame) continue;
    const std::optional<float> distance_m = distanceAtOnePlace(track, candidate);
    if (!distance_m || *distance_m >= least_m || !matches(object)) continue;
    nearest = object;
    least_m = *distance_m;
  }
  return nearest;
}

bool ObjectTracks::isAt(ObjectId object, const Candidate& candidate) const {
  const auto found = state_.tracks.find(object);
  return found != state_.tracks.end() && distanceAtOnePlace(found->second, candidate).has_value();
}

bool ObjectTracks::isObserved(ObjectId root) const {
  return std::ranges::any_of(state_.tracks,
                             [&](const auto& track) { return catalogue_.mergeRootOf(track.first) == root; });
}

bool ObjectTracks::hasMoved(ObjectId object) const {
  const ObjectId root = catalogue_.mergeRootOf(object);
  return std::ranges::any_of(state_.moved,
                             [&](ObjectId moved) { return catalogue_.mergeRootOf(moved) == root; }) ||
         std::ranges::any_of(state_.tracks, [&](const auto& track) {
           return track.second.isMissing() && catalogue_.mergeRootOf(track.first) == root;
         });
}

std::vector<ObjectId> ObjectTracks::missing() const {
  std::set<ObjectId> missing;
  for (const auto& [object, track] : state_.tracks) {
    const ObjectId root = catalogue_.mergeRootOf(object);
    if (root && track.isMissing()) missing.insert(root);
  }
  return {missing.begin(), missing.end()};
}

}  // namespace scantrove
