#include "core/scan/object_collector.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "core/base/log.h"
#include "core/scan/candidate_crop.h"

namespace scantrove {
namespace {

/// Two sightings of one scan are of one object when their centroids lie within this fraction of its diagonal.
constexpr float kSamePlaceFraction = 0.25F;

/// A person said what this object is.
bool isSettled(const ObjectRecord& record) { return record.confirmed || record.named_by == NamedBy::person; }

}  // namespace

ObjectCollector::ObjectCollector(ObjectDatabase& database, std::int64_t session, Detector detector,
                                 const DetectionParams& params)
    : database_(database), session_(session), catalogue_(database, std::move(detector)) {
  setParams(params);
}

Result<std::unique_ptr<ObjectCollector>> ObjectCollector::create(ComputeContext& compute,
                                                                 ObjectDatabase& database,
                                                                 std::int64_t session,
                                                                 const DetectionParams& params) {
  Result<Detector> detector = Detector::create(compute);
  if (!detector) return fail(detector.error());
  std::unique_ptr<ObjectCollector> collector(
      new ObjectCollector(database, session, std::move(*detector), params));
  SCANTROVE_TRY(collector->catalogue_.load());
  return collector;
}

void ObjectCollector::setParams(const DetectionParams& params) {
  params_ = params;
  catalogue_.detector().setParams(params);
}

FrameObjects ObjectCollector::collect(const RgbdFrame& frame, const PoseEstimate& pose,
                                      const SurfaceInColor& in_color,
                                      const std::vector<Candidate>& candidates) {
  FrameObjects objects;
  if (frames_until_retry_ > 0) --frames_until_retry_;
  if (mayUseCatalogue()) {
    if (const Result<void> followed = followCatalogue(); !followed) noteFailure(followed.error(), objects);
  }
  mergeJoined(objects);
  std::vector<Sighting> sightings;
  if (!frame.color.empty()) {
    for (const Candidate& candidate : candidates) {
      std::optional<ObjectView> view = cutView(frame, pose.T_world_camera, in_color, candidate);
      if (!view) continue;
      view->session = session_;
      sightings.push_back({&candidate, std::move(*view)});
    }
  }
  std::vector<Sighting*> unidentified;
  for (Sighting& sighting : sightings) {
    if (!object_of_region_.contains(sighting.candidate->region)) unidentified.push_back(&sighting);
  }
  identify(unidentified, objects);
  for (Sighting& sighting : sightings) {
    const auto found = object_of_region_.find(sighting.candidate->region);
    if (found == object_of_region_.end()) continue;
    meet(found->second, *sighting.candidate);
    keepNewDirection(found->second, sighting, objects);
  }
  for (const Candidate& candidate : candidates) {
    SeenObject seen;
    seen.region = candidate.region;
    seen.box = boxInColor(in_color, candidate);
    describeObject(seen);
    objects.seen.push_back(std::move(seen));
  }
  return objects;
}

void ObjectCollector::noteFailure(const Error& error, FrameObjects& objects) {
  frames_until_retry_ = kFramesUntilRetry;
  if (is_failure_said_) {
    spdlog::warn("{}", error.message());
  } else {
    objects.catalogue_failure = error;
    is_failure_said_ = true;
  }
}

void ObjectCollector::identify(const std::vector<Sighting*>& unidentified, FrameObjects& objects) {
  std::vector<Sighting*> to_look_up;
  std::vector<DetectionQuery> queries;
  for (Sighting* sighting : unidentified) {
    // The same thing under a new region: no need to look at it.
    if (const ObjectId object = metNearby(*sighting->candidate)) {
      object_of_region_[sighting->candidate->region] = object;
      continue;
    }
    to_look_up.push_back(sighting);
    queries.push_back({sighting->view.color, sighting->view.mask, sighting->candidate->size_m});
  }
  if (queries.empty()) return;
  const std::vector<DetectionMatch> matches = catalogue_.detector().find(queries);
  for (std::size_t i = 0; i < matches.size(); ++i) {
    ObjectId object = matches[i].object;
    if (const ObjectRecord* known = record(object)) {
      if (!isMet(object)) objects.recognised.push_back(*known);
    } else {
      object = addToCatalogue(*to_look_up[i], objects);
      if (!object) continue;
    }
    object_of_region_[to_look_up[i]->candidate->region] = object;
    meet(object, *to_look_up[i]->candidate);
  }
}

ObjectId ObjectCollector::addToCatalogue(Sighting& sighting, FrameObjects& objects) {
  if (!mayUseCatalogue()) return {};
  const Result<ObjectRecord> added = database_.addObject(sighting.view);
  if (!added) {
    noteFailure(added.error(), objects);
    return {};
  }
  is_failure_said_ = false;
  objects.added.push_back(*added);
  catalogue_.noteAdded(*added);
  met_[added->id].views.keep(sighting.view.direction);
  return added->id;
}

void ObjectCollector::keepNewDirection(ObjectId object, Sighting& sighting, FrameObjects& objects) {
  const ObjectRecord* holder = record(catalogue_.holderOf(object));
  if (holder == nullptr || holder->views >= params_.max_views || !mayUseCatalogue()) return;
  ObjectView& view = sighting.view;
  const bool is_new = std::ranges::all_of(met_, [&](const auto& met) {
    return catalogue_.holderOf(met.first) != holder->id ||
           met.second.views.isNew(view.direction, params_.new_view_angle_deg);
  });
  if (!is_new) return;
  view.object = object;
  if (const Result<std::int64_t> stored = database_.addView(view); !stored) {
    noteFailure(stored.error(), objects);
    return;
  }
  is_failure_said_ = false;
  met_.at(object).views.keep(view.direction);
  catalogue_.noteView(holder->id);
  objects.new_views.push_back(holder->id);
}

void ObjectCollector::regionsMerged(RegionId into, RegionId from) {
  const auto found = object_of_region_.find(from);
  if (found == object_of_region_.end()) return;
  const ObjectId object = found->second;
  object_of_region_.erase(found);
  const auto [entry, is_first] = object_of_region_.try_emplace(into, object);
  if (is_first) return;
  if (!catalogue_.holderOf(entry->second)) {
    entry->second = object;  // a deleted one gives way
  } else {
    joined_.emplace_back(entry->second, object);
  }
}

bool ObjectCollector::shouldMerge(ObjectId a, ObjectId b) const {
  const ObjectRecord* first = record(a);
  const ObjectRecord* second = record(b);
  if (first == nullptr || second == nullptr || a == b || catalogue_.areKeptApart(a, b)) return false;
  return !(isSettled(*first) && isSettled(*second));
}

void ObjectCollector::mergeJoined(FrameObjects& objects) {
  if (!mayUseCatalogue()) return;
  while (!joined_.empty()) {
    const std::array<ObjectId, 2> pair{catalogue_.holderOf(joined_.back().first),
                                       catalogue_.holderOf(joined_.back().second)};
    if (shouldMerge(pair[0], pair[1])) {
      Result<ObjectMerge> merge = database_.merge(pair);
      if (merge) {
        is_failure_said_ = false;
        objects.merged.push_back(std::move(*merge));
      }
      const Result<void> followed = merge ? followCatalogue() : fail(merge.error());
      if (!followed) return noteFailure(followed.error(), objects);
    }
    joined_.pop_back();
  }
}

void ObjectCollector::meet(ObjectId object, const Candidate& candidate) {
  MetObject& met = met_[object];
  met.centroid_world = candidate.centroid_world;
  met.size_m = candidate.size_m;
}

bool ObjectCollector::isMet(ObjectId holder) const {
  return std::ranges::any_of(met_, [&](const auto& met) { return catalogue_.holderOf(met.first) == holder; });
}

ObjectId ObjectCollector::metNearby(const Candidate& candidate) const {
  ObjectId nearest;
  float least_distance_m = std::numeric_limits<float>::max();
  for (const auto& [object, met] : met_) {
    const float diagonal = std::max(met.size_m.norm(), candidate.size_m.norm());
    const bool alike = std::min(met.size_m.norm(), candidate.size_m.norm()) > 0.5F * diagonal;
    const float distance_m = (met.centroid_world - candidate.centroid_world).norm();
    if (!alike || distance_m >= std::min(kSamePlaceFraction * diagonal, least_distance_m)) continue;
    nearest = object;
    least_distance_m = distance_m;
  }
  return nearest;
}

void ObjectCollector::describeObject(SeenObject& seen) const {
  seen.object = objectOf(seen.region);
  const ObjectRecord* known = record(seen.object);
  seen.name = known != nullptr ? known->name : std::string();
  seen.confirmed = known != nullptr && known->confirmed;
  seen.recognised = known != nullptr && known->first_session != session_;
}

ObjectId ObjectCollector::objectOf(RegionId region) const {
  const auto found = object_of_region_.find(region);
  return found == object_of_region_.end() ? ObjectId{} : catalogue_.holderOf(found->second);
}

std::vector<ScanReport::Object> ObjectCollector::metObjects() const {
  std::map<ObjectId, ScanReport::Object> objects;
  for (const auto& [object, met] : met_) {
    const ObjectRecord* known = record(catalogue_.holderOf(object));
    if (known == nullptr) continue;
    objects[known->id] = {known->id, known->name, known->confirmed, known->views,
                          known->first_session == session_ ? std::string() : known->first_session_name};
  }
  std::vector<ScanReport::Object> list;
  for (auto& [id, object] : objects) list.push_back(std::move(object));
  return list;
}

}  // namespace scantrove
