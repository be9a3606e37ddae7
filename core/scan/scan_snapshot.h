#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "core/base/ids.h"
#include "core/capture/intrinsics.h"
#include "core/collection/seen_object.h"
#include "core/discovery/region_set.h"
#include "core/editing/frame_review.h"
#include "core/fusion/fusion_params.h"
#include "core/scan/frame_counts.h"
#include "core/scan/packed_surface.h"
#include "core/scan/region_info.h"
#include "core/scan/scan_state.h"
#include "core/tracking/pose_estimate.h"

namespace scantrove {

/// The points of one brick of the label cloud, with a version that grows with each change of the brick.
struct CloudBrick {
  struct Point {
    float x, y, z;        ///< the voxel's centre; world, metres
    FragmentId fragment;  ///< gives the region through all ScanSnapshot::changed_regions so far
    PackedColor color{};  ///< the scene's colour
    std::int8_t height =
        0;  ///< of the voxel's centre over the surface, along the normal; kHeightSteps = a voxel
    PackedNormal normal{};  ///< out of the surface; none: unknown, or estimated surface

    static constexpr float kHeightSteps = 100;
    [[nodiscard]] Eigen::Vector3f center() const { return {x, y, z}; }
    /// The surface point.
    [[nodiscard]] Eigen::Vector3f onSurface(float voxel_size_m) const {
      return center() - voxel_size_m * static_cast<float>(height) / kHeightSteps * normal.unpacked();
    }
  };
  Eigen::Vector3i position;  ///< in units of bricks
  std::uint64_t version = 0;
  std::vector<Point> points;  ///< replaces all earlier points of this brick
  bool by_person = false;     ///< changed by a user, who waits to see it
};

/// The new region of a fragment; none: it has no voxels any more.
struct RegionChange {
  FragmentId fragment;
  RegionId region;
  bool by_person = false;  ///< changed by a user, who waits to see it
};

/// What the window shows: one immutable value, made by the worker and taken from the mailbox by the window.
/// Snapshots may be skipped: `changed_bricks` and `changed_regions` of a skipped one are carried over into
/// the next. It has more than twenty fields, because all parts of the window must show the same frame.
struct ScanSnapshot {
  ScanState state = ScanState::idle;
  int frame_index = -1;  ///< of the source
  FrameCounts frames;
  int frames_total = 0;  ///< of the recording; 0 = unknown (live)
  PoseEstimate pose;
  Intrinsics K;                                               ///< of the frame, at the working resolution
  std::shared_ptr<const std::vector<Eigen::Vector3f>> trail;  ///< camera centres so far, world

  // Panels. Shared images that are not modified any more; any may be empty.
  cv::Mat color;          ///< CV_8UC3 BGR, as recorded; of an earlier frame if this one has none
  cv::Mat last_seen;      ///< colour of the last frame with a pose while tracking is lost; else empty
  cv::Mat depth_raw_m;    ///< CV_32FC1 metres, 0 = none, working resolution
  cv::Mat depth_fused_m;  ///< CV_32FC1 metres, 0 = none, working resolution: V_t's camera depth
  cv::Mat segments;       ///< CV_32SC1, S_t ids, working resolution
  cv::Mat regions;        ///< CV_32SC1, S_cloud,t region ids, working resolution
  std::vector<SeenObject> objects;
  cv::Mat color_places;  ///< SurfaceInColor::places: position of each pixel of `regions` in `color`; empty:
                         ///< the same fractions of width and height

  std::shared_ptr<const RegionInfos> region_infos;               ///< of the whole map; null: none yet
  std::shared_ptr<const std::vector<DoneOperation>> operations;  ///< the whole log; null: none yet
  /// During review: the session's key frames by their numbers in the source, and the index of the one in
  /// the panels (-1: none).
  std::shared_ptr<const std::vector<int>> key_frames;
  int shown_key_frame = -1;
  std::shared_ptr<const std::vector<FrameReview>> reviews;  ///< of each of `key_frames`; null like these

  std::vector<CloudBrick> changed_bricks;
  std::vector<RegionChange> changed_regions;  ///< the last of several for one fragment counts

  struct StageTime {
    std::string name;
    double ms = 0;
  };
  std::vector<StageTime> stage_times;
  double fps = 0;                                    ///< over the last second of processing
  float voxel_size_m = FusionParams{}.voxel_size_m;  ///< of the map
  int map_bricks = 0;
  double map_megabytes = 0;
  int region_count = 0;
};

}  // namespace scantrove
