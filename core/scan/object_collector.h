#pragma once
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/capture/color_projection.h"
#include "core/capture/rgbd_frame.h"
#include "core/catalog/object_database.h"
#include "core/discovery/candidate.h"
#include "core/fusion/depth_view.h"
#include "core/scan/catalogue_mirror.h"
#include "core/scan/frame_objects.h"
#include "core/scan/met_objects.h"
#include "core/scan/recognition_history.h"
#include "core/scan/scan_report.h"
#include "core/tracking/pose_estimate.h"

namespace scantrove {

/// Turns candidates into objects of the catalogue (thesis 5.1.1, 5.2 and ch. 6). A candidate is looked up
/// several times before it counts as known or unknown; of those that share regions the one that the catalogue
/// and its outline speak for is taken. What is whole and unknown is added; then new directions of view are
/// kept. Follows what persons and other programs do to the catalogue meanwhile: what was deleted is not added
/// again by this scan, what was merged is one. One thread, the worker's; may throw cl::Error.
///
/// Regions are remembered with the object that they were taken for. Who holds that object now, after merges
/// and deletions, is asked anew each time (CatalogueMirror::holderOf), so that whatever is undone is undone
/// here too.
class ObjectCollector {
 public:
  /// After a failure the catalogue is left alone for so many frames: each try may wait 5 s for a lock.
  static constexpr int kFramesUntilRetry = 60;
  /// Candidates that are looked up in one frame at most: bounds what it takes.
  static constexpr std::size_t kMostLooks = 4;

  /// Loads all views of `database` into the detector.
  [[nodiscard]] static Result<std::unique_ptr<ObjectCollector>> create(ComputeContext& compute,
                                                                       ObjectDatabase& database,
                                                                       std::int64_t session,
                                                                       const DetectionParams& params);

  /// Candidates of one frame, which may share regions; `in_color` at their resolution. That the catalogue
  /// fails is part of the outcome; it ends nothing.
  [[nodiscard]] FrameObjects collect(const RgbdFrame& frame, const PoseEstimate& pose,
                                     const SurfaceInColor& in_color,
                                     const std::vector<Candidate>& candidates);

  /// The region `from` is now part of `into`. When they were two objects, collect() makes them one in the
  /// catalogue, unless persons said what each is, or took such a merge back.
  void regionsJoined(RegionId into, RegionId from);
  /// `part` was a part of `from` until now. What a person deleted stays so in its parts.
  void regionsParted(RegionId from, RegionId part);

  /// Objects whose place this frame, the last one given to collect(), shows empty may be met elsewhere from
  /// now on. `depth_noise_m`: FusionParams.
  void lookForThoseMet(const DepthView& now, float depth_noise_m) {
    met_.lookAtPlaces(now, depth_noise_m, frame_);
  }

  /// A person says that the candidate with this region is an object: it is added when it is seen next, whole
  /// or not.
  void addByPerson(RegionId region) { wanted_.insert(region); }

  /// The region is that object, as an earlier scan of this map found out.
  void bind(RegionId region, ObjectId object) { met_.bind({region}, object); }

  /// Learns what happened to the catalogue since the last call; collect() does so by itself.
  [[nodiscard]] Result<void> followCatalogue() { return catalogue_.follow(); }
  void setParams(const DetectionParams& params);

  /// Objects met in this scan, by id.
  [[nodiscard]] std::vector<ScanReport::Object> metObjects() const;
  /// The object that a region is, or none: unknown, or deleted by a person.
  [[nodiscard]] ObjectId objectOf(RegionId region) const;
  /// The record of an object of the catalogue, or null.
  [[nodiscard]] const ObjectRecord* record(ObjectId object) const { return catalogue_.record(object); }
  /// Fills in the object of `seen.regions` as it is called now.
  void describeObject(SeenObject& seen) const;

 private:
  /// One frame as cut up into views.
  struct Look {
    const RgbdFrame& frame;
    const Eigen::Isometry3d& T_world_camera;
    const SurfaceInColor& in_color;
    FrameObjects& objects;
  };

  ObjectCollector(ObjectDatabase& database, std::int64_t session, Detector detector,
                  const DetectionParams& params);

  [[nodiscard]] bool mayUseCatalogue() const { return frames_until_retry_ == 0; }
  void noteFailure(const Error& error, FrameObjects& objects);

  void mergeJoined(FrameObjects& objects);
  [[nodiscard]] bool shouldMerge(ObjectId a, ObjectId b) const;
  void lookUpDue(const std::vector<Candidate>& candidates, const Look& look);
  void lookUp(const std::vector<const Candidate*>& candidates, const Look& look);
  /// The object that this candidate is, as far as is known; nothing is bound to it yet.
  [[nodiscard]] ObjectId identityOf(const Candidate& candidate) const;
  [[nodiscard]] std::vector<std::size_t> choose(const std::vector<Candidate>& candidates,
                                                const std::vector<ObjectId>& identities) const;
  void collectOne(const Candidate& candidate, ObjectId identity, const Look& look);
  void joinDoubles(const std::vector<const Candidate*>& chosen);
  [[nodiscard]] bool isWanted(const Candidate& candidate) const;
  void addToCatalogue(const Candidate& candidate, const Look& look);
  void keepNewDirection(ObjectId object, const Candidate& candidate, const Look& look);
  /// None: the colour image does not show it.
  [[nodiscard]] std::optional<ObjectView> viewOf(const Candidate& candidate, const Look& look) const;
  [[nodiscard]] bool isMet(ObjectId holder) const;

  ObjectDatabase& database_;
  std::int64_t session_ = 0;
  CatalogueMirror catalogue_;
  DetectionParams params_;

  MetObjects met_;
  RecognitionHistory recognition_;
  std::set<RegionId> wanted_;  // by a person, not added yet
  std::vector<std::pair<ObjectId, ObjectId>>
      joined_;  // whose regions were joined, or that stand at one place
  std::set<std::pair<ObjectId, ObjectId>> side_by_side_;  // seen in one frame; smaller id first
  int frame_ = 0;
  int frames_until_retry_ = 0;
  bool is_failure_said_ = false;
};

}  // namespace scantrove
