#pragma once
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/base/result.h"
#include "core/capture/rgbd_frame.h"
#include "core/catalog/detector.h"
#include "core/catalog/object_database.h"
#include "core/catalog/view_sphere.h"
#include "core/discovery/candidate.h"
#include "core/fusion/pose_estimate.h"
#include "core/scan/scan_report.h"
#include "core/scan/scan_snapshot.h"

namespace scantrove {

/// Turns candidates into objects of the catalogue (thesis 5.1.1 and 5.2): a candidate that is met for the
/// first time is looked up; a known one is recognised, an unknown one added; then new directions of view are
/// kept. One thread, the worker's.
class ObjectCollector {
 public:
  /// What happened in one frame, for the event queue.
  struct Happenings {
    std::vector<SeenObject> seen;
    std::vector<ObjectRecord> added;
    std::vector<ObjectRecord> recognised;  ///< first time in this scan
    std::vector<ObjectId> new_views;
  };

  /// Loads all views of `database` into the detector.
  [[nodiscard]] static Result<std::unique_ptr<ObjectCollector>> create(ComputeContext& compute,
                                                                       ObjectDatabase& database,
                                                                       std::int64_t session,
                                                                       const DetectionParams& params);

  [[nodiscard]] Result<Happenings> collect(const RgbdFrame& frame, const PoseEstimate& pose,
                                           const Intrinsics& working_K,
                                           const std::vector<Candidate>& candidates);

  /// The region `from` is now part of `into`.
  void regionsMerged(RegionId into, RegionId from);

  /// A person renamed, confirmed, merged or deleted: reads the catalogue again.
  [[nodiscard]] Result<void> reload();
  void setParams(const DetectionParams& params);

  /// Objects met in this scan, by id.
  [[nodiscard]] std::vector<ScanReport::Object> metObjects() const;
  /// The object that a region is, or none.
  [[nodiscard]] ObjectId objectOf(RegionId region) const;
  /// The record of an object that was met, or null.
  [[nodiscard]] const ObjectRecord* record(ObjectId object) const;

 private:
  struct MetObject {
    Eigen::Vector3f centroid_world = Eigen::Vector3f::Zero();  ///< newest sighting
    Eigen::Vector3f size_m = Eigen::Vector3f::Zero();
    bool is_new = false;  ///< added in this scan
  };

  ObjectCollector(ObjectDatabase& database, std::int64_t session, const DetectionParams& params)
      : database_(database), session_(session), views_(params) {}

  struct Sighting {
    const Candidate* candidate = nullptr;
    ObjectView view;
  };
  [[nodiscard]] Result<void> identify(const std::vector<Sighting*>& strangers, Happenings& happenings);
  [[nodiscard]] Result<ObjectId> addToCatalogue(const Sighting& sighting, Happenings& happenings);
  void meet(ObjectId object, const Candidate& candidate, bool is_new);
  [[nodiscard]] ObjectId metNearby(const Candidate& candidate) const;
  [[nodiscard]] Result<void> keepNewDirection(ObjectId object, Sighting& sighting, Happenings& happenings);
  [[nodiscard]] SeenObject describe(const Candidate& candidate, const Intrinsics& working_K) const;

  ObjectDatabase& database_;
  std::int64_t session_ = 0;
  ViewSphere views_;
  std::unique_ptr<Detector> detector_;
  std::unordered_map<ObjectId, ObjectRecord> records_;
  std::unordered_map<ObjectId, MetObject> met_;
  std::unordered_map<RegionId, ObjectId> object_of_region_;
};

}  // namespace scantrove
