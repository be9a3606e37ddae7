#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/dataset/dataset_export.h"
#include "core/dataset/export_counts.h"
#include "core/dataset/export_record.h"
#include "core/dataset/export_scans.h"
#include "core/dataset/export_text.h"
#include "core/dataset/labeled_scan.h"

namespace scantrove {

/// A running export: everything a format needs to write its files into the staged folder. One thread.
class ExportJob {
 public:
  /// Writes to `folder`; `progress` and `cancel` outlive the job.
  ExportJob(ExportScans scans, const ExportOptions& options, std::filesystem::path folder,
            const ExportProgressCallback& progress, const std::stop_token& cancel);

  /// Reads the regions of all scans and selects those to export. Error: a scan's; see ExportScans::read().
  [[nodiscard]] Result<void> readRegions();
  /// Error: there are none to export; says how to get some.
  [[nodiscard]] Result<void> needRegions() const;

  [[nodiscard]] ExportScans& scans() { return scans_; }
  [[nodiscard]] const ExportScans& scans() const { return scans_; }
  /// Opens one scan after the other: formats call it once, and `use` for each scan.
  [[nodiscard]] Result<void> forEachScan(const std::function<Result<void>()>& use);
  // Of the scan in work.
  [[nodiscard]] const DatasetPart& part() const { return scans_.part(); }
  [[nodiscard]] LabeledScan& scan() { return scans_.scan(); }
  [[nodiscard]] const std::vector<LabeledRegion>& allRegions() const { return part().all; }
  [[nodiscard]] const std::vector<LabeledRegion>& chosen() const { return part().chosen; }
  /// The key frames to export; none: not chosen yet (framesToExport).
  [[nodiscard]] std::optional<std::vector<KeyFrameInfo>>& frames() { return frames_; }

  [[nodiscard]] const ExportOptions& options() const { return options_; }
  [[nodiscard]] ExportSummary& summary() { return counts_.summary(); }
  [[nodiscard]] ExportCounts& counts() { return counts_; }
  /// An image of the scan in work is written.
  void endImage() {
    counts_.endImage();
    ++scans_.part().images;
  }

  /// Reports the progress. Error: it was cancelled.
  [[nodiscard]] Result<void> step(int done, int total, const std::string& what) const;

  /// Names of files are in this folder of the data set from now on: "", or "kitchen/".
  void setFolder(std::filesystem::path folder) { inner_folder_ = std::move(folder); }
  /// Writes the file `name` ("images/000012.jpg") with its folders. A dry run counts its bytes only. Error:
  /// names it and the system's reason.
  [[nodiscard]] Result<void> write(const std::filesystem::path& name, std::string_view bytes);
  /// Registers a file that was written by other code.
  [[nodiscard]] Result<void> noteWritten(const std::filesystem::path& name);
  [[nodiscard]] std::filesystem::path pathOf(const std::filesystem::path& name) const {
    return folder_ / inner_folder_ / name;
  }

  /// Error: a file is missing, has another length, or was not written by this job.
  [[nodiscard]] Result<void> checkFiles() const;
  /// Writes the record of all files.
  [[nodiscard]] Result<void> writeRecord() const { return record_.writeTo(folder_); }

 private:
  [[nodiscard]] tl::unexpected<Error> readBackFailure(const std::filesystem::path& name,
                                                      const std::string& why) const;
  void noteUnlabeled();

  ExportScans scans_;
  ExportOptions options_;
  std::filesystem::path folder_;
  std::filesystem::path inner_folder_;
  const ExportProgressCallback& progress_;
  const std::stop_token& cancel_;
  std::optional<std::vector<KeyFrameInfo>> frames_;
  ExportRecord record_;
  ExportCounts counts_;
};

}  // namespace scantrove
