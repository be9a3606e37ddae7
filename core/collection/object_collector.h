#pragma once
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/capture/rgbd_frame.h"
#include "core/catalogue/catalogue_mirror.h"
#include "core/catalogue/catalogue_writer.h"
#include "core/catalogue/object_database.h"
#include "core/collection/best_views.h"
#include "core/collection/collected_objects.h"
#include "core/collection/collector_memory.h"
#include "core/collection/frame_objects.h"
#include "core/collection/identity_resolver.h"
#include "core/collection/object_tracks.h"
#include "core/collection/recognizer.h"
#include "core/collection/user_requests.h"
#include "core/collection/view_keeper.h"
#include "core/discovery/candidate.h"
#include "core/fusion/color_projection.h"
#include "core/fusion/depth_view.h"

namespace scantrove {

/// Turns candidates into objects of the catalogue. A candidate is compared in several frames before it
/// counts as known or unknown; of overlapping candidates the one with the best support by catalogue and
/// outline is used. A complete, unknown candidate is added; then views from new directions are stored.
/// Changes by users and other programs are followed: this scan does not add deleted objects again and
/// treats merged objects as one. One thread, the worker's; may throw cl::Error.
///
/// Only create(), settle() and finish() wait for the database. Results take effect at once; another thread
/// stores them, and a later call reports that they are stored.
///
/// Six parts do the work: ObjectTracks follows objects, Recognizer compares appearances, IdentityResolver
/// decides which objects are the same, ViewKeeper stores views, BestViews chooses them in the end,
/// UserRequests handles requests of users. CollectedObjects reports the result. Accessors to the parts make
/// it more than thirty functions.
class ObjectCollector {
 public:
  using JoinedBy = IdentityResolver::JoinedBy;

  /// Loads all views of `database`, which is not needed afterwards, and starts to write into the catalogue
  /// of `writer`, which must be the same. `memory`: of collectorMemory(), for a scan that continues; else
  /// empty. Error: also when the catalogue is not the memory's.
  [[nodiscard]] static Result<std::unique_ptr<ObjectCollector>> create(
      ComputeContext& compute, ObjectDatabase& database, CatalogueWriter::Options writer,
      const DetectionParams& params, std::span<const std::uint32_t> memory = {});

  [[nodiscard]] ObjectTracks& tracks() { return tracks_; }
  [[nodiscard]] const ObjectTracks& tracks() const { return tracks_; }
  [[nodiscard]] UserRequests& requests() { return requests_; }
  [[nodiscard]] const UserRequests& requests() const { return requests_; }
  [[nodiscard]] ViewKeeper& views() { return views_; }
  [[nodiscard]] BestViews& bestViews() { return best_views_; }
  [[nodiscard]] const CollectedObjects& objects() const { return objects_; }
  void setParams(const DetectionParams& params);

  /// Candidates of one frame, which may share regions; `in_color` at their resolution. The outcome includes
  /// what was stored since the last call, and failures of the catalogue, which end nothing.
  [[nodiscard]] FrameObjects collect(const RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera,
                                     const SurfaceInColor& in_color, std::vector<Candidate> candidates);
  /// Adds requested candidates from a frame between collected frames.
  [[nodiscard]] FrameObjects addRequested(const RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera,
                                          const SurfaceInColor& in_color,
                                          const std::vector<Candidate>& candidates);
  /// Marks objects as missing whose places the last collected frame shows empty; they may be found
  /// elsewhere from now on. `depth_noise_m`: FusionParams.
  void checkPlaces(const DepthView& now, float depth_noise_m) {
    tracks_.checkPlaces(now, depth_noise_m, frame_);
  }

  /// The region `from` is now part of `into`. If they were two objects, collect() merges them in the
  /// catalogue, unless users edited both or undid such a merge. `operation`: the number of a user's join,
  /// which merges them at once, whatever users did before. See IdentityResolver.
  void joinRegions(RegionId into, RegionId from, JoinedBy by = JoinedBy::user, int operation = 0);
  /// IdentityResolver::partRegions(); objects are keys of this scan.
  void partRegions(int operation, const std::map<RegionId, ObjectId>& objects,
                   std::vector<ObjectMerge> earlier) {
    identities_.partRegions(operation, objects, std::move(earlier));
  }
  /// `part` was part of `from` until now.
  void splitRegion(RegionId from, RegionId part) { identities_.splitRegion(from, part); }
  /// An earlier scan of this map identified the region as this object.
  void bind(RegionId region, ObjectId object) { tracks_.bind({region}, catalogue_.keyOf(object)); }

  // Refinement, when regions do not change any more: begin; settle the complete sets; compare the views()
  // with the map; collect() from the key frames; begin the last pass; collect() from the frames that it
  // names; choose the bestViews() and store them; end.

  void beginRefinement();
  /// From now on the scene consists of the `complete` sets, which are disjoint, most likely first. A
  /// tracked object follows its regions into one of them. `is_unlikely`: the region is part of no complete
  /// object. An object of such regions alone loses its views, unless a user has edited it.
  void settleComplete(std::span<const CompleteSet> complete,
                      const std::function<bool(RegionId)>& is_unlikely);
  /// Of settled sets: they are complete, or requested.
  [[nodiscard]] bool mayBeObject(const RegionSet& regions) const;
  /// Frames (RgbdFrame::index) that best show a complete set that is no object yet, or an object without a
  /// view. Collecting from them again adds it.
  [[nodiscard]] std::vector<int> beginLastPass();
  void endRefinement();

  /// Applies changes of the catalogue since the last call, and asks for more; collect() includes this.
  [[nodiscard]] FrameObjects applyCatalogueChanges();
  /// Waits until all results are stored and all changes by others are known; applyCatalogueChanges() then
  /// reports them. False: not within `limit`.
  [[nodiscard]] bool settle(std::chrono::milliseconds limit) { return writer_->settle(limit); }
  /// Stores what waits and ends the session. `announce` receives stored results and failures of the catalogue
  /// as they happen. Nothing is collected afterwards. Error: what the catalogue lacks, and why.
  [[nodiscard]] Result<void> finish(const std::function<void(const FrameObjects&)>& announce);
  /// After finish(): the state that another run of the program needs to continue.
  [[nodiscard]] CollectorState state() const;

 private:
  ObjectCollector(CatalogueMirror catalogue, std::unique_ptr<CatalogueWriter> writer,
                  const DetectionParams& params, CollectorState state);

  /// Applies the events of the catalogue that have arrived.
  void applyEvents(FrameObjects& objects);
  [[nodiscard]] ObjectId identityOf(const Candidate& candidate) const;
  [[nodiscard]] std::vector<std::size_t> choose(const std::vector<Candidate>& candidates,
                                                const std::vector<ObjectId>& identities) const;
  void collectOne(const Candidate& candidate, ObjectId identity, const ObservedFrame& observed,
                  FrameObjects& objects);
  void addObject(const Candidate& candidate, const ObservedFrame& observed, UserRequests::MadeFor made);
  void merge(const std::vector<SameObjects>& same);

  CatalogueMirror catalogue_;  // the parts identify objects by its keys
  std::unique_ptr<CatalogueWriter> writer_;
  ObjectTracks tracks_;
  UserRequests requests_;
  IdentityResolver identities_;
  Recognizer recognizer_;
  ViewKeeper views_;
  BestViews best_views_;
  CollectedObjects objects_;
  bool is_refining_ = false;
  bool is_last_pass_ = false;
  int frame_ = 0;
};

}  // namespace scantrove
