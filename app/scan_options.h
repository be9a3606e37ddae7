#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "core/scan/scan_request.h"

namespace scantrove {

/// Options for source and scan, shared by all commands that scan.
struct ScanOptions {
  std::string source;
  int frames = 0;  ///< 0 = all
  int start = 0;
  int stride = 1;
  int loops = 1;
  std::string poses = "auto";
  std::string intrinsics;                ///< "fx,fy,cx,cy", or empty
  std::string color_registration;        ///< format of parseColorRegistration(); empty = from the source
  double depth_scale = 0;                ///< units per metre; 0 = from the source
  std::string depth_topic, color_topic;  ///< of a ROS recording; empty = the only fitting pair
  std::string config;
  std::vector<std::string> settings;
  std::string device;

  void addTo(CLI::App& command);
  /// Adds only the options for frames and cameras of the source.
  void addSourceTo(CLI::App& command);

  /// The request without results and catalogue. Throws CLI::ValidationError (wrong usage).
  [[nodiscard]] ScanRequest toRequest() const;
  /// The options of addSourceTo(). Throws CLI::ValidationError.
  [[nodiscard]] SourceOptions toSourceOptions() const;
};

inline constexpr const char* kSourceHelp =
    "a folder, a file (.oni, .r3d, .sens; ROS and RealSense .bag, .db3, .mcap; Azure Kinect and Femto "
    ".mkv),\n"
    "'camera', 'camera:URI', 'freenect' (Kinect v1), 'realsense' (series D400),\n"
    "'record3d' (iPhone on USB), 'demo', 'demo:room',\n"
    "'demo:wall', 'demo:corridor', or a random scene: 'demo:room:SEED' (also tabletop, sweep, moving,\n"
    "hands, turntable). A demo may end with ':uneven' (bumpy surfaces), ':drab' (low contrast), ':exact' (no "
    "noise),\n"
    "':phone' (a telephone's camera), ':device' (poses of a phone that tracks itself) or, tabletop and "
    "room,\n"
    "with ':hard' (a camera that fails as real ones do)";

/// The parameters after `config` (none when empty), then `settings`. Throws CLI::ValidationError.
[[nodiscard]] ScanParams paramsFrom(const std::string& config, const std::vector<std::string>& settings);

}  // namespace scantrove
