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
#include "core/session/region_label.h"
#include "core/session/saved_scan.h"
#include "core/session/scan_joins.h"

namespace scantrove {

/// The objects of a running scan: passes frames and edits of regions to the collector, and tells the map
/// which regions the collector knows. One thread, the worker's.
class ScanObjects {
 public:
  /// `pipeline` outlives this.
  ScanObjects(MappingPipeline& pipeline, std::unique_ptr<ObjectCollector> collector)
      : pipeline_(pipeline), collector_(std::move(collector)) {}

  [[nodiscard]] ObjectCollector& collector() { return *collector_; }
  [[nodiscard]] const ObjectCollector& collector() const { return *collector_; }

  /// Call after each processed frame. Error: the device failed. An unavailable catalogue is a value, not an
  /// error.
  [[nodiscard]] Result<FrameObjects> addFrame(const RgbdFrame& frame, const FrameResult& result);

  /// Restores objects and edits of regions from an earlier scan of this map. Named things that are no
  /// objects of the catalogue yet are added when seen.
  void restore(const SavedScan& scan);

  /// Call after a user edited regions.
  void applyEdit(const RegionEditor::Outcome& outcome, EditDirection direction);
  /// The label of each region, from edits here and from the catalogue.
  [[nodiscard]] std::map<RegionId, RegionLabel> labels() const;

  /// Merges that the catalogue stored.
  void addMerges(std::span<const ObjectMerge> merges) { joins_.addMerges(merges); }
  /// ScanJoins::takeChanged().
  [[nodiscard]] SessionMetadata takeChangedJoins() { return joins_.takeChanged(collector_->objects()); }

  /// Adds requested regions from the last frame, and ends collecting: ObjectCollector::finish.
  [[nodiscard]] Result<void> finish(const std::function<void(const FrameObjects&)>& announce);

 private:
  /// Regions of objects in the catalogue keep their identities; those of one confirmed object become one
  /// region.
  void keepKnown(const FrameObjects& objects);
  /// Applies the names of the edited regions.
  void applyNames(const Operation& operation, EditDirection direction);
  /// Requests the region as an object if a user marked it as one. False: not marked.
  bool requestNoted(RegionId region);
  [[nodiscard]] Result<void> addRequestedAtEnd(const std::function<void(const FrameObjects&)>& announce);

  MappingPipeline& pipeline_;
  std::unique_ptr<ObjectCollector> collector_;
  ScanJoins joins_;
  struct Seen {
    RgbdFrame frame;
    Eigen::Isometry3d T_world_camera;
  };
  std::optional<Seen> last_seen_;  // the last usable frame, with colour if any has it
};

}  // namespace scantrove
