#pragma once
#include <filesystem>
#include <memory>

#include "core/base/result.h"
#include "core/base/stamped_pose.h"
#include "core/capture/rgbd_frame.h"
#include "core/exchange/label_map_writer.h"
#include "core/pipeline/mapping_pipeline.h"
#include "core/scan/scan_report.h"
#include "core/session/final_label_images.h"
#include "core/session/frame_label_writer.h"
#include "core/session/region_label.h"
#include "core/session/region_numbers.h"
#include "core/session/saved_scan.h"

namespace scantrove {

/// Writes the result folder of a scan (the contract of `scantrove scan`): label images during the scan;
/// trajectory, labelled cloud, label map and report at its end. Every file is written under a temporary
/// name and renamed. One thread, the worker's.
class ScanOutput {
 public:
  /// Creates the folder and checks that it is writable, before any other work.
  [[nodiscard]] static Result<std::unique_ptr<ScanOutput>> create(const std::filesystem::path& folder,
                                                                  bool label_maps);

  /// Positions and poses are relative to this point, in metres; set before the first frame.
  void setOrigin(const Eigen::Vector3d& origin_world) { origin_world_ = origin_world; }

  /// The frames of an earlier scan that this one continues.
  void begin(const SavedScan& earlier);

  /// Drops all frames so far.
  void restart();

  /// Error: label images of this or an earlier frame could not be written.
  [[nodiscard]] Result<void> addFrame(const RgbdFrame& frame, const FrameResult& result);

  /// First part of the end of a scan: needs neither device nor catalogue.
  [[nodiscard]] Result<void> writeTrajectory();

  /// What is known of the regions at the end.
  struct Regions {
    std::map<RegionId, RegionLabel> labels;
    SavedObjectness objectness;
  };
  /// Writes the other files. A failed file does not prevent others, nor does a failed device: the cloud
  /// then has the points read so far. Error: the first failure (the others are in the log). `store` stores
  /// the record of the final label images in the session.
  [[nodiscard]] Result<void> finish(MappingPipeline& pipeline, const Regions& regions,
                                    const ScanReport& report, const FinalLabelImages::StoreRecord& store);
  /// Images that finish() could not draw, for the user.
  [[nodiscard]] const std::vector<Error>& remarks() const { return final_labels_.remarks(); }
  /// Measured points of the cloud that finish() wrote.
  [[nodiscard]] std::size_t cloudPoints() const { return cloud_points_; }

 private:
  explicit ScanOutput(std::filesystem::path folder);

  [[nodiscard]] LabelMapEntry entryOf(RegionId region, const Regions& regions) const;
  [[nodiscard]] Result<void> writeCloud(MappingPipeline& pipeline, const Regions& regions);

  std::filesystem::path folder_;
  Trajectory trajectory_;
  Eigen::Vector3d origin_world_ = Eigen::Vector3d::Zero();
  std::size_t cloud_points_ = 0;
  RegionNumbers numbers_;
  std::unique_ptr<FrameLabelWriter> label_images_;  // null: not requested
  FinalLabelImages final_labels_;
};

}  // namespace scantrove
