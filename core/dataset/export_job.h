#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/dataset/dataset_export.h"
#include "core/dataset/export_text.h"
#include "core/dataset/labeled_scan.h"

namespace scantrove {

/// A running export: everything a format needs to write its files into the staged folder. One thread.
class ExportJob {
 public:
  /// Writes to `folder`; `progress` and `cancel` outlive the job.
  ExportJob(LabeledScan& scan, const ExportOptions& options, std::filesystem::path folder,
            const ExportProgressCallback& progress, const std::stop_token& cancel);

  /// Reads the regions and selects those to export. Error: the scan's.
  [[nodiscard]] Result<void> readRegions();
  /// Error: there are none; says how to get some.
  [[nodiscard]] Result<void> needRegions() const;

  [[nodiscard]] LabeledScan& scan() { return scan_; }
  [[nodiscard]] const ExportOptions& options() const { return options_; }
  [[nodiscard]] const std::vector<LabeledRegion>& allRegions() const { return all_; }
  [[nodiscard]] const std::vector<LabeledRegion>& chosen() const { return chosen_; }
  [[nodiscard]] ExportSummary& summary() { return summary_; }
  /// The key frames to export; none: not chosen yet (framesToExport).
  [[nodiscard]] std::optional<std::vector<KeyFrameInfo>>& frames() { return frames_; }

  /// Reports the progress. Error: it was cancelled.
  [[nodiscard]] Result<void> step(int done, int total, const std::string& what) const;

  /// Writes the file `name` ("images/000012.jpg") with its folders. Error: names it and the system's
  /// reason.
  [[nodiscard]] Result<void> write(const std::filesystem::path& name, std::string_view bytes);
  /// Registers a file that was written by other code.
  [[nodiscard]] Result<void> noteWritten(const std::filesystem::path& name);
  [[nodiscard]] std::filesystem::path pathOf(const std::filesystem::path& name) const {
    return folder_ / name;
  }

  /// The counts of a class in the summary, which lists it from now on.
  ClassCount& countOf(const std::string& class_name);
  /// Begins the counts of the next image.
  void beginImage() { in_image_.clear(); }
  /// Counts a written mask of `pixels`, in the summary.
  void countMask(const std::string& class_name, int pixels);
  /// Counts an object of a format without images.
  void countObject(const std::string& class_name);

  /// Error: a file is missing, has another length, or was not written by this job.
  [[nodiscard]] Result<void> checkFiles() const;

 private:
  [[nodiscard]] tl::unexpected<Error> readBackFailure(const std::filesystem::path& name,
                                                      const std::string& why) const;

  LabeledScan& scan_;
  ExportOptions options_;
  std::filesystem::path folder_;
  const ExportProgressCallback& progress_;
  const std::stop_token& cancel_;
  std::vector<LabeledRegion> all_, chosen_;
  std::optional<std::vector<KeyFrameInfo>> frames_;
  std::map<std::filesystem::path, std::uintmax_t> written_;  // bytes, by name
  std::set<std::string> in_image_;                           // classes
  ExportSummary summary_;
};

}  // namespace scantrove
