#include "core/scan/object_collector.h"

#include <algorithm>
#include <set>

#include "core/scan/candidate_crop.h"

namespace scantrove {
namespace {
/// Two sightings of one scan are of one object when their centroids lie within this fraction of its diagonal.
constexpr float kSamePlaceFraction = 0.25F;
}  // namespace

Result<std::unique_ptr<ObjectCollector>> ObjectCollector::create(ComputeContext& compute,
                                                                 ObjectDatabase& database,
                                                                 std::int64_t session,
                                                                 const DetectionParams& params) {
  std::unique_ptr<ObjectCollector> collector(new ObjectCollector(database, session, params));
  Result<std::unique_ptr<Detector>> detector = Detector::create(compute);
  if (!detector) return fail(detector.error());
  collector->detector_ = std::move(*detector);
  collector->detector_->setParams(params);
  SCANTROVE_TRY(collector->reload());
  return collector;
}

void ObjectCollector::setParams(const DetectionParams& params) {
  detector_->setParams(params);
  views_.setParams(params);
}

Result<void> ObjectCollector::reload() {
  Result<std::vector<ObjectRecord>> objects = database_.objects();
  if (!objects) return fail(objects.error());
  const Result<std::vector<ObjectHolder>> holders = database_.holders();
  if (!holders) return fail(holders.error());
  records_.clear();
  for (ObjectRecord& record : *objects) {
    if (!met_.contains(record.id)) views_.countStored(record.id, record.views);
    records_.emplace(record.id, std::move(record));
  }
  detector_->clear();
  std::unordered_map<ObjectId, ObjectId> holder_of;
  for (const ObjectHolder& entry : *holders) holder_of.emplace(entry.object, entry.holder);
  SCANTROVE_TRY(database_.forEachDescriptor(0, [&](const StoredDescriptor& view) {
    const ObjectId holder = holder_of[view.first_object];
    if (records_.contains(holder)) detector_->add(holder, view.thumbnail, view.size_m);
  }));
  std::erase_if(object_of_region_, [&](const auto& entry) { return !records_.contains(entry.second); });
  std::erase_if(met_, [&](const auto& entry) { return !records_.contains(entry.first); });
  return {};
}

void ObjectCollector::regionsMerged(RegionId into, RegionId from) {
  const auto found = object_of_region_.find(from);
  if (found == object_of_region_.end()) return;
  object_of_region_.try_emplace(into, found->second);
  object_of_region_.erase(from);
}

Result<ObjectCollector::Happenings> ObjectCollector::collect(const RgbdFrame& frame, const PoseEstimate& pose,
                                                             const Intrinsics& working_K,
                                                             const std::vector<Candidate>& candidates) {
  Happenings happenings;
  std::vector<Sighting> sightings;
  if (!frame.color.empty()) {
    for (const Candidate& candidate : candidates) {
      sightings.push_back({&candidate, cutView(frame, pose.T_world_camera, working_K, candidate)});
      sightings.back().view.session = session_;
    }
  }
  std::vector<Sighting*> strangers;
  for (Sighting& sighting : sightings) {
    if (!object_of_region_.contains(sighting.candidate->region)) strangers.push_back(&sighting);
  }
  SCANTROVE_TRY(identify(strangers, happenings));
  for (Sighting& sighting : sightings) {
    const ObjectId object = object_of_region_.at(sighting.candidate->region);
    met_[object].centroid_world = sighting.candidate->centroid_world;
    met_[object].size_m = sighting.candidate->size_m;
    SCANTROVE_TRY(keepNewDirection(object, sighting, happenings));
  }
  for (const Candidate& candidate : candidates) happenings.seen.push_back(describe(candidate, working_K));
  return happenings;
}

Result<void> ObjectCollector::identify(const std::vector<Sighting*>& strangers, Happenings& happenings) {
  std::vector<Sighting*> to_look_up;
  std::vector<DetectionQuery> queries;
  for (Sighting* sighting : strangers) {
    // The same thing under a new region: no need to look at it.
    if (const ObjectId object = metNearby(*sighting->candidate)) {
      object_of_region_[sighting->candidate->region] = object;
      continue;
    }
    to_look_up.push_back(sighting);
    queries.push_back({sighting->view.color, sighting->view.mask, sighting->candidate->size_m});
  }
  if (queries.empty()) return {};
  const std::vector<DetectionMatch> matches = detector_->find(queries);
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const Sighting& sighting = *to_look_up[i];
    ObjectId object = matches[i].object;
    if (object) {
      if (!met_.contains(object)) happenings.recognised.push_back(records_.at(object));
      meet(object, *sighting.candidate, false);
    } else {
      Result<ObjectId> added = addToCatalogue(sighting, happenings);
      if (!added) return fail(added.error());
      object = *added;
    }
    object_of_region_[sighting.candidate->region] = object;
  }
  return {};
}

