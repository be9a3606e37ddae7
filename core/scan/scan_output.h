#pragma once
#include <filesystem>
#include <memory>

#include "core/base/result.h"
#include "core/base/stamped_pose.h"
#include "core/capture/rgbd_frame.h"
#include "core/pipeline/mapping_pipeline.h"
#include "core/scan/final_label_images.h"
#include "core/scan/frame_label_writer.h"
#include "core/scan/region_numbers.h"
#include "core/scan/scan_report.h"
#include "core/session/saved_scan.h"

namespace scantrove {

/// Writes the result folder of a scan (the contract of `scantrove scan`): label images while it runs,
/// trajectory, labelled cloud, label map and report at its end. Every file is written beside and renamed. One
/// thread, the worker's.
class ScanOutput {
 public:
  /// Makes the folder and proves that it can be written to, before any work is done.
  [[nodiscard]] static Result<std::unique_ptr<ScanOutput>> create(const std::filesystem::path& folder,
                                                                  bool label_maps);

  /// All places and poses are relative to this point, in metres; to be said before the first frame.
  void setOrigin(const Eigen::Vector3d& origin_world) { origin_world_ = origin_world; }

  /// The frames of an earlier scan that this one goes on with.
  void begin(const SavedScan& earlier);

  /// The frames so far are none of the scan's.
  void beginAnew();

  /// Error: label images of this or an earlier frame could not be written.
  [[nodiscard]] Result<void> addFrame(const RgbdFrame& frame, const FrameResult& result);

  /// The end of a scan, first part: needs neither device nor catalogue.
  [[nodiscard]] Result<void> writeTrajectory();

  /// The other files. Writes what there is; a file that cannot be written keeps no other from being written,
  /// nor does a device that fails: the cloud is what could be read of it. Error: the first that failed (the
  /// others are in the log). `store` keeps the record of the final label images in the session.
  [[nodiscard]] Result<void> finish(MappingPipeline& pipeline, const std::map<RegionId, RegionLabel>& labels,
                                    const ScanReport& report, const FinalLabelImages::StoreRecord& store);
  /// What finish() could not draw, for the user.
  [[nodiscard]] const std::vector<Error>& remarks() const { return final_labels_.remarks(); }
  /// That finish() wrote.
  [[nodiscard]] std::size_t cloudPoints() const { return cloud_points_; }

 private:
  explicit ScanOutput(std::filesystem::path folder) : folder_(std::move(folder)), final_labels_(folder_) {}

  [[nodiscard]] Result<void> writeCloud(MappingPipeline& pipeline,
                                        const std::map<RegionId, RegionLabel>& labels);

  std::filesystem::path folder_;
  Trajectory trajectory_;
  Eigen::Vector3d origin_world_ = Eigen::Vector3d::Zero();
  std::size_t cloud_points_ = 0;
  RegionNumbers numbers_;
  std::unique_ptr<FrameLabelWriter> label_images_;  // null: they are not wanted
  FinalLabelImages final_labels_;
};

}  // namespace scantrove
