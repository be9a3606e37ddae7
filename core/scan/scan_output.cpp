#include "core/scan/scan_output.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <numeric>
#include <opencv2/core.hpp>

#include "core/exchange/atomic_file.h"
#include "core/exchange/cloud_writer.h"
#include "core/exchange/label_image_writer.h"
#include "core/exchange/label_map_writer.h"
#include "core/exchange/region_palette.h"
#include "core/exchange/trajectory_writer.h"
#include "core/scan/report_json.h"
#include "core/segmentation/upsample_segments.h"

namespace scantrove {
namespace {

std::string labelFileName(int frame_index) {
  char name[24];
  std::snprintf(name, sizeof(name), "%06d.png", frame_index);
  return name;
}

}  // namespace

Result<std::unique_ptr<ScanOutput>> ScanOutput::create(const std::filesystem::path& folder, bool label_maps) {
  SCANTROVE_TRY(prepareOutputFolder(folder));
  SCANTROVE_TRY(checkReplaceable(
      folder, std::array{"trajectory.txt", "cloud.ply", "cloud.pcd", "labels.json", "report.json"}));
  if (label_maps) {
    for (const char* part : {"segments", "labels", "labels-final"}) {
      SCANTROVE_TRY(prepareOutputFolder(folder / part));
    }
  }
  return std::unique_ptr<ScanOutput>(new ScanOutput(folder, label_maps));
}

Result<void> ScanOutput::addFrame(const RgbdFrame& frame, const FrameResult& result) {
  if (!result.pose.usable()) return {};
  trajectory_.push_back({frame.timestamp_s, result.pose.T_world_camera});
  if (!label_maps_) return {};
  const std::string name = labelFileName(frame.index);
  const cv::Size size = frame.depth.size();
  const SegmentMap& segments = result.segments;
  const auto atInputResolution = [&](std::span<const std::uint32_t> ids) {
    const auto* depth = frame.depth.ptr<std::uint16_t>();
    return upsampleByDepth(ids, segments.depths_m, segments.width, segments.height,
                           {size.width, size.height, {depth, frame.depth.total()}, frame.metres_per_unit});
  };
  SCANTROVE_TRY(writeLabelImage(folder_ / "segments" / name, atInputResolution(segments.ids), size.width,
                                size.height, size));
  SCANTROVE_TRY(writeLabelImage(folder_ / "labels" / name,
                                numbers_.numbersOf(atInputResolution(result.regions.regions)), size.width,
                                size.height, size));
  label_files_.emplace_back(name);
  return {};
}

Result<void> ScanOutput::finish(ScanPipeline& pipeline, const ScanReport& report) {
  SCANTROVE_TRY(writeTumTrajectory(folder_ / "trajectory.txt", trajectory_));
  SCANTROVE_TRY(writeFinalLabels(pipeline.labelTable()));
  SCANTROVE_TRY(writeCloud(pipeline));
  return writeReport(folder_ / "report.json", report);
}

Result<void> ScanOutput::writeFinalLabels(const LabelTable& table) {
  for (const std::filesystem::path& name : label_files_) {
    Result<cv::Mat> image = readLabelImage(folder_ / "labels" / name);
    if (!image) return fail(image.error());
    std::vector<std::uint32_t> final_numbers;
    final_numbers.reserve(image->total());
    std::for_each(image->begin<std::uint16_t>(), image->end<std::uint16_t>(), [&](std::uint16_t number) {
      final_numbers.push_back(numbers_.numberOf(table.regionOf(numbers_.regionOf(number)).value));
    });
    SCANTROVE_TRY(writeLabelImage(folder_ / "labels-final" / name, final_numbers, image->cols, image->rows,
                                  image->size()));
  }
  return {};
}

Result<void> ScanOutput::writeCloud(ScanPipeline& pipeline) {
  std::vector<cl_int> slots(static_cast<std::size_t>(pipeline.bricks().brickCount()));
  std::iota(slots.begin(), slots.end(), 0);
  const LabelCloud::Extract extract = pipeline.extractCloud(slots);
  std::vector<LabeledPoint> points;
  points.reserve(extract.points.size());
  std::map<std::uint32_t, LabelMapEntry> entries;  // by number
  for (const LabelPoint& point : extract.points) {
    const RegionId region = pipeline.labelTable().regionOf(point.label);
    const std::uint32_t number = numbers_.numberOf(region.value);
    LabelMapEntry& entry = entries[number];
    if (!entry.region) {
      entry.region = RegionId{number};
      entry.color = regionColor(entry.region);
      if (const ObjectCollector* collector = pipeline.collector()) {
        entry.object = collector->objectOf(region);
        if (const ObjectRecord* record = collector->record(entry.object)) entry.name = record->name;
      }
    }
    points.push_back({point.x, point.y, point.z, entry.color[0], entry.color[1], entry.color[2], number});
  }
  SCANTROVE_TRY(writePly(folder_ / "cloud.ply", points));
  SCANTROVE_TRY(writePcd(folder_ / "cloud.pcd", points));
  std::vector<LabelMapEntry> list;
  for (auto& [number, entry] : entries) list.push_back(std::move(entry));
  return writeLabelMap(folder_ / "labels.json", list);
}

}  // namespace scantrove
