#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/base/ids.h"
#include "core/base/stage_timer.h"
#include "core/collection/collected_object.h"
#include "core/fusion/sensor_fit.h"
#include "core/scan/frame_counts.h"
#include "core/session/scan_params.h"

namespace scantrove {

/// The drift of the map, as measured when the camera revisited a place.
struct MapDrift {
  /// Frames at a revisited place whose poses were corrected, and by how much.
  int corrected_frames = 0;
  double most_corrected_m = 0;
  /// Relocalisations of such a place by landmarks, and the greatest distance found.
  int revisited_key_frames = 0;
  double most_m = 0;
  /// Frames in which the pose of a device that tracks itself jumped and was not believed.
  int device_jumps = 0;
};

/// The results of a scan. It has more than twenty fields, one for each entry of report.json.
struct ScanReport {
  std::string source;
  std::string device;
  ScanParams params;
  FrameCounts frames;
  std::vector<int> lost_frames;  ///< RgbdFrame::index
  MapDrift drift;
  std::vector<std::string> advice;                     ///< sentences about the scan as a whole
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();  ///< of positions here, in the recording's world
  double fps = 0;  ///< processed frames / wall time of processing, including decoding
  double frame_median_ms = 0;
  double frame_p95_ms = 0;
  struct Stage {
    std::string name;
    double median_ms = 0;
    double p95_ms = 0;
  };
  std::vector<Stage> stages;
  std::vector<SlowFrame> slowest_frames;  ///< slowest first
  struct Kernel {
    std::string name;
    double mean_ms = 0;  ///< per frame, on the device
  };
  std::vector<Kernel> kernels;  ///< most expensive first; empty unless profiled
  double peak_memory_mb = 0;
  DepthSensor sensor;  ///< for which automatic parameters were chosen; `params` has the chosen ones
  int map_bricks = 0;
  double map_megabytes = 0;              ///< device memory, MiB
  double map_disk_megabytes = 0;         ///< of the part on disk, compressed, MiB
  int regions = 0;                       ///< of at least kSmallFragmentVoxels voxels
  int small_fragments = 0;               ///< smaller ones
  std::vector<CollectedObject> objects;  ///< observed in this scan
  struct Refinement {
    double seconds = 0;
    int key_frames = 0;    ///< used by it
    bool skipped = false;  ///< some or all of it is postponed
  };
  Refinement refinement;  ///< the pass after the last frame
  /// Refined later: an earlier report has the frames, their times and the device.
  bool is_of_refinement = false;
};

}  // namespace scantrove
