#include "core/scan/scan_parts.h"

#include <utility>

namespace scantrove {

PoseUse ScanParts::poseUse() const {
  if (takesGivenPoses()) return PoseUse::given;
  const SourceInfo& info = source->info();
  const bool are_by_device = info.has_poses && info.pose_origin == PoseOrigin::device;
  // They are of the camera in the room, in which a single object may turn.
  const bool are_used =
      request.poses == ScanRequest::Poses::automatic && are_by_device && !request.object.has_value();
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
  constexpr double kFilledByObject = 0.12;  // of the image, by a single object
  SCANTROVE_TRY(moveInto(
      map, MappingPipeline::create(*compute, {info.intrinsics, request.params, poseUse(), info.frame_count,
                                              request.object ? kFilledByObject : 1.0})));
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
