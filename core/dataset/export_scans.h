#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/dataset/dataset_export.h"
#include "core/dataset/export_text.h"
#include "core/dataset/labeled_scan.h"
#include "core/dataset/project_export.h"
#include "core/dataset/scan_split.h"

namespace scantrove {

/// One scan of a data set, as formats need it.
struct DatasetPart {
  std::string name;    ///< of the scan
  std::string prefix;  ///< of its files (scanPrefixes); empty: the data set is of one scan
  std::optional<DatasetSplit> split = {};  ///< none: not split by scan
  int number = 1;                          ///< in the data set, from 1
  std::uint32_t id_offset = 0;             ///< makes the ids of its regions differ from those of other scans
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< LabeledScan::origin()
  std::vector<LabeledRegion> all = {};               ///< sorted by id
  std::vector<LabeledRegion> chosen = {};            ///< to export, sorted by id
  std::vector<LabeledRegion> unlabeled = {};         ///< objects in its images without a label
  int images = 0;                                    ///< written

  /// The id of a region that is unique in the data set.
  [[nodiscard]] std::uint32_t idOf(std::uint32_t region) const { return id_offset + region; }
  /// "train/kitchen/" or "kitchen/", for formats with a folder for each scan; empty for one scan.
  [[nodiscard]] std::string folder() const;
};

/// The scans of a data set: one that is open, or those of a project, which are opened one after the other.
class ExportScans {
 public:
  /// `scan` outlives this.
  explicit ExportScans(LabeledScan& scan);
  explicit ExportScans(ProjectToExport project);

  /// Called before each scan is read.
  using BeforeScan = std::function<Result<void>(int done, int total, const std::string& what)>;
  /// Reads the regions of all scans, chooses those to export, and the splits. Scans of a project without
  /// anything to export are left out with a note if `needs_regions`. Error: a scan's; no scan left; a class
  /// or scan that does not exist; scans with different classes.
  [[nodiscard]] Result<void> read(const ExportOptions& options, bool needs_regions, const BeforeScan& before,
                                  std::vector<std::string>& notes);

  /// Of the scan, or of the project.
  [[nodiscard]] const std::string& title() const { return title_; }
  [[nodiscard]] bool isProject() const { return is_project_; }
  [[nodiscard]] bool isSplit() const { return is_project_ && split_.isAny(); }
  /// All classes of the catalogue.
  [[nodiscard]] const std::vector<ObjectClass>& classes() const { return classes_; }
  /// The chosen regions of all scans, for categories: ids are not unique.
  [[nodiscard]] std::vector<LabeledRegion> chosen() const;
  [[nodiscard]] const std::vector<DatasetPart>& parts() const { return parts_; }

  /// Opens one scan after the other, and calls `use` with part() and scan(). Error: of a scan or of `use`.
  [[nodiscard]] Result<void> forEach(const std::function<Result<void>()>& use);
  /// The part and the scan in work; before forEach() the first one, and no scan of a project.
  [[nodiscard]] DatasetPart& part() { return parts_.at(current_); }
  [[nodiscard]] const DatasetPart& part() const { return parts_.at(current_); }
  [[nodiscard]] LabeledScan& scan();
  [[nodiscard]] bool isOpen() const { return open_ != nullptr; }

 private:
  [[nodiscard]] Result<void> readOne(const ScanToExport& source, const ExportOptions& options);
  [[nodiscard]] Result<void> takeClasses(const std::string& scan, const std::vector<ObjectClass>& classes);
  [[nodiscard]] Result<void> checkChosenClasses(const ExportChoices& choices) const;
  [[nodiscard]] Result<void> leaveOutEmpty(const ExportOptions& options, std::vector<std::string>& notes);
  [[nodiscard]] Result<void> splitScans(std::vector<std::string>& notes);
  void numberParts();

  std::string title_;
  bool is_project_ = false;
  ScanSplit split_;
  std::vector<ScanToExport> sources_;  // of parts_
  std::vector<DatasetPart> parts_;
  std::vector<ObjectClass> classes_;
  std::size_t current_ = 0;
  std::shared_ptr<LabeledScan> open_;
};

/// Why nothing of a scan is exported, in words for the user.
[[nodiscard]] Error nothingToExport(const std::string& scan, const ExportOptions& options);

/// Adds the entries of one scan (by region or instance) with ids that are unique in the data set.
void addToLegend(ExportJson& legend, const ExportJson& of_scan, const DatasetPart& part);

}  // namespace scantrove
