#pragma once
#include <Eigen/Core>
#include <functional>
#include <memory>

#include "core/base/result.h"
#include "core/capture/continued_source.h"
#include "core/capture/frame_source.h"
#include "core/capture/local_poses.h"
#include "core/compute/compute_context.h"
#include "core/fusion/sensor_fit.h"
#include "core/pipeline/mapping_pipeline.h"
#include "core/refinement/refinement_memory.h"
#include "core/scan/frame_counts.h"
#include "core/scan/scan_objects.h"
#include "core/scan/scan_output.h"
#include "core/scan/scan_request.h"
#include "core/session/session_recorder.h"

namespace scantrove {

/// The parts of a running scan.
struct ScanParts {
  ScanRequest request;                        ///< completed from the earlier scan
  std::function<void()> on_catalogue_events;  ///< called on another thread
  std::unique_ptr<FrameSource> source;
  DepthSensor sensor;                                      ///< for which automatic parameters were chosen
  ContinuedSource* continued = nullptr;                    ///< `source` if the scan continues with it
  LocalPoses* local_poses = nullptr;                       ///< `source` or inside it, if its poses are used
  Eigen::Vector3d origin_world = Eigen::Vector3d::Zero();  ///< of the map, in the recording's world
  std::unique_ptr<ScanOutput> output;                      ///< null: no results are written
  std::unique_ptr<ComputeContext> compute;
  std::unique_ptr<MappingPipeline> pipeline;
  std::unique_ptr<ScanObjects> objects;       ///< uses `pipeline`
  std::unique_ptr<SessionRecorder> recorder;  ///< null: no session
  RefinementMemory refinement;                ///< the position where it stops or stopped
  SavedObjectness objectness;                 ///< by this refinement or the stopped one that it continues
  FrameCounts earlier_frames;                 ///< of a session that is only refined
  bool keeps_earlier_scan = false;            ///< in the folder, until this scan has a usable frame

  /// The use of the recording's poses by `request`.
  [[nodiscard]] PoseUse poseUse() const;
  [[nodiscard]] bool takesGivenPoses() const { return request.poses == ScanRequest::Poses::given; }
  void setOrigin(const Eigen::Vector3d& origin);
  /// Replaces the map, if any, and the collector by new ones. Error: the catalogue cannot be read, or the
  /// device has no room; then nothing has changed. `give_up` receives the old map.
  [[nodiscard]] Result<void> makeMap(ObjectDatabase& database,
                                     const std::function<void(MappingPipeline&)>& give_up = {});
};

}  // namespace scantrove
