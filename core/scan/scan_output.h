#pragma once
#include <filesystem>
#include <memory>
#include <vector>

#include "core/base/result.h"
#include "core/base/stamped_pose.h"
#include "core/capture/rgbd_frame.h"
#include "core/scan/region_numbers.h"
#include "core/scan/scan_pipeline.h"
#include "core/scan/scan_report.h"

namespace scantrove {

/// Writes the result folder of a scan (the contract of `scantrove scan`): label maps while it runs,
/// trajectory, labelled cloud, label map and report at its end. Every file is written beside and renamed. One
/// thread, the worker's.
class ScanOutput {
 public:
  /// Makes the folder and proves that it can be written to, before any work is done.
  [[nodiscard]] static Result<std::unique_ptr<ScanOutput>> create(const std::filesystem::path& folder,
                                                                  bool label_maps);

  [[nodiscard]] Result<void> addFrame(const RgbdFrame& frame, const FrameResult& result);

  [[nodiscard]] Result<void> finish(ScanPipeline& pipeline, const ScanReport& report);

 private:
  ScanOutput(std::filesystem::path folder, bool label_maps)
      : folder_(std::move(folder)), label_maps_(label_maps) {}

  [[nodiscard]] Result<void> writeCloud(ScanPipeline& pipeline);
  [[nodiscard]] Result<void> writeFinalLabels(const LabelTable& table);

  std::filesystem::path folder_;
  bool label_maps_ = false;
  Trajectory trajectory_;
  RegionNumbers numbers_;
  std::vector<std::filesystem::path> label_files_;  // names within labels/
};

}  // namespace scantrove
