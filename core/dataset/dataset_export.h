#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/dataset/labeled_scan.h"

namespace scantrove {

/// What a labelled scan can leave as. What each writes: dataset_formats.h.
enum class DatasetFormat { coco, bop, yolo, masks, ply, pcd, mesh, tum, scannet };

/// "coco", "bop", ... in the order of the enumeration.
[[nodiscard]] const std::vector<std::string>& datasetFormatNames();

/// Key frames with masks; the others are clouds, meshes or a trajectory.
[[nodiscard]] bool hasImages(DatasetFormat format);

/// Error: names `name` and lists what there is.
[[nodiscard]] Result<DatasetFormat> parseDatasetFormat(std::string_view name);

struct ExportOptions {
  DatasetFormat format = DatasetFormat::coco;
  std::filesystem::path folder;  ///< to be made; may be there if nothing is in it
  bool all_frames = false;       ///< every frame that was kept, not key frames only
  bool background = false;       ///< also regions that are background or were rejected
};

/// How far an export is: `done` of `total` steps, and which one comes now ("frame 120").
struct ExportProgress {
  int done = 0, total = 0;
  std::string what;
};
using ExportProgressCallback = std::function<void(const ExportProgress&)>;

/// What was written.
struct ExportSummary {
  std::filesystem::path folder;
  int images = 0;       ///< frames with labels
  int regions = 0;      ///< that count: with a name or an object, and what `background` adds
  int annotations = 0;  ///< a region in an image each
  std::uint64_t points = 0, faces = 0;
  std::uint64_t bytes = 0;
  std::vector<std::string> skipped;  ///< a sentence for each key frame that could not be used
};

/// What an export would give, from what is known without computing a mask.
struct ExportPreview {
  int images = 0;
  int regions = 0;
  double megabytes = 0;  ///< estimated; images that are copied count as they are
};

/// Error: as the scan's, in reading its regions or key frames.
[[nodiscard]] Result<ExportPreview> previewExport(LabeledScan& scan, const ExportOptions& options);

/// Writes `scan` to `options.folder`: into `FOLDER.part-XXXXXX` beside it, checks that all files are there,
/// and renames, so that the folder is there whole or not at all. A key frame that cannot be read is skipped
/// and named in the summary. `progress` is called in this thread, before each step. `cancel` is looked at as
/// often. Error: a folder with something in it; nothing to export; every key frame unusable; the scan's map
/// unreadable; a full or read-only disk (names the path and the remedy); cancelled. Nothing is left behind
/// then.
[[nodiscard]] Result<ExportSummary> exportDataset(LabeledScan& scan, const ExportOptions& options,
                                                  const ExportProgressCallback& progress = {},
                                                  const std::stop_token& cancel = {});

}  // namespace scantrove
