#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/dataset/export_choices.h"
#include "core/dataset/labeled_scan.h"
#include "core/dataset/scan_split.h"

namespace scantrove {

/// The formats of a data set; see dataset_formats.h.
enum class DatasetFormat {
  coco,
  bop,
  yolo,
  masks,
  voc,
  labelstudio,
  boxes,
  foundationpose,
  ply,
  pcd,
  mesh,
  tum,
  scannet
};

/// "coco", "bop", ... in the order of the enumeration.
[[nodiscard]] const std::vector<std::string>& datasetFormatNames();

/// Whether the format consists of key frames with masks; the others are clouds, meshes or a trajectory.
[[nodiscard]] bool hasImages(DatasetFormat format);

/// Whether the format can mark regions that a learner ignores: coco, masks, voc.
[[nodiscard]] bool hasIgnoreRegions(DatasetFormat format);

/// Whether the scans of a project share the files of the format; else each has a folder of its own.
[[nodiscard]] bool joinsScans(DatasetFormat format);

/// Error: names `name` and lists the formats.
[[nodiscard]] Result<DatasetFormat> parseDatasetFormat(std::string_view name);

/// Limits and default of ExportOptions::texture_size_px.
inline constexpr int kMinTexture_px = 256, kMaxTexture_px = 4096;

struct ExportOptions {
  DatasetFormat format = DatasetFormat::coco;
  std::filesystem::path folder;  ///< to be created; an empty one may exist
  bool all_frames = false;       ///< every stored frame, not only key frames
  bool background = false;       ///< include regions that are background or rejected
  bool include_unfit = false;    ///< include frames that are blurred, or whose depth and colour do not fit
  std::string license = {};      ///< name or text; empty: none was given
  bool checked_only = false;     ///< only frames whose review is checked
  ExportChoices choices = {};
  bool dry_run = false;     ///< computes the summary and writes nothing
  int texture_size_px = 0;  ///< meshes get textures of this size at most; 0: none
};

/// The progress of an export: `done` of `total` steps, and the next one ("frame 120").
struct ExportProgress {
  int done = 0, total = 0;
  std::string what;
};
using ExportProgressCallback = std::function<void(const ExportProgress&)>;

/// The content of a data set of one class.
struct ClassCount {
  std::string name;
  int images = 0;            ///< that show it
  int instances = 0;         ///< masks in images; formats without images: objects
  std::uint64_t pixels = 0;  ///< of the masks
};

/// The content of one split of a data set.
struct SplitCount {
  DatasetSplit split = DatasetSplit::train;
  int scans = 0;  ///< of a project; 0: frames of one scan are split
  int images = 0;
  std::vector<ClassCount> classes;  ///< by name
};

/// The result of an export.
struct ExportSummary {
  std::filesystem::path folder;
  int images = 0;       ///< frames with labels
  int regions = 0;      ///< exported: with a name or an object, or due to `background`
  int annotations = 0;  ///< masks in images, one for each region or object; without images: objects
  std::vector<ClassCount> classes;  ///< by name; sums of the annotations
  std::vector<SplitCount> splits;   ///< in the order of DatasetSplit; empty: the data set is not split
  int scans = 1;
  int unlabeled = 0;  ///< objects that images show and that have no label (UnlabeledObjects)
  std::uint64_t points = 0, faces = 0;
  std::uint64_t bytes = 0;
  std::vector<std::string> skipped;  ///< a sentence for each key frame that was left out
  int unfit = 0;                     ///< of those: blurred, or depth and colour do not fit (FrameFitness)
  std::vector<std::string> notes;    ///< other sentences for the user
};

/// The expected result of an export, without computing masks or reading images.
struct ExportPreview {
  int images = 0;  ///< including unfit ones
  int regions = 0;
  double megabytes = 0;              ///< estimated; copied images count with their size
  std::vector<std::string> classes;  ///< of regions that could be exported, sorted
};

/// Error: as for reading the scan's regions or key frames.
[[nodiscard]] Result<ExportPreview> previewExport(LabeledScan& scan, const ExportOptions& options);

/// Writes `scan` to `options.folder` atomically: into `FOLDER.part-XXXXXX` beside it, which is renamed when
/// all files are complete. A data set of the same format that is there already is replaced, as far as nobody
/// has changed it (ExportRecord). An unreadable or unfit key frame is skipped and named in the summary.
/// `progress` is called on this thread, and `cancel` checked, before each step. Error: a folder with anything
/// else; nothing to export; every key frame unusable; the scan's map unreadable; a full or read-only disk
/// (names the path and the remedy); cancelled. Nothing is left behind then.
[[nodiscard]] Result<ExportSummary> exportDataset(LabeledScan& scan, const ExportOptions& options,
                                                  const ExportProgressCallback& progress = {},
                                                  const std::stop_token& cancel = {});

}  // namespace scantrove
