#include "core/scan/scan_parts.h"

#include <utility>

namespace scantrove {

PoseUse ScanParts::poseUse() const {
  if (takesGivenPoses()) return PoseUse::given;
  const SourceInfo& info = source->info();
  const bool are_by_device = info.has_poses && info.pose_origin == PoseOrigin::device;
  const bool are_used = request.poses == ScanRequest::Poses::automatic && are_by_device;
  return are_used ? PoseUse::predicted : PoseUse::none;
}

void ScanParts::setOrigin(const Eigen::Vector3d& origin) {
  origin_world = origin;
  if (output) output->setOrigin(origin);
}

Result<void> ScanParts::makeMap(ObjectDatabase& database,
                                const std::function<void(MappingPipeline&)>& give_up) {
  const SourceInfo& info = source->info();
  std::unique_ptr<MappingPipeline> map;
  SCANTROVE_TRY(moveInto(map, MappingPipeline::create(
                                  *compute, {info.intrinsics, request.params, poseUse(), info.frame_count})));
  CatalogueWriter::Options catalogue;
  catalogue.database = request.database;
  catalogue.source = info.name;
  catalogue.camera = info.intrinsics;
  catalogue.on_events = on_catalogue_events;
  catalogue.patience = request.catalogue_patience;
  std::unique_ptr<ObjectCollector> collector;
  SCANTROVE_TRY(moveInto(collector, ObjectCollector::create(*compute, database, catalogue,
                                                            request.params.detection, refinement.collector)));
  if (pipeline && give_up) give_up(*pipeline);
  objects = std::make_unique<ScanObjects>(*map, std::move(collector));
  pipeline = std::move(map);
  return {};
}

}  // namespace scantrove
