#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "core/scan/scan_request.h"

namespace scantrove {

/// The options that say what to scan and how; shared by all commands that scan.
struct ScanOptions {
  std::string source;
  int frames = 0;  ///< 0 = all
  int start = 0;
  int stride = 1;
  std::string poses = "tracked";
  std::string intrinsics;          ///< "fx,fy,cx,cy", or empty
  std::string color_registration;  ///< as parseColorRegistration() reads it; empty = the source's
  double depth_scale = 0;          ///< units per metre; 0 = the source's
  std::string config;
  std::vector<std::string> settings;
  std::string device;

  void addTo(CLI::App& command);
  /// Only which frames of the source, and what is known of its cameras.
  void addSourceTo(CLI::App& command);

  /// What they ask for; all but results and catalogue. Throws CLI::ValidationError (wrong usage) with what is
  /// wrong.
  [[nodiscard]] ScanRequest toRequest() const;
  /// The part of addSourceTo(). Throws likewise.
  [[nodiscard]] SourceOptions toSourceOptions() const;
};

inline constexpr const char* kSourceHelp =
    "a folder, an .oni file, 'camera', 'camera:URI', 'freenect' (a Kinect v1), 'demo', 'demo:room', "
    "'demo:wall',\n'demo:corridor'; a random scene: 'demo:room:SEED', and so tabletop, sweep, moving; "
    "':uneven' "
    "gives a\ndemo's surfaces bumps, ':drab' few colours, ':exact' takes the noise away";

/// The parameters after `config` (none when empty), then `settings`. Throws CLI::ValidationError.
[[nodiscard]] ScanParams paramsFrom(const std::string& config, const std::vector<std::string>& settings);

}  // namespace scantrove
