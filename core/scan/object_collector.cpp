#include "core/scan/object_collector.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <variant>

#include "core/catalogue/thumbnail.h"
#include "core/discovery/candidate_finder.h"
#include "core/scan/candidate_crop.h"
#include "core/scan/clarity.h"
#include "core/scan/collector_memory.h"

namespace scantrove {
namespace {

/// An object that was seen so few frames ago is there under regions of its own.
constexpr int kFramesToReturn = 10;
/// What was recognised is held against earlier scans so often.
constexpr int kFramesToAlign = 30;
/// An object that was seen elsewhere so few frames ago is not here.
constexpr int kFramesToMove = 90;

/// What is to be announced of some news.
struct Announced {
  FrameObjects& objects;

  void operator()(const news::ObjectStored& e) const { objects.added.push_back(e.record); }
  void operator()(const news::ViewStored& e) const { objects.new_views.push_back(e.root); }
  void operator()(const news::MergeStored& e) const { objects.merged.push_back(e.merge); }
  void operator()(const news::NameStored& e) const {
    objects.named.push_back({e.naming.object, e.naming.name});
    if (e.naming.merge) objects.merged.push_back(*e.naming.merge);
  }
  void operator()(const news::ViewsDiscarded& e) const {
    if (e.is_removed) objects.left.push_back(e.object);
  }
  void operator()(const news::NameDropped& e) const {
    if (e.why) objects.catalogue_failure = e.why;
  }
  void operator()(const news::Failed& e) const { objects.catalogue_failure = e.error; }
  void operator()(const auto& /*nothing that anybody waits for*/) const {}
};

}  // namespace

ObjectCollector::ObjectCollector(Detector detector, const DetectionParams& params)
    : catalogue_(std::move(detector)) {
  setParams(params);
}

Result<std::unique_ptr<ObjectCollector>> ObjectCollector::create(ComputeContext& compute,
                                                                 ObjectDatabase& database,
                                                                 CatalogueWriter::Options writer,
                                                                 const DetectionParams& params,
                                                                 std::span<const std::uint32_t> memory) {
  Result<Detector> detector = Detector::create(compute);
  if (!detector) return fail(detector.error());
  std::unique_ptr<ObjectCollector> collector(new ObjectCollector(std::move(*detector), params));
  const auto known = CollectorMemory::restore(memory, *collector);
  Result<CataloguePosition> position = collector->catalogue_.load(database);
  if (!position) return fail(position.error());
  if (known) {
    SCANTROVE_TRY(CollectorMemory::checkObjects(*collector));
    position->event = known->event;
    writer.session = known->session;
    writer.ids = collector->catalogue_.idsOfThisScan();
  }
  SCANTROVE_TRY(moveInto(collector->writer_, CatalogueWriter::start(writer, *position)));
  return collector;
}

void ObjectCollector::setParams(const DetectionParams& params) {
  params_ = params;
  catalogue_.detector().setParams(params);
}

FrameObjects ObjectCollector::collect(const RgbdFrame& frame, const PoseEstimate& pose,
                                      const SurfaceInColor& in_color, std::vector<Candidate> candidates) {
  FrameObjects objects;
  std::erase_if(candidates, [this](const Candidate& candidate) {
    return candidate.objectness && !mayBeObject(candidate.regions);
  });
  if (frame_ == 1) catalogue_.detector().warmUp();  // the first has been shown by then
  frame_ += is_looking_again_ ? RecognitionHistory::kFramesApart : 1;
  takeNews(objects);
  mergeJoined();
  if (is_looking_again_ || frame_ % kFramesToAlign == 0) alignWithEarlierScans();
  const Look look{frame, pose.T_world_camera, in_color, objects};
  lookUpDue(candidates, look);
  lookAmongThoseThatCame(candidates, look);
  std::vector<ObjectId> identities;
  for (const Candidate& candidate : candidates) identities.push_back(identityOf(candidate));
  std::vector<const Candidate*> chosen;
  for (const std::size_t i : choose(candidates, identities)) {
    chosen.push_back(&candidates[i]);
    collectOne(candidates[i], identities[i], look);
  }
  joinDoubles(chosen);
  if (is_looking_again_) lookAmongThoseOfBefore(chosen, look);
  const int oldest = frame_ - RecognitionHistory::kMemory;
  recognition_.forgetBefore(oldest);
  std::erase_if(doubts_, [oldest](const auto& entry) { return entry.second.last_frame < oldest; });
  for (const Candidate* candidate : chosen) {
    SeenObject seen;
    seen.regions = candidate->regions;
    seen.box = boxInColor(in_color, *candidate);
    describeObject(seen);
    objects.seen.push_back(std::move(seen));
  }
  return objects;
}

void ObjectCollector::takeNews(FrameObjects& objects) {
  for (const CatalogueNews& news : writer_->takeNews()) {
    catalogue_.apply(news);
    std::visit(Announced{objects}, news);
    if (const auto* named = std::get_if<news::NameStored>(&news)) noteStored(*named);
    objects.has_news = true;
  }
  if (!known_again_.empty()) {
    std::ranges::move(known_again_, std::back_inserter(objects.recognized));
    known_again_.clear();
    objects.has_news = true;
  }
  if (!refusals_.empty()) {
    objects.catalogue_failure = refusals_.front();
    objects.has_news = true;
    refusals_.erase(refusals_.begin());
  }
  writer_->follow();
}

FrameObjects ObjectCollector::followCatalogue() {
  FrameObjects objects;
  takeNews(objects);
  return objects;
}

Result<void> ObjectCollector::finish(const std::function<void(const FrameObjects&)>& announce) {
  mergeJoined(Which::all);
  return writer_->finish([&] { announce(followCatalogue()); });
}

void ObjectCollector::lookUpDue(const std::vector<Candidate>& candidates, const Look& look) {
  if (look.frame.color.empty()) return;
  std::vector<const Candidate*> due;
  for (const Candidate& candidate : candidates) {
    if (!met_.objectOf(candidate.regions) && !nearby(candidate) &&
        recognition_.isAttemptDue(candidate.regions, frame_))
      due.push_back(&candidate);
  }
  std::ranges::stable_sort(due, {}, [this](const Candidate* candidate) {
    return std::pair(!candidate->is_complete, recognition_.observations(candidate->regions));
  });
  due.resize(std::min(due.size(), kMaxObservations));
  lookUp(due, look);
}

void ObjectCollector::lookUp(const std::vector<const Candidate*>& candidates, const Look& look) {
  if (candidates.empty()) return;
  const std::vector<ObjectId> missing = missingObjects();
  std::vector<DetectionQuery> queries(candidates.size());
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Candidate& candidate = *candidates[i];
    const std::optional<ObjectView> view =
        cropView(look.frame, look.T_world_camera, look.in_color, candidate);
    if (!view) continue;
    queries[i] = {view->color, view->mask, candidate.size_m};
    queries[i].guesses = candidate.has_appeared ? missing : expectedAt(candidate);
  }
  const std::vector<DetectionMatch> matches = catalogue_.detector().find(queries);
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const DetectionMatch match =
        candidates[i]->has_appeared ? orBack(matches[i], missing.size()) : orExpected(matches[i]);
    recognition_.add(candidates[i]->regions, match, params_.max_distance, frame_);
  }
}

