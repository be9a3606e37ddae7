#pragma once
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>

#include "core/base/result.h"
#include "core/capture/rgbd_frame.h"
#include "core/collection/object_collector.h"
#include "core/pipeline/mapping_pipeline.h"
#include "core/scan/scan_joins.h"
#include "core/session/region_label.h"
#include "core/session/saved_scan.h"

namespace scantrove {

/// The objects of a running scan: gives the collector what frames show and what users say of regions, and
/// tells the map which regions the collector knows. One thread, the worker's.
class ScanObjects {
 public:
  /// `pipeline` outlives this.
  ScanObjects(MappingPipeline& pipeline, std::unique_ptr<ObjectCollector> collector)
      : pipeline_(pipeline), collector_(std::move(collector)) {}

  [[nodiscard]] ObjectCollector& collector() { return *collector_; }
  [[nodiscard]] const ObjectCollector& collector() const { return *collector_; }

  /// After each frame that the pipeline processed. Error: the device failed. A catalogue that cannot be
  /// reached is a value.
  [[nodiscard]] Result<FrameObjects> addFrame(const RgbdFrame& frame, const FrameResult& result);

  /// The regions' objects, as an earlier scan of this map found out, and what users said of regions in it:
  /// things that are no objects of the catalogue become such when they are seen.
  void restore(const SavedScan& scan);

  /// After a user edited regions.
  void follow(const RegionEditor::Outcome& outcome, EditDirection direction);
  /// What there is to say of each region: by users here, and by the catalogue.
  [[nodiscard]] std::map<RegionId, RegionLabel> labels() const;

  /// What the catalogue stored of merges.
  void addMerges(std::span<const ObjectMerge> merges) { joins_.addMerges(merges); }
  /// ScanJoins::takeChanged().
  [[nodiscard]] SessionMetadata takeChangedJoins() { return joins_.takeChanged(collector_->objects()); }

  /// Adds what users wait for and the last frame shows, and ends the collecting: ObjectCollector::finish.
  [[nodiscard]] Result<void> finish(const std::function<void(const FrameObjects&)>& announce);

 private:
  /// Regions of objects that the catalogue knows keep their identities; those of one confirmed object become
  /// one.
  void keepKnown(const FrameObjects& objects);
  /// The names of the regions that an edit was about.
  void followNames(const Operation& operation, EditDirection direction);
  /// The region is waited for if a user takes it for a thing. False: it is not.
  bool requestNoted(RegionId region);
  [[nodiscard]] Result<void> addRequestedAtEnd(const std::function<void(const FrameObjects&)>& announce);

  MappingPipeline& pipeline_;
  std::unique_ptr<ObjectCollector> collector_;
  ScanJoins joins_;
  struct Seen {
    RgbdFrame frame;
    Eigen::Isometry3d T_world_camera;
  };
  std::optional<Seen> last_seen_;  // the last usable frame
};

}  // namespace scantrove
