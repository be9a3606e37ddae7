#include "core/dataset/dataset_export.h"

#include <algorithm>
#include <array>
#include <exception>
#include <opencv2/core.hpp>
#include <set>
#include <utility>

#include "core/dataset/centered_mesh.h"
#include "core/dataset/dataset_formats.h"
#include "core/dataset/dataset_readme.h"
#include "core/dataset/export_scans.h"
#include "core/dataset/frame_choice.h"
#include "core/dataset/project_export.h"
#include "core/dataset/region_choice.h"
#include "core/dataset/scan_list.h"
#include "core/dataset/staged_folder.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

using WriteFormat = Result<void> (*)(ExportJob&);

/// In the order of the enumeration.
constexpr std::array<WriteFormat, 13> kWriters{
    exportCoco,        exportBop,   exportYolo,           exportMasks,    exportVoc,
    exportLabelStudio, exportBoxes, exportFoundationPose, exportPlyCloud, exportPcdCloud,
    exportMesh,        exportTum,   exportScannet};

/// What to write, and whom to tell about it.
struct ExportTask {
  const ExportOptions& options;
  WriteFormat write;
  const ExportProgressCallback& progress;
  const std::stop_token& cancel;
};

/// Writes a format that knows one scan: in a project, into a folder for each.
Result<void> writeApart(ExportJob& job, WriteFormat write) {
  SCANTROVE_TRY(job.forEachScan([&] {
    job.setFolder(job.part().folder());
    return write(job);
  }));
  job.setFolder({});
  return {};
}

Result<ExportSummary> exportInto(ExportScans scans, const ExportTask& task, const fs::path& folder) {
  ExportJob job(std::move(scans), task.options, folder, task.progress, task.cancel);
  SCANTROVE_TRY(job.readRegions());
  SCANTROVE_TRY(joinsScans(task.options.format) ? task.write(job) : writeApart(job, task.write));
  if (job.scans().isProject() && hasImages(task.options.format) && job.summary().images == 0) {
    return fail("No key frame of the project " + job.scans().title() + " can be used: there are no images.",
                job.summary().unfit > 0 ? "Export unfit frames, too (--include-unfit-frames)." : "");
  }
  SCANTROVE_TRY(writeScanList(job));
  SCANTROVE_TRY(writeReadme(job));
  if (task.options.dry_run) return std::move(job.summary());
  SCANTROVE_TRY(job.step(1, 1, "checking files"));
  SCANTROVE_TRY(job.checkFiles());
  SCANTROVE_TRY(job.writeRecord());
  SCANTROVE_TRY(job.step(1, 1, "done"));
  return std::move(job.summary());
}

/// Turns exceptions of libraries into errors. `place`: the folder that the user knows.
Result<ExportSummary> exportGuarded(ExportScans scans, const ExportTask& task, const fs::path& folder,
                                    const fs::path& place) {
  try {
    return exportInto(std::move(scans), task, folder);
  } catch (const std::bad_alloc&) {
    return fail("There is not enough memory to export to " + place.string() + ".",
                "Close other programs, or export key frames only.");
  } catch (const std::exception& error) {
    return fail("The export to " + place.string() + " failed: " + error.what() + ".");
  }
}

/// Writes into a folder that is created atomically; a dry run writes nothing.
Result<ExportSummary> exportWith(ExportScans scans, const ExportTask& task) {
  const ExportOptions& options = task.options;
  if (options.dry_run) return exportGuarded(std::move(scans), task, options.folder, options.folder);
  const std::string& format = datasetFormatNames().at(static_cast<std::size_t>(options.format));
  auto folder = StagedFolder::createOver(options.folder, format);
  if (!folder) return fail(folder.error());
  auto summary = exportGuarded(std::move(scans), task, folder->path(), folder->place());
  if (!summary) return fail(folder->inFinalWords(summary.error()));
  if (auto committed = folder->commit(); !committed) return fail(folder->inFinalWords(committed.error()));
  summary->folder = folder->place();
  if (!folder->leftOver().empty()) {
    summary->notes.push_back("Something was put into " + folder->place().string() +
                             " while the export ran. It is in " + folder->leftOver().string() + ".");
  }
  return summary;
}