ObjectId ObjectCollector::identityOf(const Candidate& candidate) const {
  if (const ObjectId object = met_.objectOf(candidate.regions)) return object;
  const std::string* wanted_name = wantedName(candidate);
  // The same thing under a new region.
  const ObjectId before = nearby(candidate);
  if (const ObjectId object = isDoubted(candidate.regions, before) ? ObjectId{} : before) {
    // What a person deleted is not added again, but by a person.
    if (wanted_name == nullptr) return object;
    const auto other = not_these_.find(*candidate.regions.begin());
    if (catalogue_.mergeRootOf(object) && (other == not_these_.end() || other->second != object))
      return object;
  }
  if (wanted_name != nullptr && !wanted_name->empty()) return {};  // what it looks like counts for less
  const std::optional<ObjectId> verdict = recognition_.verdict(candidate.regions);
  const ObjectRecord* known = verdict ? recordOf(catalogue_.mergeRootOf(*verdict)) : nullptr;
  if (known == nullptr || isDoubted(candidate.regions, known->id) ||
      isOfAnotherWhole(known->id, candidate.regions))
    return {};
  // One of this look that was seen elsewhere a moment ago is another of the kind.
  for (const auto& [met_object, met] : met_.all()) {
    if (catalogue_.mergeRootOf(met_object) == known->id &&
        (is_looking_again_ || frame_ - met.last_frame < kFramesToMove) && !MetObjects::wasRemoved(met) &&
        !met_.isAt(met_object, candidate))
      return {};
  }
  return known->id;
}

