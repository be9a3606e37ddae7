#include "core/refinement/final_pass.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <string>
#include <utility>

#include "core/compute/guarded.h"
#include "core/discovery/region_candidate.h"
#include "core/refinement/collector_input.h"
#include "core/refinement/finer_regions.h"
#include "core/refinement/rated_sets.h"

namespace scantrove {
namespace {

/// At most so many key frames, evenly selected from the list.
template <class T>
std::vector<T> evenly(std::vector<T> all, std::size_t most) {
  if (all.size() <= most) return all;
  std::vector<T> chosen;
  for (std::size_t i = 0; i < most; ++i) chosen.push_back(std::move(all[i * all.size() / most]));
  return chosen;
}

/// RatedSets: at this objectness a set is a complete object with a probability of about one half; below, an
/// object is dropped. Of the sets between this and even odds about half are complete in random rooms.
constexpr float kComplete = -0.2F;

/// Least pixels of an object's view, of a reference image.
constexpr double kMinViewPixels = 400;

constexpr std::array kPasses{RefinementPosition::Pass::segment,    RefinementPosition::Pass::rate,
                             RefinementPosition::Pass::judge,      RefinementPosition::Pass::collect,
                             RefinementPosition::Pass::complete,   RefinementPosition::Pass::compare_views,
                             RefinementPosition::Pass::store_views};

RefinementPosition::Pass after(RefinementPosition::Pass pass) {
  return static_cast<RefinementPosition::Pass>(static_cast<int>(pass) + 1);
}

}  // namespace

FinalPass::FinalPass(MappingPipeline& pipeline, ObjectCollector& collector, std::vector<KeyFrame> key_frames,
                     Callbacks callbacks)
    : pipeline_(pipeline),
      collector_(collector),
      key_frames_(evenly(std::move(key_frames), kMaxKeyFrames)),
      callbacks_(std::move(callbacks)) {}

Result<void> FinalPass::run(RefinementPosition begin) {
  position_ = begin;
  // Ratings count together and are not stored, so this pass starts again.
  if (position_.pass == Pass::rate) position_.frames = 0;
  // Nor are offers of views.
  if (position_.pass == Pass::compare_views || position_.pass == Pass::store_views)
    position_ = {Pass::compare_views, 0};
  for (; position_.pass != Pass::done; position_ = {after(position_.pass), 0}) {
    if (!callbacks_.may_continue()) return {};  // a pass may first read the whole map
    const Result<bool> is_done = runPass();
    if (!is_done) return fail(is_done.error());
    if (!*is_done) return {};
  }
  return {};
}

Result<bool> FinalPass::runPass() {
  switch (position_.pass) {
    case Pass::segment:
      return segment();
    case Pass::rate:
      return rate();
    case Pass::judge:
      return judgeViews();
    case Pass::collect:
      return collect();
    case Pass::complete:
      return complete();
    case Pass::compare_views:
      return compareViews();
    case Pass::store_views:
      return storeViews();
    case Pass::done:
      break;
  }
  return true;
}

template <class Task>
Result<bool> FinalPass::forEach(const std::vector<Task>& tasks,
                                const std::function<Result<void>(const Task&)>& step) {
  for (auto i = static_cast<std::size_t>(position_.frames); i < tasks.size(); ++i) {
    if (!callbacks_.may_continue()) return false;
    reportProgress(tasks.size());
    SCANTROVE_TRY(step(tasks[i]));
    ++position_.frames;
  }
  return true;
}

Result<bool> FinalPass::forEachKeyFrame(const std::vector<const KeyFrame*>& keys, const FrameStep& step) {
  return forEach<const KeyFrame*>(keys, [&](const KeyFrame* key) -> Result<void> {
    const Result<RgbdFrame> frame = key->read();
    if (!frame) return {};  // the reader of the key frame reports it
    return step(*frame, key->T_world_camera);
  });
}

std::vector<const FinalPass::KeyFrame*> FinalPass::allKeyFrames() const {
  std::vector<const KeyFrame*> keys;
  for (const KeyFrame& key : key_frames_) keys.push_back(&key);
  return keys;
}

std::vector<const FinalPass::KeyFrame*> FinalPass::keyFramesOf(const std::vector<int>& frames) const {
  std::vector<const KeyFrame*> keys = allKeyFrames();
  std::erase_if(keys,
                [&](const KeyFrame* key) { return !std::ranges::binary_search(frames, key->frame_index); });
  return keys;
}

/// At full resolution structures as narrow as a book spine become regions.
Result<bool> FinalPass::segment() {
  return forEachKeyFrame(allKeyFrames(),
                         [this](const RgbdFrame& frame, const Eigen::Isometry3d& T) -> Result<void> {
                           const Result<RegionEvents> events = pipeline_.segmentCloser(frame, T);
                           if (!events) return fail(events.error());
                           applyRegionEvents(collector_, *events, ObjectCollector::JoinedBy::frames);
                           return {};
                         });
}

/// Rates regions and finer ones over all key frames; the most likely complete objects become regions.
Result<bool> FinalPass::rate() {
  SCANTROVE_TRY(moveInto(judge_, makeJudge(pipeline_.labels().table())));
  MapLabels& labels = pipeline_.labels();
  const FinerRegions finer(labels.table(), labels.merger(), labels.voxelsOfFragments(),
                           pipeline_.params().labeling,
                           [this](RegionId region) { return collector_.requests().isFixed(region); });
  std::unique_ptr<RegionJudge> finer_judge;
  if (finer.areDivided()) {
    SCANTROVE_TRY(moveInto(finer_judge, makeJudge(finer.table())));
    // Sets without parts are rated as they are.
    finer_judge->askOnlyOf([&finer](const RegionSet& regions) { return finer.holdsPart(regions); });
  }
  collector_.beginRefinement();
  RatedSets rated;
  const auto rateFrame = [&](const RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera) {
    return guarded("rating frame " + std::to_string(frame.index), [&]() -> Result<void> {
      FrameResult observed = pipeline_.observe(frame, T_world_camera);
      std::vector<Candidate> candidates = findCandidates(observed, *judge_, pipeline_.labels().table());
      if (finer_judge) {
        // All in finer regions.
        for (Candidate& candidate : candidates) candidate.regions = finer.partsOf(candidate.regions);
        std::ranges::move(findCandidates(observed, *finer_judge, finer.table()),
                          std::back_inserter(candidates));
      }
      rated.add(frame.index, candidates);
      return {};
    });
  };
  Result<bool> is_done = forEachKeyFrame(allKeyFrames(), rateFrame);
  if (!is_done || !*is_done) return is_done;
  if (finer_judge) {
    std::vector<RegionSet> parts;
    for (const RatedSets::Rated& set : rated.disjoint(kComplete)) parts.push_back(set.regions);
    RegionEvents events;
    finer.apply(parts, labels.table(), labels.merger(), labels.voxelsOfFragments(), events);
    pipeline_.applyRegionEvents(events);
    rated.rename([&](const RegionSet& set) { return finer.regionsOf(set, pipeline_.labels().table()); });
    applyRegionEvents(collector_, events, ObjectCollector::JoinedBy::frames);
    if (!events.parted.empty()) SCANTROVE_TRY(moveInto(judge_, makeJudge(pipeline_.labels().table())));
  }
  const std::vector<RatedSets::Rated> chosen = rated.disjoint(kComplete);
  objectness_ = rated.ofRegions(chosen);
  std::vector<CompleteSet> complete;
  for (const RatedSets::Rated& set : chosen) complete.push_back({set.regions, set.frame_index});
  collector_.settleComplete(complete, [&](RegionId region) { return rated.isUnlikely(region, kComplete); });
  return true;
}

/// Views that differ from the map's current content are outdated.
Result<bool> FinalPass::judgeViews() {
  return forEach<int>(collector_.views().framesOfViews(), [this](int frame_index) {
    return guarded("judging the views of frame " + std::to_string(frame_index),
                   [&] { return judgeViewsOf(frame_index); });
  });
}

Result<void> FinalPass::judgeViewsOf(int frame_index) {
  for (const auto& [image_px, T_world_camera, intrinsics] : collector_.views().camerasOfViews(frame_index)) {
    const Intrinsics K = pipeline_.workingIntrinsicsOf(intrinsics).resizedTo(image_px.width, image_px.height);
    const Result<RenderedView> view = pipeline_.readout().renderView(T_world_camera, K);
    if (!view) return fail(view.error());
    collector_.views().compare(frame_index, *view, pipeline_.params().fusion.depth_noise_m);
  }
  return {};
}

/// Adds objects and views that the scan missed.
Result<bool> FinalPass::collect() {
  return forEachKeyFrame(allKeyFrames(), [this](const RgbdFrame& frame, const Eigen::Isometry3d& T) {
    return collectFrom(frame, T);
  });
}

/// Adds views of objects without any, from the frames that show them best.
Result<bool> FinalPass::complete() {
  return forEachKeyFrame(
      keyFramesOf(collector_.beginLastPass()),
      [this](const RgbdFrame& frame, const Eigen::Isometry3d& T) { return collectFrom(frame, T); });
}

/// All key frames offer their views of the objects.
Result<bool> FinalPass::compareViews() {
  BestViews& best = collector_.bestViews();
  best.begin();
  return forEachKeyFrame(allKeyFrames(), [&](const RgbdFrame& frame, const Eigen::Isometry3d& T) {
    return forEachObjectIn(frame, T, [&best](const Candidate& candidate, const ObservedFrame& observed) {
      best.offer(candidate, observed);
    });
  });
}

/// Stores the best of the offered views in place of others.
Result<bool> FinalPass::storeViews() {
  BestViews& best = collector_.bestViews();
  const auto storeFrom = [&](const RgbdFrame& frame, const Eigen::Isometry3d& T) {
    return forEachObjectIn(frame, T, [&best](const Candidate& candidate, const ObservedFrame& observed) {
      best.store(candidate, observed);
    });
  };
  Result<bool> is_done = forEachKeyFrame(keyFramesOf(best.choose()), storeFrom);
  if (!is_done || !*is_done) return is_done;
  best.finish();
  collector_.endRefinement();
  return is_done;
}

Result<void> FinalPass::forEachObjectIn(
    const RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera,
    const std::function<void(const Candidate&, const ObservedFrame&)>& use) {
  return guarded("viewing the objects in frame " + std::to_string(frame.index), [&]() -> Result<void> {
    const FrameResult seen = pipeline_.observe(frame, T_world_camera);
    const std::vector<RegionId> shown = seen.shownRegions();
    const double least_pixels = kMinViewPixels * seen.view.K.pixelScale();
    const ObservedFrame observed{frame, T_world_camera, seen.observed.in_color};
    std::vector<Candidate> candidates =
        candidatesOf(collector_.bestViews().sets(), seen.inputFor(shown), least_pixels);
    leaveOutRejected(collector_, pipeline_.labels().editor().notes(), candidates);
    for (const Candidate& candidate : candidates) use(candidate, observed);
    return {};
  });
}

Result<void> FinalPass::collectFrom(const RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera) {
  if (!judge_) {  // the regions were settled in an earlier run
    SCANTROVE_TRY(moveInto(judge_, makeJudge(pipeline_.labels().table())));
  }
  judge_->askOnlyOf([this](const RegionSet& regions) { return collector_.mayBeObject(regions); });
  return guarded("collecting from frame " + std::to_string(frame.index), [&]() -> Result<void> {
    FrameResult observed = pipeline_.observe(frame, T_world_camera);
    std::vector<Candidate> candidates = findCandidates(observed, *judge_, pipeline_.labels().table());
    callbacks_.collected(
        collector_.collect(frame, T_world_camera, observed.observed.in_color, std::move(candidates)));
    return {};
  });
}

std::vector<Candidate> FinalPass::findCandidates(FrameResult& observed, RegionJudge& judge,
                                                 const RegionTable& table) {
  pipeline_.findCandidates(judge, table, observed);
  return candidatesFor(collector_, observed, pipeline_.labels().editor().notes(),
                       pipeline_.params().discovery.min_points);
}

Result<std::unique_ptr<RegionJudge>> FinalPass::makeJudge(const RegionTable& table) {
  Result<RegionSamples> known = pipeline_.readout().sampleRegions(table);
  if (!known) return fail(known.error());
  return std::make_unique<RegionJudge>(pipeline_.params().discovery, std::move(*known));
}

int FinalPass::stepsOf(Pass pass) const {
  const bool is_short = pass == Pass::judge || pass == Pass::complete || pass == Pass::store_views;
  return is_short ? (keyFrames() + 3) / 4 : keyFrames();
}

/// The number of tasks of a pass is known at its start, its share of the progress from the beginning.
void FinalPass::reportProgress(std::size_t tasks) const {
  int done = 0, all = 0;
  for (const Pass pass : kPasses) {
    all += stepsOf(pass);
    if (pass < position_.pass) done += stepsOf(pass);
  }
  done += stepsOf(position_.pass) * position_.frames / static_cast<int>(tasks);
  callbacks_.progress(done, all);
}

}  // namespace scantrove
