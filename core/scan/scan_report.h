#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/base/ids.h"
#include "core/base/stage_timer.h"
#include "core/collection/collected_object.h"
#include "core/scan/frame_counts.h"
#include "core/session/scan_params.h"

namespace scantrove {

/// How far the map has drifted, as far as the camera came back to where it had been.
struct MapDrift {
  /// Frames at a place seen before, whose poses were corrected by what was seen there then, and by how much.
  int corrected_frames = 0;
  double most_corrected_m = 0;
  /// Times that such a place was known again by its landmarks, and how far apart they lay at most.
  int revisited_key_frames = 0;
  double most_m = 0;
};

/// What came out of a scan; written as report.json.
struct ScanReport {
  std::string source;
  std::string device;
  ScanParams params;
  FrameCounts frames;
  std::vector<int> lost_frames;  ///< RgbdFrame::index
  MapDrift drift;
  std::vector<std::string> advice;                     ///< sentences about the scan as a whole
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();  ///< in the recording's world; places here are relative
  double fps = 0;  ///< frames processed / wall time of processing, decoding included
  double frame_median_ms = 0;
  double frame_p95_ms = 0;
  struct Stage {
    std::string name;
    double median_ms = 0;
    double p95_ms = 0;
  };
  std::vector<Stage> stages;
  std::vector<SlowFrame> slowest_frames;  ///< the slowest first
  struct Kernel {
    std::string name;
    double mean_ms = 0;  ///< a frame, on the device
  };
  std::vector<Kernel> kernels;  ///< the dearest first; empty unless profiled
  double peak_memory_mb = 0;
  int map_bricks = 0;
  double map_megabytes = 0;              ///< device memory, MiB
  double map_disk_megabytes = 0;         ///< of the part that is on disk, compressed, MiB
  int regions = 0;                       ///< of at least kSmallFragmentVoxels voxels
  int small_fragments = 0;               ///< smaller ones
  std::vector<CollectedObject> objects;  ///< observed in this scan
  struct Refinement {
    double seconds = 0;
    int key_frames = 0;    ///< that it uses
    bool skipped = false;  ///< some or all of it is left for later
  };
  Refinement refinement;  ///< the pass after the last frame
  /// It came later: of the frames, their times and the device an earlier report tells.
  bool is_of_refinement = false;
};

}  // namespace scantrove