ObjectId ObjectCollector::nearby(const Candidate& candidate) const {
  return met_.nearby(candidate, frame_ - kFramesToReturn, [&](ObjectId object) {
    return !isInViewBeside(object, candidate.regions) && !isOfAnotherWhole(object, candidate.regions);
  });
}

bool ObjectCollector::isInViewBeside(ObjectId object, const RegionSet& regions) const {
  return std::ranges::any_of(in_view_, [&](RegionId region) {
    return met_.objectOf(region) == object && !regions.contains(region);
  });
}

std::vector<std::size_t> ObjectCollector::choose(const std::vector<Candidate>& candidates,
                                                 const std::vector<ObjectId>& identities) const {
  constexpr float kKnown = 0.3F, kConfirmed = 1, kWanted = 3;
  std::vector<float> known;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const ObjectId object = identities[i];
    const ObjectRecord* root = recordOf(catalogue_.mergeRootOf(object));
    const bool is_confirmed = root != nullptr && root->confirmed;
    known.push_back(!object ? 0 : (is_confirmed ? kConfirmed : kKnown));
    const std::string* wanted_name = wantedName(candidates[i]);
    if (wanted_name != nullptr && !wanted_name->empty()) known.back() = kWanted;
  }
  return chooseDisjoint(candidates, known);
}

void ObjectCollector::collectOne(const Candidate& candidate, ObjectId identity, const Look& look) {
  if (const auto doubt = doubts_.find(candidate.regions); doubt != doubts_.end())
    met_.stillThere(doubt->second.object, frame_);
  if (!identity) {
    const bool is_unknown = recognition_.verdict(candidate.regions).has_value();  // or stands elsewhere
    const bool is_found = (isClear(candidate, kForObject) && is_unknown) || isLastLook(candidate, look);
    if (is_found || isWanted(candidate.regions))
      addToCatalogue(candidate, look, is_found ? MadeFor::itself : MadeFor::wish);
    return;
  }
  const ObjectRecord* known = recordOf(catalogue_.mergeRootOf(identity));
  const bool is_alike = known == nullptr || isAlike(*known, candidate, look);
  // A set that is much larger than the object holds more than it: its other regions stay free. Of what came,
  // a part may not be on the map yet.
  const bool is_requested = wantedName(candidate) != nullptr;
  const bool has_appeared = candidate.has_appeared && candidate.regions.size() == 1;
  const bool is_needed = isLastLook(candidate, look) && !hasView(identity);
  if (!is_alike && !is_requested && !has_appeared && !is_needed) {
    // Of what was put elsewhere that says more than its size.
    if (!isSettled(*known) && !isHeldWith(known->id, back_) && isClear(candidate, kForObject) &&
        isOfOtherSize(*known, candidate))
      doubt(candidate, identity);
    return;
  }
  doubts_.erase(candidate.regions);
  if (known != nullptr && !isMet(known->id) && !CatalogueMirror::isOfThisScan(known->id))
    look.objects.recognized.push_back(*known);
  if (met_.objectOf(candidate.regions) != identity && met_.all().contains(identity) &&
      !met_.isAt(identity, candidate))
    moved_.insert(identity);
  met_.bind(candidate.regions, identity);
  met_.meet(identity, candidate, frame_);
  if (is_requested || is_needed || (is_alike && isClear(candidate, kForView)))
    keepNewDirection(identity, candidate, look);
  if (is_requested) fulfil(candidate, identity, MadeFor::itself);
}

