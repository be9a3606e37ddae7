#pragma once
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/capture/rgbd_frame.h"
#include "core/catalogue/catalogue_mirror.h"
#include "core/catalogue/catalogue_writer.h"
#include "core/catalogue/object_database.h"
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

/// Turns candidates into objects of the catalogue. A candidate is looked up in several frames before it
/// counts as known or unknown; of those that share regions the one is taken that the catalogue and its
/// outline support. A complete, unknown candidate is added; then views from new directions are stored.
/// Changes that users and other programs make to the catalogue are followed: what was deleted is not added
/// again by this scan, what was merged is one. One thread, the worker's; may throw cl::Error.
///
/// No call but create(), settle() and finish() waits for the database: what is found counts at once, another
/// thread stores it, and a later call tells so.
///
/// The work is done by five parts: ObjectTracks follows objects, Recognizer compares appearances,
/// IdentityResolver decides what is the same, ViewKeeper stores views, UserRequests does what users ask for.
/// CollectedObjects tells what came of it.
class ObjectCollector {
 public:
  using JoinedBy = IdentityResolver::JoinedBy;

  /// Loads all views of `database`, which is needed no longer than that, and starts to write into the
  /// catalogue of `writer`, which is the same one. `memory`: of collectorMemory(), for a scan that continues;
  /// empty: of none. Error: also a catalogue that is another one than the memory's.
  [[nodiscard]] static Result<std::unique_ptr<ObjectCollector>> create(
      ComputeContext& compute, ObjectDatabase& database, CatalogueWriter::Options writer,
      const DetectionParams& params, std::span<const std::uint32_t> memory = {});

  [[nodiscard]] ObjectTracks& tracks() { return tracks_; }
  [[nodiscard]] const ObjectTracks& tracks() const { return tracks_; }
  [[nodiscard]] UserRequests& requests() { return requests_; }
  [[nodiscard]] const UserRequests& requests() const { return requests_; }
  [[nodiscard]] ViewKeeper& views() { return views_; }
  [[nodiscard]] const CollectedObjects& objects() const { return objects_; }
  void setParams(const DetectionParams& params);

  /// Candidates of one frame, which may share regions; `in_color` at their resolution. What was stored since
  /// the last call and that the catalogue fails is part of the outcome; it ends nothing.
  [[nodiscard]] FrameObjects collect(const RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera,
                                     const SurfaceInColor& in_color, std::vector<Candidate> candidates);
  /// Adds those of the candidates that a user waits for, as one frame shows them, between collected frames.
  [[nodiscard]] FrameObjects addRequested(const RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera,
                                          const SurfaceInColor& in_color,
                                          const std::vector<Candidate>& candidates);
  /// Objects whose places this frame, the last one given to collect(), shows empty may be found elsewhere
  /// from now on. `depth_noise_m`: FusionParams.
  void checkPlaces(const DepthView& now, float depth_noise_m) {
    tracks_.checkPlaces(now, depth_noise_m, frame_);
  }

  /// The region `from` is now part of `into`. If they were two objects, collect() merges them in the
  /// catalogue, unless users edited both, or undid such a merge; see IdentityResolver.
  void joinRegions(RegionId into, RegionId from, JoinedBy by = JoinedBy::user);
  /// `part` was a part of `from` until now.
  void splitRegion(RegionId from, RegionId part) { identities_.splitRegion(from, part); }
  /// The region is that object of the catalogue, as an earlier scan of this map found out.
  void bind(RegionId region, ObjectId object) { tracks_.bind({region}, catalogue_.keyOf(object)); }

  // Refinement, when regions do not change any more: begin; settle what is complete; compare the views() with
  // the map; collect() from the key frames; begin the last pass; collect() from the frames that it names;
  // end.

  void beginRefinement();
  /// From now on the scene consists of the `complete` sets, which are disjoint, most likely first. A tracked
  /// object follows its regions into one of them. `is_unlikely`: the region is no part of a complete object:
  /// the views of an object of such regions alone are dropped, unless a user has edited it.
  void settleComplete(std::span<const CompleteSet> complete,
                      const std::function<bool(RegionId)>& is_unlikely);
  /// Of sets that are settled: they are complete, or requested.
  [[nodiscard]] bool mayBeObject(const RegionSet& regions) const;
  /// Frames (RgbdFrame::index) that show best a complete set that is no object yet, or one without a view.
  /// Collected from once more, it becomes one, or has one.
  [[nodiscard]] std::vector<int> beginLastPass();
  void endRefinement();

  /// Applies what happened to the catalogue since the last call, and asks for more; collect() does so itself.
  [[nodiscard]] FrameObjects followCatalogue();
  /// Waits until all that was found is stored, and all changes by others are known: followCatalogue() tells
  /// them. False: not within `limit`.
  [[nodiscard]] bool settle(std::chrono::milliseconds limit) { return writer_->settle(limit); }
  /// Stores what waits and ends the session; `announce` is told what is stored, and that the catalogue fails,
  /// as it happens. Nothing is collected afterwards. Error: what the catalogue has not got, and why.
  [[nodiscard]] Result<void> finish(const std::function<void(const FrameObjects&)>& announce);
  /// After finish(): what another run of the program needs to continue.
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

  CatalogueMirror catalogue_;  // the parts know objects by its keys
  std::unique_ptr<CatalogueWriter> writer_;
  ObjectTracks tracks_;
  UserRequests requests_;
  IdentityResolver identities_;
  Recognizer recognizer_;
  ViewKeeper views_;
  CollectedObjects objects_;
  bool is_refining_ = false;
  bool is_last_pass_ = false;
  int frame_ = 0;
};

}  // namespace scantrove
