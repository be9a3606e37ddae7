#pragma once
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/dataset/dataset_export.h"

namespace scantrove {

/// Counts the content of a data set while it is written, in its summary: of all, and of each split.
class ExportCounts {
 public:
  [[nodiscard]] ExportSummary& summary() { return summary_; }

  /// The counts of a class in the summary, which lists it from now on.
  ClassCount& countOf(const std::string& class_name) { return countIn(summary_.classes, class_name); }
  /// A scan of a project goes to `split`.
  void beginScan(DatasetSplit split) { ++splitCount(split).scans; }
  /// Begins the counts of the next image. `split`: none if the data set is not split.
  void beginImage(std::optional<DatasetSplit> split);
  /// Counts the image as written.
  void endImage();
  /// Counts a mask of `pixels` in the image.
  void countMask(const std::string& class_name, int pixels);
  /// Counts an object of a format without images. `split`: of its scan.
  void countObject(const std::string& class_name, std::optional<DatasetSplit> split);

 private:
  static ClassCount& countIn(std::vector<ClassCount>& classes, const std::string& class_name);
  SplitCount& splitCount(DatasetSplit split);

  ExportSummary summary_;
  std::set<std::string> in_image_;     // classes
  std::optional<DatasetSplit> split_;  // of the image
};

}  // namespace scantrove