void ObjectCollector::addToCatalogue(const Candidate& candidate, const Look& look, MadeFor made) {
  if (look.frame.color.empty()) return;
  std::optional<ObjectView> view = viewToKeep(candidate, look);
  if (!view) return;
  const ObjectId object = catalogue_.nextKey();
  view->object = object;
  if (!writer_->addObject(*view)) return;  // it stays a candidate
  catalogue_.add(*view);
  if (const auto doubt = doubts_.find(candidate.regions); doubt != doubts_.end())
    takePlaceOf(doubt->second.object, object);
  if (candidate.has_appeared) appeared_.try_emplace(object);
  met_.bind(candidate.regions, object);
  met_.meet(object, candidate, frame_);
  met_.met(object).views.keep(view->direction);
  noteKept(*view, candidate, look.frame, look.in_color.places.size());
  fulfil(candidate, object, made);
}

void ObjectCollector::keepNewDirection(ObjectId object, const Candidate& candidate, const Look& look) {
  const ObjectRecord* root = recordOf(catalogue_.mergeRootOf(object));
  if (root == nullptr || root->views >= params_.max_views || look.frame.color.empty()) return;
  const Eigen::Vector3f direction = directionOf(candidate, look.T_world_camera);
  const bool is_new = std::ranges::all_of(met_.all(), [&](const auto& met) {
    return catalogue_.mergeRootOf(met.first) != root->id ||
           met.second.views.isNew(direction, params_.new_view_angle_deg);
  });
  if (!is_new || !writer_->hasRoomForView(object)) return;
  std::optional<ObjectView> view = viewToKeep(candidate, look);
  if (!view) return;
  view->object = object;
  catalogue_.addView(*view);
  noteKept(*view, candidate, look.frame, look.in_color.places.size());
  writer_->addView(std::move(*view));
  met_.met(object).views.keep(direction);
}

std::optional<ObjectView> ObjectCollector::viewToKeep(const Candidate& candidate, const Look& look) {
  std::optional<ObjectView> view = cropView(look.frame, look.T_world_camera, look.in_color, candidate);
  if (view) view->descriptor = makeThumbnail(view->color, view->mask);
  return view;
}

bool ObjectCollector::isMet(ObjectId root) const {
  return std::ranges::any_of(met_.all(),
                             [&](const auto& met) { return catalogue_.mergeRootOf(met.first) == root; });
}

void ObjectCollector::describeObject(SeenObject& seen) const {
  const ObjectRecord* known = recordOf(catalogue_.mergeRootOf(met_.objectOf(seen.regions)));
  const bool is_known = known != nullptr;
  seen.object = is_known ? catalogue_.idOf(known->id) : ObjectId{};
  seen.name = is_known ? known->name : std::string();
  seen.confirmed = is_known && known->confirmed;
  seen.recognized = is_known && !CatalogueMirror::isOfThisScan(known->id);
}

ObjectId ObjectCollector::objectOf(RegionId region) const {
  return catalogue_.idOf(catalogue_.mergeRootOf(met_.objectOf(region)));
}

RegionObject ObjectCollector::describeRegion(RegionId region) const {
  const ObjectId object = met_.objectOf(region), root = catalogue_.mergeRootOf(object);
  const ObjectRecord* known = recordOf(root);
  if (known == nullptr) return {.state = object ? RegionObject::State::deleted : RegionObject::State::none};
  const ObjectId id = catalogue_.idOf(known->id);
  if (!id) return {};  // not stored yet
  return {RegionObject::State::known, id, known->name, known->named_by, known->confirmed, root != object};
}

std::optional<ObjectRecord> ObjectCollector::record(ObjectId object) const {
  const ObjectRecord* known = recordOf(catalogue_.keyOf(object));
  if (known == nullptr) return std::nullopt;
  ObjectRecord record = *known;
  record.id = object;
  return record;
}

std::vector<ScanReport::Object> ObjectCollector::metObjects() const {
  std::map<ObjectId, ScanReport::Object> objects;
  for (const auto& [object, met] : met_.all()) {
    const ObjectRecord* known = recordOf(catalogue_.mergeRootOf(object));
    const ObjectId id = known != nullptr ? catalogue_.idOf(known->id) : ObjectId{};
    if (!id) continue;
    objects[id] = {id, known->name, known->confirmed, known->views,
                   CatalogueMirror::isOfThisScan(known->id) ? std::string() : known->first_session_name};
  }
  std::vector<ScanReport::Object> list;
  for (auto& [id, object] : objects) list.push_back(std::move(object));
  return list;
}

}  // namespace scantrove
