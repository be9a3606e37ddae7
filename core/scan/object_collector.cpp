#include "core/scan/object_collector.h"

#include <algorithm>
#include <array>
#include <optional>

#include "core/base/log.h"
#include "core/discovery/candidate_finder.h"
#include "core/scan/candidate_crop.h"

namespace scantrove {
namespace {

/// A view is kept of a look whose size is about that of the object.
constexpr float kAlikeFraction = 0.7F;
/// An object that was seen so few frames ago is there under regions of its own.
constexpr int kFramesToReturn = 10;
/// An object that was seen elsewhere so few frames ago is not here.
constexpr int kFramesToMove = 90;

/// A look that is worth a view: the outline is the thing's own, and little of it is hidden.
bool isClear(const Candidate& candidate) {
  constexpr float kLeastOutline = 0.75F, kMostHidden = 0.35F;
  return candidate.is_whole && candidate.outline >= kLeastOutline && candidate.hidden <= kMostHidden;
}

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
  ++frame_;
  if (frames_until_retry_ > 0) --frames_until_retry_;
  if (mayUseCatalogue()) {
    if (const Result<void> followed = followCatalogue(); !followed) noteFailure(followed.error(), objects);
  }
  mergeJoined(objects);
  const Look look{frame, pose.T_world_camera, in_color, objects};
  lookUpDue(candidates, look);
  std::vector<ObjectId> identities;
  for (const Candidate& candidate : candidates) identities.push_back(identityOf(candidate));
  std::vector<const Candidate*> chosen;
  for (const std::size_t i : choose(candidates, identities)) {
    chosen.push_back(&candidates[i]);
    collectOne(candidates[i], identities[i], look);
  }
  joinDoubles(chosen);
  recognition_.forgetBefore(frame_ - RecognitionHistory::kMemory);
  for (const Candidate* candidate : chosen) {
    SeenObject seen;
    seen.regions = candidate->regions;
    seen.box = boxInColor(in_color, *candidate);
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

void ObjectCollector::lookUpDue(const std::vector<Candidate>& candidates, const Look& look) {
  if (look.frame.color.empty()) return;
  std::vector<const Candidate*> due;
  for (const Candidate& candidate : candidates) {
    if (!met_.objectOf(candidate.regions) && !met_.nearby(candidate, frame_ - kFramesToReturn) &&
        recognition_.isLookDue(candidate.regions, frame_))
      due.push_back(&candidate);
  }
  std::ranges::stable_sort(due, {}, [this](const Candidate* candidate) {
    return std::pair(!candidate->is_whole, recognition_.looks(candidate->regions));
  });
  due.resize(std::min(due.size(), kMostLooks));
  lookUp(due, look);
}

void ObjectCollector::lookUp(const std::vector<const Candidate*>& candidates, const Look& look) {
  if (candidates.empty()) return;
  std::vector<DetectionQuery> queries;
  for (const Candidate* candidate : candidates) {
    const std::optional<ObjectView> view = viewOf(*candidate, look);
    queries.push_back(view ? DetectionQuery{view->color, view->mask, candidate->size_m} : DetectionQuery{});
  }
  const std::vector<DetectionMatch> matches = catalogue_.detector().find(queries);
  for (std::size_t i = 0; i < matches.size(); ++i)
    recognition_.add(candidates[i]->regions, matches[i], params_.max_distance, frame_);
}

ObjectId ObjectCollector::identityOf(const Candidate& candidate) const {
  if (const ObjectId object = met_.objectOf(candidate.regions)) return object;
  // The same thing under a new region.
  if (const ObjectId object = met_.nearby(candidate, frame_ - kFramesToReturn)) return object;
  const std::optional<ObjectId> verdict = recognition_.verdict(candidate.regions);
  const ObjectRecord* known = verdict ? record(catalogue_.holderOf(*verdict)) : nullptr;
  if (known == nullptr) return {};
  // One of this look that was seen elsewhere a moment ago is another of the kind.
  for (const auto& [met_object, met] : met_.all()) {
    if (catalogue_.holderOf(met_object) == known->id && frame_ - met.last_frame < kFramesToMove &&
        !MetObjects::hasLeft(met) && !met_.isAt(met_object, candidate))
      return {};
  }
  return known->id;
}

std::vector<std::size_t> ObjectCollector::choose(const std::vector<Candidate>& candidates,
                                                 const std::vector<ObjectId>& identities) const {
  constexpr float kKnown = 0.3F, kConfirmed = 1;
  std::vector<float> known;
  for (const ObjectId object : identities) {
    const ObjectRecord* is_record = record(catalogue_.holderOf(object));
    const bool is_confirmed = is_record != nullptr && is_record->confirmed;
    known.push_back(!object ? 0 : (is_confirmed ? kConfirmed : kKnown));
  }
  return chooseDisjoint(candidates, known);
}

void ObjectCollector::collectOne(const Candidate& candidate, ObjectId identity, const Look& look) {
  if (!identity) {
    const bool is_unknown = recognition_.verdict(candidate.regions).has_value();  // or stands elsewhere
    if (isWanted(candidate) || (isClear(candidate) && is_unknown)) addToCatalogue(candidate, look);
    return;
  }
  const ObjectRecord* known = record(catalogue_.holderOf(identity));
  const float size_m = candidate.size_m.norm();
  const bool is_alike =
      known == nullptr || known->size_m.isZero() || !isMet(known->id) ||
      std::min(size_m, known->size_m.norm()) >= kAlikeFraction * std::max(size_m, known->size_m.norm());
  // A set that is much larger than the object holds more than it: its other regions stay free.
  if (!is_alike) return;
  if (known != nullptr && !isMet(known->id)) look.objects.recognised.push_back(*known);
  met_.bind(candidate.regions, identity);
  met_.meet(identity, candidate, frame_);
  if (isClear(candidate)) keepNewDirection(identity, candidate, look);
}

bool ObjectCollector::isWanted(const Candidate& candidate) const {
  return std::ranges::any_of(wanted_, [&](RegionId region) { return candidate.regions.contains(region); });
}

/// Two objects at one place are one, the second was met under other regions; those that were ever seen side
/// by side are two.
void ObjectCollector::joinDoubles(const std::vector<const Candidate*>& chosen) {
  std::set<ObjectId> in_view;
  for (const Candidate* candidate : chosen) in_view.insert(met_.objectOf(candidate->regions));
  in_view.erase(ObjectId{});
  for (const ObjectId a : in_view) {
    for (const ObjectId b : in_view) {
      if (a < b) side_by_side_.emplace(a, b);
    }
  }
  for (const Candidate* candidate : chosen) {
    const ObjectId object = met_.objectOf(candidate->regions);
    if (!object) continue;
    for (const auto& [other, met] : met_.all()) {
      if (in_view.contains(other) || side_by_side_.contains(std::minmax(object, other))) continue;
      if (met_.isAt(other, *candidate) &&
          shouldMerge(catalogue_.holderOf(other), catalogue_.holderOf(object)))
        joined_.emplace_back(other, object);
    }
  }
}

void ObjectCollector::addToCatalogue(const Candidate& candidate, const Look& look) {
  if (!mayUseCatalogue() || look.frame.color.empty()) return;
  const std::optional<ObjectView> view = viewOf(candidate, look);
  if (!view) return;
  const Result<ObjectRecord> added = database_.addObject(*view);
  if (!added) return noteFailure(added.error(), look.objects);
  is_failure_said_ = false;
  look.objects.added.push_back(*added);
  catalogue_.noteAdded(*added);
  met_.bind(candidate.regions, added->id);
  met_.meet(added->id, candidate, frame_);
  met_.met(added->id).views.keep(directionOf(candidate, look.T_world_camera));
  for (const RegionId region : candidate.regions) wanted_.erase(region);
}

void ObjectCollector::keepNewDirection(ObjectId object, const Candidate& candidate, const Look& look) {
  const ObjectRecord* holder = record(catalogue_.holderOf(object));
  if (holder == nullptr || holder->views >= params_.max_views || !mayUseCatalogue() ||
      look.frame.color.empty())
    return;
  const Eigen::Vector3f direction = directionOf(candidate, look.T_world_camera);
  const bool is_new = std::ranges::all_of(met_.all(), [&](const auto& met) {
    return catalogue_.holderOf(met.first) != holder->id ||
           met.second.views.isNew(direction, params_.new_view_angle_deg);
  });
  if (!is_new) return;
  std::optional<ObjectView> view = viewOf(candidate, look);
  if (!view) return;
  view->object = object;
  if (const Result<std::int64_t> stored = database_.addView(*view); !stored)
    return noteFailure(stored.error(), look.objects);
  is_failure_said_ = false;
  met_.met(object).views.keep(direction);
  catalogue_.noteView(holder->id);
  look.objects.new_views.push_back(holder->id);
}

std::optional<ObjectView> ObjectCollector::viewOf(const Candidate& candidate, const Look& look) const {
  std::optional<ObjectView> view = cutView(look.frame, look.T_world_camera, look.in_color, candidate);
  if (view) view->session = session_;
  return view;
}

void ObjectCollector::regionsJoined(RegionId into, RegionId from) {
  recognition_.forgetRegion(from);
  const auto [kept, gone] = met_.regionsJoined(into, from);
  if (!kept) return;
  if (!catalogue_.holderOf(kept)) {
    met_.bind({into}, gone);  // a deleted one gives way
  } else {
    joined_.emplace_back(kept, gone);
  }
}

void ObjectCollector::regionsParted(RegionId from, RegionId part) {
  const ObjectId object = met_.objectOf(from);
  if (object && !catalogue_.holderOf(object)) met_.bind({part}, object);
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

bool ObjectCollector::isMet(ObjectId holder) const {
  return std::ranges::any_of(met_.all(),
                             [&](const auto& met) { return catalogue_.holderOf(met.first) == holder; });
}

void ObjectCollector::describeObject(SeenObject& seen) const {
  seen.object = catalogue_.holderOf(met_.objectOf(seen.regions));
  const ObjectRecord* known = record(seen.object);
  seen.name = known != nullptr ? known->name : std::string();
  seen.confirmed = known != nullptr && known->confirmed;
  seen.recognised = known != nullptr && known->first_session != session_;
}

ObjectId ObjectCollector::objectOf(RegionId region) const {
  return catalogue_.holderOf(met_.objectOf(region));
}

std::vector<ScanReport::Object> ObjectCollector::metObjects() const {
  std::map<ObjectId, ScanReport::Object> objects;
  for (const auto& [object, met] : met_.all()) {
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
