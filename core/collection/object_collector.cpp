#include "core/collection/object_collector.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>
#include <variant>

#include "core/collection/clarity.h"
#include "core/discovery/candidate_finder.h"

namespace scantrove {
namespace {

/// Frames between comparisons of recognised objects with earlier scans.
constexpr int kFramesToAlign = 30;

/// What an event of the catalogue announces.
struct Announced {
  FrameObjects& objects;

  void operator()(const event::ObjectStored& e) const { objects.added.push_back(e.record); }
  void operator()(const event::ViewStored& e) const { objects.new_views.push_back(e.root); }
  void operator()(const event::MergeStored& e) const { objects.merged.push_back(e.merge); }
  void operator()(const event::NameStored& e) const {
    objects.named.push_back({e.naming.object, e.naming.name});
    if (e.naming.merge) objects.merged.push_back(*e.naming.merge);
  }
  void operator()(const event::ViewsDiscarded& e) const {
    if (e.is_removed) objects.removed.push_back(e.object);
  }
  void operator()(const event::NameDropped& e) const {
    if (e.why) objects.catalogue_failure = e.why;
  }
  void operator()(const event::Failed& e) const { objects.catalogue_failure = e.error; }
  void operator()(const auto& /*nothing that anybody waits for*/) const {}
};

}  // namespace

ObjectCollector::ObjectCollector(CatalogueMirror catalogue, std::unique_ptr<CatalogueWriter> writer,
                                 const DetectionParams& params, CollectorState state)
    : catalogue_(std::move(catalogue)),
      writer_(std::move(writer)),
      tracks_(catalogue_, std::move(state.tracks)),
      requests_(catalogue_, *writer_, tracks_, std::move(state.requests)),
      identities_(catalogue_, *writer_, tracks_, requests_, std::move(state.identities)),
      recognizer_(catalogue_, tracks_, requests_, std::move(state.recognizer)),
      views_(catalogue_, *writer_, tracks_, requests_, identities_, std::move(state.views)),
      best_views_(catalogue_, tracks_, requests_, identities_, views_),
      objects_(catalogue_, tracks_),
      is_refining_(state.is_refining),
      is_last_pass_(state.is_last_pass),
      frame_(state.frame) {
  setParams(params);
}

Result<std::unique_ptr<ObjectCollector>> ObjectCollector::create(ComputeContext& compute,
                                                                 ObjectDatabase& database,
                                                                 CatalogueWriter::Options writer,
                                                                 const DetectionParams& params,
                                                                 std::span<const std::uint32_t> memory) {
  Result<Detector> detector = Detector::create(compute, params.model);
  if (!detector) return fail(detector.error());
  CatalogueMirror catalogue(std::move(*detector));
  std::optional<CollectorState> known = collectorStateFrom(memory);
  if (known) catalogue.continueSession(known->catalogue);
  Result<CataloguePosition> position = catalogue.load(database);
  if (!position) return fail(position.error());
  if (known) {
    SCANTROVE_TRY(checkObjects(*known, catalogue));
    position->event = known->last_event;
    writer.session = known->catalogue.session;
    writer.ids = known->catalogue.ids;
  }
  Result<std::unique_ptr<CatalogueWriter>> started = CatalogueWriter::start(writer, *position);
  if (!started) return fail(started.error());
  return std::unique_ptr<ObjectCollector>(new ObjectCollector(
      std::move(catalogue), std::move(*started), params, known ? std::move(*known) : CollectorState{}));
}

CollectorState ObjectCollector::state() const {
  CollectorState state;
  state.catalogue = catalogue_.continued();
  state.catalogue.session = writer_->session();
  state.last_event = writer_->lastEvent();
  state.tracks = tracks_.state();
  state.requests = requests_.state();
  state.identities = identities_.state();
  state.recognizer = recognizer_.state();
  state.views = views_.all();
  state.is_refining = is_refining_;
  state.is_last_pass = is_last_pass_;
  state.frame = frame_;
  return state;
}

void ObjectCollector::setParams(const DetectionParams& params) {
  recognizer_.setParams(params);
  views_.setParams(params);
}

FrameObjects ObjectCollector::collect(const RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera,
                                      const SurfaceInColor& in_color, std::vector<Candidate> candidates) {
  FrameObjects objects;
  std::erase_if(candidates, [this](const Candidate& candidate) {
    return candidate.objectness && !mayBeObject(candidate.regions);
  });
  if (frame_ == 1) recognizer_.warmUp();  // the first frame is on screen by now
  frame_ += is_refining_ ? RecognitionHistory::kFramesApart : 1;
  applyEvents(objects);
  identities_.merge(IdentityResolver::Which::held, frame_);
  if (is_refining_ || frame_ % kFramesToAlign == 0) recognizer_.alignWithEarlierScans();
  const ObservedFrame observed{frame, T_world_camera, in_color};
  std::vector<const Candidate*> unidentified;
  for (const Candidate& candidate : candidates) {
    if (!tracks_.objectOf(candidate.regions) && !identities_.nearby(candidate, frame_))
      unidentified.push_back(&candidate);
  }
  recognizer_.lookUp(std::move(unidentified), observed, frame_);
  merge(recognizer_.compareAppeared(candidates, observed));
  std::vector<ObjectId> identities;
  for (const Candidate& candidate : candidates) identities.push_back(identityOf(candidate));
  std::vector<const Candidate*> chosen;
  for (const std::size_t i : choose(candidates, identities)) {
    chosen.push_back(&candidates[i]);
    collectOne(candidates[i], identities[i], observed, objects);
  }
  identities_.mergeDuplicates(chosen, frame_);
  if (is_refining_) merge(recognizer_.compareWithEarlierScans(chosen, observed));
  const int oldest = frame_ - RecognitionHistory::kMemory;
  recognizer_.forgetBefore(oldest);
  identities_.forgetBefore(oldest);
  for (const Candidate* candidate : chosen) {
    SeenObject seen;
    seen.regions = candidate->regions;
    seen.box = boxInColor(in_color, *candidate);
    objects_.describe(seen);
    objects.seen.push_back(std::move(seen));
  }
  return objects;
}

FrameObjects ObjectCollector::addRequested(const RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera,
                                           const SurfaceInColor& in_color,
                                           const std::vector<Candidate>& candidates) {
  FrameObjects objects;
  applyEvents(objects);
  const ObservedFrame observed{frame, T_world_camera, in_color};
  for (const Candidate& candidate : candidates) {
    if (requests_.requestedName(candidate) != nullptr)
      collectOne(candidate, identityOf(candidate), observed, objects);
  }
  return objects;
}

void ObjectCollector::applyEvents(FrameObjects& objects) {
  for (const CatalogueEvent& event : writer_->drainEvents()) {
    catalogue_.apply(event);
    std::visit(Announced{objects}, event);
    if (const auto* named = std::get_if<event::NameStored>(&event)) requests_.noteStored(*named);
    objects.is_catalogue_changed = true;
  }
  for (ObjectRecord& record : identities_.takeRecognized()) {
    objects.recognized.push_back(std::move(record));
    objects.is_catalogue_changed = true;
  }
  if (std::optional<Error> refusal = requests_.takeRefusal()) {
    objects.catalogue_failure = std::move(refusal);
    objects.is_catalogue_changed = true;
  }
  writer_->requestChanges();
}

FrameObjects ObjectCollector::applyCatalogueChanges() {
  FrameObjects objects;
  applyEvents(objects);
  return objects;
}

Result<void> ObjectCollector::finish(const std::function<void(const FrameObjects&)>& announce) {
  identities_.merge(IdentityResolver::Which::all, frame_);
  return writer_->finish([&] { announce(applyCatalogueChanges()); });
}

void ObjectCollector::joinRegions(RegionId into, RegionId from, JoinedBy by, int operation) {
  recognizer_.forgetRegion(from);
  requests_.joinRegions(into, from);
  identities_.joinRegions(into, from, by, frame_, operation);
}

ObjectId ObjectCollector::identityOf(const Candidate& candidate) const {
  return identities_.identityOf(candidate, recognizer_.verdict(candidate.regions), frame_, is_refining_);
}

std::vector<std::size_t> ObjectCollector::choose(const std::vector<Candidate>& candidates,
                                                 const std::vector<ObjectId>& identities) const {
  constexpr float kKnown = 0.3F, kConfirmed = 1, kRequested = 3;
  std::vector<float> known;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const ObjectId object = identities[i];
    const ObjectRecord* record = catalogue_.currentRecord(object);
    const bool is_confirmed = record != nullptr && record->confirmed;
    known.push_back(!object ? 0 : (is_confirmed ? kConfirmed : kKnown));
    const std::string* requested_name = requests_.requestedName(candidates[i]);
    if (requested_name != nullptr && !requested_name->empty()) known.back() = kRequested;
  }
  return chooseDisjoint(candidates, known);
}