/// The estimated bytes of a frame in a data set of `objects` objects.
double bytesOfImage(const KeyFrameInfo& frame, DatasetFormat format, int objects) {
  constexpr double kDepthBytes = 1.2, kColorBytes = 1.5, kMaskBytes = 0.01;  // per pixel, compressed
  constexpr double kObjectsInView = 0.3;  // part of a scan's objects that a frame shows
  const double pixels = frame.color_file.empty() ? frame.K_depth.pixels() : frame.K_color.pixels();
  if (format == DatasetFormat::foundationpose) {
    const double copies = std::max(1.0, kObjectsInView * objects);
    return copies * pixels * (kColorBytes + kDepthBytes + kMaskBytes);
  }
  std::error_code failure;
  const std::uintmax_t size =
      frame.color_file.empty() ? 0 : std::filesystem::file_size(frame.color_file, failure);
  const bool has_depth = format == DatasetFormat::bop || format == DatasetFormat::boxes;
  return (failure ? 0 : static_cast<double>(size)) + pixels * (has_depth ? kDepthBytes : kMaskBytes);
}

}  // namespace

const std::vector<std::string>& datasetFormatNames() {
  static const std::vector<std::string> kNames{"coco",        "bop",   "yolo",           "masks", "voc",
                                               "labelstudio", "boxes", "foundationpose", "ply",   "pcd",
                                               "mesh",        "tum",   "scannet"};
  return kNames;
}

bool hasImages(DatasetFormat format) { return format <= DatasetFormat::foundationpose; }

bool hasIgnoreRegions(DatasetFormat format) {
  return format == DatasetFormat::coco || format == DatasetFormat::masks || format == DatasetFormat::voc;
}

bool joinsScans(DatasetFormat format) { return format <= DatasetFormat::labelstudio; }

Result<DatasetFormat> parseDatasetFormat(std::string_view name) {
  const auto& names = datasetFormatNames();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<DatasetFormat>(found - names.begin());
  std::string all;
  for (const std::string& known : names) all += (all.empty() ? "" : ", ") + known;
  return fail("There is no format called '" + std::string(name) + "'.", "Formats: " + all + ".");
}

Result<ExportPreview> previewExport(LabeledScan& scan, const ExportOptions& options) {
  const auto regions = scan.regions();
  if (!regions) return fail(regions.error());
  const auto choice = chooseFrames(scan, options);
  if (!choice) return fail(choice.error());
  const std::vector<KeyFrameInfo>* const frames = &choice->frames;
  ExportPreview preview;
  preview.regions =
      static_cast<int>(chooseRegions(*regions, options.background, options.choices).exported.size());
  ExportChoices of_any_class = options.choices;
  of_any_class.classes.clear();
  std::set<std::string> classes;
  for (const LabeledRegion& region : chooseRegions(*regions, options.background, of_any_class).exported)
    classes.insert(classOf(region));
  preview.classes.assign(classes.begin(), classes.end());
  double voxels = 0;
  for (const LabeledRegion& region : *regions) voxels += region.voxels;
  if (!hasImages(options.format)) {
    // Bytes per voxel of a surface (the three files of a mesh have two faces per voxel), and per pose.
    constexpr double kCloudBytes = 30, kMeshBytes = 300, kPoseBytes = 90;
    const bool is_cloud = options.format == DatasetFormat::ply || options.format == DatasetFormat::pcd;
    const double bytes = options.format == DatasetFormat::tum
                             ? kPoseBytes * static_cast<double>(frames->size())
                             : voxels * (is_cloud ? kCloudBytes : kMeshBytes);
    // PNG and GLB hold the texture of the scene, objects about a third of it once more.
    constexpr double kTexelBytes = 2 * 1.3 * 2;
    const double texels = options.format == DatasetFormat::mesh
                              ? static_cast<double>(options.texture_size_px) * options.texture_size_px
                              : 0;
    preview.megabytes = (bytes + kTexelBytes * texels) / 1e6;
    return preview;
  }
  for (const KeyFrameInfo& frame : *frames) {
    if (frame.color_file.empty() && options.format != DatasetFormat::masks) continue;
    ++preview.images;
    preview.megabytes += bytesOfImage(frame, options.format, preview.regions) / 1e6;
  }
  return preview;
}

Result<ExportSummary> exportDataset(LabeledScan& scan, const ExportOptions& options,
                                    const ExportProgressCallback& progress, const std::stop_token& cancel) {
  const WriteFormat write = kWriters.at(static_cast<std::size_t>(options.format));
  return exportWith(ExportScans(scan), {options, write, progress, cancel});
}

Result<ExportSummary> exportProject(ProjectToExport project, const ExportOptions& options,
                                    const ExportProgressCallback& progress, const std::stop_token& cancel) {
  const WriteFormat write = kWriters.at(static_cast<std::size_t>(options.format));
  return exportWith(ExportScans(std::move(project)), {options, write, progress, cancel});
}

Result<ExportSummary> exportCenteredMesh(LabeledScan& scan, const ExportOptions& options,
                                         const ExportProgressCallback& progress,
                                         const std::stop_token& cancel) {
  return exportWith(ExportScans(scan), {options, exportCenteredObjects, progress, cancel});
}

}  // namespace scantrove
