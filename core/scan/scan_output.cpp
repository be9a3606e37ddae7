#include "core/scan/scan_output.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <vector>

#include "core/base/first_error.h"
#include "core/compute/guarded.h"
#include "core/exchange/atomic_file.h"
#include "core/exchange/cloud_writer.h"
#include "core/exchange/label_map_writer.h"
#include "core/exchange/region_palette.h"
#include "core/exchange/trajectory_writer.h"
#include "core/scan/open_source.h"
#include "core/scan/report_json.h"

namespace scantrove {

ScanOutput::ScanOutput(std::filesystem::path folder)
    : folder_(std::move(folder)),
      final_labels_(folder_, [](const std::string& source) { return openSource(source, {}); }) {}

Result<std::unique_ptr<ScanOutput>> ScanOutput::create(const std::filesystem::path& folder, bool label_maps) {
  SCANTROVE_TRY(prepareOutputFolder(folder));
  SCANTROVE_TRY(checkReplaceable(
      folder, std::array{"trajectory.txt", "cloud.ply", "cloud.pcd", "labels.json", "report.json"}));
  std::unique_ptr<ScanOutput> output(new ScanOutput(folder));
  if (label_maps) {
    for (const char* part : {"segments", "labels", "labels-final"}) {
      SCANTROVE_TRY(prepareOutputFolder(folder / part));
    }
    output->label_images_ = std::make_unique<FrameLabelWriter>(folder, output->numbers_);
  }
  return output;
}

void ScanOutput::begin(const SavedScan& earlier) {
  for (const SavedFrame& frame : earlier.frames) {
    if (frame.isUsable()) trajectory_.push_back({frame.time_s, frame.T_world_camera});
  }
  final_labels_.begin(earlier);
}

void ScanOutput::restart() {
  trajectory_.clear();
  if (!label_images_) return;
  label_images_->discard();
  label_images_.reset();
  numbers_ = RegionNumbers();
  label_images_ = std::make_unique<FrameLabelWriter>(folder_, numbers_);
}

Result<void> ScanOutput::addFrame(const RgbdFrame& frame, const FrameResult& result) {
  if (!result.pose.usable()) return {};
  trajectory_.push_back({frame.timestamp_s, result.pose.T_world_camera});
  for (const LateFrame& late : result.late)
    trajectory_.push_back({late.timestamp_s, late.pose.T_world_camera});
  if (!label_images_) return {};
  return label_images_->add({frame.index, frame.depth, frame.meters_per_unit, result.segments,
                             result.view.regions, result.pose.T_world_camera, frame.intrinsics});
}

Result<void> ScanOutput::writeTrajectory() {
  return guarded("writing the trajectory", [&] {
    std::ranges::stable_sort(trajectory_, {}, &StampedPose::timestamp_s);
    Trajectory in_world = trajectory_;
    for (StampedPose& pose : in_world) pose.T_world_camera.translation() += origin_world_;
    return writeTumTrajectory(folder_ / "trajectory.txt", in_world);
  });
}

Result<void> ScanOutput::finish(MappingPipeline& pipeline, const Regions& regions, const ScanReport& report,
                                const FinalLabelImages::StoreRecord& store) {
  FirstError outcome;
  const auto attempt = [&](const std::string& activity, const auto& work) {
    outcome.note(guarded(activity, work));
  };
  attempt("writing the report", [&] { return writeReport(folder_ / "report.json", report); });
  const FrameLabelWriter::RenderView render = [&](const Eigen::Isometry3d& T,
                                                  const std::optional<Intrinsics>& of_frame) {
    return pipeline.readout().renderView(T, pipeline.workingIntrinsicsOf(of_frame));
  };
  if (label_images_) attempt("writing the label images", [&] { return label_images_->finish(render); });
  attempt("writing the labelled cloud", [&] { return writeCloud(pipeline, regions); });
  // Last, because it may read whole recordings again.
  const FinalLabelRecord own = label_images_ ? label_images_->written() : FinalLabelRecord();
  attempt("drawing the label images again",
          [&] { return final_labels_.redraw(own, numbers_, render, store); });
  return outcome.result();
}

LabelMapEntry ScanOutput::entryOf(RegionId region, const Regions& regions) const {
  LabelMapEntry entry;
  entry.region = region;
  entry.color = regionColor(region);
  const std::optional<std::uint32_t> number = numbers_.knownNumberOf(region);
  if (number && *number != region.value) entry.image_label = number;
  if (const auto found = regions.labels.find(region); found != regions.labels.end()) {
    entry.object = found->second.object;
    entry.name = found->second.name;
    entry.category = found->second.category;
    entry.confirmed = found->second.confirmed;
  }
  if (const auto found = regions.objectness.find(region); found != regions.objectness.end())
    entry.objectness = found->second;
  return entry;
}

Result<void> ScanOutput::writeCloud(MappingPipeline& pipeline, const Regions& regions) {
  LabeledCloud points;
  std::map<RegionId, LabelMapEntry> entries;
  FirstError outcome;
  const auto add = [&](const Eigen::Vector3f& p, RegionId region, bool is_estimated) {
    auto place = entries.find(region);
    if (place == entries.end()) place = entries.emplace(region, entryOf(region, regions)).first;
    const LabelMapEntry& entry = place->second;
    points.push_back({p.x(), p.y(), p.z(), entry.color[0], entry.color[1], entry.color[2], region.value,
                      static_cast<std::uint8_t>(is_estimated)});
  };
  const RegionTable& table = pipeline.labels().table();
  // If device or memory fails, the points read so far are written.
  outcome.note(guarded("reading out the labelled cloud", [&] {
    return pipeline.readout().forEachCloudPoint([&](const LabelPoint& point) {
      add({point.x, point.y, point.z}, table.regionOf(FragmentId{point.fragment}), false);
    });
  }));
  cloud_points_ = points.size();
  pipeline.labels().estimated().forEach([&](const Eigen::Vector3f& point, FragmentId fragment) {
    if (const RegionId region = table.regionOf(fragment)) add(point, region, true);
  });
  std::vector<LabelMapEntry> list;
  for (auto& [region, entry] : entries) list.push_back(std::move(entry));
  // Later edits of the session do not change these files, so they state their date.
  const std::string comment =
      std::string(kCloudComment) +
      " of the session as the scan ended; 'scantrove export' writes it with later edits";
  const auto attempt = [&](const std::string& activity, const auto& work) {
    outcome.note(guarded(activity, work));
  };
  attempt("writing the labelled cloud",
          [&] { return writePly(folder_ / "cloud.ply", points, origin_world_, comment); });
  attempt("writing the labelled cloud",
          [&] { return writePcd(folder_ / "cloud.pcd", points, origin_world_, comment); });
  attempt("writing the label map", [&] { return writeLabelMap(folder_ / "labels.json", list); });
  return outcome.result();
}

}  // namespace scantrove