void ObjectCollector::collectOne(const Candidate& candidate, ObjectId identity, const ObservedFrame& observed,
                                 FrameObjects& objects) {
  using MadeFor = UserRequests::MadeFor;
  if (const ObjectId mismatched = identities_.mismatchOf(candidate.regions))
    tracks_.keepAlive(mismatched, frame_);
  const bool is_clear = isClear(candidate, kForObject);
  const auto set = identities_.complete().find(candidate.regions);
  const bool is_best_frame =
      is_last_pass_ && set != identities_.complete().end() && set->second == observed.frame.index;
  if (!identity) {
    const bool is_unknown = recognizer_.verdict(candidate.regions).has_value();  // or the object is elsewhere
    const bool is_found = (is_clear && is_unknown) || is_best_frame;
    if (is_found || requests_.isRequested(candidate.regions))
      addObject(candidate, observed, is_found ? MadeFor::itself : MadeFor::request);
    return;
  }
  const ObjectRecord* known = catalogue_.currentRecord(identity);
  const bool is_as_large = known == nullptr || views_.matchesSize(*known, candidate, observed);
  // A set much larger than the object contains more than the object, so its other regions stay free. The
  // map may still lack a part of an object that appeared.
  const bool is_requested = requests_.requestedName(candidate) != nullptr;
  const bool has_appeared = candidate.has_appeared && candidate.regions.size() == 1;
  const bool needs_view = is_best_frame && !views_.hasView(identity);
  if (!is_as_large && !is_requested && !has_appeared && !needs_view) {
    // An object that moved is recognised by more than its size.
    if (!isSettled(*known) && !recognizer_.hasReturned(known->id) && is_clear &&
        views_.contradictsSize(*known, candidate))
      identities_.countMismatch(candidate, identity, frame_);
    return;
  }
  identities_.clearMismatch(candidate.regions);
  if (known != nullptr && !tracks_.isObserved(known->id) && !CatalogueMirror::isOfThisScan(known->id))
    objects.recognized.push_back(*known);
  tracks_.observe(identity, candidate, frame_);
  if (is_requested || needs_view || (is_as_large && isClear(candidate, kForView)))
    views_.addView(identity, candidate, observed);
  if (is_requested) requests_.complete(candidate, identity, MadeFor::itself);
}