Result<ObjectId> ObjectCollector::addToCatalogue(const Sighting& sighting, Happenings& happenings) {
  const Candidate& candidate = *sighting.candidate;
  Result<ObjectRecord> added = database_.addObject(sighting.view);
  if (!added) return fail(added.error());
  detector_->add(added->id, sighting.view.color, sighting.view.mask, candidate.size_m);
  views_.keep(added->id, sighting.view.direction);
  meet(added->id, candidate, true);
  happenings.added.push_back(*added);
  records_[added->id] = *added;
  return added->id;
}

void ObjectCollector::meet(ObjectId object, const Candidate& candidate, bool is_new) {
  const auto [entry, first_time] = met_.try_emplace(object);
  if (first_time) entry->second.is_new = is_new;
  entry->second.centroid_world = candidate.centroid_world;
  entry->second.size_m = candidate.size_m;
}

ObjectId ObjectCollector::metNearby(const Candidate& candidate) const {
  for (const auto& [object, met] : met_) {
    const float diagonal = std::max(met.size_m.norm(), candidate.size_m.norm());
    const bool alike = std::min(met.size_m.norm(), candidate.size_m.norm()) > 0.5F * diagonal;
    if (alike && (met.centroid_world - candidate.centroid_world).norm() < kSamePlaceFraction * diagonal)
      return object;
  }
  return {};
}

Result<void> ObjectCollector::keepNewDirection(ObjectId object, Sighting& sighting, Happenings& happenings) {
  ObjectView& view = sighting.view;
  if (!views_.isNew(object, view.direction)) return {};
  view.object = object;
  Result<std::int64_t> stored = database_.addView(view);
  if (!stored) return fail(stored.error());
  views_.keep(object, view.direction);
  ObjectRecord& record = records_.at(object);
  ++record.views;
  detector_->add(object, view.color, view.mask, record.size_m);
  happenings.new_views.push_back(object);
  return {};
}

SeenObject ObjectCollector::describe(const Candidate& candidate, const Intrinsics& working_K) const {
  SeenObject seen;
  seen.region = candidate.region;
  const auto width = static_cast<float>(working_K.width);
  const auto height = static_cast<float>(working_K.height);
  seen.box = {static_cast<float>(candidate.box_px.x) / width, static_cast<float>(candidate.box_px.y) / height,
              static_cast<float>(candidate.box_px.width) / width,
              static_cast<float>(candidate.box_px.height) / height};
  seen.object = objectOf(candidate.region);
  if (const ObjectRecord* known = record(seen.object)) {
    seen.name = known->name;
    seen.confirmed = known->confirmed;
    seen.recognised = !met_.at(known->id).is_new;
  }
  return seen;
}

ObjectId ObjectCollector::objectOf(RegionId region) const {
  const auto found = object_of_region_.find(region);
  return found == object_of_region_.end() ? ObjectId{} : found->second;
}

const ObjectRecord* ObjectCollector::record(ObjectId object) const {
  const auto found = records_.find(object);
  return found == records_.end() ? nullptr : &found->second;
}

std::vector<ScanReport::Object> ObjectCollector::metObjects() const {
  std::vector<ScanReport::Object> objects;
  for (const auto& [id, met] : met_) {
    const ObjectRecord& known = records_.at(id);
    objects.push_back({id, known.name, known.confirmed, known.views,
                       met.is_new ? std::string() : known.first_session_name});
  }
  std::sort(objects.begin(), objects.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return objects;
}

}  // namespace scantrove
