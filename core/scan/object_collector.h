#pragma once
#include <map>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/capture/color_projection.h"
#include "core/capture/rgbd_frame.h"
#include "core/catalog/object_database.h"
#include "core/catalog/view_sphere.h"
#include "core/discovery/candidate.h"
#include "core/fusion/pose_estimate.h"
#include "core/scan/catalogue_mirror.h"
#include "core/scan/frame_objects.h"
#include "core/scan/scan_report.h"

namespace scantrove {

/// Turns candidates into objects of the catalogue (thesis 5.1.1 and 5.2): a candidate that is met for the
/// first time is looked up; a known one is recognised, an unknown one added; then new directions of view are
/// kept. Follows what persons and other programs do to the catalogue meanwhile: what was deleted is not added
/// again by this scan, what was merged is one. One thread, the worker's; may throw cl::Error.
///
/// A region is remembered with the object that it was taken for. Who holds that object now, after merges and
/// deletions, is asked anew each time (CatalogueMirror::holderOf), so that whatever is undone is undone here
/// too.
class ObjectCollector {
 public:
  /// After a failure the catalogue is left alone for so many frames: each try may wait 5 s for a lock.
  static constexpr int kFramesUntilRetry = 60;

  /// Loads all views of `database` into the detector.
  [[nodiscard]] static Result<std::unique_ptr<ObjectCollector>> create(ComputeContext& compute,
                                                                       ObjectDatabase& database,
                                                                       std::int64_t session,
                                                                       const DetectionParams& params);

  /// Candidates of one frame; `in_color` at their resolution. That the catalogue fails is part of the
  /// outcome; it ends nothing.
  [[nodiscard]] FrameObjects collect(const RgbdFrame& frame, const PoseEstimate& pose,
                                     const SurfaceInColor& in_color,
                                     const std::vector<Candidate>& candidates);

  /// The region `from` is now part of `into`. When they were two objects, collect() makes them one in the
  /// catalogue, unless persons said what each is, or took such a merge back.
  void regionsMerged(RegionId into, RegionId from);

  /// Learns what happened to the catalogue since the last call; collect() does so by itself.
  [[nodiscard]] Result<void> followCatalogue() { return catalogue_.follow(); }
  void setParams(const DetectionParams& params);

  /// Objects met in this scan, by id.
  [[nodiscard]] std::vector<ScanReport::Object> metObjects() const;
  /// The object that a region is, or none: unknown, or deleted by a person.
  [[nodiscard]] ObjectId objectOf(RegionId region) const;
  /// The record of an object of the catalogue, or null.
  [[nodiscard]] const ObjectRecord* record(ObjectId object) const { return catalogue_.record(object); }
  /// Fills in the object of `seen.region` as it is called now.
  void describeObject(SeenObject& seen) const;

 private:
  struct MetObject {
    Eigen::Vector3f centroid_world = Eigen::Vector3f::Zero();  ///< newest sighting
    Eigen::Vector3f size_m = Eigen::Vector3f::Zero();
    ViewSphere views;
  };
  struct Sighting {
    const Candidate* candidate = nullptr;
    ObjectView view;
  };

  ObjectCollector(ObjectDatabase& database, std::int64_t session, Detector detector,
                  const DetectionParams& params);

  [[nodiscard]] bool mayUseCatalogue() const { return frames_until_retry_ == 0; }
  void noteFailure(const Error& error, FrameObjects& objects);

  void mergeJoined(FrameObjects& objects);
  [[nodiscard]] bool shouldMerge(ObjectId a, ObjectId b) const;
  void identify(const std::vector<Sighting*>& unidentified, FrameObjects& objects);
  [[nodiscard]] ObjectId addToCatalogue(Sighting& sighting, FrameObjects& objects);
  void keepNewDirection(ObjectId object, Sighting& sighting, FrameObjects& objects);
  void meet(ObjectId object, const Candidate& candidate);
  [[nodiscard]] bool isMet(ObjectId holder) const;
  [[nodiscard]] ObjectId metNearby(const Candidate& candidate) const;

  ObjectDatabase& database_;
  std::int64_t session_ = 0;
  CatalogueMirror catalogue_;
  DetectionParams params_;

  std::map<ObjectId, MetObject> met_;                        // by the object at that time
  std::unordered_map<RegionId, ObjectId> object_of_region_;  // likewise; stays when the object is deleted
  std::vector<std::pair<ObjectId, ObjectId>> joined_;        // whose regions were joined
  int frames_until_retry_ = 0;
  bool is_failure_said_ = false;
};

}  // namespace scantrove