void ObjectCollector::addObject(const Candidate& candidate, const ObservedFrame& observed,
                                UserRequests::MadeFor made) {
  const ObjectId object = views_.addObject(candidate, observed);
  if (!object) return;  // it stays a candidate
  if (const ObjectId mismatched = identities_.mismatchOf(candidate.regions)) {
    identities_.replace(mismatched, object);
    if (recognizer_.hasAppeared(mismatched)) recognizer_.noteAppeared(object);
  }
  if (candidate.has_appeared) recognizer_.noteAppeared(object);
  tracks_.observe(object, candidate, frame_);
  tracks_.viewsOf(object).keep(observed.directionOf(candidate));
  requests_.complete(candidate, object, made);
}

void ObjectCollector::merge(const std::vector<SameObjects>& same) {
  for (const SameObjects& pair : same) identities_.requestMerge(pair, frame_);
}

void ObjectCollector::beginRefinement() {
  identities_.merge(IdentityResolver::Which::all, frame_);
  is_refining_ = true;
  // Refinement may start again because a user has changed something since.
  is_last_pass_ = false;
  identities_.forgetComplete();
  recognizer_.forgetComparisons();
  views_.beginRefinement();
}

void ObjectCollector::settleComplete(std::span<const CompleteSet> complete,
                                     const std::function<bool(RegionId)>& is_unlikely) {
  identities_.settle(complete);
  views_.dropUnlikely(is_unlikely);
}

bool ObjectCollector::mayBeObject(const RegionSet& regions) const {
  return identities_.complete().contains(regions) || requests_.isRequested(regions);
}

std::vector<int> ObjectCollector::beginLastPass() {
  is_last_pass_ = true;
  std::set<int> frames;
  for (const auto& [regions, best_frame] : identities_.complete()) {
    if (!views_.hasView(tracks_.objectOf(regions))) frames.insert(best_frame);
  }
  return {frames.begin(), frames.end()};
}

void ObjectCollector::endRefinement() {
  is_refining_ = is_last_pass_ = false;
  identities_.forgetComplete();
  recognizer_.forgetComparisons();
  identities_.mergeReplaced(views_.objectsInValidViews());
  views_.removeOutdated();
}

}  // namespace scantrove
